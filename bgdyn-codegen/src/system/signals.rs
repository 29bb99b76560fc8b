//! The sources of the inputs, as expressions: signals in time and controllers.

use bgdyn_runtime::Dd;

use super::controller_model::torques_of_model;
use super::followed::computed_torques;
use super::pose_hold;
use super::summed::summed_under;
use super::waveform::{course, rate};
use super::{ActuatorEfforts, EffortSums, SceneEquations};
use crate::expr::{Builder, Expr, Leaf};
use crate::scene::{InputSource, integral_name, limit_events};

/// Returns every input: by its source in the scene, or as given by the caller, within its limits.
pub(super) fn inputs<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let scene = &system.scene;
    let unlimited = unlimited(system, b);
    let values = unlimited.iter().zip(&scene.limits);
    let mut values: Vec<Expr<'g>> = values
        .map(|(&value, limit)| limited(b, value, limit))
        .collect();
    // The integral part follows a limit: ż = k_i (r − q) + (u − unlimited u)/T_t.
    for (i, drive) in scene.drives.iter().enumerate() {
        let InputSource::IntegralRate(of) = drive else {
            continue;
        };
        if let InputSource::Pid {
            tracking: Some(tracking),
            ..
        } = &scene.drives[*of]
            && scene.limits[*of].is_some()
        {
            let beyond = values[*of] - unlimited[*of];
            values[i] = values[i] + beyond * (Dd::ONE / *tracking);
        }
    }
    values
}

fn limited<'g>(b: &'g Builder, value: Expr<'g>, limit: &Option<[Dd; 2]>) -> Expr<'g> {
    match limit {
        Some([least, most]) => value.max(b.constant(*least)).min(b.constant(*most)),
        None => value,
    }
}

/// Returns the distances of each limited input to its least and its largest value, by the names of their events.
pub(super) fn limit_distances<'g>(
    system: &SceneEquations,
    b: &'g Builder,
) -> Vec<(String, Expr<'g>)> {
    let scene = &system.scene;
    if scene.limits.iter().all(Option::is_none) {
        return vec![];
    }
    let mut found = Vec::new();
    for ((part, value), limit) in scene
        .layout
        .inputs
        .iter()
        .zip(unlimited(system, b))
        .zip(&scene.limits)
    {
        if let Some([least, most]) = limit {
            let distances = [value - b.constant(*least), b.constant(*most) - value];
            found.extend(limit_events(&part.name).into_iter().zip(distances));
        }
    }
    found
}

/// Returns every input before its limits; of the rate of an integral part k_i (r − q).
fn unlimited<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let layout = &system.scene.layout;
    let sums = under_signals(system, b);
    let name = |i: usize| layout.inputs[i].follows.as_deref().unwrap_or_default();
    let torques = match &system.controller_model {
        Some(model) => torques_of_model(&sums, model),
        None => computed_torques(system, b, &sums),
    };
    let mut values: Vec<Expr<'g>> = Vec::new();
    for (i, drive) in system.scene.drives.iter().enumerate() {
        values.push(match drive {
            InputSource::Given => b.leaf(Leaf::Input(i)),
            InputSource::Waveform(signal) => course(b, signal),
            InputSource::RateOf(_) => by_signal(system, b, i),
            InputSource::Pd {
                target,
                stiffness,
                damping,
            } => {
                let (wanted, port) = (course(b, target), sums.coordinate(name(i)));
                (wanted - port.displacement) * *stiffness + (rate(b, wanted) - port.rate) * *damping
            }
            InputSource::Pid {
                target,
                stiffness,
                damping,
                ..
            } => {
                let (wanted, port) = (course(b, target), sums.coordinate(name(i)));
                let error = wanted - port.displacement;
                let part = sums.state(&integral_name(&layout.inputs[i].name));
                error * *stiffness + (rate(b, wanted) - port.rate) * *damping + part
            }
            InputSource::IntegralRate(of) => match &system.scene.drives[*of] {
                InputSource::Pid {
                    target, integral, ..
                } => (course(b, target) - sums.coordinate(name(*of)).displacement) * *integral,
                _ => b.zero(),
            },
            InputSource::ComputedTorque { .. } => torques[i].unwrap_or(b.zero()),
            InputSource::Hold(hold, k) => pose_hold::efforts(&sums, hold).0[*k],
        });
    }
    values
}

/// Returns the sums of all laws that a controller knows: without drives, under the signals of the scene.
fn under_signals<'g, 'a>(system: &'a SceneEquations, b: &'g Builder) -> EffortSums<'g, 'a> {
    let parts = system.scene.layout.inputs.iter().enumerate();
    let inputs = || {
        parts
            .map(|(i, part)| match part.drives.or(part.drives_dependent) {
                Some(_) => b.zero(),
                None => limited(b, by_signal(system, b, i), &system.scene.limits[i]),
            })
            .collect()
    };
    let graph = (&system.graph, None);
    summed_under(b, &system.scene, graph, ActuatorEfforts::Unknown, inputs)
}

/// Returns the value of an input by its signal, or by the signal of which it is the rate or the rate's rate; as given by
/// the caller without one.
fn by_signal<'g>(system: &SceneEquations, b: &'g Builder, i: usize) -> Expr<'g> {
    match &system.scene.drives[i] {
        InputSource::RateOf(base) => rate(b, by_signal(system, b, *base)),
        InputSource::Waveform(signal) => course(b, signal),
        _ => b.leaf(Leaf::Input(i)),
    }
}
