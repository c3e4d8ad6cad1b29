//! Taking out of the graph what a function's results need.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashMap;

use super::{Definition, Input, Program, Step, Value, ValueId};
use crate::graph::{Component, Graph, Guard, GuardId, NodeId, Op, SearchId, Stage, Symbol};

/// What a function starts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// The parameters alone.
    Prepare,
    /// The drives.
    Direct,
    /// A pose.
    FromPose,
    /// The drives, and a pose from which searches start.
    Near,
    /// The unknowns of a search, and what is known to it.
    Search(SearchId),
    /// The drives where they are on the way of a search, and what is given to it.
    OnTheWay(SearchId),
}

/// Takes programs out of a graph.
#[derive(Clone, Copy, Debug)]
pub struct Extract<'g> {
    /// The graph.
    pub graph: &'g Graph,
    /// What the function starts from.
    pub form: Form,
}

impl Extract<'_> {
    /// The program of some results, each with its path, and those of them that must be finite.
    #[must_use]
    pub fn program(self, results: &[(String, NodeId)], finite: &[NodeId]) -> Program {
        self.program_of(None, results, finite)
    }

    /// The same with the names of a scene, by its place among all.
    #[must_use]
    pub fn program_of(self, scene: Option<usize>, results: &[(String, NodeId)], finite: &[NodeId]) -> Program {
        let nodes: Vec<NodeId> = results.iter().map(|(_, node)| *node).collect();
        let mut building = Building {
            extract: self,
            scene,
            program: Program { counts_rounding: self.counts_rounding(&nodes), ..Program::default() },
            placed: BTreeMap::new(),
            computed: FxHashMap::default(),
        };
        let needed = self.needed(&nodes, |node| building.operands(node));
        // What a search is given was checked before, and so were the drives of a pose.
        let is_argument =
            |node: NodeId| !matches!(self.input(node), Some(Input::Known(_))) && self.form != Form::FromPose;
        for node in &needed {
            if matches!(self.graph.op(*node), Op::Symbol(Symbol::Drive(_))) && is_argument(*node) {
                let value = building.value(*node);
                building.program.steps.push(Step::FiniteInput(value));
            }
        }
        for node in needed {
            building.place(node);
        }
        let outputs: Vec<(String, ValueId)> =
            results.iter().map(|(path, node)| (path.clone(), building.value(*node))).collect();
        let program = &mut building.program;
        let constant =
            |value: &ValueId| matches!(program.values[value.index()].definition, Definition::Computed(Op::Constant(_)));
        let mut checked: Vec<ValueId> = Vec::new();
        for value in finite.iter().filter_map(|node| building.placed.get(node).copied()) {
            if !constant(&value) && !checked.contains(&value) {
                checked.push(value);
            }
        }
        if !checked.is_empty() {
            program.steps.push(Step::FiniteResults(checked));
        }
        program.outputs = outputs;
        building.program
    }

    /// Whether what is counted leads to some results, or may read what is prepared.
    fn counts_rounding(self, results: &[NodeId]) -> bool {
        self.graph.counts_rounding()
            && (self.form == Form::Prepare
                || self
                    .needed(results, |node| self.graph.op(node).operands())
                    .iter()
                    .any(|node| self.graph.is_of_count(*node)))
    }

    /// All nodes that are evaluated for some results, in order, if these are the `operands` of each.
    fn needed(self, results: &[NodeId], operands: impl Fn(NodeId) -> Vec<NodeId>) -> BTreeSet<NodeId> {
        let mut needed = BTreeSet::new();
        let mut open = results.to_vec();
        while let Some(node) = open.pop() {
            if needed.insert(node) && self.input(node).is_none() {
                open.extend(operands(node));
                let op = self.graph.op(node);
                if let Op::Symbol(Symbol::Start(search, number)) = op {
                    open.push(self.graph.start_of(search, number));
                }
                if let Op::Checked { guard, .. } = op
                    && self.checks(guard)
                {
                    open.extend(self.graph.guard(guard).condition.operands());
                }
            }
        }
        needed
    }

    /// Whether the function makes a check: what holds in every pose is not asked of one again.
    fn checks(self, guard: GuardId) -> bool {
        self.form != Form::FromPose || !self.graph.holds_in_poses(guard)
    }

    /// The checks that the function makes for some results.
    pub(super) fn guards(self, results: &[NodeId]) -> BTreeSet<GuardId> {
        let needed = self.needed(results, |node| self.graph.op(node).operands());
        let guard = |node| match self.graph.op(node) {
            Op::Checked { guard, .. } => Some(guard),
            _ => None,
        };
        needed.into_iter().filter_map(guard).collect()
    }

    /// The input that a node is for this function, if it is one.
    fn input(self, node: NodeId) -> Option<Input> {
        let op = self.graph.op(node);
        let is_given = match self.form {
            Form::Search(search) => self.graph.is_known_to(search, node),
            Form::OnTheWay(search) => self.graph.is_given_on_the_way(search, node),
            Form::Prepare | Form::Direct | Form::FromPose | Form::Near => false,
        };
        if is_given {
            return Some(Input::Known(node));
        }
        if let Op::Symbol(symbol) = op {
            let read = match symbol {
                Symbol::Parameter(_) => self.form == Form::Prepare,
                // Elsewhere a search starts where it is declared to.
                Symbol::Start(..) => self.form == Form::Near,
                _ => true,
            };
            if read {
                return Some(Input::Symbol(symbol));
            }
        }
        if matches!(op, Op::Held(_)) && self.form == Form::FromPose {
            return Some(Input::Kept(node));
        }
        // A change of sign is made where it is used.
        let prepared = self.graph.stage(node) == Stage::Prepared && !matches!(op, Op::Neg(_));
        (prepared && self.form != Form::Prepare).then_some(Input::Prepared(node))
    }
}

struct Building<'g> {
    extract: Extract<'g>,
    scene: Option<usize>,
    program: Program,
    /// The value of each node that is placed.
    placed: BTreeMap<NodeId, ValueId>,
    /// What is computed already. Without the names within, nodes may compute the same.
    computed: FxHashMap<Op<ValueId>, ValueId>,
}

impl Building<'_> {
    /// What a node computes in this function. Where a pose keeps the reciprocal of a divisor, the quotient is a product with it; what is counted
    /// are the operations as the graph has them.
    fn op(&self, node: NodeId) -> Op {
        let graph = self.extract.graph;
        match graph.op(node) {
            Op::Quantity(value) if self.reads_pose() => {
                Op::Quantity(graph.put_together_from_pose(node).unwrap_or(value))
            }
            Op::Div(dividend, divisor) if self.reads_pose() && !graph.is_divided(node) => {
                match graph.kept_reciprocal(divisor) {
                    // A reciprocal under the name of its own.
                    Some(reciprocal) if graph.expr(dividend).is_one() => Op::Quantity(reciprocal),
                    Some(reciprocal) => Op::Mul(dividend, reciprocal),
                    None => Op::Div(dividend, divisor),
                }
            }
            op => op,
        }
    }

    /// What a node reads in this function; of a divisor in whose place another number is read the check stays.
    fn operands(&self, node: NodeId) -> Vec<NodeId> {
        let graph = self.extract.graph;
        let (own, op) = (graph.op(node), self.op(node));
        let divisor = match own {
            Op::Div(_, divisor) if op != own => Some(divisor).filter(|divisor| graph.is_checked(*divisor)),
            _ => None,
        };
        op.operands().into_iter().chain(divisor).collect()
    }

    /// Whether the function is arranged for what a pose keeps.
    fn reads_pose(&self) -> bool {
        self.extract.form == Form::FromPose && !self.program.counts_rounding
    }

    fn add(&mut self, node: NodeId, definition: Definition) -> ValueId {
        let graph = self.extract.graph;
        let id = ValueId::new(self.program.values.len());
        let label = graph.label_in(self.scene, node);
        let section = graph.heading_in(self.scene, node).unwrap_or_else(|| graph.section(node));
        let (divided, component) = (graph.is_divided(node), self.component(node));
        self.program.values.push(Value { definition, label, section, divided, component, within: None });
        self.placed.insert(node, id);
        id
    }

    /// What is known of a component of a direction.
    fn component(&self, node: NodeId) -> Option<Component<ValueId>> {
        let Component { arm, reciprocal, length } = self.extract.graph.component(node)?;
        Some(Component { arm: arm.and_then(|arm| self.placed.get(&arm).copied()), reciprocal, length })
    }

    /// The value of a node; its operands are placed.
    fn value(&mut self, node: NodeId) -> ValueId {
        if let Some(value) = self.placed.get(&node) {
            return *value;
        }
        match self.extract.input(node) {
            Some(input) => self.add(node, Definition::Input(input)),
            None => {
                match self.op(node) {
                    // A named value is the value, a kept one too where nothing is kept, a checked one because its check has its own
                    // step. A name passes on to it.
                    Op::Quantity(inner) | Op::Held(inner) | Op::Checked { value: inner, .. } => {
                        let value = self.value(inner);
                        self.placed.insert(node, value);
                        let own = &mut self.program.values[value.index()];
                        if own.label.is_none() {
                            own.label = self.extract.graph.label_in(self.scene, node);
                            own.section =
                                self.extract.graph.heading_in(self.scene, node).unwrap_or_else(|| own.section.clone());
                        }
                        value
                    }
                    Op::Symbol(Symbol::Start(search, number)) => {
                        let value = self.value(self.extract.graph.start_of(search, number));
                        self.placed.insert(node, value);
                        value
                    }
                    op => {
                        let op = op.map(|operand| self.value(operand));
                        if let Some(same) = self.computed.get(&op) {
                            self.placed.insert(node, *same);
                            let graph = self.extract.graph;
                            let component = self.component(node);
                            let known = &mut self.program.values[same.index()];
                            known.divided |= graph.is_divided(node);
                            known.component = known.component.take().or(component);
                            return *same;
                        }
                        let value = self.add(node, Definition::Computed(op.clone()));
                        self.computed.insert(op, value);
                        value
                    }
                }
            }
        }
    }

    fn place(&mut self, node: NodeId) {
        let graph = self.extract.graph;
        let before = self.program.values.len();
        let value = self.value(node);
        let known = value.index() < before;
        if known && !matches!(graph.op(node), Op::Checked { .. }) || self.extract.input(node).is_some() {
            return;
        }
        match self.op(node) {
            Op::Checked { guard, .. } if self.extract.checks(guard) => self.check(&graph.guard(guard)),
            Op::Constant(_) | Op::Quantity(_) | Op::Held(_) | Op::Checked { .. } | Op::Symbol(Symbol::Start(..)) => {}
            _ => self.program.steps.push(Step::Let(value)),
        }
    }

    fn check(&mut self, guard: &Guard) {
        let before = self.program.values.len();
        let failure = guard.failure.map(|node| self.value(node));
        let condition = guard.condition.map(|node| self.value(node));
        // What the report alone needs is computed when it is made.
        let report = (before..self.program.values.len())
            .map(ValueId::new)
            .filter(|value| match &self.program.values[value.index()].definition {
                Definition::Computed(op) => !matches!(op, Op::Constant(_)),
                Definition::Input(_) => false,
            })
            .collect();
        let report: Vec<ValueId> = report;
        self.placed.retain(|_, value| !report.contains(value));
        self.computed.retain(|_, value| !report.contains(value));
        let guard = Guard { condition, failure };
        let repeated =
            self.program.steps.iter().any(|step| matches!(step, Step::Check { guard: other, .. } if *other == guard));
        if !repeated {
            self.program.steps.push(Step::Check { guard, weaker: None, report });
        }
    }
}
