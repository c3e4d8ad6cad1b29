//! Which constraints determine which links.
//!
//! Every link has three freedoms and takes three constraints that touch it (a bipartite matching). A link then depends on the other
//! links that its constraints touch; links that depend on each other are placed together: they make a group.

use std::collections::BTreeSet;

use crate::model::ids::{GROUND, LinkId};

/// Freedoms of a link in the plane.
const FREEDOMS: usize = 3;

/// A linkage whose constraints cannot be dealt out: too many here, too few there.
#[derive(Debug)]
pub(super) struct Unbalanced {
    /// Links that have more constraints than freedoms.
    pub(super) overdetermined: BTreeSet<LinkId>,
    /// Links that have fewer.
    pub(super) loose: BTreeSet<LinkId>,
}

/// For each constraint the link that takes it.
pub(super) fn assign(links: usize, constraints: &[Vec<LinkId>]) -> Result<Vec<LinkId>, Unbalanced> {
    let mut owner: Vec<Option<LinkId>> = vec![None; constraints.len()];
    let mut unplaced = Vec::new();
    for constraint in 0..constraints.len() {
        let mut seen = BTreeSet::new();
        if !place(constraint, constraints, &mut owner, &mut seen) {
            unplaced.push(constraint);
        }
    }
    let load = |link: LinkId| owner.iter().filter(|o| **o == Some(link)).count();
    let free: Vec<LinkId> = (1..links).map(LinkId::new).filter(|l| load(*l) < FREEDOMS).collect();
    if unplaced.is_empty() && free.is_empty() {
        return Ok(owner.into_iter().map(|o| o.unwrap_or(GROUND)).collect());
    }
    Err(Unbalanced {
        overdetermined: reachable_from_constraints(&unplaced, constraints, &owner),
        loose: reachable_from_links(&free, constraints, &owner),
    })
}

/// Gives a constraint to a link with room, moving others if need be.
fn place(
    constraint: usize,
    constraints: &[Vec<LinkId>],
    owner: &mut Vec<Option<LinkId>>,
    seen: &mut BTreeSet<LinkId>,
) -> bool {
    for &link in &constraints[constraint] {
        if !seen.insert(link) {
            continue;
        }
        let held: Vec<usize> = (0..owner.len()).filter(|c| owner[*c] == Some(link)).collect();
        if held.len() < FREEDOMS || held.into_iter().any(|other| place(other, constraints, owner, seen)) {
            owner[constraint] = Some(link);
            return true;
        }
    }
    false
}

/// The links that surplus constraints press upon: all that they could go to if others made room.
fn reachable_from_constraints(
    from: &[usize],
    constraints: &[Vec<LinkId>],
    owner: &[Option<LinkId>],
) -> BTreeSet<LinkId> {
    let mut links = BTreeSet::new();
    let mut open: Vec<usize> = from.to_vec();
    while let Some(constraint) = open.pop() {
        for &link in &constraints[constraint] {
            if links.insert(link) {
                open.extend((0..owner.len()).filter(|c| owner[*c] == Some(link)));
            }
        }
    }
    links
}

/// The links that miss constraints: all from which one could be passed on to a link with room.
fn reachable_from_links(from: &[LinkId], constraints: &[Vec<LinkId>], owner: &[Option<LinkId>]) -> BTreeSet<LinkId> {
    let mut links: BTreeSet<LinkId> = from.iter().copied().collect();
    let mut open: Vec<LinkId> = from.to_vec();
    while let Some(link) = open.pop() {
        for (constraint, touched) in constraints.iter().enumerate() {
            if let (true, Some(holder)) = (touched.contains(&link), owner[constraint])
                && links.insert(holder)
            {
                open.push(holder);
            }
        }
    }
    links
}

/// The groups: strongly connected components of the links under "depends on", dependencies first (Tarjan's algorithm).
pub(super) fn components(links: usize, constraints: &[Vec<LinkId>], owner: &[LinkId]) -> Vec<Vec<LinkId>> {
    let mut depends: Vec<BTreeSet<LinkId>> = vec![BTreeSet::new(); links];
    for (touched, owner) in constraints.iter().zip(owner) {
        depends[owner.index()].extend(touched.iter().filter(|l| *l != owner));
    }
    let mut search = Search {
        depends,
        order: vec![None; links],
        low: vec![0; links],
        stack: Vec::new(),
        count: 0,
        groups: Vec::new(),
    };
    for link in (1..links).map(LinkId::new) {
        if search.order[link.index()].is_none() {
            search.visit(link);
        }
    }
    search.groups
}

struct Search {
    depends: Vec<BTreeSet<LinkId>>,
    order: Vec<Option<usize>>,
    low: Vec<usize>,
    stack: Vec<LinkId>,
    count: usize,
    groups: Vec<Vec<LinkId>>,
}

impl Search {
    fn visit(&mut self, link: LinkId) {
        let own = self.count;
        self.count += 1;
        self.order[link.index()] = Some(own);
        self.low[link.index()] = own;
        self.stack.push(link);
        for next in self.depends[link.index()].clone() {
            match self.order[next.index()] {
                None => {
                    self.visit(next);
                    self.low[link.index()] = self.low[link.index()].min(self.low[next.index()]);
                }
                Some(order) if self.stack.contains(&next) => {
                    self.low[link.index()] = self.low[link.index()].min(order);
                }
                Some(_) => {}
            }
        }
        if self.low[link.index()] == own {
            let start = self.stack.iter().position(|l| *l == link).unwrap_or(0);
            let mut group = self.stack.split_off(start);
            group.sort();
            self.groups.push(group);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{assign, components};
    use crate::model::ids::LinkId;

    fn links(indices: &[usize]) -> Vec<LinkId> {
        indices.iter().map(|i| LinkId::new(*i)).collect()
    }

    /// A four-bar: crank 1, coupler 2, rocker 3; pins at A0, A, B, B0 and the drive.
    fn four_bar() -> Vec<Vec<LinkId>> {
        [&[1][..], &[1, 2], &[2, 3], &[3]].iter().flat_map(|l| [links(l), links(l)]).chain([links(&[1])]).collect()
    }

    #[test]
    fn a_four_bar_is_a_crank_and_a_dyad() {
        let constraints = four_bar();
        let owner = assign(4, &constraints).unwrap();
        assert_eq!(components(4, &constraints, &owner), [links(&[1]), links(&[2, 3])]);
    }

    #[test]
    fn a_missing_and_a_surplus_drive_are_located() {
        let mut constraints = four_bar();
        constraints.pop();
        let loose = assign(4, &constraints).unwrap_err();
        assert!(loose.overdetermined.is_empty() && loose.loose.len() == 3);
        constraints.extend([links(&[1]), links(&[3])]);
        let tight = assign(4, &constraints).unwrap_err();
        assert!(tight.loose.is_empty() && tight.overdetermined.len() == 3);
    }
}
