//! A four-stroke engine at 3000 rpm: torque, bearing forces and the side force on the cylinder wall over two turns, with gas force,
//! weights and inertia; what the ground feels; and the flywheel for a wanted evenness.
//!
//! `cargo run --example engine` prints a table and writes `engine.csv` and `engine.svg` into the folder that it names; another folder
//! can be given behind `--`.
#![allow(clippy::cast_precision_loss, reason = "small whole numbers are exact")]

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use linkage_runtime::cycle::{Cycle, flywheel_inertia, peak};
use linkage_runtime::{Series, Vector2, linkage};

linkage! {
    /// Crank, connecting rod and piston of an upright engine.
    pub mod engine;

    units { mm, N }

    ground      { O: (0, 0) }
    link crank  { O -> A: 42mm }
    link rod    { A -> B: 142mm }
    link piston { B }

    mass crank:  3.2kg at (-4mm, 0), inertia 5600kg*mm^2;
    mass rod:    0.62kg at (45mm, 0), inertia 1900kg*mm^2;
    mass piston: 0.48kg at (12mm, 0);

    revolute O:  ground -> crank;
    revolute A:  crank  -> rod;
    revolute B:  rod    -> piston;
    prismatic S: ground.O -> piston.B along 90deg, angle 90deg;

    drive theta: O { rate: 3000rpm, acceleration: 0 };
    unknown T: torque(ground -> crank);
    assemble B: ahead(A);

    load gas: force(piston.B);
    load W: gravity = 9.80665m/s^2 @ -90deg;
    load I: inertia;

    scene forces: equilibrium -> (T, O, A, B, S, power, ground about ground.O);
    scene shakes: acceleration -> (shaking(ground.O));
    scene cycle:  sweep(forces);
    scene shaking: sweep(shakes);
}

/// Positions in two turns.
const COUNT: usize = 720;
/// Bore, mm.
const BORE: f64 = 86.0;

/// Pressure in the cylinder above that outside, N/mm², `turned` behind the upper dead centre at which the fuel burns: expansion and
/// compression by `p Vⁿ`, at a compression of 10; the pressures outside otherwise.
fn pressure(turned: f64) -> f64 {
    let (crank, rod): (f64, f64) = (42.0, 142.0);
    let height = |angle: f64| {
        let aside: f64 = crank * angle.sin();
        crank * angle.cos() + (rod * rod - aside * aside).sqrt()
    };
    let volume = (crank + rod - height(turned)) / (2.0 * crank) + 1.0 / 9.0;
    let (least, most): (f64, f64) = (1.0 / 9.0, 10.0 / 9.0);
    if turned < PI {
        // The pressure rises to its largest value over the first 20°.
        let burnt = (turned / 20f64.to_radians()).min(1.0);
        let compressed = 0.1 * (most / least).powf(1.3);
        let burning = compressed + (5.5 - compressed) * (0.5 - 0.5 * (PI * burnt).cos());
        burning * (least / volume).powf(1.3) - 0.1
    } else if turned < 3.0 * PI {
        0.0
    } else {
        0.1 * (most / volume).powf(1.3) - 0.1
    }
}

/// A curve of the plot.
struct Curve<'a> {
    name: &'a str,
    colour: &'a str,
    values: Vec<f64>,
}

/// The smallest of 1, 2, 5 times a power of ten that makes at most so many steps.
fn step_of(range: f64, steps: f64) -> f64 {
    let power = 10f64.powf((range / steps).log10().floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|part| part * power).find(|step| range / step <= steps).unwrap_or(range)
}

/// A panel of curves over the crank angle: a frame, ticks with their values, a legend.
fn panel(svg: &mut String, top: f64, title: &str, degrees: &[f64], curves: &[Curve<'_>]) {
    let (left, width, height) = (80.0, 760.0, 200.0);
    let all = curves.iter().flat_map(|curve| curve.values.iter().copied());
    let (least, most) = all.fold((0.0f64, 0.0f64), |(least, most), value| (least.min(value), most.max(value)));
    let step = step_of(most - least, 7.0);
    let (first, last) = ((least / step).floor(), (most / step).ceil());
    let x = |angle: f64| left + width * angle / 720.0;
    let y = |value: f64| top + height * (last * step - value) / ((last - first) * step);
    let _ = writeln!(svg, "<text x=\"{left}\" y=\"{}\" font-weight=\"bold\">{title}</text>", top - 10.0);
    let mut tick = first;
    while tick <= last {
        let (value, at) = (tick * step, y(tick * step));
        let shade = if tick == 0.0 { "#444" } else { "#ddd" };
        let _ = writeln!(
            svg,
            "<line x1=\"{left}\" y1=\"{at:.1}\" x2=\"{}\" y2=\"{at:.1}\" stroke=\"{shade}\"/>",
            left + width
        );
        let value = if step < 1.0 { format!("{value:.1}") } else { format!("{value:.0}") };
        let _ = writeln!(svg, "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{value}</text>", left - 8.0, at + 4.0);
        tick += 1.0;
    }
    for angle in (0..=720).step_by(90).map(f64::from) {
        let at = x(angle);
        let bottom = top + height;
        let _ = writeln!(
            svg,
            "<line x1=\"{at:.1}\" y1=\"{bottom}\" x2=\"{at:.1}\" y2=\"{}\" stroke=\"#444\"/>",
            bottom + 5.0
        );
        let _ = writeln!(svg, "<text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">{angle}</text>", bottom + 19.0);
    }
    let _ = writeln!(
        svg,
        "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"#444\"/>"
    );
    for (index, Curve { name, colour, values }) in curves.iter().enumerate() {
        let points: Vec<String> =
            degrees.iter().zip(values).map(|(angle, value)| format!("{:.1},{:.1}", x(*angle), y(*value))).collect();
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.6\"/>",
            points.join(" ")
        );
        let at = left + width - 190.0 * (curves.len() - index) as f64 + 60.0;
        let _ = writeln!(
            svg,
            "<line x1=\"{at}\" y1=\"{0}\" x2=\"{1}\" y2=\"{0}\" stroke=\"{colour}\" stroke-width=\"3\"/>",
            top - 14.0,
            at + 22.0
        );
        let _ = writeln!(svg, "<text x=\"{}\" y=\"{}\">{name}</text>", at + 28.0, top - 10.0);
    }
}

fn size(x: &[f64], y: &[f64]) -> Vec<f64> {
    x.iter().zip(y).map(|(x, y)| x.hypot(*y)).collect()
}

#[allow(clippy::too_many_lines, reason = "one table, one file and one picture after the other")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    // From the upper dead centre at which the fuel burns; the crank turns clockwise in the books' pictures, here counter-clockwise.
    let turned: Vec<f64> = (0..COUNT).map(|step| 2.0 * TAU * step as f64 / COUNT as f64).collect();
    let degrees: Vec<f64> = turned.iter().map(|angle| angle.to_degrees()).collect();
    let theta: Vec<f64> = turned.iter().map(|angle| angle + 0.5 * PI).collect();
    let area = 0.25 * PI * BORE * BORE;
    let gas: Vec<Vector2<f64>> = turned.iter().map(|angle| Vector2::new(0.0, -area * pressure(*angle))).collect();

    let mut rows = vec![vec![0.0; COUNT]; 15];
    let [t, ox, oy, ax, ay, bx, by, sx, sy, sn, sc, power, gx, gy, gm] = &mut rows[..] else { unreachable!("15 rows") };
    let inputs = engine::CycleInputs { theta: Series::Each(&theta), gas: Series::Each(&gas) };
    let results = engine::Cycle {
        T: t,
        O_x: ox,
        O_y: oy,
        A_x: ax,
        A_y: ay,
        B_x: bx,
        B_y: by,
        S_force_x: sx,
        S_force_y: sy,
        S_normal: sn,
        S_couple: sc,
        power,
        ground_about_ground_O_force_x: gx,
        ground_about_ground_O_force_y: gy,
        ground_about_ground_O_moment: gm,
    };
    engine::cycle(&inputs, results)?;
    let (mut shaking_x, mut shaking_y, mut shaking_moment) = (vec![0.0; COUNT], vec![0.0; COUNT], vec![0.0; COUNT]);
    let results = engine::Shaking {
        shaking_ground_O_force_x: &mut shaking_x,
        shaking_ground_O_force_y: &mut shaking_y,
        shaking_ground_O_moment: &mut shaking_moment,
    };
    engine::shaking(&engine::ShakingInputs { theta: Series::Each(&theta) }, results)?;

    // The torque that the engine gives is the opposite of what holds its crank at its speed.
    let torque: Vec<f64> = rows[0].iter().map(|torque| -torque / 1000.0).collect();
    let (main_bearing, crank_pin, piston_pin) =
        (size(&rows[1], &rows[2]), size(&rows[3], &rows[4]), size(&rows[5], &rows[6]));
    let side = rows[7].clone();
    let shaking = size(&shaking_x, &shaking_y);

    println!("Four-stroke engine, 3000 rpm; crank angle from the upper dead centre at which the fuel burns\n");
    println!(
        "{:>6} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}",
        "angle", "gas", "torque", "bearing", "crank pin", "pin", "wall", "shaking"
    );
    println!("{:>6} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}", "°", "kN", "N·m", "kN", "kN", "kN", "kN", "kN");
    for index in (0..COUNT).step_by(30) {
        let kilo = |value: f64| format!("{:9.3}", value / 1000.0);
        println!(
            "{:>6.0} {} {:>9.2} {} {} {} {} {}",
            degrees[index],
            kilo(-gas[index].y),
            torque[index],
            kilo(main_bearing[index]),
            kilo(crank_pin[index]),
            kilo(piston_pin[index]),
            kilo(side[index]),
            kilo(shaking[index])
        );
    }

    let cycle = Cycle::new(&theta, 2.0 * TAU)?;
    let speed = 100.0 * PI;
    let mean = cycle.mean(&torque)?;
    let fluctuation = cycle.energy_fluctuation(&torque)?;
    println!("\nmean torque {mean:.2} N·m, root mean square {:.2} N·m", cycle.rms(&torque)?);
    println!("work of a cycle {:.1} J, power {:.2} kW", cycle.integral(&torque)?, -cycle.mean(&rows[11])? / 1e6);
    for (name, values) in
        [("bearing", &main_bearing), ("crank pin", &crank_pin), ("piston pin", &piston_pin), ("wall", &side)]
    {
        let peak = peak(values).ok_or("no positions")?;
        println!(
            "{name}: at most {:.3} kN at {:.0}°, root mean square {:.3} kN",
            peak.value / 1000.0,
            degrees[peak.index],
            cycle.rms(values)? / 1000.0
        );
    }
    println!(
        "fluctuation of energy {fluctuation:.1} J: for a coefficient of speed fluctuation of 1/50 an inertia of {:.4} kg·m²",
        flywheel_inertia(fluctuation, 0.02, speed)?
    );

    let folder = std::env::args()
        .nth(1)
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("target/engine"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    let mut csv = String::from(
        "angle (deg),gas (N),torque (N m),bearing (N),crank pin (N),piston pin (N),wall (N),shaking x (N),shaking y (N),ground x (N),ground y (N),moment on the ground (N m)\n",
    );
    for index in 0..COUNT {
        let values = [
            degrees[index],
            -gas[index].y,
            torque[index],
            main_bearing[index],
            crank_pin[index],
            piston_pin[index],
            side[index],
            shaking_x[index],
            shaking_y[index],
            rows[12][index],
            rows[13][index],
            rows[14][index] / 1000.0,
        ];
        // What is rounded to nothing has no sign.
        let rounded = |value: f64| (value * 1e6).round() / 1e6 + 0.0;
        csv.push_str(&values.map(|value| format!("{:.6}", rounded(value))).join(","));
        csv.push('\n');
    }
    std::fs::write(folder.join("engine.csv"), csv)?;
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"880\" height=\"880\" viewBox=\"0 0 880 880\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"880\" height=\"880\" fill=\"white\"/>\n",
    );
    let kilo = |values: &[f64]| values.iter().map(|value| value / 1000.0).collect::<Vec<_>>();
    let means = vec![mean; COUNT];
    panel(
        &mut svg,
        50.0,
        "Torque of the engine, N·m",
        &degrees,
        &[
            Curve { name: "torque", colour: "#1f5fa8", values: torque },
            Curve { name: "mean", colour: "#c0392b", values: means },
        ],
    );
    panel(
        &mut svg,
        320.0,
        "Bearing forces, kN",
        &degrees,
        &[
            Curve { name: "main bearing", colour: "#1f5fa8", values: kilo(&main_bearing) },
            Curve { name: "crank pin", colour: "#c0392b", values: kilo(&crank_pin) },
            Curve { name: "piston pin", colour: "#2e8b57", values: kilo(&piston_pin) },
        ],
    );
    panel(
        &mut svg,
        590.0,
        "Side and shaking forces, kN",
        &degrees,
        &[
            Curve { name: "on the piston by the wall", colour: "#1f5fa8", values: kilo(&side) },
            Curve { name: "shaking, upwards", colour: "#c0392b", values: kilo(&shaking_y) },
        ],
    );
    svg.push_str(
        "<text x=\"460\" y=\"840\" text-anchor=\"middle\">crank angle from the upper dead centre, °</text>\n</svg>\n",
    );
    std::fs::write(folder.join("engine.svg"), svg)?;
    println!("\nwritten: {}", folder.display());
    Ok(())
}
