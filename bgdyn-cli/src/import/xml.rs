//! Reads XML text into a small tree with line numbers.

use anyhow::{Result, anyhow};
use xml::common::{Position, TextPosition};
use xml::name::OwnedName;
use xml::reader::{EventReader, ParserConfig2, XmlEvent};

/// Deeper nesting than this is refused: no URDF comes near, and it bounds every recursion.
const MAX_DEPTH: usize = 64;

/// Line and column, both from 1.
pub(super) type At = (u64, u64);

/// An element: attributes in the order of the file, children likewise.
#[derive(Debug, Clone)]
pub(super) struct Element {
    /// The name, with its prefix where it has one.
    pub(super) name: String,
    pub(super) attributes: Vec<(String, String)>,
    pub(super) children: Vec<Element>,
    /// Whether text other than white space stands directly inside.
    pub(super) text: bool,
    pub(super) at: At,
}

impl Element {
    /// An element of this name with nothing in it.
    pub(super) fn empty(name: &str, at: At) -> Self {
        let (attributes, children) = (Vec::new(), Vec::new());
        Element {
            name: name.into(),
            attributes,
            children,
            text: false,
            at,
        }
    }

    /// The value of an attribute.
    pub(super) fn get(&self, attribute: &str) -> Option<&str> {
        let found = self.attributes.iter().find(|(name, _)| name == attribute);
        found.map(|(_, value)| value.as_str())
    }

    /// The first child of this name.
    pub(super) fn child(&self, name: &str) -> Option<&Element> {
        self.children.iter().find(|child| child.name == name)
    }

    /// All children of this name.
    pub(super) fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Element> {
        self.children.iter().filter(move |child| child.name == name)
    }

    /// How many elements of this name stand at or below this one.
    pub(super) fn count(&self, name: &str) -> usize {
        let below: usize = self.children.iter().map(|child| child.count(name)).sum();
        below + usize::from(self.name == name)
    }

    /// The element as XML text.
    pub(super) fn write(&self, out: &mut String) {
        out.push('<');
        out.push_str(&self.name);
        for (name, value) in &self.attributes {
            out.push_str(&format!(" {name}=\"{}\"", escaped(value)));
        }
        out.push('>');
        for child in &self.children {
            child.write(out);
        }
        out.push_str(&format!("</{}>", self.name));
    }
}

/// An error at a place of the file: `LINE:COLUMN: message`.
pub(super) fn fault((line, column): At, message: impl std::fmt::Display) -> anyhow::Error {
    anyhow!("{line}:{column}: {message}")
}

/// Reads the one root element.
pub(super) fn parse(text: &str) -> Result<Element> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    // The text is UTF-8 already, whatever its declaration says.
    let config = ParserConfig2::new()
        .override_encoding(Some(xml::Encoding::Utf8))
        .ignore_invalid_encoding_declarations(true)
        .allow_multiple_root_elements(false)
        .max_entity_expansion_length(1 << 16)
        .ignore_comments(true)
        .cdata_to_characters(true);
    let mut reader = EventReader::new_with_config(text.as_bytes(), config);
    let lines = Lines::new(text);
    let mut open: Vec<Element> = Vec::new();
    let mut root = None;
    loop {
        let event = reader.next().map_err(|error| {
            let at = error.position();
            let hint = match text.contains("<xacro:") {
                true => EXPAND,
                false => "",
            };
            let message = error.msg().trim();
            fault(
                (at.row + 1, at.column + 1),
                format_args!("this is not well-formed XML: {message}{hint}"),
            )
        })?;
        let at = lines.start_of_tag(reader.position());
        match event {
            XmlEvent::StartElement {
                name, attributes, ..
            } => {
                if name
                    .namespace
                    .as_deref()
                    .is_some_and(|uri| uri.trim_end_matches('/').ends_with("xacro"))
                {
                    let name = written(&name);
                    return Err(fault(
                        at,
                        format_args!("`<{name}>` is an instruction to xacro{EXPAND}"),
                    ));
                }
                if open.len() == MAX_DEPTH {
                    return Err(fault(
                        at,
                        format_args!("elements are nested more than {MAX_DEPTH} deep"),
                    ));
                }
                open.push(Element {
                    name: written(&name),
                    attributes: attributes
                        .into_iter()
                        .map(|a| (written(&a.name), a.value))
                        .collect(),
                    children: Vec::new(),
                    text: false,
                    at,
                });
            }
            XmlEvent::EndElement { .. } => {
                if let Some(done) = open.pop() {
                    match open.last_mut() {
                        Some(parent) => parent.children.push(done),
                        None => root = Some(done),
                    }
                }
            }
            XmlEvent::Characters(text) => {
                if let Some(element) = open.last_mut() {
                    element.text |= !text.trim().is_empty();
                }
            }
            XmlEvent::EndDocument => break,
            _ => {}
        }
    }
    root.ok_or_else(|| fault((1, 1), "the file holds no element"))
}

/// The lines of a text.
struct Lines<'a>(Vec<&'a str>);

impl<'a> Lines<'a> {
    fn new(text: &'a str) -> Self {
        Lines(text.split('\n').collect())
    }

    /// Where the tag opens that the reader is in or has just left: a `<` cannot stand inside one.
    fn start_of_tag(&self, inside: TextPosition) -> At {
        let last = usize::try_from(inside.row)
            .unwrap_or(usize::MAX)
            .min(self.0.len() - 1);
        let column = usize::try_from(inside.column).unwrap_or(usize::MAX);
        let before = |row: usize, line: &str| match row == last {
            true => line.chars().take(column.saturating_add(1)).collect(),
            false => line.to_string(),
        };
        for row in (0..=last).rev() {
            let part = before(row, self.0[row]);
            if let Some(byte) = part.rfind('<') {
                return (row as u64 + 1, part[..byte].chars().count() as u64 + 1);
            }
        }
        (inside.row + 1, inside.column + 1)
    }
}

/// What to do with a file that was not expanded.
pub(super) const EXPAND: &str =
    ": expand the file first (`xacro robot.urdf.xacro > robot.urdf`) and import the result";

fn written(name: &OwnedName) -> String {
    match &name.prefix {
        Some(prefix) => format!("{prefix}:{}", name.local_name),
        None => name.local_name.clone(),
    }
}

fn escaped(value: &str) -> String {
    let mut out = String::with_capacity(value.len());
    for c in value.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
