//! Motion of positions by velocities.

use bgdyn_runtime::{Scalar as _, StateVector};

use crate::fixed_axes::{self, carry, straight_change};
use crate::ode::Ode;
use crate::real::Of;

/// Moves the positions of a state by its velocities, for a time: planar and floating joints go straight on while they turn,
/// which is exact. Where positions have rates of another kind, as with wheels, the error is of the third power of the time:
/// half of the change at the rates here, and half of that on the way back at the rates there.
///
/// The velocities remain as they are, along the axes of links before the motion.
pub(crate) fn moved<O: Ode>(
    ode: &O,
    t: Of<O::State>,
    y: &mut O::State,
    time: Of<O::State>,
) -> Result<(), O::Error> {
    let positions = ode.positions();
    if let Some(joints) = ode.quasi_joints() {
        let mut change = y.zero();
        straight_change(joints, positions, y.entries(), time, change.entries_mut());
        add(positions, y, &change);
        return Ok(());
    }
    let there = ode.position_change(t, y, time)?;
    let mut end = y.clone();
    add(positions, &mut end, &there);
    let back = ode.position_change(t, &end, -time)?;
    let mut change = there.plus(-Of::<O::State>::from_f64(1.0), &back);
    change = change.times(Of::<O::State>::from_f64(0.5));
    add(positions, y, &change);
    Ok(())
}

/// Turns the velocities of the state `y` from the axes of links at the positions of another one to those at its own.
pub(crate) fn turn_velocities<O: Ode>(ode: &O, from: &O::State, y: &mut O::State) {
    if let Some(joints) = ode.quasi_joints() {
        carry(joints, from.entries(), y.entries_mut());
    }
}

/// Adds ω × v of planar and floating joints, with ω of one state and v of another, to the rates of the velocities: with both of
/// the same they are those along axes that do not turn.
pub(crate) fn add_turning<O: Ode>(
    ode: &O,
    (turning, moving): (&O::State, &O::State),
    rates: &mut O::State,
) {
    if let Some(joints) = ode.quasi_joints() {
        let states = (turning.entries(), moving.entries());
        fixed_axes::add_turning(joints, states, rates.entries_mut());
    }
}

/// Adds a change to the positions of a state.
fn add<Y: StateVector>(positions: usize, y: &mut Y, change: &Y) {
    let changes = change.entries().iter().take(positions);
    for (x, &change) in y.entries_mut().iter_mut().zip(changes) {
        *x = *x + change;
    }
}
