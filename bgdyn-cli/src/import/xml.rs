//! Parses XML text into a tree with the position of each element.

use anyhow::{Result, anyhow};
use roxmltree::{Document, Error, Node, ParsingOptions};

/// Deeper nesting is refused: no robot is close to it, and it bounds every recursion.
const MAX_DEPTH: usize = 200;

/// Largest number of elements, texts and comments of a file: only a document that expands its own entities
/// has more.
const MAX_NODES: u32 = 1 << 22;

/// Line and column, both from 1.
pub(super) type At = (u32, u32);

/// An element: attributes and children in the order of the file.
#[derive(Debug, Clone)]
pub(super) struct Element {
    /// The name, with its prefix if it has one.
    pub(super) name: String,
    pub(super) attributes: Vec<(String, String)>,
    pub(super) children: Vec<Element>,
    /// The text directly in it, without the white space around it.
    pub(super) text: String,
    pub(super) at: At,
}

impl Element {
    /// Returns an empty element of this name.
    pub(super) fn empty(name: &str, at: At) -> Self {
        let (attributes, children) = (Vec::new(), Vec::new());
        Element {
            name: name.into(),
            attributes,
            children,
            text: String::new(),
            at,
        }
    }

    /// Returns the value of an attribute.
    pub(super) fn get(&self, attribute: &str) -> Option<&str> {
        let found = self.attributes.iter().find(|(name, _)| name == attribute);
        found.map(|(_, value)| value.as_str())
    }

    /// Returns the first child of this name.
    pub(super) fn child(&self, name: &str) -> Option<&Element> {
        self.children.iter().find(|child| child.name == name)
    }

    /// Returns all children of this name.
    pub(super) fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Element> {
        self.children.iter().filter(move |child| child.name == name)
    }

    /// Returns the number of elements of this name at or below this one.
    pub(super) fn count(&self, name: &str) -> usize {
        let below: usize = self.children.iter().map(|child| child.count(name)).sum();
        below + usize::from(self.name == name)
    }
}

/// Returns an error at a position of the file: `LINE:COLUMN: message`.
pub(super) fn fault((line, column): At, message: impl std::fmt::Display) -> anyhow::Error {
    anyhow!("{line}:{column}: {message}")
}

/// Parses the only root element.
pub(super) fn parse(text: &str) -> Result<Element> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let lines = Lines::new(text);
    let options = ParsingOptions {
        allow_dtd: true,
        nodes_limit: MAX_NODES,
        entity_resolver: None,
    };
    let document =
        Document::parse_with_options(text, options).map_err(|e| malformed(&lines, &e))?;
    element(document.root_element(), &lines, 1)
}

/// Returns the error of a text that is not XML.
fn malformed(lines: &Lines<'_>, error: &Error) -> anyhow::Error {
    let at = match error {
        // The parser gives no position for a premature end.
        Error::NoRootNode | Error::UnclosedRootNode | Error::UnexpectedEndOfStream => {
            lines.at(lines.text.len())
        }
        other => (other.pos().row, other.pos().col),
    };
    let hint = match lines.text.contains("<xacro:") {
        true => EXPAND,
        false => "",
    };
    // The message repeats the position.
    let message = error
        .to_string()
        .replace(&format!(" at {}", error.pos()), "");
    fault(
        at,
        format_args!("this is not well-formed XML: {message}{hint}"),
    )
}

/// Converts the element, and its content, `depth` levels from the top.
fn element(node: Node<'_, '_>, lines: &Lines<'_>, depth: usize) -> Result<Element> {
    let start = node.range().start;
    let (at, name) = (lines.at(start), lines.name(start + 1));
    let namespace = node.tag_name().namespace().unwrap_or_default();
    if namespace.trim_end_matches('/').ends_with("xacro") {
        return Err(fault(
            at,
            format_args!("`<{name}>` is an instruction to xacro{EXPAND}"),
        ));
    }
    if depth > MAX_DEPTH {
        return Err(fault(
            at,
            format_args!("elements are nested more than {MAX_DEPTH} deep"),
        ));
    }
    let mut read = Element::empty(name, at);
    for attribute in node.attributes() {
        let name = lines.name(attribute.range().start);
        let value = attribute.value().to_owned();
        read.attributes.push((name.to_owned(), value));
    }
    for child in node.children() {
        if child.is_element() {
            read.children.push(element(child, lines, depth + 1)?);
        } else if child.is_text() {
            read.text += child.text().unwrap_or_default();
        }
    }
    read.text = read.text.trim().to_owned();
    Ok(read)
}

/// A text and the starts of its lines.
struct Lines<'a> {
    text: &'a str,
    starts: Vec<usize>,
}

impl<'a> Lines<'a> {
    fn new(text: &'a str) -> Self {
        let ends = text.match_indices('\n').map(|(end, _)| end + 1);
        let starts = std::iter::once(0).chain(ends).collect();
        Lines { text, starts }
    }

    /// Returns line and column of a byte.
    fn at(&self, byte: usize) -> At {
        let line = self.starts.partition_point(|start| *start <= byte);
        let before = &self.text[self.starts[line - 1]..byte];
        let number = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
        (number(line), number(before.chars().count() + 1))
    }

    /// Returns the name that starts at a byte, with its prefix.
    fn name(&self, byte: usize) -> &'a str {
        let rest = &self.text[byte..];
        let ends = |c: char| c.is_whitespace() || matches!(c, '/' | '>' | '=');
        &rest[..rest.find(ends).unwrap_or(rest.len())]
    }
}

/// Advice for a file that was not expanded.
pub(super) const EXPAND: &str =
    ": expand the file first (`xacro robot.urdf.xacro > robot.urdf`) and import the result";
