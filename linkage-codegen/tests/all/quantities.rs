//! What quantities mean: powers behind literals, and what parameters may not be.

use crate::support::numbers::Double;
use crate::support::{Arguments, checked_prepared, compile, scene};
use linkage_codegen::graph::Failure;
use linkage_codegen::program::Fault;

/// The torque that holds 1 N at the end of a lever of this length, N·mm.
fn torque(length: &str) -> f64 {
    let linkage = compile(&format!(
        "mod lever; units {{ mm, N }} ground {{ O: (0, 0) }} link lever {{ O -> A: {length} }} revolute O: ground -> lever; drive q: O;
         load F: force(lever.A) = (0, 1N); unknown M: torque(ground -> lever); scene all: equilibrium;"
    ));
    let arguments = Arguments { drives: vec![0.0], loads: vec![[0.0; 2]], ..Arguments::default() };
    scene::<Double>(&linkage, "all", &arguments).expect("forces")["M"].0
}

#[test]
fn a_power_behind_a_literal_is_one_of_its_unit() {
    let written =
        ["sqrt(900mm^2)", "900mm^2/30mm", "(30mm)^2/30mm", "27e3mm^3/(30mm)^2", "sqrt(9e-4m^2)", "30mm^1", "30mm"];
    for length in written {
        assert!((torque(length) + 30.0).abs() < 1e-12, "{length}: {}", torque(length));
    }
}

#[test]
fn parameters_are_refused_where_constants_are() {
    let linkage = compile(
        "mod arm; ground { O: (0, 0), P: (0, 300mm) } link arm { O -> A: 100mm }
         param i: inertia = 900kg*mm^2; param k: stiffness = 2N/mm; param c: damping = 1N*s/mm; param f: length = 10mm;
         param load_mass: mass = 1kg;
         mass arm: load_mass at A, inertia i; load K: spring(ground.P, arm.A) { rate: k, free: f, damping: c };
         revolute O: ground -> arm; drive q: O; load I: inertia; scene all: equilibrium;",
    );
    let parameters = [9e-4, 2e3, 1e3, 0.01, 1.0];
    let prepared = |parameters: [f64; 5]| {
        let arguments = Arguments { params: parameters.to_vec(), ..Arguments::default() };
        checked_prepared::<Double>(&linkage, &arguments).map(|_| ())
    };
    assert_eq!(prepared(parameters), Ok(()));
    assert_eq!(prepared([0.0, 0.0, 0.0, 0.0, 1.0]), Ok(()), "only a mass must be positive");
    for (index, what) in ["moment of inertia", "rate", "damping", "free length", "mass"].into_iter().enumerate() {
        let mut parameters = parameters;
        parameters[index] = -1e-3;
        let Err(Fault::Failed(Failure::Parameter { requirement })) = prepared(parameters) else { panic!("{what}") };
        assert!(requirement.contains(what), "{requirement}");
    }
}

/// A distance that closes a triangle is a length too, and one parameter is one length, in whatever order the links are declared.
#[test]
fn a_length_that_is_a_distance_elsewhere_is_refused_where_it_is_negative() {
    let crank = "link crank { A0 -> A: r }";
    let coupler = "link coupler { A -> B: 1m, C: left(A -> B, r, 0.7m) }";
    for links in [[crank, coupler].concat(), [coupler, crank].concat()] {
        let linkage = compile(&format!(
            "mod sample; param r: length = 0.5m; ground {{ A0: (0, 0), B0: (1m, 0) }} {links} link rocker {{ B0 -> B: r }}
             revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
             drive theta: A0; unknown T: torque(ground -> crank); assemble B: left(A -> B0) smooth at 60deg; load F: force(coupler.C);
             scene all: equilibrium;"
        ));
        let prepared = |r: f64| {
            let arguments = Arguments { params: vec![r], ..Arguments::default() };
            checked_prepared::<Double>(&linkage, &arguments).map(|_| ())
        };
        assert_eq!(prepared(0.5), Ok(()));
        let Err(Fault::Failed(Failure::Parameter { requirement })) = prepared(-0.7) else { panic!("{links}") };
        assert!(requirement.contains("must be positive"), "{requirement}");
        assert!(prepared(0.0).is_err());
    }
}

/// What is prepared from parameters is called by what it is, and said to be prepared.
#[test]
fn what_is_prepared_has_names() {
    let linkage = compile(
        "mod adjusted; units { mm, N } param l2: length; param l3: length; param l4: length; param b0: length;
         ground { A0: (0, 0), B0: (b0, 0) } link crank { A0 -> A: l2 }
         link coupler { A -> B: l3, C: left(A -> B, 70mm, 80mm) } link rocker { B0 -> B: l4 }
         revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker;
         drive theta: A0; assemble B: left(A -> B0); load F: force(coupler.C); scene statics: equilibrium;",
    );
    let text = linkage_codegen::emit::equations(&linkage);
    let prepared = "\n    prepared for poses and scenes\n";
    for lines in [
        format!("{prepared}      l3_plus_l4 = l3 + l4\n"),
        format!(
            "{prepared}      abs_of_l3_minus_l4 = |l3_minus_l4|\n      squared_l3_plus_l4 = l3_plus_l4·l3_plus_l4\n"
        ),
        format!("{prepared}      product_of_l3_minus_l4_and_l3_plus_l4 = l3_minus_l4·l3_plus_l4\n"),
        format!(
            "{prepared}      coupler_C_x_over_l3 = inverse_l3·coupler_C_x\n      coupler_C_y_over_l3 = inverse_l3·coupler_C_y\n"
        ),
    ] {
        assert!(text.contains(&lines), "{lines:?} in {text}");
    }
}
