//! Expands the keys `joints` and `contacts`: one declaration of an effect for several joints or contacts.
//!
//! The declaration becomes one effect per joint or contact, with the name NAME_JOINT or NAME_CONTACT and the same
//! values.

use super::{Declaration, EffectKind};
use crate::fault::{Faults, wording};
use crate::format::{Fields, Key, Located, ParsedValue, Reads};
use crate::mechanism::ContactPair;

/// The key of several joints.
pub const JOINTS: Key = Key {
    name: "joints",
    reads: Reads::Joints,
    needed: false,
    about: "`all`, or a list: one effect for each, called NAME_JOINT",
};

/// The key of several contacts.
pub const CONTACTS: Key = Key {
    name: "contacts",
    reads: Reads::Contacts,
    needed: false,
    about: "`all`, or a list: one effect for each, called NAME_CONTACT",
};

/// What the word "all" means, and the contacts of each entry.
#[derive(Clone, Copy, Debug)]
pub struct EachOf<'a> {
    /// The joints of the word "all".
    pub joints: &'a [&'a str],
    /// The contacts of the mechanism.
    pub contacts: &'a [ContactPair],
}

impl EachOf<'_> {
    /// Returns the names that a name in a list means: the contacts of an entry with several, else itself.
    fn meant(&self, name: &str) -> Vec<String> {
        let of_entry = self.contacts.iter().filter(|pair| pair.entry == name);
        let found: Vec<String> = of_entry.map(|pair| pair.name.clone()).collect();
        match found.is_empty() {
            true => vec![name.to_owned()],
            false => found,
        }
    }

    /// Returns the names of the word "all" for a key.
    fn all(&self, several: &Key) -> Vec<String> {
        match several.reads {
            Reads::Contacts => self.contacts.iter().map(|pair| pair.name.clone()).collect(),
            _ => self.joints.iter().map(|name| (*name).to_owned()).collect(),
        }
    }
}

/// Returns the key of an effect for one joint or contact, and the key for several; `None` if it acts elsewhere.
fn one_and_several(effect: &dyn EffectKind) -> Option<(&'static Key, Key)> {
    let joint = effect.joint_key().map(|key| (key, JOINTS));
    joint.or(effect.contact_key().map(|key| (key, CONTACTS)))
}

/// Returns the keys for declaring an effect: its own, and the key of several joints or contacts, which replaces that of
/// one, if it acts on one.
pub fn keys_declared(effect: &dyn EffectKind) -> Vec<Key> {
    let mut keys = effect.keys().to_vec();
    if let Some((one, several)) = one_and_several(effect)
        && let Some(at) = keys.iter().position(|key| key == one)
    {
        keys.insert(at + 1, several);
    }
    keys
}

impl Declaration {
    /// Returns whether it declares one effect per joint.
    pub fn has_joints(&self) -> bool {
        self.fields.get(&JOINTS).is_some()
    }

    /// Returns one effect for each of its joints or contacts, or itself if it has one.
    pub fn of_each(self, each: &EachOf<'_>, faults: &mut Faults) -> Vec<Declaration> {
        let Some((one, several)) = one_and_several(self.effect) else {
            return vec![self];
        };
        let Some(list) = self.fields.get(&several).cloned() else {
            return self.of_entry(one, each);
        };
        if let Some(given) = self.fields.get(one) {
            let fault = wording::one_and_several(
                &given.location,
                &self.name.value,
                [one.name, several.name],
            );
            faults.push(fault);
            return vec![];
        }
        let Some(names) = names(&list, (each, &several), faults) else {
            return vec![];
        };
        if names.is_empty() {
            let location = &list.location;
            faults.push(wording::empty_list(
                location,
                &self.name.value,
                several.name,
            ));
        }
        let own = self.fields.clone().without(&several);
        let named = names.into_iter();
        named
            .map(|name| self.of_one(own.clone().with(one, name.clone()), &name.value))
            .collect()
    }

    /// Returns one effect for each contact of its entry, or itself if that has one.
    fn of_entry(self, one: &Key, each: &EachOf<'_>) -> Vec<Declaration> {
        let Some(Located {
            value: ParsedValue::Text(name),
            location,
        }) = self.fields.get(one).cloned()
        else {
            return vec![self];
        };
        let meant = match one.reads {
            Reads::Contact => each.meant(&name),
            _ => vec![],
        };
        if meant.len() <= 1 {
            return vec![self];
        }
        let own = self.fields.clone().without(one);
        let one_of = |value: String| {
            let named = Located {
                value: value.clone(),
                location: location.clone(),
            };
            self.of_one(own.clone().with(one, named), &value)
        };
        meant.into_iter().map(one_of).collect()
    }

    /// Returns the effect NAME_END with these fields.
    fn of_one(&self, fields: Fields, end: &str) -> Declaration {
        Declaration {
            name: Located {
                value: format!("{}_{end}", self.name.value),
                location: self.name.location.clone(),
            },
            effect: self.effect,
            fields,
        }
    }

    /// Returns these values, and its own for missing keys; the keys of one and of several replace each other.
    pub(super) fn fields_with(&self, fields: Fields) -> Fields {
        let mut base = self.fields.clone();
        if let Some((one, several)) = one_and_several(self.effect) {
            let keys = [one, &several];
            if keys.iter().any(|key| fields.get(key).is_some()) {
                base = keys.into_iter().fold(base, Fields::without);
            }
        }
        fields.over(&base)
    }
}

/// Returns the names of the key, each once.
fn names(
    list: &Located<ParsedValue>,
    (each, several): (&EachOf<'_>, &Key),
    faults: &mut Faults,
) -> Option<Vec<Located<String>>> {
    let location = &list.location;
    let located = |value: String, location: &crate::fault::Location| Located {
        value,
        location: location.clone(),
    };
    match &list.value {
        ParsedValue::Text(word) if word == "all" => {
            let all = each.all(several).into_iter();
            Some(all.map(|name| located(name, location)).collect())
        }
        ParsedValue::Words(words) => {
            let mut found: Vec<Located<String>> = Vec::new();
            for word in words {
                let meant = match several.reads {
                    Reads::Contacts => each.meant(&word.value),
                    _ => vec![word.value.clone()],
                };
                for name in meant {
                    if found.iter().any(|other| other.value == name) {
                        let key = several.name;
                        faults.push(wording::listed_twice(&word.location, key, &name));
                        return None;
                    }
                    found.push(located(name, &word.location));
                }
            }
            Some(found)
        }
        _ => {
            faults.push(wording::list_of_wrong_kind(location, several.name));
            None
        }
    }
}
