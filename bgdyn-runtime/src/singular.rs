//! The error of accelerations that do not exist: the joint and the cause.

use core::fmt;

use nalgebra::SVector;

use crate::argument::{Argument, Look};
use crate::scalar::Scalar;

/// The error that the accelerations do not exist. [`Singular::cause`] returns the cause: an argument is
/// NaN or infinite, or the pivot of `joint` in the mass matrix is not larger than the rounding error of
/// the terms that were subtracted in it, so that the matrix is singular or not distinguishable from a
/// singular one.
///
/// If the own inertia ratio of every joint is large enough, M is never singular, and a pivot of M is
/// refused at 64 units of rounding of the entry it was computed from. Otherwise (massless links, heavy
/// loads on light links) a bound for the error is computed together with the pivot.
// Two words, which are returned in registers. A larger error makes every call that returns a `Result`
// slower, also if it succeeds.
#[derive(Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Singular {
    kind: Kind,
    /// Index of the joint; if an argument is the cause, of its component.
    index: u32,
    name: &'static &'static str,
}

/// The cause of missing accelerations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Cause {
    /// The pivot of the joint was refused: the joint has no inertia left to accelerate.
    Pivot,
    /// The dependent velocities of a kinematic loop, a wheel or a knife edge do not follow from the independent ones:
    /// the position is singular, or on the other side of a singular one.
    Loop,
    /// A kinematic loop is out of reach, or at the end of its reach: functions in closed form. A loop or a wheel did not
    /// close in the bounded number of steps: `close`.
    OutOfReach,
    /// `assemble` found no position at which the kinematic loop or the wheel closes.
    NotAssembled,
    /// A kinematic loop closes, but on another branch than that of the mechanism.
    Branch,
    /// The actuated joints of a mechanism with loops cannot produce every acceleration here: the matrix from their
    /// efforts to those along the independent velocities is singular. The loops are regular, and forward dynamics
    /// answers; [`Singular::name`] is the independent joint whose equation follows from others.
    Actuators,
    /// The joints cannot move the frame of an operational inertia in every direction here: the posture is singular, and
    /// the inertia is infinite. [`Singular::name`] is a direction in which the inverse inertia follows from those
    /// after it, from `angular x` to `linear z`.
    Posture,
    /// An argument of the function is NaN or infinite.
    Argument {
        /// The argument.
        argument: Argument,
        /// Index of the component.
        index: usize,
    },
    /// The joint's acceleration, or a state's rate, is not finite although the arguments are: a number is
    /// too large for the scalar, or the state is outside of the model's domain.
    NotFinite,
}

/// The indices of pivots of the matrix of the actuators begin here: a place among the names, plus this number, which is
/// exact in lanes of `f32`.
pub const ACTUATORS: usize = 1 << 16;

/// The same for loops on another branch.
pub(crate) const BRANCHES: usize = 2 * ACTUATORS;

/// The same for loops that are out of reach.
pub const OUT_OF_REACH: usize = 3 * ACTUATORS;

/// The same for loops that were not assembled.
pub(crate) const NOT_ASSEMBLED: usize = 4 * ACTUATORS;

/// The same for the directions of an operational inertia.
pub const TASKS: usize = 5 * ACTUATORS;

/// A [`Cause`] without its index: four bytes, so that `Option` and `Result` can use its unused values.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Pivot,
    Loop,
    OutOfReach,
    NotAssembled,
    Branch,
    Actuators,
    Posture,
    NotFinite,
    Argument(Argument),
}

impl Kind {
    const fn of_pivot(pivot: usize, joints: usize) -> (Self, usize) {
        let kind = match pivot / ACTUATORS {
            0 if pivot < joints => Kind::Pivot,
            0 => Kind::Loop,
            1 => Kind::Actuators,
            2 => Kind::Branch,
            3 => Kind::OutOfReach,
            4 => Kind::NotAssembled,
            _ => Kind::Posture,
        };
        (kind, pivot % ACTUATORS)
    }

    const fn cause(self, index: usize) -> Cause {
        match self {
            Kind::Pivot => Cause::Pivot,
            Kind::Loop => Cause::Loop,
            Kind::OutOfReach => Cause::OutOfReach,
            Kind::NotAssembled => Cause::NotAssembled,
            Kind::Branch => Cause::Branch,
            Kind::Actuators => Cause::Actuators,
            Kind::Posture => Cause::Posture,
            Kind::NotFinite => Cause::NotFinite,
            Kind::Argument(argument) => Cause::Argument { argument, index },
        }
    }
}

impl Cause {
    /// Returns the cause of a refused pivot of a function with `joints` joints, and the index of its joint or loop among
    /// the names: joints come first, then loops. Pivots of the matrix of the actuators begin at [`ACTUATORS`], those of
    /// loops out of reach at [`OUT_OF_REACH`].
    pub const fn of_pivot(pivot: usize, joints: usize) -> (Self, usize) {
        let (kind, index) = Kind::of_pivot(pivot, joints);
        (kind.cause(index), index)
    }
}

impl Singular {
    /// Returns the error that the joint with this index has no inertia left; `names` are those of all
    /// joints.
    pub fn new(joint: usize, names: &'static [&'static str]) -> Self {
        Singular::of_kind(Kind::Pivot, joint, names)
    }

    /// Returns the error of a refused pivot; see [`Cause::of_pivot`].
    pub(crate) fn refused(pivot: usize, joints: usize, names: &'static [&'static str]) -> Self {
        let (kind, index) = Kind::of_pivot(pivot, joints);
        Singular::of_kind(kind, index, names)
    }

    /// Returns the error that the joint with this index has an acceleration that is not finite.
    pub(crate) fn not_finite(joint: usize, names: &'static [&'static str]) -> Self {
        Singular::of_kind(Kind::NotFinite, joint, names)
    }

    fn of_kind(kind: Kind, joint: usize, names: &'static [&'static str]) -> Self {
        let name = names.get(joint).unwrap_or(&"");
        let index = joint as u32;
        Singular { kind, index, name }
    }

    /// Returns the index of the joint that failed, in the order of `JOINT_NAMES`; of a loop, in the order of
    /// `PIVOT_NAMES`; of the inverse dynamics of actuated joints, in the order of `ACTUATED_PIVOT_NAMES`; of an operational inertia, in the order of `OPERATIONAL_PIVOT_NAMES`; if an argument is the cause, the index of its component.
    pub const fn joint(&self) -> usize {
        self.index as usize
    }

    /// Returns the cause.
    pub const fn cause(&self) -> Cause {
        self.kind.cause(self.joint())
    }

    /// Returns the name of the joint or loop; if an argument is the cause, the name of its component: of a joint,
    /// of a part of a scene's state, of a run-time parameter.
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// Checks an argument: its first component that is not finite, with this index, becomes the cause,
    /// unless an earlier argument already is.
    pub(crate) fn look(
        &mut self,
        argument: Argument,
        components: &'static [&'static str],
        index: Option<usize>,
    ) {
        if let (
            Some(index),
            Kind::Pivot
            | Kind::Loop
            | Kind::OutOfReach
            | Kind::NotAssembled
            | Kind::Branch
            | Kind::Actuators
            | Kind::Posture
            | Kind::NotFinite,
        ) = (index, self.kind)
        {
            *self = Singular::of_kind(Kind::Argument(argument), index, components);
        }
    }
}

impl fmt::Display for Singular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (joint, name, cause) = (self.joint(), self.name, self.cause());
        match cause {
            Cause::Pivot => write!(
                f,
                "singular mass matrix: joint `{name}` (number {joint}) has {cause}"
            ),
            Cause::Loop | Cause::OutOfReach | Cause::NotAssembled | Cause::Branch => {
                write!(f, "loop or constraint `{name}` {cause}")
            }
            Cause::Actuators => write!(f, "no efforts of the actuated joints: `{name}` {cause}"),
            Cause::Posture => write!(f, "no operational inertia: direction `{name}` {cause}"),
            Cause::Argument {
                argument: Argument::Time,
                ..
            } => {
                write!(f, "no accelerations: argument `t` is NaN or infinite")
            }
            Cause::Argument { argument, index } => write!(
                f,
                "no accelerations: component {index} (`{name}`) of argument `{}` is NaN or infinite",
                argument.name()
            ),
            Cause::NotFinite => write!(
                f,
                "no accelerations: joint `{name}` (number {joint}) has {cause}"
            ),
        }
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Cause::Pivot => f.write_str("no inertia left to accelerate"),
            Cause::Loop => f.write_str("is singular here"),
            Cause::OutOfReach => f.write_str("is out of reach here, or at the end of its reach"),
            Cause::NotAssembled => f.write_str("closes at no position that was found"),
            Cause::Branch => f.write_str("closes here on another branch only"),
            Cause::Actuators => f.write_str("does not follow the actuated joints here"),
            Cause::Posture => f.write_str("cannot be accelerated here: the posture is singular"),
            Cause::Argument { argument, index } => write!(
                f,
                "component {index} of argument `{}` is NaN or infinite",
                argument.name()
            ),
            Cause::NotFinite => f.write_str("an acceleration that is not finite"),
        }
    }
}

/// Formats it as a struct, with the cause in words; a failed `unwrap` prints this.
impl fmt::Debug for Singular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Singular")
            .field("joint", &self.joint())
            .field("name", self.name)
            .field("cause", &format_args!("{}", self.cause()))
            .finish()
    }
}

impl core::error::Error for Singular {}

/// [`crate::Scalar::checked_pivot`] for scalars without lanes.
#[inline]
pub(crate) fn note_refused(ok: bool, joint: usize, refused: &mut Option<usize>) {
    if !ok && refused.is_none() {
        *refused = Some(joint);
    }
}

/// [`crate::Scalar::succeeded`] for scalars without lanes.
#[inline]
pub(crate) fn succeeded<T: Scalar, const N: usize>(
    accelerations: &SVector<T, N>,
    refused: Option<usize>,
) -> bool {
    refused.is_none() && zero_if_finite(sum(accelerations)) == T::from_f64(0.0)
}

/// [`crate::Scalar::failed`] for scalars without lanes.
#[cold]
#[inline(never)]
pub(crate) fn failed<T: Scalar, const N: usize>(
    accelerations: SVector<T, N>,
    refused: Option<usize>,
    names: &'static [&'static str],
    arguments: impl FnOnce(&mut Look<'_, T>),
) -> Option<Singular> {
    let mut error = match (refused, first_not_finite(accelerations.as_slice())) {
        (Some(pivot), _) => Singular::refused(pivot, N, names),
        (None, Some(joint)) => Singular::not_finite(joint, names),
        // The accelerations are finite; only their sum was too large.
        (None, None) => return None,
    };
    arguments(&mut |argument, components, values| {
        error.look(argument, components, first_not_finite(values));
    });
    Some(error)
}

/// Returns the sum of the accelerations. If it is finite, all accelerations are: one comparison checks
/// all.
#[inline]
pub(crate) fn sum<T: Scalar, const N: usize>(accelerations: &SVector<T, N>) -> T {
    let all = accelerations.iter().copied();
    all.reduce(|sum, x| sum + x).unwrap_or(T::from_f64(0.0))
}

/// Returns the index of the first value that is not finite.
#[cold]
fn first_not_finite<T: Scalar>(values: &[T]) -> Option<usize> {
    let wild = |&x: &T| zero_if_finite(x) != T::from_f64(0.0);
    values.iter().position(wild)
}

/// Returns 0 for finite numbers, NaN for others.
#[allow(clippy::eq_op, reason = "that is how")]
#[inline]
pub(crate) fn zero_if_finite<T: Scalar>(x: T) -> T {
    x - x
}
