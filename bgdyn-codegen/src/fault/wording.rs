//! All messages about specs and scenes, one function for each fault.

mod checking;
mod effects;
mod inertia;
mod inputs;
mod reading;
mod scene;
mod values;

use super::suggest::{nearest, unknown_name};
pub(crate) use checking::*;
pub(crate) use effects::*;
pub(crate) use inertia::*;
pub(crate) use inputs::*;
pub(crate) use reading::*;
pub(crate) use scene::*;
pub(crate) use values::*;

/// How many characters of a user's text a message repeats.
const QUOTE_WIDTH: usize = 60;

/// A user's text between backticks, on one line and not too long.
pub(crate) fn quote(text: &str) -> String {
    let mut shown: String = text.chars().take(QUOTE_WIDTH).flat_map(escape).collect();
    if text.chars().nth(QUOTE_WIDTH).is_some() {
        shown.push('…');
    }
    format!("`{shown}`")
}

/// A message that may hold a user's text: what would break its line is escaped.
pub(super) fn one_line(message: String) -> String {
    match message.contains(char::is_control) {
        true => message.chars().flat_map(escape).collect(),
        false => message,
    }
}

fn escape(c: char) -> Vec<char> {
    if c.is_control() {
        c.escape_default().collect()
    } else {
        vec![c]
    }
}

/// A number with six digits, for what was computed.
fn figure(x: f64) -> String {
    let digits: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    let plain = digits == 0.0 || (1e-4..1e6).contains(&digits.abs());
    if plain {
        format!("{digits}")
    } else {
        format!("{digits:e}")
    }
}

fn figures(numbers: &[f64]) -> String {
    numbers
        .iter()
        .map(|x| figure(*x))
        .collect::<Vec<_>>()
        .join(", ")
}

fn listed<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    words.into_iter().map(quote).collect::<Vec<_>>().join(", ")
}

/// "did you mean …?", or what is known.
fn meant(word: &str, known: &[&str], otherwise: String) -> String {
    match nearest(word, known.iter().copied()) {
        Some(near) => format!("did you mean {}?", quote(near)),
        None => otherwise,
    }
}
