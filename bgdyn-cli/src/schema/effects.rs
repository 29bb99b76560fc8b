//! Builds the JSON Schema of effects from the generator's list of effects.

use bgdyn_codegen::declaration::keys_declared;
use bgdyn_codegen::effect::{EFFECTS, Effect};
use bgdyn_codegen::format::{Dimension, Reads};
use serde_json::{Value, json};

use super::parts::{axis, described, identifier, object, quantity, triple, value};

/// Returns the keys by the word of the key `type`.
pub(super) fn effects() -> Value {
    let written = EFFECTS.iter().filter(|effect| !effect.built_in());
    let (mut words, mut branches) = (Vec::new(), Vec::new());
    for effect in written {
        words.push(json!({ "const": effect.keyword(), "description": effect.summary() }));
        branches.push(json!({
            "if": { "properties": { "type": { "const": effect.keyword() } } },
            "then": keys(*effect),
        }));
    }
    json!({
        "type": "object",
        "properties": { "type": { "oneOf": words } },
        "required": ["type"],
        "allOf": branches,
    })
}

fn keys(effect: &dyn Effect) -> Value {
    let word = ("type", json!({ "const": effect.keyword() }));
    let declared = keys_declared(effect);
    let keys = declared.iter();
    let keys = keys.map(|key| (key.name, described(key.about, reads(key.reads))));
    let needed = declared.iter().filter(|key| key.needed);
    let needed: Vec<&str> = needed.map(|key| key.name).collect();
    // `joints` may replace `joint`, and `contacts` `contact`.
    let replaced = |key: &str| matches!(key, "joint" | "contact");
    let others: Vec<&str> = needed.iter().copied().filter(|n| !replaced(n)).collect();
    let mut found = object(&keys.chain([word]).collect::<Vec<_>>(), &others);
    if let Some(one) = needed.iter().find(|n| replaced(n)) {
        found["oneOf"] = json!([{ "required": [one] }, { "required": [format!("{one}s")] }]);
    }
    found
}

pub(super) fn reads(reads: Reads) -> Value {
    match reads {
        Reads::Number(fit) => value(fit),
        Reads::Word(words) => json!({ "enum": words }),
        Reads::Coordinate
        | Reads::Joint
        | Reads::Site
        | Reads::Plane
        | Reads::Contact
        | Reads::Node
        | Reads::Input => identifier(),
        Reads::Joints | Reads::Contacts => {
            json!({ "anyOf": [{ "const": "all" }, { "type": "array", "items": identifier() }] })
        }
        Reads::Sites => {
            json!({ "type": "array", "items": identifier(), "minItems": 2, "maxItems": 2 })
        }
        Reads::Vector(fit) => triple(value(fit)),
        Reads::Axis => axis(),
        Reads::Words(words) => json!({ "type": "array", "items": { "enum": words } }),
        Reads::Group(names, fit) => group(names, fit),
        Reads::Coefficients(fit) => json!({
            "type": "object",
            "propertyNames": identifier(),
            "additionalProperties": quantity(fit),
            "minProperties": 1,
        }),
    }
}

/// Returns numbers with the last words of `names` as keys; three may be a list.
fn group(names: &[&'static str], fit: &[Dimension]) -> Value {
    let short = names
        .iter()
        .map(|name| name.split_once('.').map_or(*name, |(_, own)| own));
    let keys: Vec<_> = short.map(|name| (name, value(fit))).collect();
    let mapping = object(&keys, &[]);
    match names.len() {
        3 => json!({ "anyOf": [triple(value(fit)), mapping] }),
        _ => mapping,
    }
}
