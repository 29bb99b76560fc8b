//! An effect as a file declares it, not yet checked.

use super::Declaration;
use super::element::node_names;
use crate::format::{Fields, Located};

/// An effect as a mechanism's file declares it; a scene may use it, with other values if it likes.
#[derive(Clone, Debug, PartialEq)]
pub struct Declared {
    /// Its name.
    pub name: Located<String>,
    /// What it is.
    pub effect: &'static dyn Declaration,
    /// Its values.
    pub fields: Fields,
}

impl Declared {
    /// Names of the hydraulic nodes that it has.
    pub fn nodes(&self) -> Vec<String> {
        let sides = self.effect.nodes(&|key| self.fields.get(key).is_some());
        node_names(&self.name.value, sides)
    }
}
