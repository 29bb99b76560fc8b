//! Emits the named numbers of a block as constants with a description, and comments on the unit of length.

use std::collections::{BTreeMap, BTreeSet};

use bgdyn_runtime::Dd;
use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::names::Names;
use super::tokens::{COMMENT, number};
use crate::expr::Name;
use crate::legend::{LegendQuantity, QUANTITIES};

/// The named numbers that a block uses, in the order of their use.
#[derive(Default)]
pub(super) struct NamedConstants {
    identifiers: BTreeMap<(u64, u64), Ident>,
    items: Vec<(Ident, Name, Dd)>,
}

impl NamedConstants {
    /// Returns the identifier of a number with this name.
    pub(super) fn add(&mut self, names: &mut Names, name: &Name, value: Dd) -> TokenStream {
        let key = (value.hi().to_bits(), value.lo().to_bits());
        let identifier = self.identifiers.entry(key).or_insert_with(|| {
            let identifier = names.named(&name.identifier().to_uppercase());
            self.items.push((identifier.clone(), name.clone(), value));
            identifier
        });
        quote! { #identifier }
    }

    /// Returns their definitions, with lengths in this unit.
    pub(super) fn items(&self, unit: Option<Dd>) -> TokenStream {
        let length = unit.map_or(1.0, Dd::to_f64);
        let items = self.items.iter().map(|(identifier, name, value)| {
            let (about, value) = (about(name, length), number(value.to_f64()));
            quote! { #[doc = #about] const #identifier: f64 = #value; }
        });
        quote! { #(#items)* }
    }
}

/// Describes a number with this name: its meaning, its owner, its unit.
fn about(name: &Name, length: f64) -> String {
    let sign = if name.negative { ", times −1" } else { "" };
    match LegendQuantity::of_name(&name.text) {
        Some((quantity, owner)) => {
            let (meaning, unit) = (quantity.meaning, quantity.unit_in(length));
            format!(" `{owner}`: {meaning}, {unit}{sign}")
        }
        None => format!(" `{}`{sign}", name.text),
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
    format!(
        "{COMMENT} Lengths in units of {unit} m{list}{}",
        units.join(", ")
    )
}
