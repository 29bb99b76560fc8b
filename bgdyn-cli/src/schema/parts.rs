//! Building blocks of JSON Schemas.

use bgdyn_codegen::format::Dimension;
use serde_json::{Map, Value, json};

/// Returns the schema of a whole file: its version under the key `version`, its name, its description, and
/// these keys.
pub(super) fn file(
    title: &str,
    version: &str,
    keys: &[(&str, Value)],
    needed: &str,
    definitions: Value,
) -> Value {
    let heading = [
        (
            version,
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
            "description",
            described("text for the docs of the generated module", text()),
        ),
    ];
    let mut schema = object(&[&heading[..], keys].concat(), &[version, needed]);
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!(title);
    schema["$defs"] = definitions;
    schema
}

/// Returns a mapping with these keys and no others.
pub(super) fn object(keys: &[(&str, Value)], needed: &[&str]) -> Value {
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

pub(super) fn described(about: &str, mut schema: Value) -> Value {
    schema["description"] = json!(about);
    schema
}

pub(super) fn text() -> Value {
    json!({ "type": "string" })
}

pub(super) fn identifier() -> Value {
    json!({ "type": "string", "pattern": "^[a-z][a-z0-9]*(_[a-z0-9]+)*$" })
}

pub(super) fn triple(item: Value) -> Value {
    json!({ "type": "array", "items": item, "minItems": 3, "maxItems": 3 })
}

pub(super) fn axis() -> Value {
    let letters = ["x", "y", "z", "-x", "-y", "-z"];
    json!({ "anyOf": [{ "enum": letters }, triple(json!({ "type": "number" }))] })
}

/// Returns a number, or text with one of the units of these dimensions.
pub(super) fn quantity(fit: &[Dimension]) -> Value {
    let units = fit.iter().flat_map(|dimension| dimension.units());
    let units: Vec<String> = units.map(escaped).collect();
    let decimal = r"([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?";
    let fraction = format!("[-+]?{decimal}/[-+]?{decimal}");
    let number = format!("[-+]?{decimal}(/[-+]?{decimal})?");
    let pattern = match units.as_slice() {
        [] => format!("^{fraction}$"),
        _ => format!("^({number} *({})|{fraction})$", units.join("|")),
    };
    json!({ "anyOf": [{ "type": "number" }, { "type": "string", "pattern": pattern }] })
}

/// Returns a unit in a pattern, with the signs that may replace its letters.
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

/// Returns a quantity, or a run-time parameter.
pub(super) fn value(fit: &[Dimension]) -> Value {
    let number = quantity(fit);
    let keys = [("parameter", identifier()), ("value", number.clone())];
    json!({ "anyOf": [number, object(&keys, &["parameter", "value"])] })
}

pub(super) fn origin() -> Value {
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
