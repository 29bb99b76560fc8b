//! The columns of a regressor that belong to a joint.

use crate::Scalar;

/// Names of the columns of a joint, in the order of [`joint_columns`].
pub const JOINT_COLUMNS: [&str; 4] = ["rotor", "viscous", "coulomb", "offset"];

/// Returns the columns of a joint beside those of the bodies: a, v, tanh(v/w), 1. Their products with the reflected inertia
/// of the rotor, the coefficients of viscous and of Coulomb friction, and the offset of the drive or its sensor add to the
/// joint's effort (Khalil and Dombre, *Modeling, Identification and Control of Robots*, 2002, chapter 12). The columns are
/// zero in the rows of all other joints.
///
/// `v` and `a` are velocity and acceleration of the joint, in rad/s and rad/s² or m/s and m/s². `width` is w, the speed at
/// which the smoothed sign is 76 % of 1, greater than 0, in the unit of `v`. Nothing is checked.
///
/// ```
/// use bgdyn_runtime::joint_columns;
///
/// let (rotor, viscous, coulomb, offset) = (0.2, 1.5, 0.8, -0.05);
/// let columns = joint_columns(0.5, 2.0, 0.001);
/// let added = columns[0] * rotor + columns[1] * viscous + columns[2] * coulomb + columns[3] * offset;
/// assert!((added - (2.0 * 0.2 + 0.5 * 1.5 + 0.8 - 0.05_f64)).abs() < 1e-15);
/// ```
pub fn joint_columns<T: Scalar>(v: T, a: T, width: T) -> [T; 4] {
    [a, v, (v / width).tanh(), T::from_f64(1.0)]
}
