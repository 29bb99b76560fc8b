//! A kind of effect as files declare it, and an effect with its checked values.

use bgdyn_runtime::Dd;

use crate::fault::{Faults, Location};
use crate::format::{Dimension, Key, Reads};
use crate::layout::StateLayout;
use crate::mechanism::{Limits, Mechanism};

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
    pub location: Location,
}

/// A checked value.
#[derive(Clone, Debug, PartialEq)]
pub enum ElementValue {
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
    pub effect: &'static dyn EffectKind,
    /// Where it stands in the file.
    pub location: Location,
    /// Its values by key.
    pub values: Vec<(&'static str, ElementValue)>,
}

/// A kind of effect, as files declare it: all but its equations.
pub trait EffectKind: Sync {
    /// The word after `type`.
    fn keyword(&self) -> &'static str;

    /// The word by which a scene calls for all effects of like kind: `friction`.
    fn family(&self) -> &'static str;

    /// One line: what it is, with its equation.
    fn summary(&self) -> &'static str;

    /// The symbol of its element on the bond graph: `R`, `C`, `I`, `GY`, `TF`, `Se`, `MTF`.
    fn symbol(&self) -> &'static str;

    /// The keys it has. A value without keys is that of the first one.
    fn keys(&self) -> &'static [Key];

    /// Whether the spec has to say nothing of it: gravity, say. A scene calls it by its keyword.
    fn built_in(&self) -> bool {
        false
    }

    /// Whether its name is that of a coordinate, on which other effects may act.
    fn adds_coordinate(&self) -> bool {
        false
    }

    /// The hydraulic nodes it has where `given` tells which keys are there: the empty name for one
    /// that is called as the effect is, `a` for one with `_a` behind it.
    fn nodes(&self, _given: &dyn Fn(&str) -> bool) -> &'static [&'static str] {
        &[]
    }

    /// Whether its node has no volume, so that the flows into it must be nothing at every instant.
    fn is_junction(&self) -> bool {
        false
    }

    /// Whether its pressure drop is the same function of its flow at all times, so that it can
    /// stand in series with others like it.
    fn in_series(&self, _: &Element) -> bool {
        false
    }

    /// How its law was solved where it has no store that it could wait for.
    fn algebraic(&self, _: &Element) -> Option<&'static str> {
        None
    }

    /// Whether a joint has one of them at most.
    fn once_per_joint(&self) -> bool {
        false
    }

    /// What stands for a missing key where its joint has these limits.
    fn limit_for(&self, _key: &str, _: &Limits) -> Option<f64> {
        None
    }

    /// When its law runs: those with smaller numbers first. Nodes stand before what joins them.
    fn order(&self) -> u8 {
        1
    }

    /// What its numbers must obey.
    fn check_values(&self, _: &mut ValueCheck<'_>) {}

    /// What it must obey beside the scene's other effects.
    fn check_in_scene(&self, _: &Element, _: &SceneContext<'_>, _: &mut Faults) {}

    /// What it changes in the mechanism, before there is a graph.
    fn modify_mechanism(&self, _: &Element, _: &mut Mechanism) {}

    /// Coordinates, states, modes, inputs and events that it adds.
    fn declare(&self, _: &Element, _: &mut StateLayout) {}

    /// Whether a first-order state is its own.
    fn owns_state(&self, element: &Element, state: &str) -> bool {
        element.name == state
    }
}

/// What an effect finds beside it in its scene.
pub struct SceneContext<'a> {
    /// The scene's effects, itself among them.
    pub elements: &'a [Element],
    /// The mechanism, locked joints welded.
    pub mechanism: &'a Mechanism,
}

/// What an effect's rules look at, and where they report.
pub struct ValueCheck<'a> {
    /// The element, its values of the right kind.
    pub element: &'a Element,
    /// What is wrong with it.
    pub faults: &'a mut Faults,
}

impl Element {
    /// What stands behind a key.
    pub fn get(&self, key: &str) -> Option<&ElementValue> {
        self.values.iter().find(|(k, _)| *k == key).map(|(_, v)| v)
    }

    /// The number behind a key.
    pub fn quantity(&self, key: &str) -> Option<&Quantity> {
        match self.get(key) {
            Some(ElementValue::Number(quantity)) => Some(quantity),
            _ => None,
        }
    }

    /// The number behind a key as the file writes it, or the name of its run-time parameter.
    pub fn written(&self, key: &str) -> Option<String> {
        let quantity = self.quantity(key)?;
        Some(quantity.parameter.clone().unwrap_or(quantity.text.clone()))
    }

    /// Its numbers by key.
    pub fn quantities(&self) -> impl Iterator<Item = (&'static str, &Quantity)> {
        self.values.iter().filter_map(|(key, value)| match value {
            ElementValue::Number(quantity) => Some((*key, quantity)),
            _ => None,
        })
    }

    /// The word or name behind a key.
    pub fn name(&self, key: &str) -> Option<&str> {
        match self.get(key) {
            Some(ElementValue::Name(name)) => Some(name),
            _ => None,
        }
    }

    /// The two names behind a key.
    pub fn names(&self, key: &str) -> Option<&[String; 2]> {
        match self.get(key) {
            Some(ElementValue::Names(names)) => Some(names),
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
            Some(ElementValue::Words(words)) => Some(words),
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
            Some(ElementValue::Vector(vector)) => Some(*vector),
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

impl std::fmt::Debug for dyn EffectKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.keyword())
    }
}

impl PartialEq for dyn EffectKind {
    fn eq(&self, other: &Self) -> bool {
        self.keyword() == other.keyword()
    }
}
