//! Builds the JSON Schema of a mechanism's file.

use bgdyn_codegen::format::{Dimension, LENGTHS, LIMIT_PARTS};
use bgdyn_codegen::mechanism::joint::JOINT_TYPES;
use serde_json::{Value, json};

use super::constraints::{closing, constraints, contact, place, plane};
use super::effects::effects;
use super::parts::{
    axis, described, file, identifier, object, origin, quantity, text, triple, value,
};

/// Returns the schema of a mechanism's file.
pub fn mechanism() -> Value {
    file(
        "A mechanism of bgdyn, format 1",
        "format",
        &[
            (
                "label",
                described("the name elsewhere (a URDF's, a drawing's)", text()),
            ),
            (
                "base",
                described(
                    "whether the base is at rest, or its motion is given at run time; fixed without it",
                    json!({ "enum": ["fixed", "given"] }),
                ),
            ),
            (
                "gravity",
                described(
                    "acceleration of free fall in world axes; [0, 0, -9.81] m/s² without it",
                    triple(quantity(&[Dimension::Acceleration])),
                ),
            ),
            (
                "snap",
                described(
                    "directions closer than this angle to a quarter turn or an axis are made exact, 0 to 1e-3 rad",
                    quantity(&[Dimension::Angle]),
                ),
            ),
            (
                "links",
                json!({ "type": "array", "minItems": 1, "items": { "$ref": "#/$defs/link" } }),
            ),
            (
                "frames",
                json!({ "type": "array", "items": { "$ref": "#/$defs/frame" } }),
            ),
            (
                "constraints",
                json!({
                    "type": "object",
                    "description": "relations between joints, and joints whose motion is given, by name: each takes one velocity from v",
                    "propertyNames": identifier(),
                    "additionalProperties": { "$ref": "#/$defs/constraint" },
                }),
            ),
            (
                "planes",
                json!({
                    "type": "object",
                    "description": "planes that wheels, balls and contacts touch, by name; without one the world's x–y plane",
                    "propertyNames": identifier(),
                    "additionalProperties": { "$ref": "#/$defs/plane" },
                }),
            ),
            (
                "contacts",
                json!({
                    "type": "object",
                    "description": "spheres, capsules and boxes that may touch a plane or a sphere, by name",
                    "propertyNames": identifier(),
                    "additionalProperties": { "$ref": "#/$defs/contact" },
                }),
            ),
            (
                "loops",
                json!({
                    "type": "array",
                    "description": "kinematic loops: each connects two places, and makes joints follow others",
                    "items": { "$ref": "#/$defs/loop" },
                }),
            ),
            (
                "independent",
                json!({
                    "type": "array",
                    "description": "joints that follow no others, although constraints or loops contain them",
                    "items": identifier(),
                }),
            ),
            (
                "actuated",
                json!({
                    "type": "array",
                    "description": "joints with drives, of a mechanism with loops, wheels or knife edges; without it the independent joints",
                    "items": identifier(),
                    "minItems": 1,
                    "uniqueItems": true,
                }),
            ),
            (
                "effects",
                json!({
                    "type": "object",
                    "description": "what else acts in the machine, by name, for scenes to call for",
                    "propertyNames": identifier(),
                    "additionalProperties": { "$ref": "#/$defs/effect" },
                }),
            ),
        ],
        "links",
        json!({
            "link": link(),
            "joint": joint(),
            "origin": origin(),
            "limits": limits(),
            "part_limits": part_limits(),
            "mimic": mimic(),
            "inertia": inertia(),
            "frame": frame(),
            "effect": effects(),
            "constraint": constraints(),
            "plane": plane(),
            "contact": contact(),
            "loop": closing(),
            "place": place(),
        }),
    )
}

fn link() -> Value {
    let mass = value(&[Dimension::Mass]);
    object(
        &[
            (
                "name",
                described(
                    "unique among links and frames; `world` is the base",
                    identifier(),
                ),
            ),
            ("label", described("the name elsewhere", text())),
            (
                "parent",
                described(
                    "the link that carries this one; the fixed base without it",
                    identifier(),
                ),
            ),
            ("joint", json!({ "$ref": "#/$defs/joint" })),
            ("mass", described("kg, not negative; 0 without it", mass)),
            (
                "com",
                described(
                    "centre of mass in link axes, m",
                    triple(value(&[Dimension::Length])),
                ),
            ),
            ("inertia", json!({ "$ref": "#/$defs/inertia" })),
            (
                "nonphysical",
                json!({ "const": "allow", "description": "accept a tensor that breaks the triangle inequality" }),
            ),
        ],
        &["name"],
    )
}

fn joint() -> Value {
    let kinds = JOINT_TYPES.map(|kind| kind.keyword);
    object(
        &[
            (
                "name",
                described(
                    "unique among joints; needed unless it is fixed",
                    identifier(),
                ),
            ),
            ("label", described("the name elsewhere", text())),
            ("type", json!({ "enum": kinds })),
            (
                "axis",
                described(
                    "direction in link axes; z without it; not for fixed, spherical, floating and planar joints",
                    axis(),
                ),
            ),
            (
                "axis2",
                described(
                    "second axis of a joint with two, in link axes where the positions are zero",
                    axis(),
                ),
            ),
            (
                "lead",
                described(
                    "of a helical joint: displacement along the axis for a full turn, or per radian with such a unit",
                    quantity(&[Dimension::Length, Dimension::Lead]),
                ),
            ),
            ("origin", json!({ "$ref": "#/$defs/origin" })),
            ("limits", json!({ "$ref": "#/$defs/limits" })),
            ("mimic", json!({ "$ref": "#/$defs/mimic" })),
            (
                "quaternion",
                json!({
                    "const": "any",
                    "description": "of a spherical or floating joint: its quaternion may have any length; without it the length must be 1",
                }),
            ),
        ],
        &["type"],
    )
}

/// Returns the limits of a joint with one coordinate, and those of the parts of one with two.
fn limits() -> Value {
    let parts = LIMIT_PARTS.map(|part| (part, json!({ "$ref": "#/$defs/part_limits" })));
    object(&[&limit_keys()[..], &parts].concat(), &[])
}

fn part_limits() -> Value {
    object(&limit_keys(), &[])
}

fn limit_keys() -> [(&'static str, Value); 4] {
    let position = || quantity(&[Dimension::Angle, Dimension::Length]);
    [
        ("lower", described("smallest coordinate", position())),
        ("upper", described("largest coordinate", position())),
        (
            "velocity",
            described(
                "largest speed",
                quantity(&[Dimension::AngularSpeed, Dimension::Speed]),
            ),
        ),
        (
            "effort",
            described(
                "largest effort",
                quantity(&[Dimension::Torque, Dimension::Force]),
            ),
        ),
    ]
}

fn mimic() -> Value {
    let ratios = [Dimension::One, Dimension::Lead, Dimension::AnglePerLength];
    object(
        &[
            (
                "joint",
                described("the joint whose coordinate it follows", identifier()),
            ),
            (
                "ratio",
                described(
                    "units of this joint per unit of the other, not 0; 1 without it",
                    quantity(&ratios),
                ),
            ),
            (
                "offset",
                described(
                    "position where the other joint's is zero; 0 without it",
                    quantity(&[Dimension::Angle, Dimension::Length]),
                ),
            ),
        ],
        &["joint"],
    )
}

fn inertia() -> Value {
    let entry = |key: &str| {
        described(
            &format!("entry {key} of the tensor"),
            value(&[Dimension::Inertia]),
        )
    };
    let entries = ["xx", "yy", "zz", "xy", "xz", "yz"].map(|key| (key, entry(key)));
    let product = quantity(&[Dimension::Inertia]);
    let products = object(&["xy", "xz", "yz"].map(|key| (key, product.clone())), &[]);
    let lengths = LENGTHS.map(|key| (key, quantity(&[Dimension::Length])));
    let others = [
        (
            "products",
            described(
                "∫xy dm and so on, in place of the off-diagonal entries",
                products,
            ),
        ),
        (
            "about",
            json!({ "enum": ["com", "origin"], "description": "the point that the tensor is about" }),
        ),
        (
            "rpy",
            described(
                "axes of the entries, or of the solid, in the link's",
                triple(quantity(&[Dimension::Angle])),
            ),
        ),
        (
            "solid",
            json!({ "enum": ["box", "cylinder", "sphere", "rod"], "description": "a body of even density" }),
        ),
        (
            "size",
            described("edges of a box", triple(quantity(&[Dimension::Length]))),
        ),
        (
            "axis",
            described("axis of a cylinder or rod; z without it", axis()),
        ),
    ];
    object(&[&entries[..], &others, &lengths].concat(), &[])
}

fn frame() -> Value {
    object(
        &[
            ("name", identifier()),
            ("label", described("the name elsewhere", text())),
            (
                "link",
                described("the link it is fixed to, or `world`", identifier()),
            ),
            ("origin", json!({ "$ref": "#/$defs/origin" })),
        ],
        &["name", "link"],
    )
}
