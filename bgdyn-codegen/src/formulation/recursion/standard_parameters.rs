//! The recursion with each body's own inertia, for users who prefer accuracy to fewer operations.
//!
//! Base parameters move inertia inboard and leave a remainder. Where both contribute to one effort, they
//! can be larger than their sum, and digits are lost.

use super::formulation::{makes, with_plan};
use super::plan_search;
use super::plans::{best_plans, cost};
use crate::bond_graph::{LinkFrame, Multibody};
use crate::formulation::{Formulation, Offer, Prepared};
use crate::function::Function;
use crate::method::Method;

/// The recursion without base parameters.
pub(in crate::formulation) struct OwnInertia;

impl Formulation for OwnInertia {
    fn name(&self) -> &'static str {
        "recursion_own"
    }

    fn summary(&self) -> &'static str {
        "the recursion with each body's own inertia instead of base parameters"
    }

    fn unserved<'a>(&self, _: &'a Multibody) -> Option<&'a LinkFrame> {
        None
    }

    fn knows(&self, method: Method) -> bool {
        method.placed_site().is_none() && !method.is_derived()
    }

    fn offer(&self, _: &Prepared<'_>, _: Method) -> Offer {
        Offer::Never
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let graph = prepared.graph;
        if !makes(graph, method) {
            return None;
        }
        let geometry = prepared.geometry_of(method);
        let mut best = best_plans(prepared, method)?;
        for tried in &mut best.plans {
            tried.plan.base_parameters = false;
            tried.cost = cost(graph, geometry, method, &tried.plan);
        }
        let mut function = with_plan(graph, geometry, method, &best);
        let described = plan_search::describe(geometry, best.taken());
        function.formulation = format!("{}: {described}", self.name());
        Some(function)
    }
}
