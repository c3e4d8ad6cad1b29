//! Drives and loads may be called as what is made of parameters would be.

use linkage_runtime::linkage;

macro_rules! four_bar {
    ($module:ident, $drive:ident, $load:ident) => {
        linkage! {
            pub mod $module;
            param l: length;
            ground { O: (0, 0), Q: (2m, 0) }
            link crank { O -> A: 0.5m }
            link b { A -> B: l }
            link c { Q -> B: 1.2m }
            revolute O: ground -> crank;
            revolute A: crank -> b;
            revolute B: b -> c;
            revolute Q: ground -> c;
            drive $drive: O;
            assemble B: left(A -> Q);
            load F: force(c.B) = (1N, 2N);
            load $load: moment(c);
            scene held: equilibrium;
            scene place: position -> (B);
        }
    };
}

four_bar!(plain, theta, M);
four_bar!(shifted, l_shifted, l_shifted_squared);
four_bar!(made, prepared, inverse_l);
four_bar!(scaled, l_scaled, prepared_2);

fn main() {
    macro_rules! numbers {
        ($module:ident, $load:ident, $effort:ident) => {{
            let linkage = $module::Linkage::new(&$module::Params { l: 1.4 }).unwrap();
            let loads = $module::Loads { $load: 3.0 };
            let pose = $module::Pose::at(&linkage, 0.7).unwrap();
            let (held, place) = (pose.held(&loads).unwrap(), pose.place().unwrap());
            let direct = $module::held_at(&linkage, 0.7, &loads).unwrap();
            [held.$effort, held.B.x, held.B.y, place.B.x, place.B.y, direct.$effort]
        }};
    }
    let expected = numbers!(plain, M, effort_theta);
    assert_eq!(numbers!(shifted, l_shifted_squared, effort_l_shifted), expected);
    assert_eq!(numbers!(made, inverse_l, effort_prepared), expected);
    assert_eq!(numbers!(scaled, prepared_2, effort_l_scaled), expected);
}
