//! The formulation `recursion`: the recursion with base parameters.

use super::expressions::outputs;
use super::geometry::Geometry;
use super::plan_search::BestPlan;
use super::plans::best_plans;
use super::{kinematics, plan_search};
use crate::bond_graph::{LinkFrame, Multibody};
use crate::expr::Builder;
use crate::formulation::{Formulation, Offer, Prepared};
use crate::function::Function;
use crate::method::Method;

/// The recursion.
pub(in crate::formulation) struct Recursion;

impl Formulation for Recursion {
    fn name(&self) -> &'static str {
        "recursion"
    }

    fn summary(&self) -> &'static str {
        "link axes, base parameters, common-axis trick, sliding origins, groups of parallel axes"
    }

    fn unserved<'a>(&self, _: &'a Multibody) -> Option<&'a LinkFrame> {
        None
    }

    fn offer(&self, prepared: &Prepared<'_>, method: Method) -> Offer {
        match makes(prepared.graph, method) {
            true => Offer::Candidate,
            false => Offer::Never,
        }
    }

    fn function(&self, prepared: &Prepared<'_>, method: Method) -> Option<Function> {
        let graph = prepared.graph;
        let geometry = prepared.geometry_of(method);
        if !makes(graph, method) {
            return None;
        }
        if let Some(site) = method.placed_site() {
            return Some(kinematics::function(graph, geometry, method, site));
        }
        let best = best_plans(prepared, method)?;
        Some(with_plan(graph, geometry, method, &best))
    }

    fn sharing(&self, prepared: &Prepared<'_>, method: Method, others: &[Method]) -> Vec<Function> {
        let (graph, geometry) = (prepared.graph, prepared.geometry());
        let plans = others
            .iter()
            .filter(|other| of_one_motion(**other) && makes(graph, **other));
        let plans = plans.filter_map(|&other| best_plans(prepared, other));
        plans
            .flat_map(|best| match method {
                Method::JacobianDotV(site) => {
                    kinematics::sharing(graph, geometry, site, best.taken())
                }
                method if of_one_motion(method) => vec![with_plan(graph, geometry, method, &best)],
                _ => Vec::new(),
            })
            .collect()
    }
}

/// Returns whether a method is computed from the motion of the bodies, or their inertia, under a plan.
fn of_one_motion(method: Method) -> bool {
    matches!(
        method,
        Method::InverseDynamics | Method::Bias | Method::ForwardDynamics | Method::MassMatrix
    )
}

/// Returns whether the recursion has the method: its derivatives are those of joints with q̇ = v. Loads through joints
/// are not those of base parameters, which move masses between links.
pub(super) fn makes(graph: &Multibody, method: Method) -> bool {
    let partial = [
        Method::InverseDynamicsDerivatives,
        Method::ForwardDynamicsDerivatives,
        Method::CoriolisMatrix,
    ];
    method != Method::JointReactions
        && !method.is_derived()
        && method != Method::MassMatrixRate
        && (graph.plain() || !partial.contains(&method))
}

/// Returns the function under the chosen plan.
pub(super) fn with_plan(
    graph: &Multibody,
    geometry: &Geometry,
    method: Method,
    best: &BestPlan,
) -> Function {
    let plan = best.taken();
    let (made, outputs) = outputs(Builder::new(), graph, geometry, method, plan);
    let name = format!(
        "{}: {}",
        Recursion.name(),
        plan_search::describe(geometry, plan)
    );
    let plans = best.considered(geometry);
    Function {
        plans,
        ..Function::flat(graph, method, name, made, outputs)
    }
}
