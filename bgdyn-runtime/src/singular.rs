//! The error of accelerations that do not exist: which joint, and why.

use core::fmt;

use nalgebra::SVector;

use crate::scalar::{Look, Scalar};

/// The accelerations do not exist. [`Singular::cause`] says why: an argument is NaN or infinite, or
/// the pivot of `joint` in the mass matrix is no larger than the rounding error of the terms that
/// were subtracted in it, so that the matrix is singular or not distinguishable from a singular one.
///
/// Where every body has a fair share of the inertia that its joint moves, M is never singular, and
/// a factor of M is refused at 64 units of rounding of the entry it was computed from. Elsewhere
/// (massless links, heavy loads on light links) a bound for the error is computed beside the pivot.
#[derive(Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Singular {
    /// Index of the joint at which it was noticed, in the order of `JOINT_NAMES`.
    pub joint: usize,
    /// Its name.
    pub name: &'static str,
    /// Why the joint has no acceleration.
    pub cause: Cause,
}

/// Why there are no accelerations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Cause {
    /// The joint has no inertia left to accelerate: its pivot was refused.
    Pivot,
    /// An argument of the function is NaN or infinite.
    Argument {
        /// Name of the argument: `q`.
        argument: &'static str,
        /// Index of the component.
        index: usize,
        /// Name of the component: of the joint, or of the part of a scene's state.
        component: &'static str,
    },
    /// The joint's acceleration, or a state's rate, is not finite although the arguments are: a number
    /// is too large for the scalar, or the state is outside of what the model can be in.
    NotFinite,
}

impl Singular {
    /// The error that the joint with this index and name has no inertia left.
    pub const fn new(joint: usize, name: &'static str) -> Self {
        Singular {
            joint,
            name,
            cause: Cause::Pivot,
        }
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Cause::Pivot => f.write_str("no inertia left to accelerate"),
            Cause::Argument {
                argument,
                component,
                ..
            } if argument == component => {
                write!(f, "argument `{argument}` is NaN or infinite")
            }
            Cause::Argument {
                argument,
                index,
                component,
            } => write!(
                f,
                "component {index} (`{component}`) of argument `{argument}` is NaN or infinite"
            ),
            Cause::NotFinite => f.write_str("an acceleration that is not finite"),
        }
    }
}

impl fmt::Display for Singular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Singular { joint, name, cause } = self;
        let joint = format_args!("joint `{name}` (number {joint})");
        match cause {
            Cause::Pivot => write!(f, "singular mass matrix: {joint} has {cause}"),
            Cause::Argument { .. } => write!(f, "no accelerations: {cause}"),
            Cause::NotFinite => write!(f, "no accelerations: {joint} has {cause}"),
        }
    }
}

/// As a struct, with the cause in words: `unwrap` shows this.
impl fmt::Debug for Singular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Singular")
            .field("joint", &self.joint)
            .field("name", &self.name)
            .field("cause", &format_args!("{}", self.cause))
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
    let (joint, cause) = match refused {
        Some(joint) => (joint, Cause::Pivot),
        None => match first_not_finite(accelerations.as_slice()) {
            Some(joint) => (joint, Cause::NotFinite),
            // Only their sum was too large.
            None => return Ok(accelerations),
        },
    };
    Err(Singular {
        joint,
        name: names.get(joint).copied().unwrap_or(""),
        cause,
    })
}

/// [`crate::Scalar::explain`] for scalars that are one number.
#[cold]
#[inline(never)]
pub(crate) fn explain<T: Scalar>(
    mut error: Singular,
    arguments: impl FnOnce(&mut Look<'_, T>),
) -> Singular {
    arguments(&mut |argument, components, values| {
        if !matches!(error.cause, Cause::Argument { .. }) {
            error.cause = cause(argument, components, first_not_finite(values), error.cause);
        }
    });
    error
}

/// The cause that the component with this index is; without one, what was assumed before.
pub(crate) fn cause(
    argument: &'static str,
    components: &'static [&'static str],
    index: Option<usize>,
    before: Cause,
) -> Cause {
    match index {
        Some(index) => Cause::Argument {
            argument,
            index,
            component: components.get(index).copied().unwrap_or(""),
        },
        None => before,
    }
}

/// Sum of the accelerations. Where it is finite, so are they all: one comparison for all of them.
#[inline]
pub(crate) fn sum<T: Scalar, const N: usize>(accelerations: &SVector<T, N>) -> T {
    let all = accelerations.iter().copied();
    all.reduce(|sum, x| sum + x).unwrap_or(T::from_f64(0.0))
}

/// Index of the first value that is not finite.
#[cold]
fn first_not_finite<T: Scalar>(values: &[T]) -> Option<usize> {
    let wild = |&x: &T| zero_if_finite(x) != T::from_f64(0.0);
    values.iter().position(wild)
}

/// 0 for finite numbers, NaN for others.
#[allow(clippy::eq_op, reason = "that is how")]
#[inline]
pub(crate) fn zero_if_finite<T: Scalar>(x: T) -> T {
    x - x
}
