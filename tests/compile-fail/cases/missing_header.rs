use linkage_runtime::linkage;

linkage! {
    units { mm, N }

    ground     { A: (0, 0) }
    link crank { A -> B: 80mm }

    revolute A: ground -> crank;

    drive theta: A;

    load F: force(crank.B);

    scene statics: equilibrium;
}

fn main() {
    println!("nothing to call: the module has no name");
}
