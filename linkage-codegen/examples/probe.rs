use linkage_codegen::graph::{Symbol, real::Real};
use linkage_codegen::model::ids::*;
use linkage_codegen::program::*;
fn main() {
    let src = std::fs::read_to_string(std::env::args().nth(1).unwrap()).unwrap();
    let theta: f64 = std::env::args().nth(2).unwrap().parse().unwrap();
    let t = std::time::Instant::now();
    let l = match linkage_codegen::analyse(src.parse().unwrap()) {
        Ok(l) => l,
        Err(e) => {
            for e in e.errors {
                println!("error: {}", e.message());
            }
            return;
        }
    };
    println!("{:?} nodes {}", t.elapsed(), l.model.graph.len());
    let g = &l.model.graph;
    let input = |i: Input| match i {
        Input::Symbol(Symbol::Drive(_)) => theta,
        Input::Symbol(Symbol::Load(_, p)) => {
            if p == 0 {
                50.0 * 230f64.to_radians().cos()
            } else {
                50.0 * 230f64.to_radians().sin()
            }
        }
        _ => f64::NAN,
    };
    for k in &l.plan.pose {
        println!("kept {}", k.name);
    }
    let p = Run { program: &l.functions.pose, graph: g }.with::<f64>(&input);
    println!("pose {:?} {}", p, l.functions.pose.counts());
    for (s, f) in l.model.scenes.iter().zip(&l.functions.scenes) {
        println!("scene {}: direct {}; from pose {}", s.name, f.direct.counts(), f.from_pose.counts());
        match (Run { program: &f.direct, graph: g }).with::<f64>(&input) {
            Ok(v) => {
                for ((n, _), v) in f.direct.outputs.iter().zip(v) {
                    println!("   {n} = {v:?}");
                }
            }
            Err(e) => println!("   {e:?}"),
        }
    }
    let _ = UnknownId::new(0);
    let _ = <f64 as Real>::neg(&1.0);
}
