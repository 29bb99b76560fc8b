//! Impulses of contacts by the cones, and what they take.

use bgdyn_runtime::{MOST_EVENT_CONTACTS, Scalar as _, StateVector};

use super::modes::{Jump, PerContact};
use super::snapshot::Snapshot;
use crate::cone::{ContactOptions, ContactProblem, solve};
use crate::real::{Of, Real};

/// Returns the impulses with which the velocities γ = G p + start are those of the cones.
pub(super) fn by_cones<Y: StateVector>(
    snapshot: &Snapshot<Y>,
    active: &PerContact<bool>,
    start: &PerContact<[Of<Y>; 3]>,
) -> Jump<Of<Y>>
where
    Of<Y>: Real,
{
    let mut jump = Jump::none();
    let problem = ContactProblem {
        delassus: &snapshot.delassus,
        velocities: start,
        friction: &snapshot.contacts.map(|contact| contact.friction),
        active,
    };
    let options = ContactOptions::default();
    jump.residual = solve(&problem, &options, &mut jump.impulses).residual;
    jump
}

/// Notes the energy that each contact takes: −p·(γ⁻ + γ⁺)/2.
pub(super) fn note_losses<Y: StateVector>(snapshot: &Snapshot<Y>, jump: &mut Jump<Of<Y>>)
where
    Of<Y>: Real,
{
    let half = Of::<Y>::from_f64(0.5);
    for c in 0..snapshot.number.min(MOST_EVENT_CONTACTS) {
        let before = snapshot.contacts[c].velocity;
        let after = snapshot.velocity(c, &jump.impulses, before);
        let p = jump.impulses[c];
        let sums = (0..3).map(|k| p[k] * (before[k] + after[k]));
        jump.losses[c] = -half * sums.fold(Of::<Y>::from_f64(0.0), |sum, x| sum + x);
    }
}
