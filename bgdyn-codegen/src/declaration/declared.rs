//! An effect as declared in a file, before the checks.

use super::EffectKind;
use super::element::node_names;
use crate::format::{Fields, Located, ParsedValue};

/// An effect as declared in a mechanism's file; a scene may use it, with other values.
#[derive(Clone, Debug, PartialEq)]
pub struct Declaration {
    /// Its name.
    pub name: Located<String>,
    /// Its kind.
    pub effect: &'static dyn EffectKind,
    /// Its values.
    pub fields: Fields,
}

impl Declaration {
    /// Returns the names of its hydraulic nodes.
    pub fn nodes(&self) -> Vec<String> {
        let sides = self.effect.nodes(&|key| self.fields.get(key).is_some());
        node_names(&self.name.value, sides)
    }

    /// Returns the joint or coordinate that it acts on; `None` if it acts elsewhere.
    pub(super) fn joint(&self) -> Option<&str> {
        let key = self.effect.joint_key()?;
        match &self.fields.get(key)?.value {
            ParsedValue::Text(joint) => Some(joint),
            _ => None,
        }
    }
}
