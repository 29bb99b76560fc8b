//! The recursion with each body's own inertia: for those who would rather have digits than save
//! operations.
//!
//! Base parameters move inertia inwards and leave a rest behind; where the two meet again in an
//! effort, they may be larger than what is left of them.

use super::{best_plans, cost, plan_search, with_plan};
use crate::formulation::{Formulation, Search};
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

    fn knows(&self, method: Method) -> bool {
        method.site().is_none()
    }

    fn function(&self, search: &Search<'_>, method: Method) -> Option<Function> {
        let graph = search.graph;
        let geometry = search.recursion.geometry(graph);
        let mut best = best_plans(search, method)?;
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
