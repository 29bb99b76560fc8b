//! Operational-space control within the limits of the joints, for any model and any of its frames: no
//! macro, no allocation, no standard library except `core`.

use core::marker::PhantomData;

use bgdyn::nalgebra::{Cholesky, RealField, SMatrix, SVector};
use bgdyn::runtime::{Limits, Pose};
use bgdyn::{Description, Dynamics, Kinematics, Scalar};

/// Drives the frame `F` of a model to a pose.
pub struct ToPose<F, T> {
    /// Stiffness of the frame's motion, 1/s².
    pub stiffness: T,
    /// Stiffness that keeps a joint inside its range, 1/s².
    pub barrier: T,
    pub frame: PhantomData<F>,
}

impl<F: bgdyn::Frame, T: Scalar + RealField> ToPose<F, T> {
    /// Returns the joint efforts at the state q, v.
    pub fn efforts<M, const N: usize>(
        &self,
        model: &M,
        target: &Pose<T>,
        q: &SVector<T, N>,
        v: &SVector<T, N>,
    ) -> SVector<T, N>
    where
        M: Dynamics<T, N, N> + Kinematics<F, T, N, N> + Description<N>,
    {
        let damping = critical(self.stiffness);
        let (error, twist) = (model.pose(q).error_to(target), model.velocity(q, v));
        let wanted = error * self.stiffness - twist * damping - model.jacobian_dot_v_world(q, v);
        let a = accelerations(&model.jacobian_world(q), &wanted);
        let a = SVector::from_fn(|j, _| self.within(&M::JOINT_LIMITS[j], a[j], q[j], v[j]));
        let tau = model.inverse_dynamics(q, v, &a);
        SVector::from_fn(|j, _| {
            let most = number::<T>(M::JOINT_LIMITS[j].effort);
            Scalar::max(Scalar::min(tau[j], most), -most)
        })
    }

    /// Limits the acceleration so that the joint can come to rest at the end of its range.
    fn within(&self, limits: &Limits, a: T, q: T, v: T) -> T {
        let braking = |end: f64| (number::<T>(end) - q) * self.barrier - v * critical(self.barrier);
        Scalar::max(Scalar::min(a, braking(limits.upper)), braking(limits.lower))
    }
}

/// Returns critical damping.
fn critical<T: Scalar>(stiffness: T) -> T {
    T::from_f64(2.0) * stiffness.sqrt()
}

fn number<T: Scalar>(x: f64) -> T {
    T::from_f64(x)
}

/// Returns the joint accelerations that give the frame the desired acceleration as closely as possible:
/// damped least squares.
fn accelerations<T: Scalar + RealField, const N: usize>(
    jacobian: &SMatrix<T, 6, N>,
    wanted: &SVector<T, 6>,
) -> SVector<T, N> {
    let damped = SMatrix::<T, 6, 6>::identity() * number::<T>(1e-4);
    let square = jacobian * jacobian.transpose() + damped;
    let solved = Cholesky::new(square).map(|factor| factor.solve(wanted));
    jacobian.transpose() * solved.unwrap_or_else(SVector::zeros)
}
