//! Puts positions right where closed contacts overlap.
//!
//! δq = M⁻¹ Jₙᵀ λ with 0 ≤ g + Jₙ δq ⟂ λ ≥ 0: the smallest change in the metric of M that opens the overlaps, in the
//! directions of the normals (Acary 2013, "Projected event-capturing time-stepping schemes"). A contact that bounces is not
//! moved: its overlap ends by itself.

use bgdyn_runtime::{MOST_CONTACTS, Scalar as _, StateVector};

use super::impulses::{Contacts, Impulses, listed};
use crate::cone::{ContactOptions, ContactProblem, solve};
use crate::contact_step::ContactStep;
use crate::contacts_at::{contacts_at, write_contacts};
use crate::failure::Reason;
use crate::motion::moved;
use crate::ode::Ode;
use crate::real::{Of, Real};

/// Lifts the state at the end of a step, and notes the deepest overlap that remains.
pub(super) fn lifted<O: Ode>(
    ode: &O,
    (t, h): (Of<O::State>, Of<O::State>),
    end: &mut O::State,
    impulses: &Impulses<'_, O::State>,
    step: &mut ContactStep<Of<O::State>>,
) -> Result<(), Reason<O::Error>>
where
    Of<O::State>: Real,
{
    let number = ode.rigid_contacts();
    if number == 0 {
        return Ok(());
    }
    let mut contacts = contacts_at(ode, t, end).map_err(Reason::Singular)?;
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
        let (at, n) = listed(&resting);
        let given = (impulses, &contacts, &at[..n]);
        match n {
            1 => shift::<O, 1>(ode, t, end, given)?,
            2..=4 => shift::<O, 4>(ode, t, end, given)?,
            5..=8 => shift::<O, 8>(ode, t, end, given)?,
            9..=16 => shift::<O, 16>(ode, t, end, given)?,
            _ => shift::<O, MOST_CONTACTS>(ode, t, end, given)?,
        }
        write_contacts(ode, t, end, &mut contacts).map_err(Reason::Singular)?;
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

/// What moves positions: the maps, the contacts, and the list of those that overlap.
type Overlaps<'a, Y> = (&'a Impulses<'a, Y>, &'a Contacts<Of<Y>>, &'a [usize]);

/// Moves the positions so that the gaps of these contacts, at most K, are 0 or more: contacts without friction, with gaps in
/// place of velocities.
fn shift<O: Ode, const K: usize>(
    ode: &O,
    t: Of<O::State>,
    end: &mut O::State,
    (impulses, contacts, at): Overlaps<'_, O::State>,
) -> Result<(), Reason<O::Error>>
where
    Of<O::State>: Real,
{
    let zero = Of::<O::State>::from_f64(0.0);
    let positions = ode.positions();
    let (mut gaps, mut active) = ([[zero; 3]; K], [false; K]);
    for (i, &c) in at.iter().enumerate() {
        (gaps[i][2], active[i]) = (contacts[c].gap, true);
    }
    let mut lambda = [[zero; 3]; K];
    let problem = ContactProblem {
        delassus: &impulses.delassus::<K>(positions, at),
        velocities: &gaps,
        friction: &[zero; K],
        active: &active,
    };
    solve(&problem, &ContactOptions::default(), &mut lambda);
    let mut change = end.clone();
    for x in &mut change.entries_mut()[positions..] {
        *x = zero;
    }
    for (&c, lambda) in at.iter().zip(&lambda) {
        if let Some(map) = &impulses.maps[c] {
            change.add(lambda[2], &map.columns[2]);
        }
    }
    moved(ode, t, &mut change, Of::<O::State>::from_f64(1.0)).map_err(Reason::Singular)?;
    end.entries_mut()[..positions].copy_from_slice(&change.entries()[..positions]);
    Ok(())
}
