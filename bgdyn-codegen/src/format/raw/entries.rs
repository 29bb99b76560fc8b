//! Parses entries by their keys: numbers, words, names, lists.

use super::{Fields, Key, ParsedValue, Raw, Reads};
use crate::fault::wording::{Wanted, expected};
use crate::format::walk::{At, Reader};
use crate::format::yaml::Data;
use crate::format::{Located, Number};
use crate::unit::Dimension;

impl Reader {
    pub(super) fn fields(&mut self, at: &At<'_>, what: Wanted<'_>, keys: &[Key]) -> Option<Fields> {
        let names: Vec<&'static str> = keys.iter().map(|k| k.name).collect();
        let before = self.faults.count();
        let map = self.mapping(at, what, &names)?;
        let mut fields = Fields::default();
        for key in keys {
            let entry = self.field(&map, key.name, |r, at| r.entry(at, key));
            if let Some(entry) = entry.given() {
                fields.0.push((key.name, entry.clone()));
            }
        }
        (self.faults.count() == before).then_some(fields)
    }

    pub(super) fn entry(&mut self, at: &At<'_>, key: &Key) -> Option<ParsedValue> {
        match key.reads {
            Reads::Number(fit) => self.value(at, fit).map(ParsedValue::Number),
            Reads::Word(_)
            | Reads::Coordinate
            | Reads::Joint
            | Reads::Site
            | Reads::Plane
            | Reads::Contact
            | Reads::Node
            | Reads::Input => self.text(at).map(ParsedValue::Text),
            Reads::Vector(fit) => self
                .vector(at, fit)
                .map(|v| ParsedValue::Vector(Box::new(v))),
            Reads::Axis => self.axis(at).map(|v| ParsedValue::Vector(Box::new(v))),
            Reads::Joints | Reads::Contacts if !matches!(at.tree.data, Data::List(_)) => {
                self.text(at).map(ParsedValue::Text)
            }
            Reads::Words(_) | Reads::Joints | Reads::Contacts => {
                self.names_list(at, expected::WORDS).map(ParsedValue::Words)
            }
            Reads::Group(names, fit) => self.group(at, names, fit).map(ParsedValue::Group),
            Reads::Coefficients(fit) => {
                let what = expected::COEFFICIENTS;
                self.coefficients(at, fit, what)
                    .map(ParsedValue::Coefficients)
            }
            Reads::Sites => {
                let items = self.list(at, expected::SITES)?;
                let mut names = items.iter().map(|at| {
                    Some(Located {
                        value: self.text(at)?,
                        location: at.location.clone(),
                    })
                });
                let pair = [names.next().flatten()?, names.next().flatten()?];
                if names.next().is_some() {
                    let location = &at.location;
                    let fault = crate::fault::wording::not_two_names(location, items.len());
                    self.faults.push(fault);
                    return None;
                }
                Some(ParsedValue::Pair(pair))
            }
        }
    }

    /// Parses a list of words.
    pub(in crate::format) fn names_list(
        &mut self,
        at: &At<'_>,
        what: Wanted<'_>,
    ) -> Option<Vec<Located<String>>> {
        let items = self.list(at, what)?;
        let word = |at: &At<'_>| {
            Some(Located {
                value: self.text(at)?,
                location: at.location.clone(),
            })
        };
        items.iter().map(word).collect()
    }

    /// Parses numbers by names of the file.
    pub(in crate::format) fn coefficients(
        &mut self,
        at: &At<'_>,
        fit: &[Dimension],
        what: Wanted<'_>,
    ) -> Option<Vec<(Located<String>, Located<Number>)>> {
        let entries = self.names(at, what)?;
        let one = |(name, at): (Located<String>, At<'_>)| {
            let value = self.number(&at, fit)?;
            let location = at.location.clone();
            Some((name, Located { value, location }))
        };
        let read: Vec<Option<_>> = entries.into_iter().map(one).collect();
        read.into_iter().collect()
    }

    /// Parses named numbers by their names; three of them also in their order.
    fn group(
        &mut self,
        at: &At<'_>,
        names: &[&'static str],
        fit: &[Dimension],
    ) -> Option<Vec<(&'static str, Located<Number>)>> {
        if names.len() == 3 && !matches!(at.tree.data, Data::Map(_)) {
            let numbers = self.triple(at, |r, at| r.value(at, fit))?;
            return Some(names.iter().copied().zip(numbers).collect());
        }
        let own = |name: &'static str| name.split_once('.').map_or(name, |(_, own)| own);
        let keys: Vec<&'static str> = names.iter().map(|name| own(name)).collect();
        let example = format!("`{{ {}: … }}`", keys.join(": …, "));
        let before = self.faults.count();
        let map = self.mapping(at, ("numbers by name", &example), &keys)?;
        let mut found = Vec::new();
        for (name, key) in names.iter().zip(&keys) {
            let read = self.field(&map, key, |r, at| r.value(at, fit));
            found.extend(read.given().map(|number| (*name, number.clone())));
        }
        (self.faults.count() == before).then_some(found)
    }

    /// Returns the entries of a mapping whose keys are names.
    pub(in crate::format) fn table(&mut self, at: &At<'_>, what: Wanted<'_>) -> Option<Vec<Raw>> {
        let entries = self.names(at, what)?;
        Some(
            entries
                .into_iter()
                .map(|(name, at)| Raw::entry(name, &at))
                .collect(),
        )
    }

    /// Returns the items of a list: bare words, or mappings of one key.
    pub(in crate::format) fn calls(&mut self, at: &At<'_>, what: Wanted<'_>) -> Option<Vec<Raw>> {
        let items = self.list(at, what)?;
        let mut calls = Vec::new();
        for item in items {
            if matches!(item.tree.data, Data::Map(_)) {
                calls.extend(self.table(&item, what).unwrap_or_default());
            } else if let Some(value) = self.text(&item) {
                let location = item.location.clone();
                calls.push(Raw::word(Located { value, location }));
            }
        }
        Some(calls)
    }
}
