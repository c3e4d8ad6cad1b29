use linkage_runtime::linkage;

linkage! {
    pub mod lever;
    ground     { O: (0, 0) }
    link lever { O -> P: 250mm }
    mass lever: 2kg at (100mm, 0);
    revolute O: ground -> lever;
    drive theta: O;
    load F: force(lever.P) = (0, -3N);
    load W: gravity = (0, -9.81m/s^2);
    scene gains: coefficients(F) -> (lever.P);
    scene effort: coefficients -> (lever.P, effort_theta);
    scene along: coefficients -> (lever.P along lever);
    scene over: virtual_work -> (advantage(F), advantage(W));
    scene held: equilibrium -> (advantage(F));
    scene unknown: virtual_work -> (advantage(G));
}

fn main() {
    println!("{}", lever::effort_at(1.0).unwrap().lever_P.by_theta_theta);
    println!("{}", lever::over_at(1.0).unwrap().F_advantage);
}
