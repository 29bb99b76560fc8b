//! Methods that are derivatives of inverse and forward dynamics.

use super::Method;
use crate::bond_graph::BondGraph;

impl Method {
    /// Returns the two methods that are derivatives of the dynamics of a mechanism, inverse first.
    pub fn derivatives_of(graph: &BondGraph) -> [Method; 2] {
        let mut closed = graph.closed.iter();
        match closed.any(|closed| closed.closure.nonholonomic()) {
            true => [
                Method::InverseDerivativesByTree,
                Method::ForwardDerivativesByTree,
            ],
            false => [
                Method::InverseDynamicsDerivatives,
                Method::ForwardDynamicsDerivatives,
            ],
        }
    }

    /// Returns whether it is a derivative of inverse or forward dynamics.
    pub fn differentiates_dynamics(self) -> bool {
        self.differentiates_inverse() || self.differentiates_forward()
    }

    /// Returns whether it is a derivative of inverse dynamics.
    pub fn differentiates_inverse(self) -> bool {
        matches!(
            self,
            Method::InverseDynamicsDerivatives | Method::InverseDerivativesByTree
        )
    }

    /// Returns whether it is a derivative of forward dynamics.
    pub fn differentiates_forward(self) -> bool {
        matches!(
            self,
            Method::ForwardDynamicsDerivatives | Method::ForwardDerivativesByTree
        )
    }
}
