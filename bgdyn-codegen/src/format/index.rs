//! Indexes YAML text as nodes with positions: strict syntax, one document, no cycles.

use std::collections::BTreeMap;
use std::rc::Rc;

use saphyr_parser::{Event, Marker, Parser, ScalarStyle, ScanError, StrInput};

use crate::fault::{Fault, Position, wording};

/// Largest nesting depth of lists and mappings; the format needs seven.
const DEPTH: usize = 64;

/// A value and its position.
#[derive(Debug)]
pub(super) struct TextNode {
    /// Position of its start.
    pub(super) position: Position,
    /// Its tag, if any.
    pub(super) tag: Option<String>,
    /// Its kind.
    pub(super) shape: NodeShape,
    depth: usize,
}

/// The kind of a node.
#[derive(Debug)]
pub(super) enum NodeShape {
    /// Text without a type.
    Scalar {
        /// The text without quotes and line folding.
        text: String,
        /// Whether it is written without quotes.
        plain: bool,
    },
    /// A list.
    List(Vec<Rc<TextNode>>),
    /// Alternating keys and values.
    Map(Vec<(Rc<TextNode>, Rc<TextNode>)>),
}

/// Returns the document's root, or `None` for an empty file.
pub(super) fn index(text: &str) -> Result<Option<Rc<TextNode>>, Fault> {
    let mut builder = IndexBuilder::default();
    let mut parser: Parser<'_, StrInput<'_>> = Parser::new_from_str(text);
    while let Some(next) = parser.next_event() {
        let (event, span) = next.map_err(|e| scan_fault(&e))?;
        builder.take(event, position(span.start))?;
    }
    Ok(builder.root)
}

/// Returns the keys of the root's mapping that are texts; for invalid YAML, those before the error.
pub(super) fn root_keys(text: &str) -> Vec<String> {
    let mut parser: Parser<'_, StrInput<'_>> = Parser::new_from_str(text);
    let (mut keys, mut depth, mut is_key) = (Vec::new(), 0_usize, true);
    while let Some(Ok((event, _))) = parser.next_event() {
        match event {
            Event::SequenceStart(..) if depth == 0 => break,
            Event::MappingStart(..) | Event::SequenceStart(..) => {
                depth += 1;
                continue;
            }
            Event::MappingEnd | Event::SequenceEnd => depth = depth.saturating_sub(1),
            Event::Scalar(text, ..) if depth == 1 && is_key => keys.push(text.into_owned()),
            Event::Scalar(..) | Event::Alias(_) => {}
            Event::DocumentEnd => break,
            _ => continue,
        }
        // A value of the root's mapping has ended, or a key.
        if depth == 1 {
            is_key = !is_key;
        }
    }
    keys
}

fn position(mark: Marker) -> Position {
    Position {
        line: mark.line().max(1),
        column: mark.col() + 1,
    }
}

fn scan_fault(error: &ScanError) -> Fault {
    wording::yaml_syntax(position(*error.marker()), error.info())
}

/// A list or mapping that has not ended yet.
struct Open {
    position: Position,
    tag: Option<String>,
    anchor: usize,
    is_map: bool,
    depth: usize,
    items: Vec<Rc<TextNode>>,
}

#[derive(Default)]
struct IndexBuilder {
    documents: usize,
    open: Vec<Open>,
    anchors: BTreeMap<usize, Rc<TextNode>>,
    root: Option<Rc<TextNode>>,
}

impl IndexBuilder {
    fn take(&mut self, event: Event<'_>, position: Position) -> Result<(), Fault> {
        let tag_text =
            |t: Option<std::borrow::Cow<'_, saphyr_parser::Tag>>| t.map(|t| t.to_string());
        match event {
            Event::DocumentStart(_) => self.document(position),
            Event::Scalar(text, style, anchor, tag) => {
                let shape = NodeShape::Scalar {
                    text: text.into_owned(),
                    plain: style == ScalarStyle::Plain,
                };
                let node = TextNode {
                    position,
                    tag: tag_text(tag),
                    shape,
                    depth: 0,
                };
                self.close(anchor, node)
            }
            Event::SequenceStart(anchor, tag) => self.open(position, tag_text(tag), anchor, false),
            Event::MappingStart(anchor, tag) => self.open(position, tag_text(tag), anchor, true),
            Event::SequenceEnd | Event::MappingEnd => self.end(),
            Event::Alias(anchor) => self.alias(anchor, position),
            _ => Ok(()),
        }
    }

    fn document(&mut self, position: Position) -> Result<(), Fault> {
        self.documents += 1;
        if self.documents > 1 {
            Err(wording::several_documents(position))
        } else {
            Ok(())
        }
    }

    fn open(
        &mut self,
        position: Position,
        tag: Option<String>,
        anchor: usize,
        is_map: bool,
    ) -> Result<(), Fault> {
        self.open.push(Open {
            position,
            tag,
            anchor,
            is_map,
            depth: 0,
            items: Vec::new(),
        });
        if self.open.len() > DEPTH {
            Err(wording::too_deep(position, DEPTH))
        } else {
            Ok(())
        }
    }

    fn end(&mut self) -> Result<(), Fault> {
        let Some(open) = self.open.pop() else {
            return Ok(());
        };
        let shape = if open.is_map {
            pairs(open.items)
        } else {
            NodeShape::List(open.items)
        };
        let depth = open.depth + 1;
        if depth > DEPTH {
            return Err(wording::too_deep(open.position, DEPTH));
        }
        self.close(
            open.anchor,
            TextNode {
                position: open.position,
                tag: open.tag,
                shape,
                depth,
            },
        )
    }

    fn close(&mut self, anchor: usize, node: TextNode) -> Result<(), Fault> {
        let node = Rc::new(node);
        if anchor != 0 {
            self.anchors.insert(anchor, Rc::clone(&node));
        }
        self.location(node);
        Ok(())
    }

    fn alias(&mut self, anchor: usize, position: Position) -> Result<(), Fault> {
        if self.open.iter().any(|o| o.anchor == anchor) {
            return Err(wording::cyclic_alias(position));
        }
        let node = self.anchors.get(&anchor).map(Rc::clone);
        self.location(node.ok_or_else(|| wording::yaml_syntax(position, "unknown anchor"))?);
        Ok(())
    }

    fn location(&mut self, node: Rc<TextNode>) {
        match self.open.last_mut() {
            Some(open) => {
                open.depth = open.depth.max(node.depth);
                open.items.push(node);
            }
            None => self.root = Some(node),
        }
    }
}

fn pairs(items: Vec<Rc<TextNode>>) -> NodeShape {
    let mut pairs = Vec::with_capacity(items.len() / 2);
    let mut items = items.into_iter();
    while let (Some(key), Some(value)) = (items.next(), items.next()) {
        pairs.push((key, value));
    }
    NodeShape::Map(pairs)
}
