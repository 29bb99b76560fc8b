//! Compares what contacts do: outputs, entries of energy and power, signs of event functions.

use std::collections::BTreeMap;

use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

use super::compare::{Pair, Worst};
use super::contact_law::Reading;
use super::state::State;

/// The functions; none without contacts.
pub struct Readings {
    outputs: Option<Function>,
    events: Option<Function>,
}

impl Readings {
    pub fn new(system: &SceneEquations, made: impl Fn(SceneFunction) -> Vec<Function>) -> Self {
        let some = !system.outputs.is_empty();
        let one = |role| some.then(|| made(role).swap_remove(0));
        Readings {
            outputs: one(SceneFunction::Outputs),
            events: one(SceneFunction::Events),
        }
    }
}

/// What an output of a contact is by the oracle.
fn output(reading: &Reading, part: &str) -> Dd {
    match part {
        "gap" => reading.gap,
        "normal" => reading.normal,
        "friction_x" => reading.friction[0],
        "friction_y" => reading.friction[1],
        "friction" => reading.rubbing,
        "slip" => reading.slip,
        other => panic!("no output {other}"),
    }
}

/// What has the sign of an event function.
fn event(reading: &Reading, part: &str) -> Dd {
    match part {
        "begins" => reading.gap,
        "ends" => -reading.gap,
        "pulled" => reading.pushes,
        "reverses" => reading.with_bristles,
        other => panic!("no event {other}"),
    }
}

impl Pair {
    pub fn touches(&self, state: &State, worst: &mut Worst) -> Result<(), String> {
        let Some(outputs) = &self.readings.outputs else {
            return Ok(());
        };
        let contacts = self.oracle.contacts(state);
        for reading in contacts.values() {
            worst.touching[usize::from(reading.gap >= Dd::ZERO)] += 1;
        }
        let found = self.value(outputs, state)?;
        let names = self.system.outputs.iter().map(|o| o.name.as_str());
        // The part of a name after that of an effect.
        let part = |name: &str| {
            let of = |(effect, reading): (&String, &Reading)| {
                let part = name.strip_prefix(effect.as_str())?.strip_prefix('_')?;
                Some((part.to_owned(), *reading))
            };
            contacts.iter().rev().find_map(of)
        };
        let mut pairs: Vec<(String, Dd, Dd)> = Vec::new();
        for (name, x) in names.zip(found) {
            let (part, reading) = part(name).expect("an output of a contact");
            pairs.push((name.into(), x, output(&reading, &part)));
        }
        self.entries(state, &contacts, &mut pairs)?;
        close(&pairs, super::compare::EXACT, worst)?;
        self.signs(state, part)
    }

    /// Adds the entries of the balance of power.
    fn entries(
        &self,
        state: &State,
        contacts: &BTreeMap<String, Reading>,
        pairs: &mut Vec<(String, Dd, Dd)>,
    ) -> Result<(), String> {
        let stored = self.value(&self.energy, state)?;
        let powers = self.value(&self.power, state)?;
        let entries = self.system.entries.iter().zip(stored);
        for ((entry, stored), power) in entries.zip(powers.chunks(3)) {
            let Some(reading) = contacts.get(&entry.name) else {
                continue;
            };
            let parts = ["stored", "supplied", "stored rate", "dissipated"];
            let found = [stored, power[0], power[1], power[2]];
            let wanted = [
                reading.stored,
                Dd::ZERO,
                reading.stored_rate,
                reading.dissipated,
            ];
            for (part, (x, y)) in parts.iter().zip(found.into_iter().zip(wanted)) {
                pairs.push((format!("{part} of {}", entry.name), x, y));
            }
        }
        Ok(())
    }

    /// Compares the signs of the event functions.
    fn signs(
        &self,
        state: &State,
        part: impl Fn(&str) -> Option<(String, Reading)>,
    ) -> Result<(), String> {
        let Some(events) = &self.readings.events else {
            return Ok(());
        };
        let names = self.system.scene.layout.events.iter().map(|e| &e.name);
        for (name, x) in names.zip(self.value(events, state)?) {
            let Some((part, reading)) = part(name) else {
                continue;
            };
            let y = event(&reading, &part);
            let (no_force, no_sign) = (reading.gap > Dd::ZERO, y.to_f64().abs() < 1e-20);
            if part == "pulled" && no_force || no_sign {
                continue;
            }
            if (x > Dd::ZERO) != (y > Dd::ZERO) {
                let (x, y, gap) = (x.to_f64(), y.to_f64(), reading.gap.to_f64());
                return Err(format!(
                    "event {name} is {x:e}, by the oracle {y:e} at the gap {gap:e}"
                ));
            }
        }
        Ok(())
    }
}

/// Compares found and wanted numbers, relative to the wanted one or to 1.
fn close(pairs: &[(String, Dd, Dd)], allowed: f64, worst: &mut Worst) -> Result<(), String> {
    for (name, x, y) in pairs {
        let scale = y.to_f64().abs().max(1.0);
        let off = (*x - *y).to_f64().abs() / scale;
        if off.is_nan() || off > allowed {
            let (x, y) = (x.to_f64(), y.to_f64());
            return Err(format!("{name} is {x:e}, by the oracle {y:e}"));
        }
        worst.readings = worst.readings.max(off);
    }
    Ok(())
}
