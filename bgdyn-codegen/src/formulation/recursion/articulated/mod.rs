//! Forward dynamics by articulated bodies (Featherstone 2008, *Rigid Body Dynamics Algorithms*,
//! ch. 7), over the frames and the bias of the recursion.
//!
//! The work grows with the number of bodies, not with its cube. And small pivots keep their
//! digits: what a joint gives way to is taken away before the inertia of its carrier is added, so
//! that large terms do not cancel in the carrier's pivot. That holds while each body keeps its own
//! inertia. Over base parameters, which give part of it to the carrier beforehand, there are fewer
//! operations and the digits of an elimination of M.
//!
//! Accelerations are relative to the motion with q̈ = 0, whose wrenches the bias already gives, so that no
//! velocity enters these sweeps. A rotor behind a gear adds N²J to its joint's pivot, and of the row and
//! column along the joint the part N²J/pivot is passed on.
//!
//! Where a joint's own inertia ratio is next to zero, only rounding errors may be left of a pivot.
//! `expr/error.rs` bounds its error operation by operation, and the pivot must exceed the bound.

mod inertia;
mod sweep;

use super::frames::Frames;
use super::geometry::Geometry;
use super::inertia_ratio::{MIN_INERTIA_RATIO, own_inertia_ratios};
use super::plan::Plan;
use super::{inverse_dynamics, plan_search};
use crate::bond_graph::BondGraph;
use crate::expr::{self, Builder, Cost, Expr, Graph};
use crate::formulation::arguments::Arguments;
use crate::formulation::{Formulation, Search};
use crate::function::Function;
use crate::method::Method;
use sweep::Sweep;

/// Forward dynamics by articulated bodies.
pub(in crate::formulation) enum Articulated {
    /// Each body with its own inertia: small pivots keep their digits.
    Own,
    /// Over base parameters.
    Base,
}

impl Formulation for Articulated {
    fn name(&self) -> &'static str {
        match self {
            Articulated::Own => "articulated",
            Articulated::Base => "articulated_base",
        }
    }

    fn summary(&self) -> &'static str {
        match self {
            Articulated::Own => "articulated bodies: small pivots keep their digits",
            Articulated::Base => "articulated bodies over base parameters",
        }
    }

    fn knows(&self, method: Method) -> bool {
        method.shape().checked()
    }

    fn function(&self, search: &Search<'_>, method: Method) -> Option<Function> {
        // A rotor that turns with its carrier couples joints beside their bodies.
        let coupled = search.graph.rotors.iter().any(|r| r.carrier.is_some());
        if method != Method::ForwardDynamics || coupled {
            return None;
        }
        let graph = search.graph;
        let geometry = search.recursion.geometry(graph);
        let cost = |plan: &Plan| self.cost(graph, geometry, plan);
        let found = plan_search::search(geometry, cost);
        let best = found.taken();
        // A pivot is never less than the own inertia of its joint.
        let guarded: Vec<bool> = own_inertia_ratios(graph, geometry)
            .iter()
            .map(|&ratio| ratio < MIN_INERTIA_RATIO)
            .collect();
        let (made, outputs) = self.outputs(Builder::new(), graph, geometry, best, &guarded);
        let name = format!("{}: {}", self.name(), plan_search::describe(geometry, best));
        let function = Function {
            plans: found.considered(geometry),
            ..Function::flat(graph, method, name, made, outputs)
        };
        Some(match self {
            // Its pivots keep their digits by the order of what is subtracted in them.
            Articulated::Own => function.in_order(),
            Articulated::Base => function,
        })
    }
}

impl Articulated {
    /// Operations under a plan, but for the bounds of pivots: those are much the same under each.
    pub(super) fn cost(&self, graph: &BondGraph, geometry: &Geometry, plan: &Plan) -> Cost {
        let unguarded = vec![false; geometry.bodies.len()];
        let (graph, outputs) = self.outputs(Builder::silent(), graph, geometry, plan, &unguarded);
        expr::cost(&graph, &outputs).unfinished()
    }

    /// The accelerations under a plan.
    fn outputs(
        &self,
        b: Builder,
        graph: &BondGraph,
        geometry: &Geometry,
        plan: &Plan,
        guarded: &[bool],
    ) -> (Graph, Vec<Expr>) {
        let careful = matches!(self, Articulated::Own);
        let plan = &Plan {
            base_parameters: !careful,
            ..plan.clone()
        };
        let outputs: Vec<Expr> = {
            let x = Arguments::new(&b, graph, Method::ForwardDynamics);
            let frames = Frames::new(&b, graph, geometry, plan, &x);
            let sweep = Sweep::new(&b, &frames, careful, guarded);
            let loads = inverse_dynamics::loads(&b, &frames, plan, x.active);
            let found = sweep.accelerations(&loads, &x.tau);
            found.into_iter().map(|e| e.expr()).collect()
        };
        (b.into_graph(), outputs)
    }
}
