//! An effect with its checked values.

use bgdyn_runtime::Dd;

use super::Declaration;
use crate::fault::Place;
use crate::spec::{Dimension, Reads};

/// A number of an effect: folded into the code, or a public field of the generated struct.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// The spec's value, in SI units.
    pub value: Dd,
    /// Name of the run-time parameter whose default it is.
    pub parameter: Option<String>,
    /// What it measures.
    pub dimension: Dimension,
    /// As it stands in the file.
    pub text: String,
    /// Where.
    pub place: Place,
}

/// A checked value.
#[derive(Clone, Debug, PartialEq)]
pub enum Checked {
    /// A number.
    Number(Quantity),
    /// A word, or the name of a coordinate, a place, a node or an input.
    Name(String),
    /// Two of them.
    Names([String; 2]),
    /// Three numbers.
    Vector([Dd; 3]),
    /// Words.
    Words(Vec<String>),
}

/// An effect of a mechanism or a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// Its name.
    pub name: String,
    /// What it is.
    pub effect: &'static dyn Declaration,
    /// Where it stands in the file.
    pub place: Place,
    /// Its values by key.
    pub values: Vec<(&'static str, Checked)>,
}

impl Element {
    /// What stands behind a key.
    pub fn get(&self, key: &str) -> Option<&Checked> {
        self.values.iter().find(|(k, _)| *k == key).map(|(_, v)| v)
    }

    /// The number behind a key.
    pub fn quantity(&self, key: &str) -> Option<&Quantity> {
        match self.get(key) {
            Some(Checked::Number(quantity)) => Some(quantity),
            _ => None,
        }
    }

    /// Its numbers by key.
    pub fn quantities(&self) -> impl Iterator<Item = (&'static str, &Quantity)> {
        self.values.iter().filter_map(|(key, value)| match value {
            Checked::Number(quantity) => Some((*key, quantity)),
            _ => None,
        })
    }

    /// The word or name behind a key.
    pub fn name(&self, key: &str) -> Option<&str> {
        match self.get(key) {
            Some(Checked::Name(name)) => Some(name),
            _ => None,
        }
    }

    /// The two names behind a key.
    pub fn names(&self, key: &str) -> Option<&[String; 2]> {
        match self.get(key) {
            Some(Checked::Names(names)) => Some(names),
            _ => None,
        }
    }

    /// What a number of it stands for: "mass of `part`".
    pub fn meaning(&self, key: &str) -> String {
        format!("{key} of `{}`", self.name)
    }

    /// The words behind a key.
    pub fn words(&self, key: &str) -> Option<&[String]> {
        match self.get(key) {
            Some(Checked::Words(words)) => Some(words),
            _ => None,
        }
    }

    /// Names of the hydraulic nodes that it has.
    pub fn nodes(&self) -> Vec<String> {
        let sides = self.effect.nodes(&|key| self.get(key).is_some());
        node_names(&self.name, sides)
    }

    /// Names of the hydraulic nodes that it joins.
    pub fn joins(&self) -> Vec<&str> {
        let keys = self.effect.keys().iter();
        let keys = keys.filter(|k| k.reads == Reads::Node);
        keys.filter_map(|k| self.name(k.name)).collect()
    }

    /// The three numbers behind a key.
    pub fn vector(&self, key: &str) -> Option<[Dd; 3]> {
        match self.get(key) {
            Some(Checked::Vector(vector)) => Some(*vector),
            _ => None,
        }
    }
}

/// The nodes of an effect: its name, or its name with each of its sides.
pub(super) fn node_names(name: &str, sides: &[&str]) -> Vec<String> {
    let of = |side: &&str| match *side {
        "" => name.to_owned(),
        side => format!("{name}_{side}"),
    };
    sides.iter().map(of).collect()
}
