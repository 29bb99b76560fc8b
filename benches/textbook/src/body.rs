//! A mechanism in the form of general tree algorithms: moving bodies only, numbers in `f64`.

use nalgebra::{Matrix3, Vector3};

/// A moving body and the joint to its parent. Links fixed to it are part of it.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Index of the parent body; `None` for the world.
    pub parent: Option<usize>,
    /// Whether the joint is prismatic; else it is revolute.
    pub slides: bool,
    /// Pose of the body axes in the parent's at coordinate zero.
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
    /// Columns are the inner frame's axes.
    pub rotation: Matrix3<f64>,
    /// The inner frame's origin, m.
    pub translation: Vector3<f64>,
}

impl Placement {
    /// Returns the identity.
    pub fn identity() -> Self {
        Placement {
            rotation: Matrix3::identity(),
            translation: Vector3::zeros(),
        }
    }

    /// Returns the pose of `inner`, given in `self`, in the frame in which `self` is given.
    pub fn of(&self, inner: &Placement) -> Self {
        Placement {
            rotation: self.rotation * inner.rotation,
            translation: self.rotation * inner.translation + self.translation,
        }
    }
}

/// Returns the inertia of a point mass about a point at the distance `r`: m (r·r 1 − r rᵀ).
pub(crate) fn steiner(mass: f64, r: &Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::identity() * r.dot(r) - r * r.transpose()) * mass
}
