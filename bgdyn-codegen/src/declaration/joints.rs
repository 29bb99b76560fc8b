//! Expands the key `joints`: one declaration of an effect for several joints.
//!
//! The declaration becomes one effect per joint, with the name NAME_JOINT and the same values.

use super::{Declaration, EffectKind};
use crate::fault::{Faults, wording};
use crate::format::{Fields, Key, Located, ParsedValue, Reads};

/// The key of several joints.
pub const JOINTS: Key = Key {
    name: "joints",
    reads: Reads::Joints,
    needed: false,
    about: "`all`, or a list: one effect for each, called NAME_JOINT",
};

/// Returns the keys for declaring an effect: its own, and the key of several joints, which replaces that of one, if it
/// acts on a joint.
pub fn keys_declared(effect: &dyn EffectKind) -> Vec<Key> {
    let mut keys = effect.keys().to_vec();
    let joint = effect.joint_key();
    if let Some(at) = keys.iter().position(|key| Some(key) == joint) {
        keys.insert(at + 1, JOINTS);
    }
    keys
}

impl Declaration {
    /// Returns whether it declares one effect per joint.
    pub fn has_joints(&self) -> bool {
        self.fields.get(&JOINTS).is_some()
    }

    /// Returns one effect for each of its joints, or itself if it has no `joints`. `all` are the names for
    /// the word "all".
    pub fn of_each_joint(self, all: &[&str], faults: &mut Faults) -> Vec<Declaration> {
        let Some(joints) = self.fields.get(&JOINTS).cloned() else {
            return vec![self];
        };
        // Only effects that act on a joint can have the key `joints`.
        let Some(key) = self.effect.joint_key() else {
            return vec![self];
        };
        if let Some(joint) = self.fields.get(key) {
            faults.push(wording::joint_and_joints(&joint.location, &self.name.value));
            return vec![];
        }
        let Some(names) = names(&joints, all, faults) else {
            return vec![];
        };
        let own = self.fields.without(&JOINTS);
        let one = |joint: Located<String>| {
            let name = format!("{}_{}", self.name.value, joint.value);
            Declaration {
                name: Located {
                    value: name,
                    location: self.name.location.clone(),
                },
                effect: self.effect,
                fields: own.clone().with(key, joint),
            }
        };
        names.into_iter().map(one).collect()
    }

    /// Returns these values, and its own for missing keys; `joint` and `joints` replace each other.
    pub(super) fn fields_with(&self, fields: Fields) -> Fields {
        let joint = self.effect.joint_key().into_iter();
        let keys: Vec<&Key> = joint.chain([&JOINTS]).collect();
        let mut base = self.fields.clone();
        if keys.iter().any(|key| fields.get(key).is_some()) {
            base = keys.into_iter().fold(base, Fields::without);
        }
        fields.over(&base)
    }
}

/// Returns the joints of the key, each once.
fn names(
    joints: &Located<ParsedValue>,
    all: &[&str],
    faults: &mut Faults,
) -> Option<Vec<Located<String>>> {
    let location = &joints.location;
    match &joints.value {
        ParsedValue::Text(word) if word == "all" => {
            let located = |name: &&str| Located {
                value: (*name).to_owned(),
                location: location.clone(),
            };
            Some(all.iter().map(located).collect())
        }
        ParsedValue::Words(words) => {
            for (i, word) in words.iter().enumerate() {
                if words[..i].iter().any(|other| other.value == word.value) {
                    faults.push(wording::joint_listed_twice(&word.location, &word.value));
                    return None;
                }
            }
            Some(words.clone())
        }
        _ => {
            faults.push(wording::joints_of_wrong_kind(location));
            None
        }
    }
}
