//! The sources of the inputs, as expressions: signals in time and controllers.

use super::followed::computed_torques;
use super::pose_hold;
use super::summed::summed;
use super::waveform::{course, rate};
use super::{ActuatorEfforts, SceneEquations};
use crate::expr::{Builder, Expr, Leaf};
use crate::scene::InputSource;

/// Returns every input: by its source in the scene, or as given by the caller.
pub(super) fn inputs<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let layout = &system.scene.layout;
    let sums = summed(b, &system.scene, &system.graph, ActuatorEfforts::Unknown);
    let name = |i: usize| layout.inputs[i].follows.as_deref().unwrap_or_default();
    let torques = computed_torques(system, b, &sums);
    let mut values: Vec<Expr<'g>> = Vec::new();
    for (i, drive) in system.scene.drives.iter().enumerate() {
        values.push(match drive {
            InputSource::Given => b.leaf(Leaf::Input(i)),
            InputSource::Waveform(signal) => course(b, signal),
            InputSource::RateOf(_) => rate_of(system, b, i),
            InputSource::Pd {
                target,
                stiffness,
                damping,
            } => {
                let (wanted, port) = (course(b, target), sums.coordinate(name(i)));
                (wanted - port.displacement) * *stiffness + (rate(b, wanted) - port.rate) * *damping
            }
            InputSource::ComputedTorque { .. } => torques[i].unwrap_or(b.zero()),
            InputSource::Hold(hold, k) => pose_hold::efforts(&sums, hold).0[*k],
        });
    }
    values
}

/// Returns the value of an input that is the rate of another one, or the rate of its rate.
fn rate_of<'g>(system: &SceneEquations, b: &'g Builder, i: usize) -> Expr<'g> {
    match &system.scene.drives[i] {
        InputSource::RateOf(base) => rate(b, rate_of(system, b, *base)),
        InputSource::Waveform(signal) => course(b, signal),
        _ => b.leaf(Leaf::Input(i)),
    }
}
