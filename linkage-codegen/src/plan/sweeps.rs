//! The results of sweeps: a slice for every number.

use std::collections::BTreeMap;

use super::Output;
use crate::diagnostics::{Diagnostic, Sink};
use crate::model::Model;

/// The name of a number of a result in a sweep: `B_x` of `B.x`.
#[must_use]
pub(crate) fn slice_name(path: &str) -> String {
    path.replace('.', "_")
}

/// No two numbers of a sweep may have one name.
pub(super) fn check_names(model: &Model, scenes: &[Output], sink: &Sink) {
    for sweep in &model.sweeps {
        let mut seen: BTreeMap<String, String> = BTreeMap::new();
        for (path, _) in scenes[sweep.scene].leaves() {
            let name = slice_name(&path);
            if let Some(other) = seen.insert(name.clone(), path.clone()) {
                let problem =
                    format!("the sweep `{}` would have two slices `{name}`: of `{other}` and of `{path}`", sweep.name);
                sink.report(
                    Diagnostic::new(sweep.name.place(), problem).help("let two scenes give them, or rename one"),
                );
                break;
            }
        }
    }
}
