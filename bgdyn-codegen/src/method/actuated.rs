//! Methods of mechanisms with loops whose actuated joints are not the independent ones.

use super::Method;
use crate::bond_graph::{ClosedTree, Site};

/// The names of methods whose efforts are along the independent velocities, where other joints are actuated.
const REDUCED: [(Method, &str); 6] = [
    (Method::InverseDynamics, "reduced_inverse_dynamics"),
    (Method::ForwardDynamics, "reduced_forward_dynamics"),
    (
        Method::InverseDynamicsDerivatives,
        "reduced_inverse_dynamics_derivatives",
    ),
    (
        Method::ForwardDynamicsDerivatives,
        "reduced_forward_dynamics_derivatives",
    ),
    (
        Method::InverseDerivativesByTree,
        "reduced_inverse_dynamics_derivatives",
    ),
    (
        Method::ForwardDerivativesByTree,
        "reduced_forward_dynamics_derivatives",
    ),
];

impl Method {
    /// Returns the methods of a mechanism whose actuated joints are not the independent ones: inverse dynamics if these
    /// joints are enough for every acceleration.
    pub fn of_actuated(closed: &ClosedTree) -> Vec<Method> {
        let Some(actuated) = closed.closure.drives() else {
            return Vec::new();
        };
        let number = actuated.joints.len();
        let enough = number >= closed.closure.independents.len();
        let inverse = enough.then_some(Method::ActuatedInverse(number));
        inverse
            .into_iter()
            .chain([Method::ActuatedForward(number)])
            .collect()
    }

    /// Returns whether its efforts are those of the actuated joints.
    pub fn of_actuated_joints(self) -> bool {
        matches!(
            self,
            Method::ActuatedInverse(_)
                | Method::ActuatedForward(_)
                | Method::ActuatedReactions(_)
                | Method::ActuatedJointReactions(_)
        )
    }

    /// Returns its name in the module of this mechanism.
    pub fn name_in(self, closed: Option<&ClosedTree>, sites: &[Site]) -> String {
        let driven = closed.is_some_and(|closed| closed.closure.drives().is_some());
        let reduced = REDUCED.iter().find(|(method, _)| driven && *method == self);
        reduced.map_or_else(|| self.name(sites), |(_, name)| (*name).to_owned())
    }

    /// Returns the names of the methods whose efforts are along the independent velocities.
    pub(super) fn reduced_names() -> impl Iterator<Item = String> {
        REDUCED.iter().map(|(_, name)| (*name).to_owned())
    }

    /// Returns why a mechanism whose actuated joints are not the independent ones lacks the method with this name.
    pub(super) fn lacking(closed: &ClosedTree, name: &str) -> Option<String> {
        let actuated = closed.closure.drives()?;
        let (drives, mobility) = (actuated.joints.len(), closed.closure.independents.len());
        match name {
            "inverse_dynamics" => Some(format!(
                "no `inverse_dynamics`: the number of actuated joints is {drives}, that of independent velocities {mobility}, so that no efforts produce every acceleration; `reduced_inverse_dynamics` returns the efforts along the independent velocities"
            )),
            _ => None,
        }
    }
}
