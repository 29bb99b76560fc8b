//! Where the values of a YAML text are, in bytes: what is replaced in place.

use std::ops::Range;

use saphyr_parser::{Event, Parser, Span, StrInput};

/// A value of the text.
#[derive(Clone, Debug)]
pub(super) struct Place {
    /// Its bytes; of a block collection from its first key to the end of its last value.
    pub(super) bytes: Range<usize>,
    /// Whether others may refer to it (`&`), or it refers to another (`*`).
    pub(super) shared: bool,
    pub(super) shape: PlaceShape,
}

#[derive(Clone, Debug)]
pub(super) enum PlaceShape {
    Scalar(String),
    Alias,
    List(Vec<Place>),
    Map(Vec<(Place, Place)>),
}

impl Place {
    /// Returns the value of a key.
    pub(super) fn get(&self, key: &str) -> Option<&Place> {
        let PlaceShape::Map(entries) = &self.shape else {
            return None;
        };
        entries
            .iter()
            .find(|(k, _)| k.text() == Some(key))
            .map(|(_, value)| value)
    }

    /// Returns the key itself.
    pub(super) fn key(&self, key: &str) -> Option<&Place> {
        let PlaceShape::Map(entries) = &self.shape else {
            return None;
        };
        entries
            .iter()
            .map(|(k, _)| k)
            .find(|k| k.text() == Some(key))
    }

    /// Returns the keys.
    pub(super) fn keys(&self) -> Vec<&str> {
        match &self.shape {
            PlaceShape::Map(entries) => entries.iter().filter_map(|(k, _)| k.text()).collect(),
            _ => Vec::new(),
        }
    }

    /// Returns the text of a scalar.
    pub(super) fn text(&self) -> Option<&str> {
        match &self.shape {
            PlaceShape::Scalar(text) => Some(text),
            _ => None,
        }
    }

    /// Returns the entries of a list.
    pub(super) fn items(&self) -> &[Place] {
        match &self.shape {
            PlaceShape::List(items) => items,
            _ => &[],
        }
    }
}

struct Opened {
    start: usize,
    shared: bool,
    is_map: bool,
    items: Vec<Place>,
}

/// Returns the root of a text that is valid YAML.
pub(super) fn spans(text: &str) -> Option<Place> {
    let starts: Vec<usize> = text
        .char_indices()
        .map(|(at, _)| at)
        .chain([text.len()])
        .collect();
    let byte = |index: usize| starts[index.min(starts.len() - 1)];
    let mut parser: Parser<'_, StrInput<'_>> = Parser::new_from_str(text);
    let (mut open, mut root): (Vec<Opened>, Option<Place>) = (Vec::new(), None);
    while let Some(Ok((event, span))) = parser.next_event() {
        let Span { start, end, .. } = span;
        let bytes = byte(start.index())..byte(end.index());
        let done = match event {
            Event::Scalar(text, _, anchor, _) => {
                let shape = PlaceShape::Scalar(text.into_owned());
                Some(Place {
                    bytes,
                    shared: anchor != 0,
                    shape,
                })
            }
            Event::Alias(_) => Some(Place {
                bytes,
                shared: true,
                shape: PlaceShape::Alias,
            }),
            Event::SequenceStart(anchor, _) | Event::MappingStart(anchor, _) => {
                let is_map = matches!(event, Event::MappingStart(..));
                open.push(Opened {
                    start: bytes.start,
                    shared: anchor != 0,
                    is_map,
                    items: Vec::new(),
                });
                None
            }
            Event::SequenceEnd | Event::MappingEnd => {
                open.pop().map(|opened| closed(opened, text, bytes.end))
            }
            _ => None,
        };
        if let Some(place) = done {
            match open.last_mut() {
                Some(parent) => parent.items.push(place),
                None => root = Some(place),
            }
        }
    }
    root
}

/// Returns a collection that has ended: a flow collection with its bracket, a block collection with its last value.
fn closed(opened: Opened, text: &str, end: usize) -> Place {
    let start = match opened.items.first() {
        Some(first) if !text[opened.start..].starts_with(['{', '[']) => first.bytes.start,
        _ => opened.start,
    };
    let flow = text[start..].starts_with(['{', '[']) && start == opened.start;
    let last = opened.items.last().map_or(start, |item| item.bytes.end);
    let bytes = start..if flow { end } else { last };
    let shape = match opened.is_map {
        false => PlaceShape::List(opened.items),
        true => {
            let mut items = opened.items.into_iter();
            let mut entries = Vec::new();
            while let (Some(key), Some(value)) = (items.next(), items.next()) {
                entries.push((key, value));
            }
            PlaceShape::Map(entries)
        }
    };
    Place {
        bytes,
        shared: opened.shared,
        shape,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_found_in_flow_and_block() {
        let text = "# ä\nlinks:\n  - name: a\n    mass: 1.5 kg # heavy\n    com: [0, 0, 1]\n    inertia:\n      xx: 2\n      zz: 3\n  - { name: b, mass: &m 4 }\n";
        let root = spans(text).expect("YAML");
        let links = root.get("links").expect("links").items();
        let at = |place: &Place| &text[place.bytes.clone()];
        assert_eq!(at(links[0].get("mass").expect("mass")), "1.5 kg");
        assert_eq!(at(links[0].get("com").expect("com")), "[0, 0, 1]");
        assert_eq!(
            at(links[0].get("inertia").expect("inertia")),
            "xx: 2\n      zz: 3"
        );
        assert!(links[1].get("mass").expect("mass").shared);
        assert_eq!(at(&links[1]), "{ name: b, mass: &m 4 }");
    }
}
