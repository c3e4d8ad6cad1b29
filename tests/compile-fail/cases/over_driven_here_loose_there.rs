use linkage_runtime::{linkage, polar};

linkage! {
    pub mod two_loops;

    units { mm, N }

    ground      { A0: (0, 0), B0: (140mm, 0), P0: (300mm, 0), Q0: (440mm, 0) }
    link a      { A0 -> A: 80mm }
    link b      { A -> B: 100mm }
    link c      { B0 -> B: 120mm }
    link p      { P0 -> P: 80mm }
    link q      { P -> Q: 100mm }
    link r      { Q0 -> Q: 120mm }

    revolute A0: ground -> a;
    revolute A:  a -> b;
    revolute B:  b -> c;
    revolute B0: ground -> c;
    revolute P0: ground -> p;
    revolute P:  p -> q;
    revolute Q:  q -> r;
    revolute Q0: ground -> r;

    drive theta: A0;
    drive phi: B0;
    assemble B: left(A -> B0);
    assemble Q: left(P -> Q0);

    load F: force(b.B);
    load G: force(q.Q);

    scene statics: equilibrium;
}

fn main() {
    let loads = two_loops::Loads { F: polar(50.0, 4.0), G: polar(50.0, 4.0) };
    let pose = two_loops::Pose::at(1.0, 2.0).unwrap();
    println!("{}", pose.statics(&loads).unwrap().effort_phi);
    println!("{}", two_loops::statics_at(1.0, 2.0, &loads).unwrap().Q);
}
