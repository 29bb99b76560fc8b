//! Second derivatives of all efforts, from their first derivatives and the mass matrix.
//!
//! With S = ∂τ/∂q, D = ∂τ/∂v and the mass matrix M, and the derivatives ∂_k along the velocity k:
//!
//! - by q and q: ∂_k S_ij, symmetric in j and k where velocities are rates of positions;
//! - by q and v: ∂_j D_ik;
//! - by a and q: ∂_k M_ij, symmetric in i and j;
//! - by v and v: ∂_k M_ij + ∂_j M_ik − ∂_i M_jk, twice the Christoffel symbols of M; where velocities are no rates of
//!   positions ∂D_ij/∂v_k.

use super::differentiate::{finish, position_derivatives, reopen};
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Leaf, Signed, copy_into};
use crate::formulation::Prepared;
use crate::formulation::slopes::derivatives;
use crate::function::{Function, in_triangle};
use crate::method::{Directional, Method};
use crate::passes::cheapest;

/// The methods that it is made of.
pub(super) const READS: [Method; 2] = [Method::InverseDynamicsDerivatives, Method::MassMatrix];

/// Returns the function, of the cheapest first derivatives.
pub(super) fn function(prepared: &Prepared<'_>) -> Option<Function> {
    let graph = prepared.graph;
    let mass = prepared.function(Method::MassMatrix)?;
    let slopes = prepared.candidates(Method::InverseDynamicsDerivatives);
    let slopes = slopes.accepted.iter();
    cheapest(slopes.map(|slopes| differentiated(graph, &slopes.plain, &mass)))
}

fn differentiated(graph: &BondGraph, slopes: &Function, mass: &Function) -> Function {
    let n = graph.coordinates.len();
    let (b, slopes_of) = reopen(slopes);
    let entries = &mass.blocks[0].outputs;
    let entries = b.with_graph(|g| copy_into(g, &mass.graph, entries, |_, _| None));
    let (by_q, by_v) = slopes_of.split_at(n * n);
    let tree = graph.closed.as_ref().map_or(graph, |closed| &closed.tree);
    let second = Second {
        b: &b,
        n,
        commutes: tree.rates_are_velocities(),
        by_q: position_derivatives(&b, by_q, graph),
        by_v: position_derivatives(&b, by_v, graph),
        mass: position_derivatives(&b, &entries, graph),
    };
    let outputs = [
        second.by_positions(),
        second.by_both(),
        second.by_velocities(by_v, graph.velocity_products),
        second.by_accelerations(),
    ];
    let method = Method::Directional(Directional::InverseSecond);
    let made = finish(graph, method, slopes, b, outputs.concat());
    Function {
        formulation: format!("{}; {}", made.formulation, mass.formulation),
        ordered: slopes.ordered || mass.ordered,
        ..made
    }
}

/// The derivatives of S, D and M along each velocity: S and D row by row, M the lower triangle.
struct Second<'g> {
    b: &'g Builder,
    n: usize,
    /// Whether derivatives along two velocities may be taken in either order.
    commutes: bool,
    by_q: Vec<Vec<Signed>>,
    by_v: Vec<Vec<Signed>>,
    mass: Vec<Vec<Signed>>,
}

impl Second<'_> {
    /// Returns an entry for each effort i, row j and column k.
    fn entries(&self, entry: impl Fn(usize, usize, usize) -> Signed) -> Vec<Signed> {
        let n = self.n;
        let at = |place: usize| entry(place / (n * n), place / n % n, place % n);
        (0..n * n * n).map(at).collect()
    }

    fn by_positions(&self) -> Vec<Signed> {
        self.entries(|i, j, k| {
            // The derivative along the outer joint has fewer operations.
            let (j, k) = match self.commutes {
                true => (j.min(k), j.max(k)),
                false => (j, k),
            };
            self.by_q[k][i * self.n + j]
        })
    }

    fn by_both(&self) -> Vec<Signed> {
        self.entries(|i, j, k| self.by_v[j][i * self.n + k])
    }

    /// Without velocity products the efforts do not have the terms of the Christoffel symbols.
    fn by_velocities(&self, by_v: &[Signed], velocity_products: bool) -> Vec<Signed> {
        if !(self.commutes && velocity_products) {
            let along = derivatives(self.b, by_v, self.n, Leaf::Velocity);
            return self.entries(|i, j, k| along[j.max(k)][i * self.n + j.min(k)]);
        }
        let mass = |i, j, k| self.b.expr(self.of_mass(i, j, k));
        self.entries(|i, j, k| {
            let (j, k) = (j.min(k), j.max(k));
            (mass(i, j, k) + mass(i, k, j) - mass(j, k, i)).signed()
        })
    }

    fn by_accelerations(&self) -> Vec<Signed> {
        self.entries(|i, j, k| self.of_mass(i, j, k))
    }

    /// Returns ∂_k M_ij.
    fn of_mass(&self, i: usize, j: usize, k: usize) -> Signed {
        self.mass[k][in_triangle(i.max(j), i.min(j))]
    }
}
