//! The JSON Schema of a mechanism's file, for editors: completion, hints and red lines while typing.
//!
//! It says what the reader says about keys, words, types and units; what a check finds by computing (a tensor
//! that no body has, a circle of parents) is for `bgdyn check`. Effects come from the generator's own table.

use bgdyn_codegen::effect::{EFFECTS, Effect};
use bgdyn_codegen::mechanism::joint::JOINT_TYPES;
use bgdyn_codegen::spec::{Dimension, LENGTHS, Reads};
use serde_json::{Map, Value, json};

/// The schema of a mechanism's file.
pub fn mechanism() -> Value {
    let mut keys = object(
        &[
            (
                "format",
                json!({ "const": 1, "description": "version of the format" }),
            ),
            (
                "name",
                described(
                    "snake_case identifier, equal to the file's stem",
                    identifier(),
                ),
            ),
            (
                "label",
                described("the name elsewhere (a URDF's, a drawing's)", text()),
            ),
            (
                "description",
                described("text for the docs of the generated module", text()),
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
                    "how far a direction may be from a quarter turn or an axis and still be taken for it, 0 to 1e-3 rad",
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
                "effects",
                json!({
                    "type": "object",
                    "description": "what else acts in the machine, by name, for scenes to call for",
                    "propertyNames": identifier(),
                    "additionalProperties": { "$ref": "#/$defs/effect" },
                }),
            ),
        ],
        &["format", "links"],
    );
    keys["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    keys["title"] = json!("A mechanism of bgdyn, format 1");
    keys["$defs"] = json!({
        "link": link(),
        "joint": joint(),
        "origin": origin(),
        "limits": limits(),
        "inertia": inertia(),
        "frame": frame(),
        "effect": effects(),
    });
    keys
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
                described("direction in link axes; z without it", axis()),
            ),
            ("origin", json!({ "$ref": "#/$defs/origin" })),
            ("limits", json!({ "$ref": "#/$defs/limits" })),
        ],
        &["type"],
    )
}

fn origin() -> Value {
    let turns = "roll, pitch, yaw about the fixed axes x, y, z: R = Rz(yaw) Ry(pitch) Rx(roll)";
    object(
        &[
            (
                "xyz",
                described("displacement, m", triple(quantity(&[Dimension::Length]))),
            ),
            (
                "rpy",
                described(turns, triple(quantity(&[Dimension::Angle]))),
            ),
        ],
        &[],
    )
}

fn limits() -> Value {
    let position = || quantity(&[Dimension::Angle, Dimension::Length]);
    object(
        &[
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
        ],
        &[],
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

/// Keys by the word after `type`.
fn effects() -> Value {
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
    let keys = effect.keys().iter();
    let keys = keys.map(|key| (key.name, described(key.about, reads(key.reads))));
    let needed = effect.keys().iter().filter(|key| key.needed);
    let needed: Vec<&str> = needed.map(|key| key.name).collect();
    object(&keys.chain([word]).collect::<Vec<_>>(), &needed)
}

fn reads(reads: Reads) -> Value {
    match reads {
        Reads::Number(fit) => value(fit),
        Reads::Word(words) => json!({ "enum": words }),
        Reads::Coordinate | Reads::Joint | Reads::Place | Reads::Node | Reads::Input => {
            identifier()
        }
        Reads::Places => {
            json!({ "type": "array", "items": identifier(), "minItems": 2, "maxItems": 2 })
        }
        Reads::Vector(fit) => triple(value(fit)),
        Reads::Words(words) => json!({ "type": "array", "items": { "enum": words } }),
        Reads::Group(names, fit) => group(names, fit),
    }
}

/// Numbers under the last words of `names`; three may be a list.
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

/// A mapping with these keys and no others.
fn object(keys: &[(&str, Value)], needed: &[&str]) -> Value {
    let properties: Map<String, Value> = keys
        .iter()
        .map(|(key, v)| (key.to_string(), v.clone()))
        .collect();
    let mut schema = json!({
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
    });
    if !needed.is_empty() {
        schema["required"] = json!(needed);
    }
    schema
}

fn described(about: &str, mut schema: Value) -> Value {
    schema["description"] = json!(about);
    schema
}

fn text() -> Value {
    json!({ "type": "string" })
}

fn identifier() -> Value {
    json!({ "type": "string", "pattern": "^[a-z][a-z0-9]*(_[a-z0-9]+)*$" })
}

fn triple(item: Value) -> Value {
    json!({ "type": "array", "items": item, "minItems": 3, "maxItems": 3 })
}

fn axis() -> Value {
    let letters = ["x", "y", "z", "-x", "-y", "-z"];
    json!({ "anyOf": [{ "enum": letters }, triple(json!({ "type": "number" }))] })
}

/// A number, or text with one of the units of these dimensions.
fn quantity(fit: &[Dimension]) -> Value {
    let units = fit.iter().flat_map(|dimension| dimension.units());
    let units: Vec<String> = units.map(escaped).collect();
    if units.is_empty() {
        return json!({ "type": "number" });
    }
    let number = r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?";
    let pattern = format!("^{number} *({})$", units.join("|"));
    json!({ "anyOf": [{ "type": "number" }, { "type": "string", "pattern": pattern }] })
}

/// A unit in a pattern, with the signs that may stand for its letters.
fn escaped(unit: &str) -> String {
    let spellings = [
        ("^2", r"(\^2|²)"),
        ("^3", r"(\^3|³)"),
        ("deg", "(deg|°)"),
        ("ohm", "(ohm|Ω)"),
        ("u", "[uµ]"),
        ("*", "[*·]"),
    ];
    let (mut pattern, mut rest) = (String::new(), unit);
    while let Some(c) = rest.chars().next() {
        if let Some((word, spelling)) = spellings.iter().find(|(word, _)| rest.starts_with(word)) {
            pattern += spelling;
            rest = &rest[word.len()..];
            continue;
        }
        if "^().".contains(c) {
            pattern.push('\\');
        }
        pattern.push(c);
        rest = &rest[c.len_utf8()..];
    }
    pattern
}

/// A quantity, or a run-time parameter.
fn value(fit: &[Dimension]) -> Value {
    let number = quantity(fit);
    let keys = [("parameter", identifier()), ("value", number.clone())];
    json!({ "anyOf": [number, object(&keys, &["parameter", "value"])] })
}
