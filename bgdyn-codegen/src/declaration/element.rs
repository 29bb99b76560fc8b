//! The trait of effect kinds as files declare them, and the type of an effect with checked values.

use bgdyn_runtime::Dd;

use crate::fault::{Faults, Location};
use crate::format::{Dimension, Key};
use crate::layout::StateLayout;
use crate::mechanism::{Limits, Mechanism};

/// A number of an effect: folded into the code, or a public field of the generated struct.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// The spec's value, in SI units.
    pub value: Dd,
    /// Name of the run-time parameter with this default value.
    pub parameter: Option<String>,
    /// Its dimension.
    pub dimension: Dimension,
    /// Its text in the file.
    pub text: String,
    /// Its location.
    pub location: Location,
}

/// A checked value.
#[derive(Clone, Debug, PartialEq)]
pub enum ElementValue {
    /// A number.
    Number(Quantity),
    /// A word, or the name of a coordinate, a site, a node or an input.
    Name(String),
    /// Two names.
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
    /// Its kind.
    pub effect: &'static dyn EffectKind,
    /// Its location in the file.
    pub location: Location,
    /// Its values by key.
    pub values: Vec<(&'static str, ElementValue)>,
}

/// A kind of effect, as files declare it, without its equations.
pub trait EffectKind: Sync {
    /// Returns the word for the key `type`.
    fn keyword(&self) -> &'static str;

    /// Returns the word for all effects of a family in a scene: `friction`.
    fn family(&self) -> &'static str;

    /// Returns one line with a description and the equation.
    fn summary(&self) -> &'static str;

    /// Returns the symbol of its element on the bond graph: `R`, `C`, `I`, `GY`, `TF`, `Se`, `MTF`.
    fn symbol(&self) -> &'static str;

    /// Returns its keys. A value without a key belongs to the first one.
    fn keys(&self) -> &'static [Key];

    /// Returns whether the effect needs no declaration in the spec (gravity, for example). A scene
    /// includes it by its keyword.
    fn built_in(&self) -> bool {
        false
    }

    /// Returns whether its name is that of a coordinate, on which other effects may act.
    fn adds_coordinate(&self) -> bool {
        false
    }

    /// Returns its hydraulic nodes; `given` returns whether a key is present. The empty string is a node
    /// with the name of the effect, `a` a node with the suffix `_a`.
    fn nodes(&self, _given: &dyn Fn(&Key) -> bool) -> &'static [&'static str] {
        &[]
    }

    /// Returns whether its node has no volume, so that the flows into it sum to zero at every instant.
    fn is_junction(&self) -> bool {
        false
    }

    /// Returns whether its pressure drop is the same function of its flow at all times, so that it can be
    /// in series with similar elements.
    fn in_series(&self, _: &Element) -> bool {
        false
    }

    /// Returns how its law is solved if no store determines its variables.
    fn algebraic(&self, _: &Element) -> Option<&'static str> {
        None
    }

    /// Returns whether its law reads the position of its joint, not only the velocity: then it cannot act
    /// on a quasi-velocity.
    fn reads_position(&self) -> bool {
        true
    }

    /// Returns whether an effect between two sites acts along the line between them, whose length must then vary.
    fn acts_along_line(&self) -> bool {
        true
    }

    /// Returns whether it can act on a joint that follows others: its law reads and adds to a port only. An
    /// effect that reads the drive of a joint cannot, because a follower has none.
    fn acts_on_followers(&self) -> bool {
        true
    }

    /// Returns whether a joint can have only one effect of this kind.
    fn once_per_joint(&self) -> bool {
        false
    }

    /// Returns the default of a missing key from the limits of its joint.
    fn limit_for(&self, _key: &Key, _: &Limits) -> Option<f64> {
        None
    }

    /// Returns the order of its law: smaller numbers run first. Nodes precede the elements that join them.
    fn order(&self) -> u8 {
        1
    }

    /// Checks the rules of its numbers.
    fn check_values(&self, _: &mut ValueCheck<'_>) {}

    /// Checks the rules for it together with the scene's other effects.
    fn check_in_scene(&self, _: &Element, _: &SceneContext<'_>, _: &mut Faults) {}

    /// Changes the mechanism, before the graph is built.
    fn modify_mechanism(&self, _: &Element, _: &mut Mechanism) {}

    /// Declares the coordinates, states, modes, inputs and events that it adds.
    fn declare(&self, _: &Element, _: &mut StateLayout) {}

    /// Returns whether a first-order state belongs to this element.
    fn owns_state(&self, element: &Element, state: &str) -> bool {
        element.name == state
    }
}

/// The scene of an effect.
pub struct SceneContext<'a> {
    /// The scene's effects, including this one.
    pub elements: &'a [Element],
    /// The mechanism, with locked joints welded.
    pub mechanism: &'a Mechanism,
}

/// The data for the rules of an effect, and the list of their errors.
pub struct ValueCheck<'a> {
    /// The element, whose values have the right types.
    pub element: &'a Element,
    /// The errors found.
    pub faults: &'a mut Faults,
}

/// Returns the nodes of an effect: its name, or its name with each of its sides.
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
