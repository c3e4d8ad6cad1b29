//! All functions of a module.

use std::collections::{BTreeMap, BTreeSet};

use super::bounds::{Given, Within};
use super::{Definition, Extract, Form, Input, Program, passes};
use crate::graph::{Graph, NodeId, Symbol};
use crate::model::Model;
use crate::plan::{Kept, Plan};

/// The programs of a linkage.
#[derive(Clone, Debug)]
pub struct Functions {
    /// From the parameters: what all other functions need of them alone.
    pub prepare: Program,
    /// From the drives: what a pose keeps.
    pub pose: Program,
    /// From the drives and another pose, from which searches start: what a pose keeps. Only if there are searches.
    pub near: Option<Program>,
    /// In the order of the graph's searches.
    pub searches: Vec<SearchFunctions>,
    /// From a pose: places, directions, transmission angles; in the order of the plan's accessors.
    pub accessors: Vec<Program>,
    /// In the order of the plan's scenes.
    pub scenes: Vec<SceneFunctions>,
    /// What the parameters alone determine, in the order of the preparation's results.
    pub prepared: Vec<NodeId>,
}

/// The two parts of a search.
#[derive(Clone, Debug)]
pub struct SearchFunctions {
    /// An evaluation: residuals, Jacobian row by row, what rounding may leave open, and the scales of travels.
    pub step: Program,
    /// What changes with the drives, on the way to where they are wanted.
    pub on_the_way: Program,
}

/// The two forms of a scene.
#[derive(Clone, Debug)]
pub struct SceneFunctions {
    /// From a pose.
    pub from_pose: Program,
    /// From the drives.
    pub direct: Program,
}

impl Functions {
    /// Takes all functions of a plan out of its graph.
    #[must_use]
    pub fn of(model: &Model, plan: &Plan) -> Self {
        let graph = &model.graph;
        let program = |form, results: &[(String, NodeId)], finite: &[NodeId]| {
            passes::optimised(Extract { graph, form }.program(results, finite), graph)
        };
        let kept: Vec<(String, NodeId)> = plan.pose.iter().map(|kept| (kept.name.clone(), kept.node)).collect();
        let finite: Vec<NodeId> = plan.pose.iter().filter(|kept| !kept.is_bound).map(|kept| kept.node).collect();
        let poses: Vec<NodeId> = plan.pose.iter().map(|kept| kept.node).collect();
        graph.hold_in_poses(Extract { graph, form: Form::Direct }.guards(&poses));
        // What is counted may read any number of a pose.
        let pose = |form| {
            let program = Extract { graph, form }.program(&kept, &finite);
            passes::optimised(Program { counts_rounding: graph.counts_rounding(), ..program }, graph)
        };
        let searches = graph.searches();
        let near = (!searches.is_empty()).then(|| pose(Form::Near));
        let pose = pose(Form::Direct);
        let within = known_of_kept(&plan.pose, core::iter::once(&pose).chain(&near), graph);
        let searches: Vec<SearchFunctions> = searches
            .into_iter()
            .map(|(id, search)| {
                let exact = |form, results: &[(String, NodeId)]| {
                    passes::exact(Extract { graph, form }.program(results, &[]), graph)
                };
                let changing: Vec<(String, NodeId)> =
                    search.known[..search.changing].iter().map(|node| (String::new(), *node)).collect();
                SearchFunctions {
                    step: exact(Form::Search(id), &search.named_results(graph)),
                    on_the_way: exact(Form::OnTheWay(id), &changing),
                }
            })
            .collect();
        let accessors: Vec<Program> =
            plan.accessors.iter().map(|accessor| program(Form::FromPose, &accessor.output.leaves(), &[])).collect();
        let scenes: Vec<SceneFunctions> = plan
            .scenes
            .iter()
            .enumerate()
            .map(|(index, output)| {
                let results = output.leaves();
                let finite: Vec<NodeId> = results.iter().map(|(_, node)| *node).collect();
                let program = |form| Extract { graph, form }.program_of(Some(index), &results, &finite);
                SceneFunctions {
                    from_pose: passes::optimised(program(Form::FromPose).at_pose(&within, graph), graph),
                    direct: passes::optimised(program(Form::Direct), graph),
                }
            })
            .collect();
        let both = scenes.iter().flat_map(|scene| [&scene.from_pose, &scene.direct]);
        let all = core::iter::once(&pose).chain(&near).chain(&accessors).chain(both);
        let prepared: BTreeSet<NodeId> = all.flat_map(prepared_inputs).collect();
        let prepared: Vec<NodeId> = prepared.into_iter().collect();
        let results: Vec<(String, NodeId)> = prepared.iter().map(|node| (String::new(), *node)).collect();
        let prepare = program(Form::Prepare, &results, &prepared);
        Self { prepare, pose, near, searches, accessors, scenes, prepared }
    }
}

/// What is known of the numbers that a pose keeps, whichever of some programs finds it.
fn known_of_kept<'p>(
    kept: &[Kept],
    poses: impl Iterator<Item = &'p Program>,
    graph: &Graph,
) -> BTreeMap<NodeId, Within> {
    let mut known: BTreeMap<NodeId, Within> = BTreeMap::new();
    for pose in poses {
        let results = Given::anything(graph.scalar()).results(pose, graph);
        // A bound of errors may be infinite.
        for (kept, within) in kept.iter().zip(results).filter(|(kept, _)| !kept.is_bound) {
            known.entry(kept.node).and_modify(|known| *known = known.or(within)).or_insert(within);
        }
    }
    known
}

impl Program {
    /// With what is known of the numbers that a pose keeps, and of its drives, which are finite.
    fn at_pose(mut self, kept: &BTreeMap<NodeId, Within>, graph: &Graph) -> Self {
        for value in &mut self.values {
            value.within = match value.definition {
                Definition::Input(Input::Kept(node)) => kept.get(&node).copied(),
                Definition::Input(Input::Symbol(Symbol::Drive(_))) => Some(Within::finite(graph.scalar())),
                _ => None,
            };
        }
        self
    }
}

fn prepared_inputs(program: &Program) -> Vec<NodeId> {
    let prepared = program.inputs().filter_map(|(_, input)| match input {
        Input::Prepared(node) => Some(node),
        _ => None,
    });
    prepared.collect()
}
