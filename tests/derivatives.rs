//! Derivatives of scenes as a user has them: held against velocities, virtual work, differences, and in a sweep.

use linkage_runtime::{Error, Series, Vector2, linkage};

linkage! {
    /// A press whose rod has its length at run time.
    mod press;
    units { mm, N }
    param length: length = 130mm;
    ground      { O: (0, 0) }
    link crank  { O -> A: 40mm }
    link rod    { A -> B: length }
    link ram    { B }
    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute B: rod -> ram;
    prismatic S: ground.O -> ram.B along 10deg;
    drive theta: O;
    assemble B: ahead(A);
    load F: force(ram.B);
    scene held:   virtual_work -> (effort_theta);
    scene place:  position -> (B, rod.angle);
    scene speed:  velocity -> (B, rod.angle);
    scene slopes: derivative(held) by (theta, F, length);
    scene moved:  derivative(place) by (theta, length);
    scene cycle:  sweep(slopes);
}

const THETA: f64 = 0.7;

fn press(length: f64) -> Result<press::Linkage, Error> {
    press::Linkage::new(&press::Params { length })
}

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(1.0), "{found} and not {expected}");
}

#[test]
fn the_change_with_the_drive_is_the_velocity_at_unit_rate() -> Result<(), Error> {
    let linkage = press(130.0)?;
    let pose = press::Pose::at(&linkage, THETA)?;
    let moved = pose.moved()?.theta;
    let speed = pose.speed(&press::Motion { theta_rate: 1.0 })?;
    near(moved.B.x, speed.B.x, 1e-14);
    near(moved.B.y, speed.B.y, 1e-14);
    near(moved.rod_angle, speed.rod_angle, 1e-14);
    Ok(())
}

#[test]
fn the_change_with_a_load_is_what_it_works_on() -> Result<(), Error> {
    let linkage = press(130.0)?;
    let loads = press::Loads { F: Vector2::new(-300.0, 40.0) };
    let pose = press::Pose::at(&linkage, THETA)?;
    let (slopes, moved) = (pose.slopes(&loads)?, pose.moved()?.theta);
    near(slopes.F.x.effort_theta, -moved.B.x, 1e-14);
    near(slopes.F.y.effort_theta, -moved.B.y, 1e-14);
    let sum = loads.F.x * slopes.F.x.effort_theta + loads.F.y * slopes.F.y.effort_theta;
    near(sum, pose.held(&loads)?.effort_theta, 1e-13);
    Ok(())
}

#[test]
fn the_change_with_a_parameter_is_that_between_two_machines() -> Result<(), Error> {
    let loads = press::Loads { F: Vector2::new(-300.0, 40.0) };
    let step = 1e-3;
    let [shorter, longer] = [press(130.0 - step)?, press(130.0 + step)?];
    let linkage = press(130.0)?;
    let efforts =
        [&shorter, &longer].map(|linkage| press::held_at(linkage, THETA, &loads).map(|held| held.effort_theta));
    let [before, behind] = efforts;
    near(press::slopes_at(&linkage, THETA, &loads)?.length.effort_theta, (behind? - before?) / (2.0 * step), 1e-7);
    let [before, behind] = [press::place_at(&shorter, THETA)?, press::place_at(&longer, THETA)?];
    let moved = press::moved_at(&linkage, THETA)?.length;
    near(moved.B.x, (behind.B.x - before.B.x) / (2.0 * step), 1e-9);
    near(moved.B.y, (behind.B.y - before.B.y) / (2.0 * step), 1e-9);
    near(moved.rod_angle, (behind.rod_angle - before.rod_angle) / (2.0 * step), 1e-9);
    Ok(())
}

#[test]
fn derivatives_are_swept() -> Result<(), Error> {
    let linkage = press(130.0)?;
    let loads = press::Loads { F: Vector2::new(-300.0, 40.0) };
    let angles: [f64; 20] = core::array::from_fn(|step| 0.3 * f64::from(u8::try_from(step).expect("few")));
    let [mut by_theta, mut by_x, mut by_y, mut by_length] = [[0.0; 20]; 4];
    let inputs = press::CycleInputs { theta: Series::Each(&angles), F: Series::Constant(loads.F) };
    let results = press::Cycle {
        theta_effort_theta: &mut by_theta,
        F_x_effort_theta: &mut by_x,
        F_y_effort_theta: &mut by_y,
        length_effort_theta: &mut by_length,
    };
    press::cycle(&linkage, &inputs, results).expect("every position has an answer");
    for (index, angle) in angles.into_iter().enumerate() {
        let slopes = press::slopes_at(&linkage, angle, &loads)?;
        let swept = [by_theta[index], by_x[index], by_y[index], by_length[index]];
        let (theta, length) = (slopes.theta.effort_theta, slopes.length.effort_theta);
        let single = [theta, slopes.F.x.effort_theta, slopes.F.y.effort_theta, length];
        assert_eq!(swept.map(f64::to_bits), single.map(f64::to_bits), "at {angle}");
    }
    Ok(())
}
