//! Unparsed entries, whose keys only a later step knows: effects, inputs, initial values.
//!
//! They store the values and positions of the file until that step states what it expects.

use super::walk::{At, Reader};
use super::yaml::{Data, YamlKind, YamlTree};
use super::{Located, Number, Vector};
use crate::fault::wording::Wanted;
use crate::fault::{Faults, Location};
use crate::unit::Dimension;

/// A named entry, not parsed.
#[derive(Clone, Debug, PartialEq)]
pub struct Raw {
    /// Its key; for a bare word of a list, that word.
    pub name: Located<String>,
    /// Location of its value.
    pub location: Location,
    /// `None` for a bare word of a list.
    tree: Option<YamlTree>,
}

/// The type of a key's value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reads {
    /// A number of one of these dimensions, or a run-time parameter. Two dimensions are those of a
    /// rotation and of a translation.
    Number(&'static [Dimension]),
    /// One of these words.
    Word(&'static [&'static str]),
    /// The name of a moving joint, or of an effect that adds a coordinate.
    Coordinate,
    /// The name of a moving joint of the mechanism.
    Joint,
    /// `all`, or a list of names of coordinates.
    Joints,
    /// The name of a link or a frame.
    Site,
    /// The names of two links or frames.
    Sites,
    /// The name of a hydraulic node: a supply, a tank, a line, a cylinder's side.
    Node,
    /// The name of an input.
    Input,
    /// Three numbers.
    Vector(&'static [Dimension]),
    /// Some of these words.
    Words(&'static [&'static str]),
    /// Names of joints, each with a number of one of these dimensions.
    Coefficients(&'static [Dimension]),
    /// Numbers of these dimensions with names of their own, `com.x` for the key `com`; each is a number or
    /// a run-time parameter. Three may be a list.
    Group(&'static [&'static str], &'static [Dimension]),
}

/// A key that an entry may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// Its name.
    pub name: &'static str,
    /// The type of its value.
    pub reads: Reads,
    /// Whether it is required.
    pub needed: bool,
    /// Its meaning: one line of documentation.
    pub about: &'static str,
}

/// The parsed value of a key.
#[derive(Clone, Debug, PartialEq)]
pub enum ParsedValue {
    /// A number.
    Number(Number),
    /// A name or a word.
    Text(String),
    /// Two names.
    Pair([Located<String>; 2]),
    /// Three numbers.
    Vector(Box<Vector>),
    /// Words.
    Words(Vec<Located<String>>),
    /// Names, each with a number.
    Coefficients(Vec<(Located<String>, Located<Number>)>),
    /// Numbers with names of their own.
    Group(Vec<(&'static str, Located<Number>)>),
}

/// The keys of an entry with their parsed values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fields(Vec<(&'static str, Located<ParsedValue>)>);

impl Fields {
    /// Returns the value of a key.
    pub fn get(&self, key: &str) -> Option<&Located<ParsedValue>> {
        self.0.iter().find(|(k, _)| *k == key).map(|(_, e)| e)
    }

    /// Returns these, and those of `base` for missing keys.
    pub fn over(mut self, base: &Fields) -> Fields {
        for (key, entry) in &base.0 {
            if self.get(key).is_none() {
                self.0.push((key, entry.clone()));
            }
        }
        self
    }

    /// Returns these without a key.
    pub fn without(mut self, key: &str) -> Fields {
        self.0.retain(|(k, _)| *k != key);
        self
    }

    /// Returns these with a name as the value of a key.
    pub fn with(mut self, key: &'static str, name: Located<String>) -> Fields {
        let (value, location) = (ParsedValue::Text(name.value), name.location);
        self.0.push((key, Located { value, location }));
        self
    }

    /// Returns these with another location, of another file.
    pub fn placed(mut self, location: &Location) -> Fields {
        for (_, entry) in &mut self.0 {
            entry.location = location.clone();
            match &mut entry.value {
                ParsedValue::Words(words) => {
                    words.iter_mut().for_each(|w| w.location = location.clone())
                }
                ParsedValue::Pair(names) => {
                    names.iter_mut().for_each(|n| n.location = location.clone())
                }
                ParsedValue::Coefficients(numbers) => {
                    numbers.iter_mut().for_each(|(name, number)| {
                        name.location = location.clone();
                        number.location = location.clone();
                    });
                }
                ParsedValue::Group(numbers) => {
                    numbers
                        .iter_mut()
                        .for_each(|(_, n)| n.location = location.clone());
                }
                _ => {}
            }
        }
        self
    }
}

impl Raw {
    pub(super) fn word(name: Located<String>) -> Self {
        Raw {
            location: name.location.clone(),
            name,
            tree: None,
        }
    }

    pub(super) fn entry(name: Located<String>, at: &At<'_>) -> Self {
        Raw {
            name,
            location: at.location.clone(),
            tree: Some(at.tree.clone()),
        }
    }

    fn at(&self) -> Option<At<'_>> {
        self.tree.as_ref().map(|tree| At {
            tree,
            location: self.location.clone(),
        })
    }

    /// Returns whether it has keys.
    pub fn is_mapping(&self) -> bool {
        matches!(&self.tree, Some(tree) if matches!(tree.data, Data::Map(_)))
    }

    /// Returns whether it is a list.
    pub fn is_list(&self) -> bool {
        matches!(&self.tree, Some(tree) if matches!(tree.data, Data::List(_)))
    }

    /// Returns whether it has no value, not even an empty one.
    pub fn is_bare(&self) -> bool {
        self.tree.is_none()
    }

    /// Returns its value if that is a word.
    pub fn as_word(&self) -> Option<&str> {
        match &self.tree.as_ref()?.data {
            Data::Scalar {
                kind: YamlKind::Text { .. },
                text,
            } => Some(text),
            _ => None,
        }
    }

    /// Returns the word of a key of its mapping, if it is one; other errors are reported when its fields
    /// are parsed.
    pub fn peek(&self, key: &str) -> Option<Located<String>> {
        let Data::Map(entries) = &self.tree.as_ref()?.data else {
            return None;
        };
        let entry = entries.iter().find(|e| e.key.as_deref() == Some(key))?;
        match &entry.value.data {
            Data::Scalar { text, .. } => Some(Located {
                value: text.clone(),
                location: Location {
                    position: entry.value.position,
                    path: format!("{}.{key}", self.location.path),
                },
            }),
            _ => None,
        }
    }

    /// Returns the entries of its mapping, not parsed.
    pub fn entries(&self, what: Wanted<'_>, faults: &mut Faults) -> Vec<Raw> {
        let read = |r: &mut Reader, at: &At<'_>| r.table(at, what);
        self.with(faults, read).unwrap_or_default()
    }

    /// Returns the items of its list, not parsed, each with the name of the entry.
    pub fn items(&self, what: Wanted<'_>, faults: &mut Faults) -> Option<Vec<Raw>> {
        self.with(faults, |r, at| {
            let items = r.list(at, what)?;
            Some(
                items
                    .iter()
                    .map(|at| Raw::entry(self.name.clone(), at))
                    .collect(),
            )
        })
    }

    /// Returns its number.
    pub fn number(&self, fit: &[Dimension], faults: &mut Faults) -> Option<Located<Number>> {
        let value = self.with(faults, |r, at| r.number(at, fit))?;
        Some(Located {
            value,
            location: self.location.clone(),
        })
    }

    /// Parses its fields with these keys. A value without keys belongs to the first one.
    pub fn fields(&self, what: Wanted<'_>, keys: &[Key], faults: &mut Faults) -> Option<Fields> {
        let Some(at) = self.at() else {
            return Some(Fields::default());
        };
        let mut reader = Reader::default();
        let fields = match keys.first() {
            Some(key) if !matches!(at.tree.data, Data::Map(_)) => {
                reader.entry(&at, key).map(|value| {
                    let location = at.location.clone();
                    Fields(vec![(key.name, Located { value, location })])
                })
            }
            _ => reader.fields(&at, what, keys),
        };
        faults.0.append(&mut reader.faults.0);
        fields
    }

    fn with<R>(
        &self,
        faults: &mut Faults,
        read: impl FnOnce(&mut Reader, &At<'_>) -> Option<R>,
    ) -> Option<R> {
        let at = self.at()?;
        let mut reader = Reader::default();
        let found = read(&mut reader, &at);
        faults.0.append(&mut reader.faults.0);
        found
    }
}

impl Reader {
    fn fields(&mut self, at: &At<'_>, what: Wanted<'_>, keys: &[Key]) -> Option<Fields> {
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

    fn entry(&mut self, at: &At<'_>, key: &Key) -> Option<ParsedValue> {
        match key.reads {
            Reads::Number(fit) => self.value(at, fit).map(ParsedValue::Number),
            Reads::Word(_)
            | Reads::Coordinate
            | Reads::Joint
            | Reads::Site
            | Reads::Node
            | Reads::Input => self.text(at).map(ParsedValue::Text),
            Reads::Vector(fit) => self
                .vector(at, fit)
                .map(|v| ParsedValue::Vector(Box::new(v))),
            Reads::Joints if !matches!(at.tree.data, Data::List(_)) => {
                self.text(at).map(ParsedValue::Text)
            }
            Reads::Words(_) | Reads::Joints => self
                .names_list(at, ("a list of words", "`[fx, fz]`"))
                .map(ParsedValue::Words),
            Reads::Group(names, fit) => self.group(at, names, fit).map(ParsedValue::Group),
            Reads::Coefficients(fit) => self.coefficients(at, fit).map(ParsedValue::Coefficients),
            Reads::Sites => {
                let items = self.list(at, ("two names", "`[one, other]`"))?;
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
    pub(super) fn names_list(
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
    fn coefficients(
        &mut self,
        at: &At<'_>,
        fit: &[Dimension],
    ) -> Option<Vec<(Located<String>, Located<Number>)>> {
        let entries = self.names(at, ("coefficients by joint", "`{ left: 1, right: -1 }`"))?;
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
    pub(super) fn table(&mut self, at: &At<'_>, what: Wanted<'_>) -> Option<Vec<Raw>> {
        let entries = self.names(at, what)?;
        Some(
            entries
                .into_iter()
                .map(|(name, at)| Raw::entry(name, &at))
                .collect(),
        )
    }

    /// Returns the items of a list: bare words, or mappings of one key.
    pub(super) fn calls(&mut self, at: &At<'_>, what: Wanted<'_>) -> Option<Vec<Raw>> {
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
