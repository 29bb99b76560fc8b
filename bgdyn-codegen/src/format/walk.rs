//! Typed readers of mappings, lists, texts and numbers, which report every fault and continue.

use super::number::number;
use super::yaml::{Data, YamlEntry, YamlKind, YamlTree};
use super::{Field, Located, Number, Vector};
use crate::fault::wording::{FoundValue, Wanted, expected};
use crate::fault::{Faults, Location, wording};
use crate::unit::Dimension;

/// The key that makes a mapping a run-time parameter.
const PARAMETER: &str = "parameter";

/// A value and its path.
#[derive(Clone, Debug)]
pub(super) struct At<'t> {
    pub(super) tree: &'t YamlTree,
    pub(super) location: Location,
}

/// A mapping whose keys are known to the format.
#[derive(Debug)]
pub(super) struct Mapping<'t> {
    pub(super) location: Location,
    entries: Vec<&'t YamlEntry>,
    merged: bool,
}

/// Reads values and records faults.
#[derive(Debug, Default)]
pub(super) struct Reader {
    pub(super) faults: Faults,
}

impl<'t> At<'t> {
    pub(super) fn root(tree: &'t YamlTree) -> Self {
        At {
            tree,
            location: Location {
                position: tree.position,
                path: String::new(),
            },
        }
    }

    fn item(&self, tree: &'t YamlTree, index: usize) -> Self {
        let path = format!("{}[{index}]", self.location.path);
        At {
            tree,
            location: Location {
                position: tree.position,
                path,
            },
        }
    }
}

impl<'t> Mapping<'t> {
    fn get(&self, key: &str) -> Option<At<'t>> {
        let entry = self
            .entries
            .iter()
            .find(|e| e.key.as_deref() == Some(key))?;
        let position = entry.value.position;
        let location = Location {
            position,
            path: join(&self.location.path, key),
        };
        Some(At {
            tree: &entry.value,
            location,
        })
    }
}

fn join(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
    } else {
        format!("{path}.{key}")
    }
}

impl Reader {
    /// Returns the mapping at `at`; reports its unknown and repeated keys.
    pub(super) fn mapping<'t>(
        &mut self,
        at: &At<'t>,
        what: Wanted<'_>,
        keys: &[&'static str],
    ) -> Option<Mapping<'t>> {
        self.refuse_tag(at);
        let Data::Map(entries) = &at.tree.data else {
            self.faults
                .push(wording::wrong_type(&at.location, what, describe(at.tree)));
            return None;
        };
        if !keys.contains(&PARAMETER) && self.refuse_parameter(at) {
            return None;
        }
        let mut mapping = Mapping {
            location: at.location.clone(),
            entries: Vec::new(),
            merged: false,
        };
        for entry in entries {
            self.key(entry, keys, &mut mapping);
        }
        Some(mapping)
    }

    fn key<'t>(&mut self, entry: &'t YamlEntry, keys: &[&'static str], mapping: &mut Mapping<'t>) {
        let here = |path: String| Location {
            position: entry.position,
            path,
        };
        let Some(key) = &entry.key else {
            let location = here(mapping.location.path.clone());
            return self.faults.push(wording::key_not_text(&location, keys));
        };
        if key == "<<" {
            mapping.merged = true;
            return self
                .faults
                .push(wording::merge_key(&here(mapping.location.path.clone())));
        }
        if !keys.contains(&key.as_str()) {
            let location = here(mapping.location.path.clone());
            return self.faults.push(wording::unknown_key(&location, key, keys));
        }
        if let Some(first) = mapping.entries.iter().find(|e| e.key.as_ref() == Some(key)) {
            let location = here(join(&mapping.location.path, key));
            return self
                .faults
                .push(wording::repeated_key(&location, key, first.position));
        }
        mapping.entries.push(entry);
    }

    /// Returns the entries of a mapping whose keys are names; reports repeated ones.
    pub(super) fn names<'t>(
        &mut self,
        at: &At<'t>,
        what: Wanted<'_>,
    ) -> Option<Vec<(Located<String>, At<'t>)>> {
        self.refuse_tag(at);
        let Data::Map(entries) = &at.tree.data else {
            self.faults
                .push(wording::wrong_type(&at.location, what, describe(at.tree)));
            return None;
        };
        if self.refuse_parameter(at) {
            return None;
        }
        let mut found: Vec<(Located<String>, At<'t>)> = Vec::new();
        for entry in entries {
            let path = join(&at.location.path, entry.key.as_deref().unwrap_or("?"));
            let at_key = |position| Location {
                position,
                path: path.clone(),
            };
            let location = at_key(entry.position);
            let Some(key) = &entry.key else {
                self.faults.push(wording::key_not_text(&location, &[]));
                continue;
            };
            if key == "<<" {
                self.faults.push(wording::merge_key(&location));
                continue;
            }
            if let Some((first, _)) = found.iter().find(|(name, _)| name.value == *key) {
                let first = first.location.position;
                self.faults
                    .push(wording::repeated_key(&location, key, first));
                continue;
            }
            let name = Located {
                value: key.clone(),
                location,
            };
            let tree = &entry.value;
            let location = at_key(tree.position);
            found.push((name, At { tree, location }));
        }
        Some(found)
    }

    /// Returns the value of `key`, parsed by `read`.
    pub(super) fn field<'t, T>(
        &mut self,
        mapping: &Mapping<'t>,
        key: &str,
        read: impl FnOnce(&mut Self, &At<'t>) -> Option<T>,
    ) -> Field<T> {
        let Some(at) = mapping.get(key) else {
            // A key that a merge key would have provided is not reported as missing.
            return if mapping.merged {
                Field::Broken
            } else {
                Field::Absent
            };
        };
        match read(self, &at) {
            Some(value) => Field::Given(Located {
                value,
                location: at.location,
            }),
            None => Field::Broken,
        }
    }

    /// Returns the value of a required key.
    pub(super) fn needed<'t, T>(
        &mut self,
        mapping: &Mapping<'t>,
        key: &str,
        what: &str,
        read: impl FnOnce(&mut Self, &At<'t>) -> Option<T>,
    ) -> Field<T> {
        let field = self.field(mapping, key, read);
        if field.is_absent() {
            self.faults
                .push(wording::missing_key(&mapping.location, key, what));
            return Field::Broken;
        }
        field
    }

    /// Returns the items of a list.
    pub(super) fn list<'t>(&mut self, at: &At<'t>, what: Wanted<'_>) -> Option<Vec<At<'t>>> {
        self.refuse_tag(at);
        if self.refuse_parameter(at) {
            return None;
        }
        let Data::List(items) = &at.tree.data else {
            self.faults
                .push(wording::wrong_type(&at.location, what, describe(at.tree)));
            return None;
        };
        Some(
            items
                .iter()
                .enumerate()
                .map(|(i, tree)| at.item(tree, i))
                .collect(),
        )
    }

    /// Returns a text; a number or a truth value is an error.
    pub(super) fn text(&mut self, at: &At<'_>) -> Option<String> {
        self.refuse_tag(at);
        if self.refuse_parameter(at) {
            return None;
        }
        match &at.tree.data {
            Data::Scalar {
                kind: YamlKind::Text { .. },
                text,
            } => Some(text.clone()),
            _ => {
                self.faults.push(wording::wrong_type(
                    &at.location,
                    expected::TEXT,
                    describe(at.tree),
                ));
                None
            }
        }
    }

    /// Returns a number of one of the dimensions `fit`.
    pub(super) fn number(&mut self, at: &At<'_>, fit: &[Dimension]) -> Option<Number> {
        self.refuse_tag(at);
        if self.refuse_parameter(at) {
            return None;
        }
        let Data::Scalar {
            kind: kind @ (YamlKind::Number | YamlKind::Text { .. }),
            text,
        } = &at.tree.data
        else {
            self.faults.push(wording::wrong_type(
                &at.location,
                expected::NUMBER,
                describe(at.tree),
            ));
            return None;
        };
        number(*kind, text, &at.location, fit)
            .map_err(|fault| self.faults.push(fault))
            .ok()
    }

    /// Returns a number of one of the dimensions `fit`, or a run-time parameter with this default.
    pub(super) fn value(&mut self, at: &At<'_>, fit: &[Dimension]) -> Option<Number> {
        if !matches!(at.tree.data, Data::Map(_)) {
            return self.number(at, fit);
        }
        let what = expected::PARAMETER;
        let map = self.mapping(at, what, &[PARAMETER, "value"])?;
        let name = self.needed(&map, PARAMETER, expected::PARAMETER_KEY, Self::text);
        let value = self.needed(&map, "value", expected::VALUE_KEY, |r, at| {
            r.number(at, fit)
        });
        Some(Number {
            parameter: Some(name.given()?.clone()),
            ..value.value()?.clone()
        })
    }

    /// Returns three numbers.
    pub(super) fn vector(&mut self, at: &At<'_>, fit: &[Dimension]) -> Option<Vector> {
        self.triple(at, |r, at| r.number(at, fit))
    }

    /// Returns three numbers, each parsed by `read`.
    pub(super) fn triple(
        &mut self,
        at: &At<'_>,
        mut read: impl FnMut(&mut Self, &At<'_>) -> Option<Number>,
    ) -> Option<Vector> {
        let items = self.list(at, expected::TRIPLE)?;
        let count = items.len();
        let numbers: Vec<Option<Located<Number>>> = items
            .into_iter()
            .map(|item| {
                let value = read(self, &item)?;
                Some(Located {
                    value,
                    location: item.location,
                })
            })
            .collect();
        if count != 3 {
            self.faults.push(wording::wrong_length(&at.location, count));
            return None;
        }
        numbers
            .into_iter()
            .collect::<Option<Vec<_>>>()?
            .try_into()
            .ok()
    }

    /// Reports a run-time parameter where none is permitted, and returns whether there is one.
    fn refuse_parameter(&mut self, at: &At<'_>) -> bool {
        let found = is_parameter(at.tree);
        if found {
            self.faults.push(wording::misplaced_parameter(&at.location));
        }
        found
    }

    fn refuse_tag(&mut self, at: &At<'_>) {
        if let Some(tag) = &at.tree.tag {
            self.faults.push(wording::tag(&at.location, tag));
        }
    }
}

/// Returns whether the tree is a run-time parameter.
fn is_parameter(tree: &YamlTree) -> bool {
    let named = |entry: &YamlEntry| entry.key.as_deref() == Some(PARAMETER);
    matches!(&tree.data, Data::Map(entries) if entries.iter().any(named))
}

/// Returns what a value is.
fn describe(tree: &YamlTree) -> FoundValue<'_> {
    match &tree.data {
        Data::List(items) => FoundValue::List(items.len()),
        Data::Map(_) => FoundValue::Mapping,
        Data::Scalar { kind, text } => match kind {
            YamlKind::Nothing => FoundValue::Nothing,
            YamlKind::Truth => FoundValue::Truth(text),
            YamlKind::Number => FoundValue::Number(text),
            YamlKind::Text { .. } => FoundValue::Text(text),
        },
    }
}
