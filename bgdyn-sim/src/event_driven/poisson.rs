//! Poisson's law of restitution with Coulomb friction, in two phases (Glocker and Pfeiffer 1995).

use bgdyn_runtime::{MOST_EVENT_CONTACTS, Scalar as _, StateVector};

use super::impulses::by_cones;
use super::modes::{Jump, PerContact, speed};
use super::snapshot::Snapshot;
use crate::real::{Of, Real};

/// The largest number of sweeps over the contacts.
const MOST_SWEEPS: usize = 20_000;

/// Returns the impulses of both phases. Compression ends where no contact approaches any more, with impulses p in the cones;
/// in expansion each contact gets e p_n back, and more where it would approach.
pub(super) fn jump<Y: StateVector>(
    snapshot: &Snapshot<Y>,
    active: &PerContact<bool>,
    restitution: &PerContact<Of<Y>>,
) -> Jump<Of<Y>>
where
    Of<Y>: Real,
{
    let start = snapshot.contacts.map(|contact| contact.velocity);
    let mut jump = by_cones(snapshot, active, &start);
    let between: PerContact<_> =
        core::array::from_fn(|c| snapshot.velocity(c, &jump.impulses, start[c]));
    let least = core::array::from_fn(|c| restitution[c] * jump.impulses[c][2]);
    let (back, residual) = expansion(snapshot, active, &between, &least);
    for (sum, back) in jump.impulses.iter_mut().zip(&back) {
        for (sum, &back) in sum.iter_mut().zip(back) {
            *sum = *sum + back;
        }
    }
    jump.residual = jump.residual.max(residual);
    jump
}

/// Returns the impulses of expansion, 0 ≤ γ_n ⟂ p_n − least ≥ 0 and |p_t| ≤ μ p_n against the slip, by projected sweeps, with
/// their last change.
fn expansion<Y: StateVector>(
    snapshot: &Snapshot<Y>,
    active: &PerContact<bool>,
    start: &PerContact<[Of<Y>; 3]>,
    least: &PerContact<Of<Y>>,
) -> (PerContact<[Of<Y>; 3]>, Of<Y>)
where
    Of<Y>: Real,
{
    let zero = Of::<Y>::from_f64(0.0);
    let mut p = [[zero; 3]; MOST_EVENT_CONTACTS];
    for c in (0..snapshot.number).filter(|&c| active[c]) {
        p[c][2] = least[c];
    }
    let mut change = zero;
    for _ in 0..MOST_SWEEPS {
        change = zero;
        let mut size = zero;
        for c in (0..snapshot.number).filter(|&c| active[c]) {
            let block = &snapshot.delassus[c][c];
            let trace = block[0][0] + block[1][1] + block[2][2];
            if trace <= zero {
                continue;
            }
            let velocity = snapshot.velocity(c, &p, start[c]);
            let old = p[c];
            let normal =
                (old[2] - velocity[2] / block[2][2].max(trace * Of::<Y>::EPSILON)).max(least[c]);
            let side = block[0][0].max(block[1][1]).max(trace * Of::<Y>::EPSILON);
            let mut new = [
                old[0] - velocity[0] / side,
                old[1] - velocity[1] / side,
                normal,
            ];
            let (limit, rubbed) = (snapshot.contacts[c].friction * normal, speed(new));
            if rubbed > limit {
                for part in &mut new[..2] {
                    *part = *part * (limit / rubbed);
                }
            }
            for (new, old) in new.iter().zip(old) {
                change = change.max((*new - old).abs());
                size = size.max(new.abs());
            }
            p[c] = new;
        }
        if change <= size * Of::<Y>::EPSILON {
            break;
        }
    }
    (p, change)
}
