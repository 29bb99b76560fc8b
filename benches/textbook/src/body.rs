//! A mechanism as programs for any tree take it: moving bodies only, numbers in `f64`.

use nalgebra::{Matrix3, Vector3};

/// A moving body and the joint that carries it. Links fixed to it are part of it.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Number of the body that carries it; `None` for the world.
    pub parent: Option<usize>,
    /// Whether the joint is prismatic; else it is revolute.
    pub slides: bool,
    /// Body axes in the carrier's at coordinate zero.
    pub placement: Placement,
    /// Unit vector of the joint's axis, in body axes.
    pub axis: Vector3<f64>,
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass in body axes, m.
    pub com: Vector3<f64>,
    /// Inertia about the centre of mass in body axes, kg·m².
    pub inertia: Matrix3<f64>,
}

/// Axes and origin of one frame in another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Columns are the placed frame's axes.
    pub rotation: Matrix3<f64>,
    /// The placed frame's origin, m.
    pub translation: Vector3<f64>,
}

impl Placement {
    /// No rotation, no displacement.
    pub fn identity() -> Self {
        Placement {
            rotation: Matrix3::identity(),
            translation: Vector3::zeros(),
        }
    }

    /// What `inner` is seen from where `self` is placed.
    pub fn of(&self, inner: &Placement) -> Self {
        Placement {
            rotation: self.rotation * inner.rotation,
            translation: self.rotation * inner.translation + self.translation,
        }
    }
}

/// What a point mass adds to the inertia about a point at the distance `r`: m (r·r 1 − r rᵀ).
pub(crate) fn steiner(mass: f64, r: &Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::identity() * r.dot(r) - r * r.transpose()) * mass
}
