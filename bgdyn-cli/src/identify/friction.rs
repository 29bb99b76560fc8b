//! Friction and rotors that a spec declares.

use bgdyn_codegen::declaration::{Declaration, EachOf};
use bgdyn_codegen::fault::Faults;
use bgdyn_codegen::format::ParsedValue;
use bgdyn_codegen::machine::Machine;

/// The number of an effect that belongs to a column of a joint.
#[derive(Clone, Debug)]
pub(crate) struct EffectNumber {
    /// The effect's name in the file.
    pub(crate) name: String,
    /// The joint.
    pub(crate) joint: String,
    /// Which of `JOINT_COLUMNS`.
    pub(crate) column: usize,
    /// The key with the number.
    pub(crate) key: &'static str,
    /// The number in the file; for a rotor its inertia without the ratio.
    pub(crate) value: f64,
    /// Factor from the number to that of the joint: N² of a rotor.
    pub(crate) factor: f64,
}

/// The keys of effects that are columns: the word of the effect, its key, the column.
const KEYS: [(&str, &str, usize); 8] = [
    ("rotor", "inertia", 0),
    ("viscous", "damping", 1),
    ("stribeck", "damping", 1),
    ("lugre", "viscous", 1),
    ("coulomb", "kinetic", 2),
    ("coulomb_smooth", "kinetic", 2),
    ("stribeck", "kinetic", 2),
    ("lugre", "kinetic", 2),
];

/// Returns the numbers of effects of joints that move against the world.
pub(crate) fn effect_numbers(effects: &[Declaration]) -> Vec<EffectNumber> {
    let mut numbers = Vec::new();
    for effect in effects {
        let Some(joint) = word(effect, "joint") else {
            continue;
        };
        if word(effect, "reference").is_some() {
            continue;
        }
        for (word, key, column) in KEYS {
            if effect.effect.keyword() != word {
                continue;
            }
            let Some(value) = number(effect, key) else {
                continue;
            };
            let ratio = number(effect, "ratio").unwrap_or(1.0);
            let factor = if column == 0 { ratio * ratio } else { 1.0 };
            let (name, joint) = (effect.name.value.clone(), joint.clone());
            numbers.push(EffectNumber {
                name,
                joint,
                column,
                key,
                value,
                factor,
            });
        }
    }
    numbers
}

/// Returns the declared effects of a machine, one for each joint where `joints` names several.
pub(crate) fn of_each_joint(machine: &Machine) -> Vec<Declaration> {
    let all = machine.mechanism.one_degree_names();
    let all: Vec<&str> = all.iter().map(String::as_str).collect();
    let each = EachOf {
        joints: &all,
        contacts: machine.mechanism.contact_pairs(),
    };
    // The check of the machine has reported what is wrong with them.
    let mut reported = Faults::default();
    let effects = machine.effects.iter().cloned();
    effects
        .flat_map(|effect| effect.of_each(&each, &mut reported))
        .collect()
}

/// Returns the word or name of a key.
pub(crate) fn word(effect: &Declaration, key: &str) -> Option<String> {
    let key = effect.effect.keys().iter().find(|k| k.name == key)?;
    match &effect.fields.get(key)?.value {
        ParsedValue::Text(text) => Some(text.clone()),
        _ => None,
    }
}

fn number(effect: &Declaration, key: &str) -> Option<f64> {
    let key = effect.effect.keys().iter().find(|k| k.name == key)?;
    match &effect.fields.get(key)?.value {
        ParsedValue::Number(number) => Some(number.value.to_f64()),
        _ => None,
    }
}
