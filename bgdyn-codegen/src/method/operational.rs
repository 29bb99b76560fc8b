//! Methods of operational space: the inertia that the joints show, and the inertia that a frame shows (Khatib 1987).
//!
//! The task is the velocity of a frame, angular part first, in world axes at its origin: J v.

use super::{Argument, Entries, Shape};
use crate::bond_graph::{Site, SiteId};

/// The directions of a task: of the angular velocity, then of the velocity of the frame's origin.
pub const TASK_DIRECTIONS: [&str; 6] = [
    "angular x",
    "angular y",
    "angular z",
    "linear x",
    "linear y",
    "linear z",
];

/// A method of operational space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Operational {
    /// M⁻¹.
    InverseMassMatrix,
    /// Λ⁻¹ = J M⁻¹ Jᵀ, which exists in every posture.
    InverseInertia(SiteId),
    /// Λ = (J M⁻¹ Jᵀ)⁻¹.
    Inertia(SiteId),
    /// J̄ = M⁻¹ Jᵀ Λ.
    ConsistentInverse(SiteId),
    /// μ = Λ (J M⁻¹ h − J̇ v).
    Bias(SiteId),
}

impl Operational {
    /// Returns the methods of a site.
    pub fn of_site(site: SiteId) -> [Operational; 4] {
        [
            Operational::InverseInertia(site),
            Operational::Inertia(site),
            Operational::ConsistentInverse(site),
            Operational::Bias(site),
        ]
    }

    /// Returns its site.
    pub fn site(self) -> Option<SiteId> {
        match self {
            Operational::InverseMassMatrix => None,
            Operational::InverseInertia(site)
            | Operational::Inertia(site)
            | Operational::ConsistentInverse(site)
            | Operational::Bias(site) => Some(site),
        }
    }

    /// Returns whether it has no result where the frame cannot move in some direction.
    pub fn inverts_task(self) -> bool {
        matches!(
            self,
            Operational::Inertia(_) | Operational::ConsistentInverse(_) | Operational::Bias(_)
        )
    }

    /// Returns its name, without that of a site.
    pub(super) fn prefix(self) -> &'static str {
        match self {
            Operational::InverseMassMatrix => "inverse_mass_matrix",
            Operational::InverseInertia(_) => "operational_inverse",
            Operational::Inertia(_) => "operational_inertia",
            Operational::ConsistentInverse(_) => "consistent_inverse",
            Operational::Bias(_) => "operational_bias",
        }
    }

    pub(super) fn arguments(self) -> &'static [Argument] {
        match self {
            Operational::Bias(_) => &[Argument::Q, Argument::V],
            _ => &[Argument::Q],
        }
    }

    pub(super) fn shape(self) -> Shape {
        Shape::Checked(match self {
            Operational::InverseMassMatrix => Entries::Joints,
            Operational::InverseInertia(_) | Operational::Inertia(_) => Entries::Task,
            Operational::ConsistentInverse(_) => Entries::TaskColumns,
            Operational::Bias(_) => Entries::TaskVector,
        })
    }

    pub(super) fn summary(self, sites: &[Site]) -> String {
        let of = self.site().map_or("", |site| &sites[site.0].name);
        let task = "angular part first; world axes, at its origin";
        match self {
            Operational::InverseMassMatrix => {
                "Inverse M⁻¹(q) of the mass matrix, exactly symmetric: accelerations by efforts."
                    .into()
            }
            Operational::InverseInertia(_) => format!(
                "Λ⁻¹ = J M⁻¹ Jᵀ of `{of}`: its acceleration by a moment and a force on it, {task}. It exists in singular postures."
            ),
            Operational::Inertia(_) => format!(
                "Operational inertia Λ = (J M⁻¹ Jᵀ)⁻¹ of `{of}`: the moment and the force that accelerate it, {task} (Khatib 1987)."
            ),
            Operational::ConsistentInverse(_) => format!(
                "J̄ = M⁻¹ Jᵀ Λ of `{of}`: the joint velocities with the least kinetic energy that move it, by its velocity, {task}."
            ),
            Operational::Bias(_) => format!(
                "μ = Λ (J M⁻¹ h − J̇ v) of `{of}`, with the bias h of the joints: the wrench on it is Λ (its acceleration) + μ, {task}."
            ),
        }
    }

    pub(super) fn units(self) -> &'static str {
        match self {
            Operational::InverseMassMatrix => {
                "1/(kg·m²) between rotations, 1/(kg·m) mixed, 1/kg between translations"
            }
            Operational::InverseInertia(_) => "1/(kg·m²), 1/(kg·m), 1/kg",
            Operational::Inertia(_) => "kg·m², kg·m, kg",
            Operational::ConsistentInverse(_) => {
                "velocities of the joints per rad/s (three columns) and per m/s"
            }
            Operational::Bias(_) => "N·m (three components), N",
        }
    }
}
