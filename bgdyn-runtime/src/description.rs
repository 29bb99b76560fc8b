//! What a generated module says of its joints and frames, and the methods beyond [`crate::Dynamics`]:
//! as traits, so that code written once runs with any model.

use nalgebra::{SMatrix, SVector};

use crate::{Limits, Motion, Pose, Scalar};

/// Names, labels, motions and limits of the moving joints, in the order of the velocities.
///
/// Every generated model implements it. The limits are for the caller: generated functions clip nothing.
pub trait Description<const NV: usize> {
    /// Names of the joints.
    const JOINT_NAMES: [&'static str; NV];
    /// Their labels: the names that they have elsewhere (a URDF's, as written); of a joint without a
    /// label its name.
    const JOINT_LABELS: [&'static str; NV];
    /// What each coordinate is: an angle or a displacement.
    const JOINT_MOTIONS: [Motion; NV];
    /// Limits of the joints; infinite where the spec states none.
    const JOINT_LIMITS: [Limits; NV];
}

/// The type that stands for a link or a named frame of a model: `scara::frames::Tool`.
pub trait Frame: Copy {
    /// The link's or the frame's name.
    const NAME: &'static str;
}

/// Where a frame is and how it moves.
///
/// Implemented for each frame whose four methods (`pose_X`, `velocity_X`, `jacobian_world_X`,
/// `jacobian_dot_v_world_X`) were asked for. World axes, at the frame's origin, angular part first.
pub trait Kinematics<F: Frame, T: Scalar, const NQ: usize, const NV: usize> {
    /// Pose of the frame in the world; m.
    fn pose(&self, q: &SVector<T, NQ>) -> Pose<T>;

    /// Velocity of the frame: rad/s, m/s.
    fn velocity(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SVector<T, 6>;

    /// Jacobian J: the velocity is J v; rad and m per unit of each joint.
    fn jacobian_world(&self, q: &SVector<T, NQ>) -> SMatrix<T, 6, NV>;

    /// J̇ v, the acceleration where the joints' is zero: rad/s², m/s².
    fn jacobian_dot_v_world(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SVector<T, 6>;
}

/// The Coriolis matrix; implemented where `coriolis_matrix` was asked for.
pub trait Coriolis<T: Scalar, const NQ: usize, const NV: usize> {
    /// C of Christoffel's symbols: bias = C v + gravity, Ṁ − 2C skew. Efforts per rad/s or m/s.
    fn coriolis_matrix(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SMatrix<T, NV, NV>;
}

/// First derivatives; implemented where both methods were asked for (`derivatives = true`).
pub trait Derivatives<T: Scalar, const NQ: usize, const NV: usize> {
    /// (∂τ/∂q, ∂τ/∂v): efforts per rad or m, and per rad/s or m/s. ∂τ/∂a is the mass matrix.
    fn inverse_dynamics_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        a: &SVector<T, NV>,
    ) -> [SMatrix<T, NV, NV>; 2];

    /// (∂q̈/∂q, ∂q̈/∂v, ∂q̈/∂τ): accelerations per rad or m, per rad/s or m/s, per N·m or N; the last
    /// is M⁻¹.
    ///
    /// # Errors
    /// Names the joint whose pivot vanishes where the mass matrix is singular.
    fn forward_dynamics_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        tau: &SVector<T, NV>,
    ) -> Result<[SMatrix<T, NV, NV>; 3], T::Singular<NV>>;
}
