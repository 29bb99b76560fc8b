//! Puts positions right where closed contacts overlap.
//!
//! δq = M⁻¹ Jₙᵀ λ with 0 ≤ g + Jₙ δq ⟂ λ ≥ 0: the smallest change in the metric of M that opens the overlaps, in the
//! directions of the normals (Acary 2013, "Projected event-capturing time-stepping schemes"). A contact that bounces is not
//! moved: its overlap ends by itself.

use bgdyn_runtime::{MOST_CONTACTS, Scalar as _, StateVector};

use super::impulses::{Contacts, Impulses, contacts_at};
use super::middle::moved;
use crate::cone::{ContactOptions, ContactProblem, solve};
use crate::contact_step::ContactStep;
use crate::failure::Reason;
use crate::ode::Ode;
use crate::real::{Of, Real};

/// Lifts the state at the end of a step, and notes the deepest overlap that remains.
pub(super) fn lifted<O: Ode>(
    ode: &O,
    (t, h): (Of<O::State>, Of<O::State>),
    end: &mut O::State,
    impulses: &Impulses<O::State>,
    step: &mut ContactStep<Of<O::State>>,
) -> Result<(), Reason<O::Error>>
where
    Of<O::State>: Real,
{
    let number = ode.contacts();
    if number == 0 {
        return Ok(());
    }
    let mut contacts = contacts_at(ode, t, end)?;
    let zero = Of::<O::State>::from_f64(0.0);
    let size = end.entries()[..ode.positions()].iter();
    let size = size.fold(Of::<O::State>::from_f64(1.0), |most, x| most.max(x.abs()));
    let negligible = Of::<O::State>::EPSILON * Of::<O::State>::from_f64(64.0) * size;
    let rests = |c: usize| {
        let bounce = impulses.before[c].restitution * impulses.before[c].velocity[2];
        let ends = impulses.slow[c] || h * bounce.abs() <= negligible;
        impulses.active[c] && step.impulses[c][2] > zero && ends
    };
    let resting: [bool; MOST_CONTACTS] = core::array::from_fn(|c| c < number && rests(c));
    if deepest(&contacts, &resting) > negligible {
        let gaps = contacts.map(|contact| contact.gap);
        shift(ode, t, end, &resting, &gaps, impulses)?;
        contacts = contacts_at(ode, t, end)?;
    }
    step.depth = deepest(&contacts, &[true; MOST_CONTACTS]);
    Ok(())
}

/// Returns the deepest overlap among some contacts.
fn deepest<T: Real>(contacts: &Contacts<T>, among: &[bool; MOST_CONTACTS]) -> T {
    let all = contacts.iter().zip(among).filter(|&(_, &among)| among);
    all.fold(T::from_f64(0.0), |most, (contact, _)| {
        most.max(-contact.gap)
    })
}

/// Moves the positions so that the gaps of these contacts are 0 or more.
fn shift<O: Ode>(
    ode: &O,
    t: Of<O::State>,
    end: &mut O::State,
    resting: &[bool; MOST_CONTACTS],
    gaps: &[Of<O::State>; MOST_CONTACTS],
    impulses: &Impulses<O::State>,
) -> Result<(), Reason<O::Error>>
where
    Of<O::State>: Real,
{
    let zero = Of::<O::State>::from_f64(0.0);
    let mut delassus = [[[[zero; 3]; 3]; MOST_CONTACTS]; MOST_CONTACTS];
    let positions = ode.positions();
    for (c, map) in impulses
        .maps
        .iter()
        .enumerate()
        .filter(|&(c, _)| resting[c])
    {
        for (d, other) in impulses
            .maps
            .iter()
            .enumerate()
            .filter(|&(d, _)| resting[d])
        {
            let (Some(map), Some(other)) = (map, other) else {
                continue;
            };
            let pairs = map.rows[2].entries().iter().zip(other.columns[2].entries());
            let pairs = pairs.skip(positions);
            delassus[c][d][2][2] = pairs.fold(zero, |sum, (&a, &b)| sum + a * b);
        }
    }
    let mut lambda = [[zero; 3]; MOST_CONTACTS];
    let problem = ContactProblem {
        delassus: &delassus,
        velocities: &gaps.map(|gap| [zero, zero, gap]),
        friction: &[zero; MOST_CONTACTS],
        active: resting,
    };
    solve(&problem, &ContactOptions::default(), &mut lambda);
    let mut change = end.clone();
    for x in &mut change.entries_mut()[positions..] {
        *x = zero;
    }
    for (map, lambda) in impulses.maps.iter().zip(&lambda) {
        if let Some(map) = map.as_ref().filter(|_| lambda[2] != zero) {
            change.add(lambda[2], &map.columns[2]);
        }
    }
    moved(ode, t, &mut change, Of::<O::State>::from_f64(1.0))?;
    end.entries_mut()[..positions].copy_from_slice(&change.entries()[..positions]);
    Ok(())
}
