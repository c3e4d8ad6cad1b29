use linkage_runtime::{linkage, polar};

linkage! {
    /// A boom on a cylinder with an arm.
    pub mod boom;
    ground    { O: (0, 0), P: (0.6m, -0.4m) }
    link boom { O -> E: 2m, Q: (1.2m, 0.3m) }
    link tube { P: (0, 0) }
    link rod  { Q: (0, 0) }
    link arm  { E -> tip: 1m }
    revolute O: ground -> boom;
    revolute P: ground -> tube;
    revolute Q: rod -> boom;
    revolute E: boom -> arm;
    prismatic lift: tube.P -> rod.Q along 0deg of tube;
    drive length: lift;
    drive curl: E;
    assemble Q: left(P -> O);
    unknown A: effort(lift);
    unknown B: effort(curl);
    unknown C: effort(curl);
    unknown D: effort(curl, length);
    unknown F: effort(lenght);
    load dig: force(arm.tip);
    scene held: equilibrium -> (A, B);
}

linkage! {
    /// Two efforts of one drive in disguise.
    pub mod five_bar;
    ground     { O1: (0, 0), O2: (0.5m, 0) }
    link left  { O1 -> P: 0.3m }
    link right { O2 -> Q: 0.3m }
    link upper { P -> R: 0.45m }
    link lower { Q -> R: 0.4m }
    revolute O1: ground -> left;
    revolute O2: ground -> right;
    revolute P: left -> upper;
    revolute Q: right -> lower;
    revolute R: upper -> lower;
    drive a: O1;
    drive b: O2;
    assemble R: left(P -> Q);
    unknown A: effort(a);
    unknown T: torque(ground -> left);
    load tool: force(upper.R);
    scene held: equilibrium;
}

fn main() {
    let loads = boom::Loads { dig: polar(10.0, 4.0) };
    println!("{}", boom::held_at(1.6, -0.3, &loads).unwrap().A);
    println!("{}", five_bar::held_at(1.9, 1.1, &five_bar::Loads { tool: polar(10.0, 4.0) }).unwrap().T);
}
