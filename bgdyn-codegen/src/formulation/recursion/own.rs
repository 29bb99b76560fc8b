//! The recursion with each body's own inertia: for those who would rather have digits than save
//! operations.
//!
//! Base parameters move inertia inwards and leave a rest behind; where the two meet again in an
//! effort, they may be larger than what is left of them.

use super::frames::Plan;
use super::geometry::geometry;
use super::{best_plan, plan, with_plan};
use crate::bond_graph::BondGraph;
use crate::formulation::Formulation;
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

    fn function(&self, graph: &BondGraph, method: Method) -> Option<Function> {
        let geometry = geometry(graph);
        let plan = Plan {
            base_parameters: false,
            ..best_plan(graph, &geometry, method)?
        };
        let mut function = with_plan(graph, &geometry, method, &plan);
        function.formulation = format!("{}: {}", self.name(), plan::describe(&geometry, &plan));
        Some(function)
    }
}
