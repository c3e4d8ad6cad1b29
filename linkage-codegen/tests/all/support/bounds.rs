//! Bounds of the rounding errors, and the errors.

use std::collections::HashMap;

use linkage_codegen::Linkage;
use linkage_codegen::graph::real::Real;

use super::numbers::Extended;
use super::{Arguments, Number, compile_if_it_closes, scene};

/// How far above the errors their bounds may be, as a median.
pub const LOOSEST: f64 = 100.0;

/// The median, if there is any.
pub fn median(ratios: &mut [f64]) -> Option<f64> {
    ratios.sort_by(f64::total_cmp);
    ratios.get(ratios.len() / 2).copied()
}

/// A scene `bounded` with all that equilibrium gives, and the bounds; a scene `alone` without them.
pub fn with_bounds(text: &str) -> Option<Linkage> {
    with_bounds_of(&compile_if_it_closes(text)?, text)
}

/// The same where the linkage without them is there: with bounds `Pose::at` and all that comes from it count their rounding.
pub fn with_bounds_of(linkage: &Linkage, text: &str) -> Option<Linkage> {
    let unknowns = linkage.model.unknowns.iter().map(|unknown| unknown.name.clone());
    let joints = linkage.model.joints.iter().map(|joint| joint.name.text.clone());
    let results: Vec<String> = unknowns.chain(joints).collect();
    let results = results.join(", ");
    compile_if_it_closes(&format!(
        "{text} scene bounded: equilibrium -> ({results}, error_bound); scene alone: equilibrium -> ({results});"
    ))
}

/// The ratios of all bounds to the true errors, over those that rounding has reached at all; panics where a bound is too small.
pub fn ratios<T: Number>(
    linkage: &Linkage,
    arguments: &Arguments,
    found: &HashMap<String, T>,
    context: &str,
) -> Vec<f64> {
    // Where the exact pose is beyond the end of the motion there is no error to speak of.
    let Ok(exact) = scene::<Extended>(linkage, "alone", arguments) else { return Vec::new() };
    ratios_to(&exact, found, context)
}

/// The same of a scene at a pose that is regular for numbers of this type, too.
pub fn ratios_of<T: Number>(linkage: &Linkage, name: &str, arguments: &Arguments, context: &str) -> Vec<f64> {
    let Ok(found) = scene::<T>(linkage, name, arguments) else { return Vec::new() };
    let exact = scene::<Extended>(linkage, name, arguments).expect("regular where rounded numbers are");
    ratios_to(&exact, &found, context)
}

fn ratios_to<T: Number>(exact: &HashMap<String, Extended>, found: &HashMap<String, T>, context: &str) -> Vec<f64> {
    let results = found.iter().filter(|(path, _)| !path.starts_with("error_bound."));
    let ratios = results.filter_map(|(path, value)| {
        let error = Extended::exactly(value.to_f64()).sub(&exact[path]).to_f64().abs();
        let bound = found[&format!("error_bound.{path}")].to_f64();
        assert!(error <= bound, "{path} = {} is off by {error:e}, bound {bound:e}\n{context}", value.to_f64());
        (error > 0.0).then(|| bound / error)
    });
    ratios.collect()
}
