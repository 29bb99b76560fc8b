//! Unparsed entries, whose keys only a later step knows: effects, inputs, initial values.
//!
//! They store the values and positions of the file until that step states what it expects.

mod entries;

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
    /// A direction: `x`, `-z`, or three numbers.
    Axis,
    /// The name of a plane.
    Plane,
    /// The name of a contact.
    Contact,
    /// `all`, or a list of names of contacts.
    Contacts,
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
    pub fn get(&self, key: &Key) -> Option<&Located<ParsedValue>> {
        self.named(key.name)
    }

    fn named(&self, key: &str) -> Option<&Located<ParsedValue>> {
        self.0.iter().find(|(k, _)| *k == key).map(|(_, e)| e)
    }

    /// Returns these, and those of `base` for missing keys.
    pub fn over(mut self, base: &Fields) -> Fields {
        for (key, entry) in &base.0 {
            if self.named(key).is_none() {
                self.0.push((key, entry.clone()));
            }
        }
        self
    }

    /// Returns these without a key.
    pub fn without(mut self, key: &Key) -> Fields {
        self.0.retain(|(k, _)| *k != key.name);
        self
    }

    /// Returns these with a name as the value of a key.
    pub fn with(mut self, key: &Key, name: Located<String>) -> Fields {
        let (value, location) = (ParsedValue::Text(name.value), name.location);
        self.0.push((key.name, Located { value, location }));
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

    /// Returns its value if that is true or false.
    pub fn as_truth(&self) -> Option<bool> {
        match &self.tree.as_ref()?.data {
            Data::Scalar {
                kind: YamlKind::Truth,
                text,
            } => Some(text == "true"),
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
