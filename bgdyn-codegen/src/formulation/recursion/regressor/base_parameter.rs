//! A base parameter: entries of the inertia of a body in the frames of the recursion, and its row of K.

use std::collections::BTreeMap;

use bgdyn_runtime::Dd;

use super::super::geometry::Geometry;
use crate::bond_graph::Multibody;
use crate::mechanism::LinkId;

/// A row of K: coefficients by the index of the parameter of a body.
pub(in crate::formulation) type CoefficientRow = BTreeMap<usize, Dd>;

/// An entry of the inertia of a body in the frames of the recursion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct InertiaEntry {
    /// The body.
    pub body: usize,
    /// The index of the entry in [`BodyInertia::entries`].
    pub index: usize,
}

/// A base parameter.
#[derive(Clone, Debug)]
pub(in crate::formulation) struct BaseParameter {
    /// The entries with this value: its column is the sum of theirs.
    pub(super) entries: Vec<InertiaEntry>,
    /// Whether it is the entries' value with the opposite sign: axes of bodies may be opposite to those of links.
    pub(super) negative: bool,
    /// Its row of K.
    pub row: CoefficientRow,
}

impl BaseParameter {
    /// Turns the sign of a first moment or a product of inertia whose first coefficient is negative.
    pub(super) fn turn(&mut self) {
        let signed = |entry: &InertiaEntry| matches!(entry.index, 2..=4 | 8..=10);
        let negative = self.row.values().next().is_some_and(|x| *x < Dd::ZERO);
        if negative && self.entries.iter().all(signed) {
            self.negative = true;
            self.row.values_mut().for_each(|x| *x = -*x);
        }
    }
}

/// Returns the bodies of regressors among those of the recursion, in the order of the parameters.
pub(super) fn bodies(graph: &Multibody, geometry: &Geometry) -> Vec<usize> {
    let place = |link: &LinkId| geometry.bodies.iter().position(|body| body.link() == *link);
    graph.moving_links().iter().filter_map(place).collect()
}
