//! Looks up values of an element by the keys that its effect declares.
//!
//! A lookup by a key that the effect does not declare, or of another type, is an error of the effect's author: it
//! panics, whether or not the file gives a value.

use bgdyn_runtime::Dd;

use super::element::node_names;
use super::{EffectKind, Element, ElementValue, Quantity};
use crate::format::{Key, Reads};

impl Element {
    /// Returns whether its effect declares a key of this name and type.
    fn declares(&self, key: &Key) -> bool {
        let mut keys = self.effect.keys().iter();
        keys.any(|own| own.name == key.name && own.reads == key.reads)
    }

    /// Returns the value of a key; `None` if the file does not give it. `readable` is whether the caller can read
    /// values of the key's type.
    fn value(&self, key: &Key, readable: bool) -> Option<&ElementValue> {
        if !readable || !self.declares(key) {
            undeclared(self, "key", key.name);
        }
        let mut values = self.values.iter();
        let found = values.find(|(name, _)| *name == key.name);
        found.map(|(_, value)| value)
    }

    /// Returns whether a key has a value.
    ///
    /// # Panics
    /// If its effect does not declare the key.
    pub fn has(&self, key: &Key) -> bool {
        self.value(key, true).is_some()
    }

    /// Returns the number of a key; `None` if the file does not give it.
    ///
    /// # Panics
    /// If its effect does not declare the key as a number.
    pub fn quantity(&self, key: &Key) -> Option<&Quantity> {
        match self.value(key, matches!(key.reads, Reads::Number(_))) {
            Some(ElementValue::Number(quantity)) => Some(quantity),
            _ => None,
        }
    }

    /// Returns the number of a key in the file's text, or the name of its run-time parameter.
    ///
    /// # Panics
    /// If its effect does not declare the key as a number.
    pub fn written(&self, key: &Key) -> Option<String> {
        let quantity = self.quantity(key)?;
        Some(quantity.parameter.clone().unwrap_or(quantity.text.clone()))
    }

    /// Returns its numbers by name, those of groups too.
    pub fn quantities(&self) -> impl Iterator<Item = (&'static str, &Quantity)> {
        self.values.iter().filter_map(|(key, value)| match value {
            ElementValue::Number(quantity) => Some((*key, quantity)),
            _ => None,
        })
    }

    /// Returns the names of a group with their numbers; `None` for those that the file does not give.
    ///
    /// # Panics
    /// If its effect does not declare the key as a group of `N` numbers.
    pub fn group<const N: usize>(&self, key: &Key) -> [(&'static str, Option<&Quantity>); N] {
        let names = match key.reads {
            Reads::Group(names, _) if self.declares(key) => names.try_into().ok(),
            _ => None,
        };
        let names: [&'static str; N] = names.unwrap_or_else(|| undeclared(self, "key", key.name));
        names.map(|name| {
            let mut numbers = self.quantities();
            (name, numbers.find(|(own, _)| *own == name).map(|(_, q)| q))
        })
    }

    /// Returns the word or name of a key; `None` if the file does not give it.
    ///
    /// # Panics
    /// If its effect does not declare the key as a word or a name.
    pub fn name(&self, key: &Key) -> Option<&str> {
        let readable = matches!(
            key.reads,
            Reads::Word(_)
                | Reads::Coordinate
                | Reads::Joint
                | Reads::Site
                | Reads::Contact
                | Reads::Node
                | Reads::Input
        );
        match self.value(key, readable) {
            Some(ElementValue::Name(name)) => Some(name),
            _ => None,
        }
    }

    /// Returns the word or name of a key that every file gives.
    ///
    /// # Panics
    /// If its effect does not declare the key as a word or a name, or the key has no value.
    pub fn needed_name(&self, key: &Key) -> &str {
        let name = self.name(key);
        name.unwrap_or_else(|| undeclared(self, "value of the key", key.name))
    }

    /// Returns whether a key has this word.
    ///
    /// # Panics
    /// If its effect does not declare the key with this word.
    pub fn says(&self, key: &Key, word: &str) -> bool {
        match key.reads {
            Reads::Word(words) if words.contains(&word) => self.name(key) == Some(word),
            _ => undeclared(self, "word", word),
        }
    }

    /// Returns the two names of a key; `None` if the file does not give it.
    ///
    /// # Panics
    /// If its effect does not declare the key as two names.
    pub fn names(&self, key: &Key) -> Option<&[String; 2]> {
        match self.value(key, key.reads == Reads::Sites) {
            Some(ElementValue::Names(names)) => Some(names),
            _ => None,
        }
    }

    /// Returns the words of a key; `None` if the file does not give it.
    ///
    /// # Panics
    /// If its effect does not declare the key as words.
    pub fn words(&self, key: &Key) -> Option<&[String]> {
        match self.value(key, matches!(key.reads, Reads::Words(_))) {
            Some(ElementValue::Words(words)) => Some(words),
            _ => None,
        }
    }

    /// Returns the three numbers of a key; `None` if the file does not give it.
    ///
    /// # Panics
    /// If its effect does not declare the key as three numbers.
    pub fn vector(&self, key: &Key) -> Option<[Dd; 3]> {
        match self.value(key, matches!(key.reads, Reads::Vector(_))) {
            Some(ElementValue::Vector(vector)) => Some(*vector),
            _ => None,
        }
    }

    /// Returns a description of one of its numbers: "mass of `part`".
    pub fn meaning(&self, key: &str) -> String {
        format!("{key} of `{}`", self.name)
    }

    /// Returns the joint or coordinate that it acts on; `None` if it acts elsewhere.
    pub fn joint(&self) -> Option<&str> {
        self.effect.joint_key().and_then(|key| self.name(key))
    }

    /// Returns the contact that it acts at; `None` if it acts elsewhere.
    pub fn contact(&self) -> Option<&str> {
        self.effect.contact_key().and_then(|key| self.name(key))
    }

    /// Returns the two sites along whose line it acts; `None` if it acts elsewhere.
    pub fn ends(&self) -> Option<&[String; 2]> {
        let mut keys = self.effect.keys().iter();
        let key = keys.find(|key| key.reads == Reads::Sites);
        key.and_then(|key| self.names(key))
    }

    /// Returns the links and frames that its keys name.
    pub fn sites(&self) -> Vec<&str> {
        let named = |key: &Key| match key.reads {
            Reads::Site => self.name(key).into_iter().collect(),
            Reads::Sites => {
                let names = self.names(key).into_iter().flatten();
                names.map(String::as_str).collect()
            }
            _ => vec![],
        };
        self.effect.keys().iter().flat_map(named).collect()
    }

    /// Returns the names of its hydraulic nodes.
    pub fn nodes(&self) -> Vec<String> {
        let sides = self.effect.nodes(&|key| self.has(key));
        node_names(&self.name, sides)
    }

    /// Returns the names of the hydraulic nodes that it joins.
    pub fn joins(&self) -> Vec<&str> {
        let keys = self.effect.keys().iter();
        let keys = keys.filter(|key| key.reads == Reads::Node);
        keys.filter_map(|key| self.name(key)).collect()
    }
}

impl dyn EffectKind + '_ {
    /// Returns its key with this name.
    ///
    /// # Panics
    /// If it has no such key.
    pub fn key(&self, name: &str) -> &'static Key {
        let found = self.keys().iter().find(|key| key.name == name);
        found.unwrap_or_else(|| panic!("the effect `{}` has no key `{name}`", self.keyword()))
    }

    /// Returns its key for the joint or coordinate that it acts on; `None` if it acts elsewhere.
    pub fn joint_key(&self) -> Option<&'static Key> {
        let mut keys = self.keys().iter();
        keys.find(|key| matches!(key.reads, Reads::Coordinate | Reads::Joint))
    }

    /// Returns its key for the contact that it acts at; `None` if it acts elsewhere.
    pub fn contact_key(&self) -> Option<&'static Key> {
        self.keys().iter().find(|key| key.reads == Reads::Contact)
    }
}

/// Panics: the effect of this element uses a name that is not declared.
pub(crate) fn undeclared(element: &Element, kind: &str, name: &str) -> ! {
    panic!(
        "the effect `{}` (element `{}`) uses the {kind} `{name}`, which is not declared",
        element.effect.keyword(),
        element.name,
    )
}
