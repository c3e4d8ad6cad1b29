mod support;
use std::time::Instant;
fn chain(dyads: u32, bound: bool) -> String {
    let mut text = String::from("mod chain; units { mm, N } ");
    let mut ground = String::from("A0: (0, 0), B0: (140mm, 0)");
    let mut links = String::from("link crank { A0 -> A: 80mm } link coupler { A -> B: 100mm, C: left(A -> B, 70mm, 80mm) } link rocker { B0 -> B: 120mm, D: (90mm, 0) } ");
    let mut joints = String::from("revolute A0: ground -> crank; revolute A: crank -> coupler; revolute B: coupler -> rocker; revolute B0: ground -> rocker; assemble B: left(A -> B0); ");
    let mut results = vec!["T".to_owned(), "A".into(), "B".into(), "A0".into(), "B0".into()];
    let mut from = "rocker".to_owned();
    for i in 0..dyads - 1 {
        let x = 300 + 150 * i;
        ground += &format!(", G{i}: ({x}mm, 0)");
        links += &format!("link c{i} {{ D -> E{i}: 150mm }} link r{i} {{ G{i} -> E{i}: 110mm, D: (90mm, 10mm) }} ");
        joints += &format!("revolute D{i}: {from}.D -> c{i}.D; revolute E{i}: c{i} -> r{i}; revolute G{i}: ground -> r{i}; assemble E{i}: left(D{i} -> G{i}); load F{i}: force(r{i}.D); ");
        for j in ["D", "E", "G"] { results.push(format!("{j}{i}")); }
        from = format!("r{i}");
    }
    text += &format!("ground {{ {ground} }} {links} {joints} drive theta: A0; unknown T: torque(ground -> crank); load F: force(coupler.C); ");
    text += &format!("scene s: equilibrium -> ({}{});", results.join(", "), if bound { ", error_bound" } else { "" });
    text
}
#[test]
fn growth() {
    for dyads in [1, 2, 3, 6, 12, 20] {
        for bound in [false, true] {
            let text = chain(dyads, bound);
            let now = Instant::now();
            let linkage = support::compile(&text);
            let time = now.elapsed();
            let s = &linkage.functions.scenes[0];
            println!("{dyads} {bound}: {time:?} kept {} from_pose {:?} direct {:?}", linkage.plan.pose.len(), s.from_pose.counts(), s.direct.counts());
        }
    }
}
