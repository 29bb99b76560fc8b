//! Reads how the controllers of a scene are sampled.

use bgdyn_runtime::{Dd, SampledControl};

use super::super::Scene;
use super::super::control::Control;
use super::super::signal::InputSource;
use crate::fault::wording::expected;
use crate::fault::{Faults, wording};
use crate::format::{Dimension, Raw};
use crate::layout::StateLayout;

/// Something that is measured or computed, by name: its index among the numbers, and its dimension.
type Channel<'a> = (&'a str, usize, Dimension);

/// Returns how the controllers are sampled; `None` if the file has no `control`.
pub(super) fn control(
    (layout, drives): (&StateLayout, &[InputSource]),
    raw: Option<&Raw>,
    faults: &mut Faults,
) -> Option<Control> {
    let raw = raw?;
    let size = layout.nq() + layout.nv() + layout.nx();
    let controlled: Vec<usize> = (0..drives.len())
        .filter(|&i| drives[i].is_controller())
        .collect();
    let mut control = Control {
        period: 0.0,
        delay: 0.0,
        resolution: vec![0.0; size],
        noise: vec![0.0; size],
        input_resolution: vec![0.0; controlled.len()],
        controlled,
        seed: 1,
    };
    if control.controlled.is_empty() {
        faults.push(wording::nothing_to_sample(&raw.name.location));
    }
    let positions = positions(layout);
    let velocities = velocities(layout);
    let efforts = efforts((layout, drives), &control.controlled);
    for entry in raw.entries(expected::CONTROL, faults) {
        let key = entry.name.value.as_str();
        match key {
            "period" => control.period = time(&entry, false, faults)?,
            "delay" => control.delay = time(&entry, true, faults)?,
            "hold" if entry.as_word() == Some("zero_order") => {}
            "hold" => faults.push(wording::unknown_hold(&entry.location)),
            "seed" => control.seed = seed(&entry, faults)?,
            "quantisation" | "noise" => {
                let parts: &[(&str, &[Channel<'_>])] = match key {
                    "noise" => &[("position", &positions), ("velocity", &velocities)],
                    _ => &[
                        ("position", &positions),
                        ("velocity", &velocities),
                        ("effort", &efforts),
                    ],
                };
                for part in entry.entries(expected::SENSORS, faults) {
                    let name = part.name.value.as_str();
                    let Some((_, channels)) = parts.iter().find(|(own, _)| *own == name) else {
                        let known: Vec<&'static str> = ["position", "velocity", "effort"]
                            .into_iter()
                            .take(parts.len())
                            .collect();
                        faults.push(wording::unknown_key(&part.name.location, name, &known));
                        continue;
                    };
                    let numbers = match (key, name) {
                        (_, "effort") => &mut control.input_resolution,
                        ("noise", _) => &mut control.noise,
                        _ => &mut control.resolution,
                    };
                    sizes(&part, channels, numbers, faults);
                }
            }
            other => {
                let known = &["period", "delay", "hold", "quantisation", "noise", "seed"];
                faults.push(wording::unknown_key(&entry.name.location, other, known));
            }
        }
    }
    if control.period <= 0.0 {
        faults.push(wording::control_without_period(&raw.location));
        return None;
    }
    let most = SampledControl::DELAYS as f64 * control.period;
    if control.delay > most {
        let numbers = (control.delay, SampledControl::DELAYS, most);
        faults.push(wording::delay_too_long(&raw.location, numbers));
    }
    Some(control)
}

/// Refuses integrators of the canonical form: held efforts are no functions of the momenta.
pub(super) fn canonical(scene: &Scene, raw: Option<&Raw>, faults: &mut Faults) {
    let method = scene.integration.method;
    if let (Some(raw), true) = (raw, method.needs_canonical()) {
        let names = (method.name(), method.on_velocities().name());
        faults.push(wording::canonical_of_control(&raw.name.location, names));
    }
}

/// Returns the positions that a sensor measures: those with a velocity of their own in the state.
fn positions(layout: &StateLayout) -> Vec<Channel<'_>> {
    let all = layout.positions.iter().enumerate();
    let measured = all.filter(|(_, position)| position.coordinate.is_some());
    measured
        .map(|(i, position)| (position.name.as_str(), i, position.dimension))
        .collect()
}

/// Returns the velocities of motions.
fn velocities(layout: &StateLayout) -> Vec<Channel<'_>> {
    let all = layout.coordinates.iter().enumerate();
    all.filter(|(_, c)| c.moves())
        .map(|(j, c)| (c.name.as_str(), layout.nq() + j, c.dimensions[1]))
        .collect()
}

/// Returns what the controllers give to drives.
fn efforts<'a>(
    (layout, drives): (&'a StateLayout, &[InputSource]),
    controlled: &[usize],
) -> Vec<Channel<'a>> {
    let all = controlled.iter().enumerate();
    all.filter(|&(_, &i)| !matches!(drives[i], InputSource::IntegralRate(_)))
        .map(|(k, &i)| {
            (
                layout.inputs[i].name.as_str(),
                k,
                layout.inputs[i].dimension,
            )
        })
        .collect()
}

/// Reads a time; `zero` says whether it may be 0.
fn time(raw: &Raw, zero: bool, faults: &mut Faults) -> Option<f64> {
    let number = raw.number(&[Dimension::Time], faults)?;
    let value = number.value.value;
    if value < Dd::ZERO || (value == Dd::ZERO && !zero) {
        let (key, text) = (&raw.name.value, &number.value.text);
        faults.push(wording::control_not_positive(&number.location, key, text));
        return None;
    }
    Some(value.to_f64())
}

fn seed(raw: &Raw, faults: &mut Faults) -> Option<u64> {
    let number = raw.number(&[Dimension::One], faults)?;
    let value = number.value.value.to_f64();
    let seed = value as u64;
    if seed as f64 != value {
        let text = &number.value.text;
        faults.push(wording::not_a_seed(&number.location, text));
        return None;
    }
    Some(seed)
}

/// Reads one size for all channels, or one for each of those that are named.
fn sizes(raw: &Raw, channels: &[Channel<'_>], numbers: &mut [f64], faults: &mut Faults) {
    let mut read = |raw: &Raw, (_, i, dimension): Channel<'_>, faults: &mut Faults| {
        let Some(number) = raw.number(&[dimension], faults) else {
            return false;
        };
        if number.value.value < Dd::ZERO {
            let (key, text) = (&raw.name.value, &number.value.text);
            faults.push(wording::control_not_positive(&number.location, key, text));
            return false;
        }
        numbers[i] = number.value.value.to_f64();
        true
    };
    if !raw.is_mapping() {
        // A wrong number for all channels is reported once.
        let _ = channels.iter().all(|&channel| read(raw, channel, faults));
        return;
    }
    for entry in raw.entries(expected::SENSORS_BY_NAME, faults) {
        let name = &entry.name.value;
        match channels.iter().find(|(own, ..)| own == name) {
            Some(&channel) => {
                read(&entry, channel, faults);
            }
            None => {
                let known: Vec<&str> = channels.iter().map(|(name, ..)| *name).collect();
                faults.push(wording::unknown_channel(&entry.name.location, name, &known));
            }
        }
    }
}
