//! Declarations of effects: their kinds, keys, checks and names.
//!
//! Their equations are in [`crate::effect`].

mod called;
mod check;
mod declared;
mod element;
mod given;
mod joints;
mod kinds;
mod once;
mod refused;
mod scope;
mod series;

use crate::fault::Faults;
use crate::layout::Layout;
use crate::mechanism::{Limits, Mechanism};
use crate::spec::Key;
pub use called::{called, declared};
pub use declared::Declared;
pub use element::{Checked, Element, Quantity};
pub use given::Given;
pub use joints::keys_declared;
pub use kinds::Kinds;
pub(crate) use once::once_per_joint;
pub use refused::Refused;
pub use scope::Context;
pub(crate) use scope::check_unique_names;
pub use series::Chain;

/// A kind of effect, as files declare it: all but its equations.
pub trait Declaration: Sync {
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
    fn rules(&self, _: &mut Given<'_>) {}

    /// What it must obey beside the scene's other effects.
    fn fits(&self, _: &Element, _: &Beside<'_>, _: &mut Faults) {}

    /// What it changes in the mechanism, before there is a graph.
    fn reduce(&self, _: &Element, _: &mut Mechanism) {}

    /// Coordinates, states, modes, inputs and events that it adds.
    fn declare(&self, _: &Element, _: &mut Layout) {}

    /// Whether a first-order state is its own.
    fn keeps(&self, element: &Element, state: &str) -> bool {
        element.name == state
    }
}

/// What an effect finds beside it in its scene.
pub struct Beside<'a> {
    /// The scene's effects, itself among them.
    pub elements: &'a [Element],
    /// The mechanism, locked joints welded.
    pub mechanism: &'a Mechanism,
}

impl std::fmt::Debug for dyn Declaration {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.keyword())
    }
}

impl PartialEq for dyn Declaration {
    fn eq(&self, other: &Self) -> bool {
        self.keyword() == other.keyword()
    }
}
