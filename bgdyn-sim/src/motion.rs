//! Motion of positions by velocities.

use bgdyn_runtime::{Scalar as _, StateVector};

use crate::ode::Ode;
use crate::real::Of;

/// Moves the positions of a state by its velocities, for a time, with an error of its third power: half of the change from
/// here, and half of that on the way back from there. Where the first is exact, so is the second, and they are the same; with
/// wheels the change is that of the rates at its beginning.
pub(crate) fn moved<O: Ode>(
    ode: &O,
    t: Of<O::State>,
    y: &mut O::State,
    time: Of<O::State>,
) -> Result<(), O::Error> {
    let positions = ode.positions();
    let half = Of::<O::State>::from_f64(0.5);
    let there = ode.position_change(t, y, time)?;
    let mut end = y.clone();
    for (x, &change) in end
        .entries_mut()
        .iter_mut()
        .zip(there.entries())
        .take(positions)
    {
        *x = *x + change;
    }
    let back = ode.position_change(t, &end, -time)?;
    let changes = there.entries().iter().zip(back.entries());
    for (x, (&there, &back)) in y.entries_mut().iter_mut().zip(changes).take(positions) {
        *x = *x + half * (there - back);
    }
    Ok(())
}
