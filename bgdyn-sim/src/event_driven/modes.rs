//! Modes of rigid contacts.

use bgdyn_runtime::MOST_EVENT_CONTACTS;

use crate::real::Real;

/// A value for each contact; those after the plant's own contacts are zero, open or `None`.
pub(super) type PerContact<X> = [X; MOST_EVENT_CONTACTS];

/// What a rigid contact does between two events.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactMode<T> {
    /// No force: λ = 0.
    Open,
    /// No slip: γ = 0, |λ_t| ≤ μ λ_n.
    Stick,
    /// Slip begins, slower than √ε m/s (1.5e-8 in `f64`): γ_n = 0, λ_t = −μ λ_n d with a fixed direction d along (x, y). With
    /// the direction of the velocity, which at no speed is none, the equations would be stiff without bound.
    Start([T; 2]),
    /// Slip: γ_n = 0, λ_t = −μ λ_n γ_t/|γ_t|. The mode has the direction at its beginning.
    Slip([T; 2]),
}

impl<T: Real> ContactMode<T> {
    /// Returns whether the contact may have a force.
    pub fn is_closed(self) -> bool {
        self != ContactMode::Open
    }

    /// Returns the direction in which a contact in this mode slips with this velocity; `None` unless it slips.
    ///
    /// It has the orientation of the mode's direction: a step beyond the instant at which slip ends goes on as it began.
    pub(super) fn direction(self, velocity: [T; 3]) -> Option<[T; 2]> {
        let first = match self {
            ContactMode::Open | ContactMode::Stick => return None,
            ContactMode::Start(direction) => return Some(direction),
            ContactMode::Slip(first) => first,
        };
        let speed = speed(velocity);
        if speed <= still::<T>() {
            return Some(first);
        }
        let speed = if along(velocity, first) < T::from_f64(0.0) {
            -speed
        } else {
            speed
        };
        Some([velocity[0] / speed, velocity[1] / speed])
    }

    /// Returns what falls through 0 at the end of a closed mode besides λ_n: what friction may grow by, how far a beginning
    /// slip is from its end, or how far a slip is from standing still or from having turned by 60°.
    pub(super) fn ends(self, friction: T, force: [T; 3], velocity: [T; 3]) -> T {
        match self {
            ContactMode::Open => T::from_f64(1.0),
            ContactMode::Stick => friction * force[2] - speed(force),
            ContactMode::Start(d) => {
                (slow::<T>() - speed(velocity)).min(along(velocity, d) + still())
            }
            ContactMode::Slip(d) => {
                along(velocity, d) - T::from_f64(0.5) * speed(velocity) + still()
            }
        }
    }
}

/// Modes of a plant and of its rigid contacts, and what the last jump did.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactModes<M, T> {
    /// Those of the plant.
    pub plant: M,
    /// Those of its contacts.
    pub contacts: [ContactMode<T>; MOST_EVENT_CONTACTS],
    /// The last jump of the velocities.
    pub jump: Jump<T>,
    /// When open contacts close.
    pub(super) closing: [Closing<T>; MOST_EVENT_CONTACTS],
}

/// When an open contact closes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Closing<T> {
    /// At this overlap, m: 0, or rounding at a contact that has opened just now.
    Overlap(T),
    /// At this instant, s: after a flight so low that rounding of the positions hides it.
    Instant(T),
}

impl<T: Real> Closing<T> {
    /// Returns a value that falls through 0 when the contact closes.
    pub(super) fn value(self, t: T, gap: T) -> T {
        match self {
            Closing::Overlap(depth) => gap + depth,
            Closing::Instant(instant) => instant - t,
        }
    }
}

/// The impulses of a jump of the velocities: of impacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump<T> {
    /// p, N·s along (x, y, normal) of each contact.
    pub impulses: [[T; 3]; MOST_EVENT_CONTACTS],
    /// The energy that each contact takes, J: −p·(γ⁻ + γ⁺)/2.
    pub losses: [T; MOST_EVENT_CONTACTS],
    /// The largest residual of the impulses, N·s, as [`crate::cone::ContactOutcome::residual`].
    pub residual: T,
    /// Whether Newton's law of restitution would have added energy, so that Poisson's law was taken.
    pub by_poisson: bool,
}

impl<T: Real> Jump<T> {
    /// Returns no jump.
    pub(super) fn none() -> Self {
        let zero = T::from_f64(0.0);
        Jump {
            impulses: [[zero; 3]; MOST_EVENT_CONTACTS],
            losses: [zero; MOST_EVENT_CONTACTS],
            residual: zero,
            by_poisson: false,
        }
    }
}

impl<M, T: Real> ContactModes<M, T> {
    /// Returns modes in which all contacts are open; [`crate::Run`] finds those of its start.
    pub fn open(plant: M) -> Self {
        ContactModes {
            plant,
            contacts: [ContactMode::Open; MOST_EVENT_CONTACTS],
            jump: Jump::none(),
            closing: [Closing::Overlap(T::from_f64(0.0)); MOST_EVENT_CONTACTS],
        }
    }
}

/// Returns |γ_t|.
pub(super) fn speed<T: Real>(velocity: [T; 3]) -> T {
    velocity[0]
        .mul_add(velocity[0], velocity[1] * velocity[1])
        .sqrt()
}

/// Returns the component along a direction in the plane of contact.
pub(super) fn along<T: Real>(velocity: [T; 3], d: [T; 2]) -> T {
    velocity[0].mul_add(d[0], velocity[1] * d[1])
}

/// Slip begins below this speed, m/s: 1.5e-8 in `f64`.
pub(super) fn slow<T: Real>() -> T {
    T::EPSILON.sqrt().max(T::from_f64(64.0) * still())
}

/// What the event of its end leaves of a slip, m/s, at the most: 1.5e-9 in `f64`.
pub(super) fn stopped<T: Real>() -> T {
    T::from_f64(0.1) * slow()
}

/// Speeds up to this, m/s, are rounding: 1e-13 in `f64`.
pub(super) fn still<T: Real>() -> T {
    T::EPSILON * T::from_f64(512.0)
}
