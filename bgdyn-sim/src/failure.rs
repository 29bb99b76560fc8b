//! The reasons for which an integration cannot continue.

use core::fmt;

use bgdyn_runtime::StateVector;

use crate::real::Of;

/// The reason why a step fails.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reason<E> {
    /// The rates do not exist: the mass matrix is singular.
    Singular(E),
    /// A component of the state would not be finite.
    NotFinite,
    /// The equations of an implicit integrator did not converge.
    NoConvergence {
        /// Number of iterations.
        iterations: usize,
        /// The last change in units of the state's rounding error.
        change: f64,
    },
    /// The matrix of an implicit integrator is singular.
    SingularMatrix,
    /// The equation has rigid contacts, and the integrator does not solve for their impulses; or more than
    /// [`MOST_CONTACTS`](bgdyn_runtime::MOST_CONTACTS).
    RigidContacts,
    /// The equation has Poisson's law of restitution, and the integrator, which solves for impulses, Newton's.
    ImpactLaw,
    /// The integrator needs the slopes of the rates, and they are not available.
    NoJacobian,
    /// The tolerance requires steps that are too small for the resolution of time.
    StepTooSmall {
        /// The required step.
        h: f64,
        /// Estimated error of the last step tried, in units of the tolerance.
        error: f64,
    },
    /// So many events occurred within one step that time would not advance.
    TooManyEvents {
        /// Number of events.
        events: usize,
    },
}

/// The early end of an integration. The integration remains at the end of the last successful step.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure<Y: StateVector, E> {
    /// Time at the end, s.
    pub t: Of<Y>,
    /// State at the end.
    pub y: Y,
    /// The reason.
    pub reason: Reason<E>,
}

impl<E: fmt::Debug> fmt::Display for Reason<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Singular(at) => write!(f, "there are no accelerations: {at:?}"),
            Self::NotFinite => f.write_str(
                "a part of the state would not be finite; a smaller step or a tolerance may help",
            ),
            Self::NoConvergence { iterations, change } => write!(
                f,
                "the method's equations are not solved after {iterations} iterations, which still change the state by {change:.1e} units of its rounding; a smaller step may help"
            ),
            Self::SingularMatrix => f.write_str(
                "the method's matrix is singular; a smaller step may help",
            ),
            Self::RigidContacts => f.write_str(
                "the method does not know so many rigid contacts: use `Moreau`, which knows 32, go from event to event with `EventDriven`, which knows 8, or use a compliant law of contact",
            ),
            Self::ImpactLaw => f.write_str(
                "the method has Newton's law at impacts, and the scene Poisson's: go from event to event with `EventDriven`",
            ),
            Self::NoJacobian => f.write_str(
                "the method needs the slopes of the rates; generate the scene with them, or take them from differences",
            ),
            Self::StepTooSmall { h, error } => write!(
                f,
                "the tolerance asks for steps of {h:.1e} s, less than time can resolve (the error is {error:.1e} times what is allowed); a larger tolerance or a method for stiff scenes may help"
            ),
            Self::TooManyEvents { events } => write!(
                f,
                "{events} events follow each other within one step: the scene chatters"
            ),
        }
    }
}

impl<Y: StateVector, E: fmt::Debug> fmt::Display for Failure<Y, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "at t = {:?} s, y = {:?}: {}",
            self.t,
            self.y.entries(),
            self.reason
        )
    }
}

impl<Y: StateVector, E: fmt::Debug> core::error::Error for Failure<Y, E> {}
