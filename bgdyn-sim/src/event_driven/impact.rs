//! Impacts: jumps of the velocities by impulses of all contacts that touch.

use bgdyn_runtime::{ImpactLaw, Scalar as _, StateVector};

use super::impulses::{by_cones, note_losses};
use super::modes::{Jump, PerContact};
use super::poisson;
use super::snapshot::Snapshot;
use crate::real::{Of, Real};

/// Returns the impulses with which contacts, where `active`, meet. Where `ends` holds, a contact comes to rest: e = 0.
pub(super) fn impact<Y: StateVector>(
    snapshot: &Snapshot<Y>,
    law: ImpactLaw,
    active: &PerContact<bool>,
    ends: &PerContact<bool>,
) -> Jump<Of<Y>>
where
    Of<Y>: Real,
{
    let zero = Of::<Y>::from_f64(0.0);
    let restitution = core::array::from_fn(|c| match ends[c] {
        true => zero,
        false => snapshot.contacts[c].restitution,
    });
    let mut jump = match law {
        ImpactLaw::Newton => by_newton(snapshot, active, &restitution),
        ImpactLaw::Poisson => poisson::jump(snapshot, active, &restitution),
    };
    note_losses(snapshot, &mut jump);
    let (lost, moved) = jump.losses.iter().fold((zero, zero), |(sum, size), &loss| {
        (sum + loss, size + loss.abs())
    });
    let rounding = moved * Of::<Y>::EPSILON.sqrt();
    if law == ImpactLaw::Newton && lost < -rounding {
        jump = poisson::jump(snapshot, active, &restitution);
        note_losses(snapshot, &mut jump);
        jump.by_poisson = true;
    }
    jump
}

/// Returns the impulses of Newton's law of restitution.
fn by_newton<Y: StateVector>(
    snapshot: &Snapshot<Y>,
    active: &PerContact<bool>,
    restitution: &PerContact<Of<Y>>,
) -> Jump<Of<Y>>
where
    Of<Y>: Real,
{
    let mut start = snapshot.contacts.map(|contact| contact.velocity);
    for (start, &e) in start.iter_mut().zip(restitution) {
        let approach = start[2].min(Of::<Y>::from_f64(0.0));
        start[2] = e.mul_add(approach, start[2]);
    }
    by_cones(snapshot, active, &start)
}
