//! Causality of hydraulic elements.
//!
//! Every element needs a cause, an effort or a flow that is determined at each instant. The state of a store is
//! one. Without a store (a junction of two orifices without a volume, a winding without inductance) the laws of
//! the elements form an algebraic loop. This file solves such loops at generation time, or reports them.
//!
//! Elements in series are solvable. They have the same flow q, and their pressure drops Δp_i = R_i q + S_i
//! q|q| add up to R q + S q|q| with R = Σ R_i and S = Σ S_i, which has one solution. Not solvable are
//! three flows at a junction without a volume, or a varying opening, which can close and leave the
//! pressure between two closed valves undetermined.

use super::Scene;
use crate::declaration::{Chain, Element};
use crate::fault::{Fault, Faults, wording};

/// Elements without a store between them, and their solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Solved {
    /// Their names.
    pub elements: Vec<String>,
    /// The nodes between them.
    pub nodes: Vec<String>,
    /// The method of solution.
    pub how: String,
}

impl Scene {
    /// Returns the elements without a store as their cause, with their solutions.
    pub fn solved(&self) -> Vec<Solved> {
        let alone = self.elements.iter().filter_map(|e| {
            e.effect.algebraic(e).map(|how| Solved {
                elements: vec![e.name.clone()],
                nodes: vec![],
                how: how.to_owned(),
            })
        });
        let in_series = self.chains.iter().map(|chain| {
            let name = |&(i, _): &(usize, bool)| self.elements[i].name.clone();
            let (from, to) = (&chain.from, &chain.to);
            Solved {
                elements: chain.members.iter().map(name).collect(),
                nodes: chain.through.clone(),
                how: format!("in series from `{from}` to `{to}`: R and S of Δp = R q + S q|q| add"),
            }
        });
        alone.chain(in_series).collect()
    }
}

/// Returns the chains of elements through junctions; unsolvable ones are faults.
pub(super) fn chains(elements: &[Element], faults: &mut Faults) -> Vec<Chain> {
    let before = faults.count();
    let junctions = elements.iter().filter(|e| e.effect.is_junction());
    let junctions: Vec<&Element> = junctions.collect();
    for junction in &junctions {
        faults.0.extend(unsolvable(junction, elements));
    }
    if faults.count() > before {
        return vec![];
    }
    let is_junction = |node: &str| junctions.iter().any(|j| j.name == node);
    let mut chains: Vec<Chain> = Vec::new();
    let mut used = vec![false; elements.len()];
    for i in 0..elements.len() {
        if let [a, b] = elements[i].joins()[..]
            && is_junction(a) != is_junction(b)
            && !used[i]
        {
            let chain = follow(i, !is_junction(a), elements, &is_junction);
            chain.members.iter().for_each(|&(k, _)| used[k] = true);
            chains.push(chain);
        }
    }
    // Elements that no chain has reached form a cycle.
    let reached = |j: &Element| chains.iter().any(|c| c.through.contains(&j.name));
    if let Some(junction) = junctions.iter().find(|j| !reached(j)) {
        let (name, location) = (&junction.name, &junction.location);
        faults.push(wording::circle_without_volume(location, name));
    }
    chains
}

/// Returns whether an element is no junction, or a junction with a solvable pressure.
pub(super) fn is_solvable(element: &Element, elements: &[Element]) -> bool {
    !element.effect.is_junction() || unsolvable(element, elements).is_none()
}

/// Returns the reason why the pressure of a junction is not solvable.
fn unsolvable(junction: &Element, elements: &[Element]) -> Option<Fault> {
    let (name, location) = (junction.name.as_str(), &junction.location);
    let joined = elements.iter().filter(|e| e.joins().contains(&name));
    let joined: Vec<&Element> = joined.collect();
    let names: Vec<&str> = joined.iter().map(|e| e.name.as_str()).collect();
    let varies = match joined.as_slice() {
        [] | [_] => return Some(wording::dead_end(location, name, names.first().copied())),
        [a, b] => Some([a, b].into_iter().find(|e| !e.effect.in_series(e))?),
        _ => None,
    };
    let varies = varies.map(|e| e.name.as_str());
    Some(wording::junction_without_volume(
        location, name, &names, varies,
    ))
}

/// Returns the chain that begins with an element at a node of known pressure.
fn follow(
    first: usize,
    forward: bool,
    elements: &[Element],
    is_junction: &dyn Fn(&str) -> bool,
) -> Chain {
    let ends = |i: usize, forward: bool| match (&elements[i].joins()[..], forward) {
        (&[a, b], true) => [a, b],
        (&[a, b], false) => [b, a],
        _ => unreachable!("an element in series joins two nodes"),
    };
    let [from, mut at] = ends(first, forward);
    let mut chain = Chain {
        from: from.to_owned(),
        to: String::new(),
        members: vec![(first, forward)],
        through: vec![],
    };
    let mut last = first;
    while is_junction(at) {
        chain.through.push(at.to_owned());
        let next = (0..elements.len()).find(|&i| i != last && elements[i].joins().contains(&at));
        let Some(next) = next else { break };
        let forward = elements[next].joins()[0] == at;
        chain.members.push((next, forward));
        (last, at) = (next, ends(next, forward)[1]);
    }
    chain.to = at.to_owned();
    chain
}
