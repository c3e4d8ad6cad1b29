//! The linkages that are measured.

use linkage_runtime::linkage;

/// METU Example 6.3, both loads given at run time, in a scalar.
macro_rules! four_bar {
    ($name:ident, $scalar:ident, $arithmetic:ident; $($sweeps:tt)*) => {
        linkage! {
            /// METU Example 6.3, both loads given at run time.
            pub(crate) mod $name;
            scalar $scalar;
            arithmetic $arithmetic;
            units { mm, N }

            ground       { A0: (0, 0), B0: (140mm, 0) }
            link crank   { A0 -> A: 80mm }
            link coupler { A -> B: 100mm, C: left(A -> B, 70mm, 80mm) }
            link rocker  { B0 -> B: 120mm, D: (90mm, 0) }

            revolute A0: ground  -> crank;
            revolute A:  crank   -> coupler;
            revolute B:  coupler -> rocker;
            revolute B0: ground  -> rocker;

            drive theta: A0;
            unknown T12: torque(ground -> crank);
            assemble B: left(A -> B0);

            load F13: force(coupler.C);
            load F14: force(rocker.D);

            scene statics: equilibrium;
            scene parts:   superposition;
            scene torque:  virtual_work -> (T12);
            $($sweeps)*
        }
    };
}

four_bar!(four_bar, f64, plain;);
four_bar!(four_bar_single, f32, plain;);
four_bar!(four_bar_fused, f64, fused;);
four_bar!(four_bar_fused_single, f32, fused;);

/// The same with sweeps. By itself, so that each of the functions above is called in one place, of which it becomes part, as in most programs.
pub(crate) mod swept {
    use linkage_runtime::linkage;

    four_bar!(four_bar, f64, plain; scene torques: sweep(torque); scene cycle: sweep(statics););
    four_bar!(four_bar_single, f32, plain; scene torques: sweep(torque); scene cycle: sweep(statics););
    four_bar!(four_bar_fused, f64, fused; scene torques: sweep(torque); scene cycle: sweep(statics););
    four_bar!(four_bar_fused_single, f32, fused; scene torques: sweep(torque); scene cycle: sweep(statics););
}

/// The six-bar, in a scalar.
macro_rules! six_bar {
    ($name:ident, $scalar:ident, $arithmetic:ident) => {
        linkage! {
            /// A six-bar, Watt's chain: a crank-rocker moves a second rocker. Weight on every link, a load on the coupler, one on
            /// the arm.
            pub(crate) mod $name;
            scalar $scalar;
            arithmetic $arithmetic;
            units { mm, N }

            ground       { A0: (0, 0), B0: (150mm, 0), D0: (330mm, 20mm) }
            link crank   { A0 -> A: 50mm }
            link coupler { A -> B: 140mm, P: (60mm, 35mm) }
            link rocker  { B0 -> B: 100mm, C: (80mm, -40mm) }
            link rod     { C -> D: 170mm }
            link arm     { D0 -> D: 110mm, Q: (70mm, 25mm) }

            mass crank:   0.4kg at (25mm, 0);
            mass coupler: 0.9kg at (65mm, 12mm);
            mass rocker:  0.8kg at (60mm, -10mm);
            mass rod:     0.7kg at (85mm, 0);
            mass arm:     0.6kg at (50mm, 8mm);

            revolute A0: ground  -> crank;
            revolute A:  crank   -> coupler;
            revolute B:  coupler -> rocker;
            revolute B0: ground  -> rocker;
            revolute C:  rocker  -> rod;
            revolute D:  rod     -> arm;
            revolute D0: ground  -> arm;

            drive theta: A0;
            unknown T: torque(ground -> crank);
            assemble B: left(A -> B0);
            assemble D: left(C -> D0);

            load F: force(coupler.P);
            load G: force(arm.Q);
            load W: gravity = 9.81m/s^2 @ -90deg;

            scene statics: equilibrium;
        }
    };
}

six_bar!(six_bar, f64, plain);
six_bar!(six_bar_single, f32, plain);
six_bar!(six_bar_fused, f64, fused);
six_bar!(six_bar_fused_single, f32, fused);

/// The slider-crank, in a scalar.
macro_rules! slider_crank {
    ($name:ident, $scalar:ident, $arithmetic:ident) => {
        linkage! {
            /// An engine's slider-crank, in line, with the force of the gas on the piston.
            pub(crate) mod $name;
            scalar $scalar;
            arithmetic $arithmetic;
            units { mm, N }

            ground      { O: (0, 0) }
            link crank  { O -> A: 45mm }
            link rod    { A -> B: 150mm }
            link piston { B }

            revolute  O: ground   -> crank;
            revolute  A: crank    -> rod;
            revolute  B: rod      -> piston;
            prismatic P: ground.O -> piston.B along 0deg;

            drive theta: O;
            unknown T: torque(ground -> crank);
            assemble B: ahead(A);

            load gas: force(piston.B);

            scene statics: equilibrium;
        }
    };
}

slider_crank!(slider_crank, f64, plain);
slider_crank!(slider_crank_single, f32, plain);
slider_crank!(slider_crank_fused, f64, fused);
slider_crank!(slider_crank_fused_single, f32, fused);

#[cfg(test)]
mod tests {
    /// What the items P1, P2 and P3 cost, whatever the machine: `statics` is P1a from the pose and P1b from the angle, P2b and P3b;
    /// `torque` is P1c, `parts` P1d.
    #[test]
    fn operations_are_pinned() {
        let of = [
            ("P1, four-bar", super::four_bar::OPERATIONS),
            ("P1, four-bar, fused", super::four_bar_fused::OPERATIONS),
            ("P1, four-bar, f32", super::four_bar_single::OPERATIONS),
            ("P1, four-bar, f32, fused", super::four_bar_fused_single::OPERATIONS),
            ("P2, six-bar", super::six_bar::OPERATIONS),
            ("P2, six-bar, fused", super::six_bar_fused::OPERATIONS),
            ("P2, six-bar, f32", super::six_bar_single::OPERATIONS),
            ("P2, six-bar, f32, fused", super::six_bar_fused_single::OPERATIONS),
            ("P3, slider-crank", super::slider_crank::OPERATIONS),
            ("P3, slider-crank, fused", super::slider_crank_fused::OPERATIONS),
            ("P3, slider-crank, f32", super::slider_crank_single::OPERATIONS),
            ("P3, slider-crank, f32, fused", super::slider_crank_fused_single::OPERATIONS),
        ];
        let text = of.map(|(title, operations)| format!("{title}\n{operations}\n")).join("\n");
        insta::with_settings!({ prepend_module_to_snapshot => false, omit_expression => true }, {
            insta::assert_snapshot!("operations", text);
        });
    }

    /// A linkage with sweeps has the same functions for single positions, which its sweeps carry out.
    #[test]
    fn swept_linkages_have_the_same_operations() {
        for [with, without] in [
            [super::swept::four_bar::OPERATIONS, super::four_bar::OPERATIONS],
            [super::swept::four_bar_single::OPERATIONS, super::four_bar_single::OPERATIONS],
            [super::swept::four_bar_fused::OPERATIONS, super::four_bar_fused::OPERATIONS],
            [super::swept::four_bar_fused_single::OPERATIONS, super::four_bar_fused_single::OPERATIONS],
        ] {
            assert_eq!(with, without);
        }
    }
}
