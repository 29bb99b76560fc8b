//! The error of a mass matrix that cannot be inverted.

use core::fmt;

/// The mass matrix is singular, or not distinguishable from a singular one: the pivot of `joint`
/// is no larger than the rounding error of the terms it was computed from, or not a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Singular {
    /// Index of the joint, in the order of `JOINT_NAMES`.
    pub joint: usize,
    /// Its name.
    pub name: &'static str,
}

impl fmt::Display for Singular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "singular mass matrix: joint `{}` (number {}) has no inertia left to accelerate, or an input is not finite",
            self.name, self.joint
        )
    }
}

impl core::error::Error for Singular {}

/// [`crate::Scalar::checked_pivot`] for scalars that are one number.
pub(crate) fn note_refused(ok: bool, joint: usize, refused: &mut Option<usize>) -> bool {
    if !ok && refused.is_none() {
        *refused = Some(joint);
    }
    ok
}

/// [`crate::Scalar::finish`] for scalars that are one number.
pub(crate) fn finish<V>(
    accelerations: V,
    refused: Option<usize>,
    names: &'static [&'static str],
) -> Result<V, Singular> {
    match refused {
        None => Ok(accelerations),
        Some(joint) => Err(Singular {
            joint,
            name: names.get(joint).copied().unwrap_or(""),
        }),
    }
}
