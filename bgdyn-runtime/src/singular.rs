//! The error of a mass matrix that cannot be inverted.

use core::fmt;

use nalgebra::SVector;

use crate::Scalar;

/// The accelerations do not exist: the pivot of `joint` in the mass matrix is no larger than the
/// rounding error of the terms that were subtracted in it, so that the matrix is singular or not
/// distinguishable from a singular one; or the joint's acceleration is not finite, out of an input
/// that is not or is too large.
///
/// Where every body has a fair share of the inertia that its joint moves, M is never singular, and
/// a factor of M is refused at 64 units of rounding of the entry it was computed from. Elsewhere
/// (massless links, heavy loads on light links) a bound for the error is computed beside the pivot.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Singular {
    /// Index of the joint, in the order of `JOINT_NAMES`.
    pub joint: usize,
    /// Its name.
    pub name: &'static str,
}

/// What it may come from: the pivot alone does not tell.
const CAUSE: &str = "has no inertia left to accelerate, or an input is not finite";

impl fmt::Display for Singular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "singular mass matrix: joint `{}` (number {}) {CAUSE}",
            self.name, self.joint
        )
    }
}

/// As a struct, with both causes: `unwrap` shows this.
impl fmt::Debug for Singular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Singular")
            .field("joint", &self.joint)
            .field("name", &self.name)
            .field("cause", &format_args!("{CAUSE}"))
            .finish()
    }
}

impl core::error::Error for Singular {}

/// [`crate::Scalar::checked_pivot`] for scalars that are one number.
#[inline]
pub(crate) fn note_refused(ok: bool, joint: usize, refused: &mut Option<usize>) {
    if !ok && refused.is_none() {
        *refused = Some(joint);
    }
}

/// [`crate::Scalar::finish`] for scalars that are one number. A result that is not finite, out of
/// an input that is not or is too large, is an error as well.
#[inline]
pub(crate) fn finish<T: Scalar, const N: usize>(
    accelerations: SVector<T, N>,
    refused: Option<usize>,
    names: &'static [&'static str; N],
) -> Result<SVector<T, N>, Singular> {
    let zero = T::from_f64(0.0);
    if refused.is_none() && zero_if_finite(sum(&accelerations)) == zero {
        return Ok(accelerations);
    }
    match refused.or_else(|| first_wild(&accelerations)) {
        Some(joint) => Err(Singular {
            joint,
            name: names.get(joint).copied().unwrap_or(""),
        }),
        // Only their sum was too large.
        None => Ok(accelerations),
    }
}

/// Sum of the accelerations. Where it is finite, so are they all: one comparison for all of them.
#[inline]
pub(crate) fn sum<T: Scalar, const N: usize>(accelerations: &SVector<T, N>) -> T {
    let all = accelerations.iter().copied();
    all.reduce(|sum, x| sum + x).unwrap_or(T::from_f64(0.0))
}

/// The first joint whose acceleration is not finite.
#[cold]
fn first_wild<T: Scalar, const N: usize>(accelerations: &SVector<T, N>) -> Option<usize> {
    let wild = |&x: &T| zero_if_finite(x) != T::from_f64(0.0);
    accelerations.iter().position(wild)
}

/// 0 for finite numbers, NaN for others.
#[allow(clippy::eq_op, reason = "that is how")]
#[inline]
pub(crate) fn zero_if_finite<T: Scalar>(x: T) -> T {
    x - x
}
