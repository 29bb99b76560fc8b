//! Reads states from a file and parameters from the command line, and describes states without a result.

use anyhow::{Result, anyhow, bail};
use bgdyn_codegen::mechanism::Parameter;
use serde::Serialize;
use serde_json::Value;

use crate::quantity::value_in;
use crate::spec_file::{read_text, shown};
use crate::usage::Usage;

/// Returns the spec's values of the run-time parameters, except those set as `NAME=VALUE`.
pub(super) fn parameters(all: &[Parameter], set: &[String]) -> Result<Vec<f64>, Usage> {
    let mut values: Vec<f64> = all.iter().map(|p| p.default.to_f64()).collect();
    let mut done: Vec<&str> = Vec::new();
    for text in set {
        let (name, value) = text
            .split_once('=')
            .ok_or_else(|| Usage(format!("`--parameter {text}`: write NAME=VALUE")))?;
        let found = all.iter().position(|p| p.name == name).ok_or_else(|| {
            let known: Vec<&str> = all.iter().map(|p| p.name.as_str()).collect();
            Usage(match known.as_slice() {
                [] => format!("no parameter `{name}`: the spec has none"),
                known => format!("no parameter `{name}`; there are {}", known.join(", ")),
            })
        })?;
        if done.contains(&name) {
            return Err(Usage(format!("the parameter `{name}` is set twice")));
        }
        done.push(name);
        let wrong = |what: String| Usage(format!("`--parameter {text}`: {what}"));
        values[found] = value_in(value, all[found].unit).map_err(wrong)?.to_f64();
    }
    Ok(values)
}

pub(super) fn states(path: &std::path::Path) -> Result<Vec<Value>> {
    let text = read_text(path)?;
    let file: Value = serde_json::from_str(&without_bare_words(&text)).map_err(|e| {
        anyhow!(
            "{}:{}:{}: this is not JSON: {e}",
            shown(path),
            e.line(),
            e.column()
        )
    })?;
    match file.get("states") {
        Some(Value::Array(states)) => Ok(states.clone()),
        _ => bail!("{}:1:1: this has no array `states`", shown(path)),
    }
}

/// Replaces `NaN` and `Infinity`, which some programs write, by `null`, so that the text is JSON.
fn without_bare_words(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    let mut quoted = false;
    while let Some(c) = rest.chars().next() {
        let word = ["-Infinity", "Infinity", "NaN"]
            .into_iter()
            .find(|w| rest.starts_with(w));
        if let (false, Some(word)) = (quoted, word) {
            out.push_str("null");
            rest = &rest[word.len()..];
            continue;
        }
        if c == '\\' && quoted {
            let two = rest.char_indices().nth(2).map_or(rest.len(), |(i, _)| i);
            out.push_str(&rest[..two]);
            rest = &rest[two..];
            continue;
        }
        quoted ^= c == '"';
        out.push(c);
        rest = &rest[c.len_utf8()..];
    }
    out
}

/// Returns a failure without a joint as its cause.
pub(super) fn plain(message: String) -> Failure {
    Failure {
        joint: None,
        message,
    }
}

/// Returns a finite number; one beyond the range of f64 is read as infinite.
pub(super) fn finite(value: &Value) -> Option<f64> {
    let number = value.as_number()?.to_string().parse().ok();
    number.filter(|x: &f64| x.is_finite())
}

/// Returns the failure that joint `name` has no inertia left.
pub(super) fn singular(name: &str) -> Failure {
    Failure {
        joint: Some(name.to_owned()),
        message: format!("singular mass matrix: joint `{name}` has no inertia left to accelerate"),
    }
}

/// The reason why a state has no result.
#[derive(Serialize)]
pub(super) struct Failure {
    pub(super) joint: Option<String>,
    pub(super) message: String,
}
