//! The named numbers of a block with their descriptions, and comments on the unit of length.

use std::collections::{BTreeMap, BTreeSet};

use bgdyn_runtime::Dd;

use super::names::Names;
use crate::expr::Name;
use crate::legend::{LegendQuantity, QUANTITIES};

/// A number with a name.
#[derive(Clone, Debug)]
pub struct NamedConstant {
    /// Its identifier.
    pub identifier: String,
    /// Its meaning, its owner, its unit.
    pub about: String,
    /// Its value.
    pub value: Dd,
}

/// The named numbers that a block uses, in the order of their use.
#[derive(Default)]
pub(super) struct ConstantNames {
    known: BTreeMap<(u64, u64), String>,
    items: Vec<(String, Name, Dd)>,
}

impl ConstantNames {
    /// Returns the identifier of a number with this name.
    pub(super) fn add(&mut self, names: &mut Names, name: &Name, value: Dd) -> String {
        let key = (value.hi().to_bits(), value.lo().to_bits());
        let identifier = self.known.entry(key).or_insert_with(|| {
            let identifier = names.named(&name.identifier().to_uppercase());
            self.items.push((identifier.clone(), name.clone(), value));
            identifier
        });
        identifier.clone()
    }

    /// Returns the numbers with their descriptions, lengths in this unit.
    pub(super) fn items(self, unit: Option<Dd>) -> Vec<NamedConstant> {
        let length = unit.map_or(1.0, Dd::to_f64);
        let item = |(identifier, name, value)| NamedConstant {
            identifier,
            about: about(&name, length),
            value,
        };
        self.items.into_iter().map(item).collect()
    }
}

/// Describes a number with this name: its meaning, its owner, its unit.
fn about(name: &Name, length: f64) -> String {
    let sign = if name.negative { ", times −1" } else { "" };
    let contents = name.contents.iter();
    let contents: String = contents.map(|links| format!("; {links}")).collect();
    match LegendQuantity::of_name(&name.text) {
        Some((quantity, owner)) => {
            let (meaning, unit) = (quantity.meaning, quantity.unit_in(length));
            format!("`{owner}`: {meaning}, {unit}{sign}{contents}")
        }
        None => format!("`{}`{sign}{contents}", name.text),
    }
}

/// Returns a comment on the unit of length, and on its effect on the quantities with these patterns.
pub(super) fn unit_of_length(unit: Dd, patterns: &BTreeSet<String>) -> String {
    let unit = unit.to_f64();
    let used = QUANTITIES.iter();
    let used = used.filter(|q| q.scales() && patterns.contains(&q.pattern()));
    let units = used.map(|q| format!("{}_* in {}", q.prefix, q.unit_in(unit)));
    let units: Vec<String> = units.collect();
    let list = if units.is_empty() { "" } else { ": " };
    format!("Lengths in units of {unit} m{list}{}", units.join(", "))
}
