//! Computed torque: a four-bar whose crank follows a planned motion, by the emitted `M` and `h` of its equation of motion `τ = M q̈ + h`.
//!
//! The crank begins with an error of position and of speed. The controller asks for the acceleration
//! `a = q̈_d + k_v (q̇_d − q̇) + k_p (q_d − q)` and applies `τ = M a + h`: what is left of the error dies away like that of a damped
//! spring, whatever the pose. The linkage is simulated by its forward dynamics, in small fixed steps; at the end the work of torque, damper
//! and working load is held against the change of kinetic and potential energy.

use linkage_runtime::{Error, linkage};

linkage! {
    /// A crank-rocker with weights, a working load on its rocker and a damper at its coupler.
    pub mod four_bar;

    ground       { A0: (0, 0), B0: (0.14m, 0) }
    link crank   { A0 -> A: 0.04m, G: (0.015m, 0) }
    link coupler { A -> B: 0.12m, G: (0.055m, 0.02m) }
    link rocker  { B0 -> B: 0.08m, G: (0.045m, 0) }

    mass crank:   0.8kg at G, inertia 400kg*mm^2;
    mass coupler: 1.2kg at G, inertia 1900kg*mm^2;
    mass rocker:  0.7kg at G, inertia 900kg*mm^2;

    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;

    drive theta: A0;
    assemble B: left(A -> B0);

    load W: gravity = 9.81m/s^2 @ -90deg;
    load D: spring(ground.B0, coupler.G) { damping: 20N*s/m };
    load M4: moment(rocker) = -0.8N*m;

    scene control: motion(W, D, M4);                        // M, h, and the acceleration under a torque
    scene powers:  virtual_work(D, M4) -> (D, M4);          // work of damper and load for unit rate of the crank
    scene centres: position -> (crank.G, coupler.G, rocker.G);
}

/// The planned motion: a third of a turn and back, smoothly, once a second.
fn planned(time: f64) -> [f64; 3] {
    let (middle, swing, omega) = (1.4, 1.05, core::f64::consts::TAU);
    let (sin, cos) = (omega * time).sin_cos();
    [middle - swing * cos, swing * omega * sin, swing * omega * omega * cos]
}

/// Position and rate of the crank, and the work done so far: of the torque, of damper and load.
#[derive(Clone, Copy)]
struct State {
    theta: f64,
    rate: f64,
    driven: f64,
    loaded: f64,
}

impl State {
    /// What changes a state, times a step.
    fn plus(self, change: Self, step: f64) -> Self {
        Self {
            theta: self.theta + step * change.theta,
            rate: self.rate + step * change.rate,
            driven: self.driven + step * change.driven,
            loaded: self.loaded + step * change.loaded,
        }
    }

    /// The torque that the controller applies.
    fn torque(self, time: f64) -> Result<f64, Error> {
        const STIFFNESS: f64 = 400.0;
        const DAMPING: f64 = 40.0;
        let [theta, rate, acceleration] = planned(time);
        let motion = four_bar::Motion { theta_rate: self.rate };
        let model = four_bar::control_at(self.theta, &motion)?;
        let wanted = acceleration + DAMPING * (rate - self.rate) + STIFFNESS * (theta - self.theta);
        Ok(model.M * wanted + model.h)
    }

    /// How it changes under a torque.
    fn change(self, torque: f64) -> Result<Self, Error> {
        let motion = four_bar::Motion { theta_rate: self.rate };
        let pose = four_bar::Pose::at(self.theta)?;
        let powers = pose.powers(&motion)?;
        Ok(Self {
            theta: self.rate,
            rate: pose.control(&motion)?.acceleration(torque)?,
            driven: torque * self.rate,
            loaded: (powers.D.work + powers.M4.work) * self.rate,
        })
    }

    /// A step by the rule of Runge and Kutta, at a torque that holds for its length.
    fn step(self, torque: f64, step: f64) -> Result<Self, Error> {
        let first = self.change(torque)?;
        let second = self.plus(first, step / 2.0).change(torque)?;
        let third = self.plus(second, step / 2.0).change(torque)?;
        let fourth = self.plus(third, step).change(torque)?;
        let outer = self.plus(first, step / 6.0).plus(fourth, step / 6.0);
        Ok(outer.plus(second, step / 3.0).plus(third, step / 3.0))
    }

    /// Kinetic energy `½ M q̇²` and potential energy `Σ m g y`.
    fn energies(self) -> Result<[f64; 2], Error> {
        let mass = four_bar::control_at(self.theta, &four_bar::Motion { theta_rate: self.rate })?.M;
        let centres = four_bar::centres_at(self.theta)?;
        let heights = 0.8 * centres.crank_G.y + 1.2 * centres.coupler_G.y + 0.7 * centres.rocker_G.y;
        Ok([0.5 * mass * self.rate * self.rate, 9.81 * heights])
    }
}

fn main() -> Result<(), Error> {
    const STEPS: u32 = 4000;
    const STEP: f64 = 1.0 / 4000.0;
    let [theta, rate, _] = planned(0.0);
    let begin = State { theta: theta + 0.15, rate: rate - 1.0, driven: 0.0, loaded: 0.0 };
    let mut state = begin;
    println!(
        "{:>8} {:>10} {:>12} {:>12} {:>12} {:>10}",
        "time/s", "theta/rad", "error/rad", "rate/(rad/s)", "torque/(N·m)", "M/(kg·m²)"
    );
    for step in 0..=STEPS {
        let time = f64::from(step) * STEP;
        let torque = state.torque(time)?;
        if step % 250 == 0 {
            let mass = four_bar::control_at(state.theta, &four_bar::Motion { theta_rate: state.rate })?.M;
            let error = state.theta - planned(time)[0];
            println!(
                "{time:>8.4} {:>10.5} {error:>12.2e} {:>12.4} {torque:>12.4} {mass:>10.6}",
                state.theta, state.rate
            );
        }
        if step < STEPS {
            state = state.step(torque, STEP)?;
        }
    }
    let ([kinetic, potential], [first_kinetic, first_potential]) = (state.energies()?, begin.energies()?);
    let (kinetic, potential) = (kinetic - first_kinetic, potential - first_potential);
    println!("\nenergy over {} s, J", f64::from(STEPS) * STEP);
    println!("  work of the torque            {:>12.8}", state.driven);
    println!("  work of damper and load       {:>12.8}", state.loaded);
    println!("  change of kinetic energy      {kinetic:>12.8}");
    println!("  change of potential energy    {potential:>12.8}");
    let open = state.driven + state.loaded - kinetic - potential;
    println!("  balance                       {open:>12.1e}");
    let size = state.driven.abs() + state.loaded.abs() + kinetic.abs() + potential.abs();
    assert!(open.abs() < 1e-9 * size, "the balance of energy is open by {open:e} of {size:e}");
    assert!((state.theta - planned(f64::from(STEPS) * STEP)[0]).abs() < 1e-3, "the crank does not follow");
    Ok(())
}
