//! An effect as a file declares it, not yet checked.

use super::EffectKind;
use super::element::node_names;
use crate::format::{Fields, Located};

/// An effect as a mechanism's file declares it; a scene may use it, with other values if it likes.
#[derive(Clone, Debug, PartialEq)]
pub struct Declaration {
    /// Its name.
    pub name: Located<String>,
    /// What it is.
    pub effect: &'static dyn EffectKind,
    /// Its values.
    pub fields: Fields,
}

impl Declaration {
    /// Names of the hydraulic nodes that it has.
    pub fn nodes(&self) -> Vec<String> {
        let sides = self.effect.nodes(&|key| self.fields.get(key).is_some());
        node_names(&self.name.value, sides)
    }
}
