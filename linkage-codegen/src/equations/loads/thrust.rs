//! A thrust between two points, such as that of a cylinder whose own bodies do not matter: positive, it pushes them apart.

use super::{Action, Line};
use crate::graph::Expr;

pub(super) fn actions<'m>(line: &Line<'m>, force: Expr<'m>) -> Vec<Action> {
    line.pushed(line.along(force))
}
