//! Motion of positions by velocities.

use bgdyn_runtime::{Scalar as _, StateVector};

use crate::fixed_axes::{carry, go_straight};
use crate::ode::Ode;
use crate::real::Of;

/// Moves the positions of a state by its velocities, for a time, with an error of its third power: half of the change from
/// here, and half of that on the way back from there. Where the first is exact, so is the second, and they are the same; with
/// wheels the change is that of the rates at its beginning. Planar and floating joints go straight on while they turn. The
/// velocities remain as they are, along the axes of links at the positions before.
pub(crate) fn moved<O: Ode>(
    ode: &O,
    t: Of<O::State>,
    y: &mut O::State,
    time: Of<O::State>,
) -> Result<(), O::Error> {
    let positions = ode.positions();
    let half = Of::<O::State>::from_f64(0.5);
    let there = straight_change(ode, t, y, time)?;
    let mut end = y.clone();
    for (x, &change) in end
        .entries_mut()
        .iter_mut()
        .zip(there.entries())
        .take(positions)
    {
        *x = *x + change;
    }
    carry(ode.turning_joints(), y.entries(), end.entries_mut());
    let back = straight_change(ode, t, &end, -time)?;
    let changes = there.entries().iter().zip(back.entries());
    for (x, (&there, &back)) in y.entries_mut().iter_mut().zip(changes).take(positions) {
        *x = *x + half * (there - back);
    }
    Ok(())
}

/// Returns the change of the positions; planar and floating joints go straight on.
fn straight_change<O: Ode>(
    ode: &O,
    t: Of<O::State>,
    y: &O::State,
    h: Of<O::State>,
) -> Result<O::State, O::Error> {
    let mut change = ode.position_change(t, y, h)?;
    go_straight(ode.turning_joints(), y.entries(), h, change.entries_mut());
    Ok(change)
}
