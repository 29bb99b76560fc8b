//! Schemas of loops, constraints, planes and contacts.

use bgdyn_codegen::format::{Dimension, Key};
use bgdyn_codegen::mechanism::closure::CLOSING_TYPES;
use bgdyn_codegen::mechanism::{CONTACT_KEYS, PLANE_KEYS, constraint_types};
use serde_json::{Value, json};

use super::effects::reads;
use super::parts::{axis, described, identifier, object, quantity};

/// Returns the constraints: one of the types, each with its keys.
pub(super) fn constraints() -> Value {
    let one = |(keyword, keys): (&'static str, &'static [Key])| {
        let own = keys
            .iter()
            .map(|key| (key.name, described(key.about, reads(key.reads))));
        let word = ("type", json!({ "const": keyword }));
        let needed = keys.iter().filter(|key| key.needed).map(|key| key.name);
        let needed: Vec<&str> = needed.chain(["type"]).collect();
        object(&own.chain([word]).collect::<Vec<_>>(), &needed)
    };
    json!({ "oneOf": constraint_types().map(one).collect::<Vec<_>>() })
}

/// Returns an entry of `planes`.
pub(super) fn plane() -> Value {
    entry(&PLANE_KEYS)
}

/// Returns an entry of `contacts`.
pub(super) fn contact() -> Value {
    entry(&CONTACT_KEYS)
}

/// Returns a mapping with these keys.
fn entry(all: &[Key]) -> Value {
    let keys = all.iter();
    let keys: Vec<_> = keys
        .map(|key| (key.name, described(key.about, reads(key.reads))))
        .collect();
    let needed = all.iter().filter(|key| key.needed).map(|key| key.name);
    object(&keys, &needed.collect::<Vec<_>>())
}

/// Returns an entry of `loops`.
pub(super) fn closing() -> Value {
    let words: Vec<Value> = CLOSING_TYPES
        .iter()
        .map(|kind| described(kind.about, json!({ "const": kind.keyword })))
        .collect();
    let place = json!({ "$ref": "#/$defs/place" });
    let position = quantity(&[Dimension::Angle, Dimension::Length]);
    let near = json!({
        "type": "object",
        "description": "positions of joints from which the loops are assembled",
        "propertyNames": identifier(),
        "additionalProperties": position,
    });
    let side = "side of the line from the joint of a's link to the joint of b's link on which the places lie; `parallel`: opposite sides of a parallelogram stay parallel, at no cost; `crossed`: its other branch";
    object(
        &[
            (
                "name",
                described("unique among links, joints, frames and loops", identifier()),
            ),
            ("type", json!({ "oneOf": words })),
            ("a", place.clone()),
            ("b", place),
            (
                "axis",
                described(
                    "of hinge and slider, in the axes of both places; z without it",
                    axis(),
                ),
            ),
            (
                "length",
                described("of a rod", quantity(&[Dimension::Length])),
            ),
            (
                "branch",
                described(
                    side,
                    json!({ "enum": ["left", "right", "parallel", "crossed"] }),
                ),
            ),
            ("near", near),
            (
                "redundant",
                described(
                    "rows that follow from others at every position are left out",
                    json!({ "const": "allow" }),
                ),
            ),
            (
                "tolerance",
                described(
                    "the gap by which rounded lengths may leave rows open that follow from others",
                    quantity(&[Dimension::Length]),
                ),
            ),
        ],
        &["name", "type", "a", "b"],
    )
}

/// Returns a place of a loop: a link with an origin on it, or a frame.
pub(super) fn place() -> Value {
    let origin = json!({ "$ref": "#/$defs/origin" });
    let link = described("the link, or `world`", identifier());
    let on_link = object(&[("link", link), ("origin", origin)], &["link"]);
    let frame = object(
        &[("frame", described("a named frame", identifier()))],
        &["frame"],
    );
    json!({ "oneOf": [on_link, frame] })
}
