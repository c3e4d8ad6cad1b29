use linkage_runtime::{linkage, polar};

linkage! {
    pub mod table;

    units { mm, N }

    ground     { X: (0, 0), Y: (0, 0) }
    link below { X: (0, 0), U: (0, 0) }
    link above { U: (0, 0), V: (0, 0), G: (30mm, 10mm) }
    link aside { V: (0, 0), Y: (0, 0) }

    prismatic X: ground -> below along 0deg;
    prismatic U: below -> above along 90deg of below;
    prismatic V: above -> aside along 0deg of above;
    prismatic Y: ground -> aside along 90deg;

    drive x: X;
    drive y: Y;

    load goods: force(above.G);

    scene statics: equilibrium;
}

fn main() {
    let loads = table::Loads { goods: polar(50.0, 4.0) };
    let pose = table::Pose::at(1.0, 2.0).unwrap();
    let all = pose.statics(&loads).unwrap();
    println!("{} {}", all.effort_x, all.U.normal);
    println!("{}", table::statics_at(1.0, 2.0, &loads).unwrap().effort_y);
}
