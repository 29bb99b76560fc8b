//! Parses the values of a file for the oracle: numbers with the units of the drafts, sites, tensors.

use bgdyn_runtime::Dd;
use serde_yaml::Value;

use super::vector::{M3, V3, ZERO, dd, m3, rpy, times, transposed, v3};

/// A number, or text with a unit.
pub fn number(value: &Value) -> Dd {
    match value {
        // The shortest decimal that rounds to the number is the text in the file.
        Value::Number(n) => decimal(&n.as_f64().expect("a number").to_string()),
        Value::String(text) => {
            let (digits, unit) = text.split_once(' ').unwrap_or((text, ""));
            let factor = match unit {
                "" | "rad" | "m" => Dd::ONE,
                "deg" => Dd::PI / dd(180.0),
                other => panic!("the oracle does not know the unit {other}"),
            };
            decimal(digits) * factor
        }
        // A run-time parameter, with its default.
        Value::Mapping(_) => number(&value["value"]),
        other => panic!("no number: {other:?}"),
    }
}

/// Returns the exact decimal, not rounded to binary.
pub fn decimal(digits: &str) -> Dd {
    digits.parse().unwrap_or_else(|e| panic!("{digits}: {e:?}"))
}

/// Returns the number of a key, or a default.
pub fn number_or(value: &Value, key: &str, otherwise: f64) -> Dd {
    value.get(key).map_or(dd(otherwise), number)
}

pub fn text<'a>(value: &'a Value, key: &str) -> Option<&'a str> {
    value.get(key).and_then(Value::as_str)
}

pub fn list(value: &Value) -> &[Value] {
    value.as_sequence().expect("a list")
}

pub fn vector(value: Option<&Value>) -> V3 {
    value.map_or(ZERO, |v| v3(|i| number(&v[i])))
}

/// A direction: three numbers of any length, or a letter.
pub fn direction(value: Option<&Value>) -> V3 {
    let raw = match value {
        None => [0.0, 0.0, 1.0].map(dd),
        Some(Value::String(name)) => {
            let sign = if name.starts_with('-') { -1.0 } else { 1.0 };
            let letter = name.trim_start_matches('-');
            ["x", "y", "z"].map(|axis| dd(if axis == letter { sign } else { 0.0 }))
        }
        numbers => vector(numbers),
    };
    let length = super::vector::norm(raw);
    raw.map(|x| x / length)
}

/// A rotation and a place.
#[derive(Clone, Copy, Debug)]
pub struct Origin {
    pub rotation: M3,
    pub place: V3,
}

pub fn origin(value: Option<&Value>) -> Origin {
    let of = |key: &str| value.and_then(|v| v.get(key));
    Origin {
        rotation: rpy(vector(of("rpy"))),
        place: vector(of("xyz")),
    }
}

/// Entries of a tensor, in axes that may be turned.
pub fn tensor(value: Option<&Value>) -> M3 {
    let Some(value) = value else {
        return [ZERO; 3];
    };
    let name = ["x", "y", "z"];
    let entries = m3(|i, j| {
        let key = format!("{}{}", name[i.min(j)], name[i.max(j)]);
        number_or(value, &key, 0.0)
    });
    let turned = rpy(vector(value.get("rpy")));
    times(turned, times(entries, transposed(turned)))
}
