//! Parses YAML text into a tree of typed values with positions.
//!
//! serde_yaml determines the type of every value (`1.5` is a number, `x` a text, `~` null); the index
//! provides its position and text, so that numbers retain their decimals.

use serde::de::{
    Deserialize, Deserializer, EnumAccess, MapAccess, SeqAccess, VariantAccess, Visitor,
};

use super::index::{NodeShape, TextNode, index};
use crate::fault::{Fault, Faults, Position, wording};

/// A typed value and its position.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct YamlTree {
    pub(super) position: Position,
    pub(super) tag: Option<String>,
    pub(super) data: Data,
}

/// The content of a value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Data {
    Scalar { kind: YamlKind, text: String },
    List(Vec<YamlTree>),
    Map(Vec<YamlEntry>),
}

/// The type of a scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum YamlKind {
    Nothing,
    Truth,
    Number,
    Text { quoted: bool },
}

/// A key with its value; `key` is empty for a key that is no scalar.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct YamlEntry {
    pub(super) key: Option<String>,
    pub(super) position: Position,
    pub(super) value: YamlTree,
}

/// Returns the file's tree, if its YAML is valid.
pub(super) fn read(text: &str, faults: &mut Faults) -> Option<YamlTree> {
    match tree(text) {
        Ok(tree) => Some(tree),
        Err(fault) => {
            faults.push(fault);
            None
        }
    }
}

fn tree(text: &str) -> Result<YamlTree, Fault> {
    let root = index(text)?.ok_or_else(wording::empty_file)?;
    let typed: Typed = serde_yaml::from_str(text).map_err(|e| serde_fault(&e))?;
    join(&root, typed)
}

fn serde_fault(error: &serde_yaml::Error) -> Fault {
    let location = error.location();
    let position = location.map(|l| Position {
        line: l.line().max(1),
        column: l.column().max(1),
    });
    wording::yaml_syntax(position.unwrap_or(Position::START), &error.to_string())
}

fn join(node: &TextNode, typed: Typed) -> Result<YamlTree, Fault> {
    let data = match (&node.shape, typed) {
        (NodeShape::Scalar { text, plain }, Typed::Scalar(kind)) => {
            let kind = if let YamlKind::Text { .. } = kind {
                YamlKind::Text { quoted: !plain }
            } else {
                kind
            };
            Data::Scalar {
                kind,
                text: text.clone(),
            }
        }
        (NodeShape::List(nodes), Typed::List(items)) if nodes.len() == items.len() => {
            let pairs = nodes.iter().zip(items);
            Data::List(pairs.map(|(n, t)| join(n, t)).collect::<Result<_, _>>()?)
        }
        (NodeShape::Map(nodes), Typed::Map(items)) if nodes.len() == items.len() => {
            let pairs = nodes.iter().zip(items);
            Data::Map(
                pairs
                    .map(|((k, v), t)| entry(k, v, t))
                    .collect::<Result<_, _>>()?,
            )
        }
        _ => return Err(wording::yaml_ambiguous(node.position)),
    };
    Ok(YamlTree {
        position: node.position,
        tag: node.tag.clone(),
        data,
    })
}

fn entry(key: &TextNode, value: &TextNode, typed: Typed) -> Result<YamlEntry, Fault> {
    let text = match &key.shape {
        NodeShape::Scalar { text, .. } => Some(text.clone()),
        NodeShape::List(_) | NodeShape::Map(_) => None,
    };
    Ok(YamlEntry {
        key: text,
        position: key.position,
        value: join(value, typed)?,
    })
}

/// The types according to serde_yaml; repeated keys are retained, so that the reader can report both.
enum Typed {
    Scalar(YamlKind),
    List(Vec<Typed>),
    Map(Vec<Typed>),
}

impl<'de> Deserialize<'de> for Typed {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TypedVisitor)
    }
}

struct TypedVisitor;

macro_rules! scalars {
    ($($visit:ident($type:ty) = $kind:expr;)*) => {
        $(fn $visit<E>(self, _: $type) -> Result<Typed, E> {
            Ok(Typed::Scalar($kind))
        })*
    };
}

impl<'de> Visitor<'de> for TypedVisitor {
    type Value = Typed;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a YAML value")
    }

    scalars! {
        visit_bool(bool) = YamlKind::Truth;
        visit_i64(i64) = YamlKind::Number;
        visit_u64(u64) = YamlKind::Number;
        visit_i128(i128) = YamlKind::Number;
        visit_u128(u128) = YamlKind::Number;
        visit_f64(f64) = YamlKind::Number;
        visit_str(&str) = YamlKind::Text { quoted: false };
    }

    fn visit_unit<E>(self) -> Result<Typed, E> {
        Ok(Typed::Scalar(YamlKind::Nothing))
    }

    fn visit_none<E>(self) -> Result<Typed, E> {
        Ok(Typed::Scalar(YamlKind::Nothing))
    }

    fn visit_some<D: Deserializer<'de>>(self, deserializer: D) -> Result<Typed, D::Error> {
        Typed::deserialize(deserializer)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Typed, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = seq.next_element()? {
            items.push(item);
        }
        Ok(Typed::List(items))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Typed, A::Error> {
        let mut values = Vec::new();
        while let Some((_, value)) = map.next_entry::<Typed, Typed>()? {
            values.push(value);
        }
        Ok(Typed::Map(values))
    }

    fn visit_enum<A: EnumAccess<'de>>(self, data: A) -> Result<Typed, A::Error> {
        let (_, content) = data.variant::<String>()?;
        content.newtype_variant()
    }
}
