//! The sources of the inputs, as expressions: signals in time and controllers.

use bgdyn_runtime::Dd;

use super::controller_model::torques_of_model;
use super::followed::computed_torques;
use super::pose_hold;
use super::summed::summed;
use super::waveform::{course, rate};
use super::{ActuatorEfforts, SceneEquations};
use crate::expr::{Builder, Expr, Leaf};
use crate::scene::{InputSource, integral_name, limit_events};

/// Returns every input: by its source in the scene, or as given by the caller, within its limits.
pub(super) fn inputs<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let scene = &system.scene;
    let unlimited = unlimited(system, b);
    let limited = |(&value, limit): (&Expr<'g>, &Option<[Dd; 2]>)| match limit {
        Some([least, most]) => value.max(b.constant(*least)).min(b.constant(*most)),
        None => value,
    };
    let mut values: Vec<Expr<'g>> = unlimited.iter().zip(&scene.limits).map(limited).collect();
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
    let sums = summed(b, &system.scene, &system.graph, ActuatorEfforts::Unknown);
    let name = |i: usize| layout.inputs[i].follows.as_deref().unwrap_or_default();
    let torques = match &system.controller_model {
        Some(model) => torques_of_model(system, model, b),
        None => computed_torques(system, b, &sums),
    };
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

/// Returns the value of an input that is the rate of another one, or the rate of its rate.
fn rate_of<'g>(system: &SceneEquations, b: &'g Builder, i: usize) -> Expr<'g> {
    match &system.scene.drives[i] {
        InputSource::RateOf(base) => rate(b, rate_of(system, b, *base)),
        InputSource::Waveform(signal) => course(b, signal),
        _ => b.leaf(Leaf::Input(i)),
    }
}
