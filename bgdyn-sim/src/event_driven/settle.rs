//! Which of the touching contacts open, stick and slip next.
//!
//! The problem has the form of the cones ([`crate::cone`]), with accelerations in place of velocities: at a contact at rest
//! K* ∋ γ̇ + μ |γ̇_t| n ⟂ λ ∈ K. A contact that slips has a known direction of friction; in the cones it gets a speed that no
//! force of the others can change. The modes found so are then checked with the forces of their linear equations, since
//! forces of redundant contacts are not unique, and changed one by one until all inequalities hold.

use bgdyn_runtime::{MOST_EVENT_CONTACTS, Scalar as _, StateVector};

use super::error::EventError;
use super::modes::{ContactMode, PerContact, along, speed};
use super::snapshot::Snapshot;
use crate::cone::{ContactOptions, ContactProblem, solve};
use crate::real::{Of, Real};

/// What is known of a contact before its mode is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Touch<T> {
    /// It is apart, or separates.
    Apart,
    /// It touches without a force now: it closes again only if it would overlap.
    Opens,
    /// It touches without slip.
    Rests,
    /// It begins to slip in this direction.
    Starts([T; 2]),
    /// It slips in this direction.
    Slips([T; 2]),
}

/// Modes of contacts.
type Settled<T> = PerContact<ContactMode<T>>;

/// The speed of contacts that slip, in parts of the largest acceleration.
const FAST: f64 = 1e6;

/// The largest number of changes of a mode after the cones.
const MOST_CHANGES: usize = 8 * MOST_EVENT_CONTACTS;

/// Finds the modes of contacts, with the accelerations γ̇ = a that they would have without forces.
pub(super) fn settled<Y: StateVector, E>(
    snapshot: &Snapshot<Y>,
    accelerations: &PerContact<[Of<Y>; 3]>,
    touches: &PerContact<Touch<Of<Y>>>,
) -> Result<Settled<Of<Y>>, EventError<E>>
where
    Of<Y>: Real,
{
    let mut modes = by_cones(snapshot, accelerations, touches)?;
    for _ in 0..MOST_CHANGES {
        let forces = snapshot
            .forces(&modes, accelerations)
            .map_err(|contact| EventError::Paradox { contact })?;
        let Some((c, mode)) = violation(snapshot, accelerations, touches, (&modes, &forces)) else {
            return Ok(modes);
        };
        modes[c] = mode;
    }
    Err(EventError::NoModes)
}

/// Returns the largest magnitude of an acceleration of contacts that touch.
fn largest<T: Real>(accelerations: &PerContact<[T; 3]>, touches: &PerContact<Touch<T>>) -> T {
    let touching = accelerations.iter().zip(touches);
    let touching = touching.filter(|&(_, &touch)| touch != Touch::Apart);
    touching
        .flat_map(|(a, _)| a)
        .fold(T::from_f64(0.0), |most, a| most.max(a.abs()))
}

/// Returns the modes that the cones give.
fn by_cones<Y: StateVector, E>(
    snapshot: &Snapshot<Y>,
    accelerations: &PerContact<[Of<Y>; 3]>,
    touches: &PerContact<Touch<Of<Y>>>,
) -> Result<Settled<Of<Y>>, EventError<E>>
where
    Of<Y>: Real,
{
    let zero = Of::<Y>::from_f64(0.0);
    let fast = Of::<Y>::from_f64(FAST).min(Of::<Y>::from_f64(1.0) / Of::<Y>::EPSILON.sqrt())
        * largest(accelerations, touches);
    let active = touches.map(|touch| !matches!(touch, Touch::Apart | Touch::Opens));
    let mut modes = [ContactMode::Open; MOST_EVENT_CONTACTS];
    if !active.contains(&true) {
        return Ok(modes);
    }
    let mut start = *accelerations;
    for (start, touch) in start.iter_mut().zip(touches) {
        if let Touch::Starts(d) | Touch::Slips(d) = touch {
            for (start, &d) in start.iter_mut().zip(d) {
                *start = fast.mul_add(d, *start);
            }
        }
    }
    let friction = snapshot.contacts.map(|contact| contact.friction);
    let problem = ContactProblem {
        delassus: &snapshot.delassus,
        velocities: &start,
        friction: &friction,
        active: &active,
    };
    let mut forces = [[zero; 3]; MOST_EVENT_CONTACTS];
    solve(&problem, &ContactOptions::default(), &mut forces);
    for c in (0..snapshot.number).filter(|&c| forces[c][2] > zero) {
        let after = snapshot.velocity(c, &forces, start[c]);
        modes[c] = match touches[c] {
            // Forces that stop it at once: there are no finite ones.
            Touch::Slips(d) if along(after, d) < fast * Of::<Y>::from_f64(0.5) => {
                return Err(EventError::Paradox { contact: c });
            }
            Touch::Slips(d) => ContactMode::Slip(d),
            Touch::Starts(d) => ContactMode::Start(d),
            _ => rests_or_slips(friction[c], forces[c], after),
        };
    }
    Ok(modes)
}

/// Returns the mode of a contact at rest with this force and acceleration.
fn rests_or_slips<T: Real>(friction: T, force: [T; 3], acceleration: [T; 3]) -> ContactMode<T> {
    let limit = friction * force[2];
    let inside = speed(force) < limit * (T::from_f64(1.0) - T::EPSILON.sqrt());
    match against(force, acceleration) {
        Some(direction) if !inside => ContactMode::Start(direction),
        _ => ContactMode::Stick,
    }
}

/// Returns the direction against a force of friction, or, without friction, along the acceleration.
fn against<T: Real>(force: [T; 3], acceleration: [T; 3]) -> Option<[T; 2]> {
    let (zero, rubbed, moved) = (T::from_f64(0.0), speed(force), speed(acceleration));
    if rubbed > zero {
        Some([-force[0] / rubbed, -force[1] / rubbed])
    } else if moved > zero {
        Some([acceleration[0] / moved, acceleration[1] / moved])
    } else {
        None
    }
}

/// Returns the contact that violates its inequality most, with another mode.
fn violation<Y: StateVector>(
    snapshot: &Snapshot<Y>,
    accelerations: &PerContact<[Of<Y>; 3]>,
    touches: &PerContact<Touch<Of<Y>>>,
    (modes, forces): (&Settled<Of<Y>>, &PerContact<[Of<Y>; 3]>),
) -> Option<(usize, ContactMode<Of<Y>>)>
where
    Of<Y>: Real,
{
    let zero = Of::<Y>::from_f64(0.0);
    let scale = largest(accelerations, touches);
    let negligible = scale * Of::<Y>::EPSILON.sqrt() * Of::<Y>::from_f64(1e-2);
    let mut worst = None;
    let mut most = zero;
    let mut found = |amount: Of<Y>, c: usize, mode| {
        if amount > most {
            (most, worst) = (amount, Some((c, mode)));
        }
    };
    for c in 0..snapshot.number {
        let after = snapshot.velocity(c, forces, accelerations[c]);
        let force = forces[c];
        let limit = snapshot.contacts[c].friction * force[2];
        // Forces are compared as the accelerations that they make.
        let own = &snapshot.delassus[c][c];
        let excess = speed(force) - limit;
        match modes[c] {
            ContactMode::Open if touches[c] == Touch::Apart => {}
            ContactMode::Open => {
                if -after[2] > negligible {
                    let mode = match touches[c] {
                        Touch::Slips(d) => ContactMode::Slip(d),
                        Touch::Starts(d) => ContactMode::Start(d),
                        _ => ContactMode::Stick,
                    };
                    found(-after[2], c, mode);
                }
            }
            _ if force[2] < zero => found(-force[2] * own[2][2], c, ContactMode::Open),
            ContactMode::Stick => {
                if excess > zero {
                    let direction = against(force, after).unwrap_or([zero; 2]);
                    let side = own[0][0].max(own[1][1]);
                    found(excess * side, c, ContactMode::Start(direction));
                }
            }
            ContactMode::Start(d) => {
                let along = along(after, d);
                if -along > negligible {
                    found(-along, c, ContactMode::Stick);
                }
            }
            ContactMode::Slip(_) => {}
        }
    }
    worst
}
