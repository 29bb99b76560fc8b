//! Forward dynamics by articulated bodies, over the frames and the bias of the recursion.
//!
//! The algorithm is that of Featherstone 2008, *Rigid Body Dynamics Algorithms*, ch. 7.
//!
//! The work is proportional to the number of bodies, not to its cube. Small pivots are accurate: the
//! projection along a joint is subtracted before the inertia of its parent is added, so that large terms
//! do not cancel in the parent's pivot. This is true if each body has its own inertia. With base
//! parameters, which move part of the inertia to the parent beforehand, the function has fewer operations
//! and the accuracy of an elimination of M.
//!
//! Accelerations are relative to the motion with q̈ = 0, whose wrenches the bias already contains, so that
//! no velocity enters these sweeps. A rotor behind a gear adds N²J to its joint's pivot, and the fraction
//! N²J/pivot of the row and column along the joint acts on the parent.
//!
//! If a joint's own inertia ratio is almost zero, its pivot may consist of rounding errors only.
//! `expr/error.rs` bounds its error operation by operation, and the pivot must exceed the bound.

mod hinge;
mod inertia;
mod sweep;

use super::frames::Frames;
use super::geometry::Geometry;
use super::inertia_ratio::{MIN_INERTIA_RATIO, own_inertia_ratios};
use super::motion::{GravityField, add_set_aside, motions};
use super::plan::{MomentaPlan, Plan};
use super::plan_search::{self, BestPlan, SEARCHED};
use super::plans::cheapest_plans;
use super::{expressions, inverse_dynamics};
use crate::bond_graph::{LinkFrame, Multibody};
use crate::expr::{self, Builder, Cost, Graph, Signed};
use crate::formulation::arguments::Arguments;
use crate::formulation::{Formulation, Offer, Prepared};
use crate::function::Function;
use crate::method::Method;
use sweep::Sweep;

const METHOD: Method = Method::ForwardDynamics;

/// Forward dynamics by articulated bodies.
pub(in crate::formulation) enum Articulated {
    /// Each body with its own inertia: small pivots are accurate.
    Own,
    /// With base parameters.
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

    fn factors_mass(&self) -> bool {
        false
    }

    fn unserved<'a>(&self, graph: &'a Multibody) -> Option<&'a LinkFrame> {
        first_follower(graph).or(graph.first_prescribed())
    }

    fn knows(&self, method: Method) -> bool {
        method.shape().checked()
    }

    /// - If a joint's own inertia ratio is below [`MIN_INERTIA_RATIO`], `articulated` at any cost: no
    ///   sample of states could show that another formulation computes that joint's pivot accurately.
    /// - `articulated_base` in place of the recursion if it needs fewer operations than the elimination
    ///   of a long chain's M alone; as a candidate if it is cheaper under the best plan of the recursion.
    ///   A plan that suits one suits the other except for a few operations, so this shows whether a
    ///   search for its own plan is worth the time. Always as a candidate with joints of several
    ///   velocities, whose blocks of M are full.
    /// - Otherwise `articulated_base` is a reserve, and `articulated` the last resort.
    fn offer(&self, prepared: &Prepared<'_>, method: Method) -> Offer {
        let (graph, geometry) = (prepared.graph, prepared.geometry());
        if !makes(graph, method) {
            return Offer::Never;
        }
        let ratios = own_inertia_ratios(graph, geometry);
        let light = ratios.iter().position(|&ratio| ratio < MIN_INERTIA_RATIO);
        match (self, light) {
            (Articulated::Own, Some(j)) => {
                let link = &geometry.bodies[j].name;
                Offer::Instead(Some(format!("{link} has next to no inertia of its own")))
            }
            (Articulated::Own, None) => Offer::LastResort,
            (Articulated::Base, Some(_)) => Offer::Never,
            (Articulated::Base, None) => self.offer_beside_recursion(prepared),
        }
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let (graph, geometry) = (prepared.graph, prepared.geometry());
        if !makes(graph, method) {
            return None;
        }
        let found = self.search(prepared);
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
            // The accuracy of its pivots depends on the order of subtractions.
            Articulated::Own => function.in_order(),
            Articulated::Base => function,
        })
    }
}

/// Returns the first link whose joint is coupled to others.
fn first_follower(graph: &Multibody) -> Option<&LinkFrame> {
    let mut frames = graph.frames.iter();
    frames.find(|frame| !frame.degrees.own_velocities())
}

/// Returns whether articulated bodies support the method. A rotor that rotates with its carrier couples
/// joints other than through their bodies, and so does a coupled joint.
fn makes(graph: &Multibody, method: Method) -> bool {
    method == METHOD
        && first_follower(graph).is_none()
        && graph.rotors.iter().all(|r| r.carrier.is_none())
}

/// Returns the number of operations for the elimination of M alone: each joint's row is subtracted from
/// those of the inboard joints.
fn elimination(geometry: &Geometry) -> usize {
    let mut depths: Vec<usize> = Vec::new();
    for parent in geometry.parents() {
        depths.push(parent.map_or(0, |p| depths[p] + 1));
    }
    depths.iter().map(|d| d * (d + 1)).sum()
}

impl Articulated {
    fn search(&self, prepared: &Prepared<'_>) -> BestPlan {
        let (graph, geometry) = (prepared.graph, prepared.geometry());
        let momenta = MomentaPlan::default();
        plan_search::search(geometry, momenta, |plan| self.cost(graph, geometry, plan))
    }

    fn offer_beside_recursion(&self, prepared: &Prepared<'_>) -> Offer {
        let (graph, geometry) = (prepared.graph, prepared.geometry());
        let long = geometry.bodies.len() > SEARCHED;
        if long && self.search(prepared).cost().operations.total() < elimination(geometry) {
            return Offer::Instead(None);
        }
        if !graph.plain() {
            return Offer::Candidate;
        }
        let best = cheapest_plans(prepared, METHOD);
        let (made, outputs) =
            expressions::outputs(Builder::silent(), graph, geometry, METHOD, best.taken());
        let recursion = expr::cost(&made, &outputs).weighted();
        match self.cost(graph, geometry, best.taken()).weighted() < recursion {
            true => Offer::Candidate,
            false => Offer::Reserve,
        }
    }

    /// Returns the cost under a plan, without the bounds of pivots, which cost almost the same under each
    /// plan.
    fn cost(&self, graph: &Multibody, geometry: &Geometry, plan: &Plan) -> Cost {
        let unguarded = vec![false; geometry.bodies.len()];
        let (graph, outputs) = self.outputs(Builder::silent(), graph, geometry, plan, &unguarded);
        expr::cost(&graph, &outputs).unfinished()
    }

    /// Returns the accelerations under a plan.
    fn outputs(
        &self,
        b: Builder,
        graph: &Multibody,
        geometry: &Geometry,
        plan: &Plan,
        guarded: &[bool],
    ) -> (Graph, Vec<Signed>) {
        let careful = matches!(self, Articulated::Own);
        let plan = &Plan {
            base_parameters: !careful,
            ..plan.clone()
        };
        let outputs: Vec<Signed> = {
            let x = Arguments::new(&b, graph, Method::ForwardDynamics);
            let frames = Frames::new(&b, graph, geometry, plan, &x);
            let sweep = Sweep::new(&b, &frames, careful, (guarded, plan.linear_first));
            let moving = motions(&b, &frames, GravityField::SetAside);
            let loads = inverse_dynamics::loads(&b, &frames, plan, &moving);
            let mut found = sweep.accelerations(&loads, &x.tau);
            add_set_aside(&frames, &moving, &mut found);
            found.into_iter().map(|e| e.signed()).collect()
        };
        (b.into_graph(), outputs)
    }
}
