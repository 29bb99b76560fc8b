//! Regressors of a payload: a rigid body that is fixed to a frame.
//!
//! Its parameters are the ten numbers of a body as regressors have them, about the origin of the frame, in its axes.

use super::{Argument, ParameterSet, Shape};
use crate::bond_graph::{Site, SiteId};

/// A method for the parameters of a payload.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PayloadRegressor {
    /// Y_X(q, v, a): the payload adds Y_X π to the efforts.
    Regressor(SiteId),
    /// Y_Xᵀ s of two velocities.
    AdaptiveStep(SiteId),
}

impl PayloadRegressor {
    /// Returns the methods of a site.
    pub fn of_site(site: SiteId) -> [PayloadRegressor; 2] {
        [
            PayloadRegressor::Regressor(site),
            PayloadRegressor::AdaptiveStep(site),
        ]
    }

    /// Returns its site.
    pub fn site(self) -> SiteId {
        let (PayloadRegressor::Regressor(site) | PayloadRegressor::AdaptiveStep(site)) = self;
        site
    }

    /// Returns its name, without that of the site.
    pub(super) fn prefix(self) -> &'static str {
        match self {
            PayloadRegressor::Regressor(_) => "payload_regressor",
            PayloadRegressor::AdaptiveStep(_) => "payload_adaptive_step",
        }
    }

    pub(super) fn arguments(self) -> &'static [Argument] {
        use Argument::{A, Direction, Q, ReferenceA, ReferenceV, V};
        match self {
            PayloadRegressor::Regressor(_) => &[Q, V, A],
            PayloadRegressor::AdaptiveStep(_) => &[Q, V, ReferenceV, ReferenceA, Direction],
        }
    }

    pub(super) fn shape(self) -> Shape {
        match self {
            PayloadRegressor::Regressor(_) => Shape::ParameterColumns(ParameterSet::Payload),
            PayloadRegressor::AdaptiveStep(_) => Shape::ParameterVector(ParameterSet::Payload),
        }
    }

    pub(super) fn summary(self, sites: &[Site]) -> String {
        let of = &sites[self.site().0].name;
        let parameters = format!(
            "the ten parameters π of a payload at `{of}`: m, mx, my, mz, Ixx, Ixy, Iyy, Ixz, Iyz, Izz about its origin, in its axes"
        );
        match self {
            PayloadRegressor::Regressor(_) => {
                format!("Regressor Y of {parameters}. The payload adds Y π to the joint efforts.")
            }
            PayloadRegressor::AdaptiveStep(_) => format!(
                "Yᵀ s with the regressor Y of two velocities (Slotine and Li 1987) of {parameters}: the direction of an adaptation law."
            ),
        }
    }

    pub(super) fn units(self) -> &'static str {
        match self {
            PayloadRegressor::Regressor(_) => {
                "N·m for a rotation, N for a translation, per kg, kg·m, kg·m²"
            }
            PayloadRegressor::AdaptiveStep(_) => "units of s times efforts, per kg, kg·m, kg·m²",
        }
    }
}
