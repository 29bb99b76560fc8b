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
    write_contacts(ode, t, y, &mut contacts)?;
    Ok(contacts)
}

/// Writes the contacts in a state, as many as the equation has.
pub(crate) fn write_contacts<O: Ode>(
    ode: &O,
    t: ScalarOf<O>,
    y: &O::State,
    contacts: &mut [RigidContact<ScalarOf<O>>],
) -> Result<(), O::Error> {
    match ode.rigid_contacts() {
        0 => Ok(()),
        number => ode.rigid_contact_states(t, y, &mut contacts[..number]),
    }
}

/// Returns the scalar product of the velocities of two states: of their components after the positions.
pub(crate) fn dot<Y: StateVector>(positions: usize, a: &Y, b: &Y) -> Of<Y> {
    let pairs = a.entries()[positions..]
        .iter()
        .zip(&b.entries()[positions..]);
    pairs.fold(Of::<Y>::from_f64(0.0), |sum, (&a, &b)| a.mul_add(b, sum))
}

/// Returns the scalar products of the velocities of three states with those of three others.
pub(crate) fn products<Y: StateVector>(
    positions: usize,
    rows: &[Y; 3],
    columns: &[Y; 3],
) -> [[Of<Y>; 3]; 3] {
    // Nine sums at once: one alone would wait for each of its additions.
    let [a, b, c] = rows.each_ref().map(|y| y.entries()[positions..].iter());
    let [x, y, z] = columns.each_ref().map(|y| y.entries()[positions..].iter());
    let mut sums = [[Of::<Y>::from_f64(0.0); 3]; 3];
    for (((&a, &b), &c), ((&x, &y), &z)) in a.zip(b).zip(c).zip(x.zip(y).zip(z)) {
        for (sums, row) in sums.iter_mut().zip([a, b, c]) {
            for (sum, column) in sums.iter_mut().zip([x, y, z]) {
                *sum = row.mul_add(column, *sum);
            }
        }
    }
    sums
}
