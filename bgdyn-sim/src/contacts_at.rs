//! The rigid contacts of an equation in a state.

use bgdyn_runtime::{RigidContact, Scalar as _, StateVector};

use crate::ode::{Ode, ScalarOf};
use crate::real::Of;

/// Returns the contacts in a state; those of the K after the equation's own are zero.
pub(crate) fn contacts_at<O: Ode, const K: usize>(
    ode: &O,
    t: ScalarOf<O>,
    y: &O::State,
) -> Result<[RigidContact<ScalarOf<O>>; K], O::Error> {
    let zero = ScalarOf::<O>::from_f64(0.0);
    let mut contacts = [RigidContact {
        gap: zero,
        velocity: [zero; 3],
        friction: zero,
        restitution: zero,
    }; K];
    let number = ode.rigid_contacts();
    if number > 0 {
        ode.rigid_contact_states(t, y, &mut contacts[..number])?;
    }
    Ok(contacts)
}

/// Returns the scalar product of the velocities of two states: of their components after the positions.
pub(crate) fn dot<Y: StateVector>(positions: usize, a: &Y, b: &Y) -> Of<Y> {
    let pairs = a.entries()[positions..]
        .iter()
        .zip(&b.entries()[positions..]);
    pairs.fold(Of::<Y>::from_f64(0.0), |sum, (&a, &b)| a.mul_add(b, sum))
}
