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

/// The key of one joint, which [`JOINTS`] replaces.
const JOINT: &str = "joint";

/// Returns the keys for declaring an effect: its own, and the key of several joints if it acts on a joint.
pub fn keys_declared(effect: &dyn EffectKind) -> Vec<Key> {
    let mut keys = effect.keys().to_vec();
    if let Some(at) = keys.iter().position(|key| key.name == JOINT) {
        keys.insert(at + 1, JOINTS);
    }
    keys
}

impl Declaration {
    /// Returns whether it declares one effect per joint.
    pub fn has_joints(&self) -> bool {
        self.fields.get(JOINTS.name).is_some()
    }

    /// Returns one effect for each of its joints, or itself if it has no `joints`. `all` are the names for
    /// the word "all".
    pub fn of_each_joint(self, all: &[&str], faults: &mut Faults) -> Vec<Declaration> {
        let Some(joints) = self.fields.get(JOINTS.name).cloned() else {
            return vec![self];
        };
        if let Some(joint) = self.fields.get(JOINT) {
            faults.push(wording::joint_and_joints(&joint.location, &self.name.value));
            return vec![];
        }
        let Some(names) = names(&joints, all, faults) else {
            return vec![];
        };
        let own = self.fields.without(JOINTS.name);
        let one = |joint: Located<String>| {
            let name = format!("{}_{}", self.name.value, joint.value);
            Declaration {
                name: Located {
                    value: name,
                    location: self.name.location.clone(),
                },
                effect: self.effect,
                fields: own.clone().with(JOINT, joint),
            }
        };
        names.into_iter().map(one).collect()
    }

    /// Returns these values, and those of `base` for missing keys; `joint` and `joints` replace each
    /// other.
    pub(super) fn over(fields: Fields, base: &Fields) -> Fields {
        let given = |key| fields.get(key).is_some();
        let base = match given(JOINT) || given(JOINTS.name) {
            true => base.clone().without(JOINT).without(JOINTS.name),
            false => base.clone(),
        };
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
