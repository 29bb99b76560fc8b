//! Checks the limits of inputs, and adds what they and integral parts need to the layout.

use bgdyn_runtime::Dd;

use super::super::signal::{InputSource, LIMIT};
use super::super::waveform::Waveform;
use crate::fault::wording::expected;
use crate::fault::{Faults, wording};
use crate::format::{Dimension, Raw};
use crate::layout::{MomentumStore, StateLayout, Variable};
use crate::mechanism::Mechanism;

/// The least and the largest value of an input; `None` without limits.
pub(in crate::scene) type InputLimits = Option<[Dd; 2]>;

/// Returns the limits of each input: those of its entry, within those of the joint in the mechanism's file if
/// `effort_limits` is true.
pub(super) fn limits(
    (mechanism, layout): (&Mechanism, &StateLayout),
    (inputs, effort_limits): (&[Raw], Option<&Raw>),
    faults: &mut Faults,
) -> Vec<InputLimits> {
    let acts = match effort_limits.map(|raw| (raw, raw.as_truth())) {
        Some((raw, None)) => {
            faults.push(wording::not_a_truth(&raw.location, "effort_limits"));
            false
        }
        Some((_, Some(truth))) => truth,
        None => false,
    };
    let own = |part: &Variable| -> InputLimits {
        let effort = acts.then(|| of_joint(mechanism, layout, part)).flatten()?;
        let most = Dd::from_f64(effort);
        Some([-most, most])
    };
    let mut limits: Vec<InputLimits> = layout.inputs.iter().map(own).collect();
    if let (true, Some(raw), true) = (acts, effort_limits, limits.iter().all(Option::is_none)) {
        faults.push(wording::no_effort_limits(&raw.location));
    }
    for raw in inputs.iter().filter(|raw| raw.is_mapping()) {
        let Some(i) = layout
            .inputs
            .iter()
            .position(|part| part.name == raw.name.value)
        else {
            continue;
        };
        // Other faults of the entry were reported already.
        let entries = raw.entries(expected::INPUT, &mut Faults::default());
        let Some(entry) = entries.iter().find(|entry| entry.name.value == LIMIT) else {
            continue;
        };
        let part = &layout.inputs[i];
        if part.follows.is_none() && part.drives.is_none() {
            let location = &entry.name.location;
            faults.push(wording::limit_without_effort(location, &part.name));
            continue;
        }
        if let Some([low, high]) = read(entry, part.dimension, faults) {
            let both = match limits[i] {
                Some([least, most]) => [
                    if low < least { least } else { low },
                    if most < high { most } else { high },
                ],
                None => [low, high],
            };
            if both[1] <= both[0] {
                let effort = limits[i].map_or(0.0, |[_, most]| most.to_f64());
                let written = [low.to_f64(), high.to_f64()];
                faults.push(wording::limit_beyond_effort(
                    &entry.location,
                    written,
                    effort,
                ));
                continue;
            }
            limits[i] = Some(both);
        }
    }
    limits
}

/// Reads a limit: a positive number for both directions, or the least and the largest value.
fn read(raw: &Raw, dimension: Dimension, faults: &mut Faults) -> InputLimits {
    let number = |raw: &Raw, faults: &mut Faults| {
        let number = raw.number(&[dimension], faults)?;
        Some(number.value.value)
    };
    let [low, high] = match raw.is_list() {
        false => {
            let most = number(raw, faults)?;
            [-most, most]
        }
        true => {
            let items = raw.items(expected::LIMIT_OF_INPUT, faults)?;
            let [low, high] = items.as_slice() else {
                faults.push(wording::target_of_other_length(
                    &raw.location,
                    items.len(),
                    2,
                    expected::TWO_LIMITS,
                ));
                return None;
            };
            [number(low, faults)?, number(high, faults)?]
        }
    };
    if high <= low {
        let (low, high) = (low.to_f64(), high.to_f64());
        faults.push(wording::not_a_limit(&raw.location, low, high));
        return None;
    }
    Some([low, high])
}

/// Returns the largest effort of the joint that an input drives, in the mechanism's file.
fn of_joint(mechanism: &Mechanism, layout: &StateLayout, part: &Variable) -> Option<f64> {
    match (part.drives, part.drives_dependent) {
        (Some(j), _) => match layout.coordinates[j].store {
            MomentumStore::Links(coordinate) => mechanism.joint(coordinate).limits.effort,
            MomentumStore::Own(_) => None,
        },
        (None, Some(d)) => {
            let velocity = layout.dependents[d].velocity;
            mechanism.open().joint(velocity).limits.effort
        }
        (None, None) => None,
    }
}

/// Adds the integral part of each `pid` to the states, with its rate as an input.
pub(super) fn add_integrals(layout: &mut StateLayout, drives: &mut Vec<InputSource>) {
    for i in 0..drives.len() {
        if !matches!(drives[i], InputSource::Pid { .. }) {
            continue;
        }
        let Variable {
            name, dimension, ..
        } = layout.inputs[i].clone();
        let unit = dimension.si();
        let about = format!("integral part of the controller of `{name}`, {unit}");
        layout.state(integral_name(&name), dimension, about);
        let about = format!("rate of the integral part of the controller of `{name}`, {unit}/s");
        layout.input(format!("{name}_integral_rate"), Dimension::One, about);
        drives.push(InputSource::IntegralRate(i));
    }
}

/// Refuses limited controllers with an integral part that has no time in which to follow the limit.
pub(super) fn check_anti_windup(
    layout: &StateLayout,
    (drives, limits, inputs): (&[InputSource], &[InputLimits], &[Raw]),
    faults: &mut Faults,
) {
    for (i, (drive, limit)) in drives.iter().zip(limits).enumerate() {
        let name = &layout.inputs[i].name;
        if let (InputSource::Pid { tracking: None, .. }, Some(_)) = (drive, limit)
            && let Some(raw) = inputs.iter().find(|raw| raw.name.value == *name)
        {
            let location = &raw.name.location;
            faults.push(wording::pid_without_anti_windup(location, name));
        }
    }
}

/// Adds the events of limited inputs that change on their own: each is the distance to a limit. Inputs of sampled
/// controllers change at samples only.
pub(super) fn add_events(
    layout: &mut StateLayout,
    drives: &[InputSource],
    limits: &[InputLimits],
    sampled: bool,
) {
    for (i, (drive, limit)) in drives.iter().zip(limits).enumerate() {
        let constant = match drive {
            InputSource::Given | InputSource::Waveform(Waveform::Constant(_)) => true,
            drive => sampled && drive.is_controller(),
        };
        if limit.is_none() || constant {
            continue;
        }
        let name = layout.inputs[i].name.clone();
        for (event, side) in limit_events(&name).into_iter().zip(["least", "largest"]) {
            layout.event(event, format!("input `{name}` reaches its {side} value"));
        }
    }
}

/// Returns the name of the integral part of an input's controller.
pub fn integral_name(input: &str) -> String {
    format!("{input}_integral")
}

/// Returns the names of the events at the least and at the largest value of an input.
pub fn limit_events(input: &str) -> [String; 2] {
    ["least", "largest"].map(|side| format!("{input}_at_{side}"))
}
