//! All messages about specs and scenes, one function for each fault.

mod actuated;
mod assembly;
mod checking;
mod constraints;
mod contact_pairs;
mod contacts;
mod control;
mod effect_rules;
mod effects;
pub(crate) mod expected;
mod help;
mod inertia;
mod inputs;
mod joints;
mod loops;
mod motionless;
mod reading;
mod scene;
mod start;
mod values;

use bgdyn_runtime::Digits;

pub(crate) use super::quote::quote;
use super::suggest::{nearest, unknown_name};
pub(crate) use actuated::*;
pub(crate) use assembly::*;
pub(crate) use checking::*;
pub(crate) use constraints::*;
pub(crate) use contact_pairs::*;
pub(crate) use contacts::*;
pub(crate) use control::*;
pub(crate) use effect_rules::*;
pub(crate) use effects::*;
pub use help::Help;
pub(crate) use inertia::*;
pub(crate) use inputs::*;
pub(crate) use joints::*;
pub(crate) use loops::*;
pub(crate) use motionless::*;
pub(crate) use reading::*;
pub(crate) use scene::*;
pub(crate) use start::*;
pub(crate) use values::*;

/// Prints a computed number with six digits.
fn six_digits(x: f64) -> String {
    Digits::new(x, 6).to_string()
}

fn six_digits_each(numbers: &[f64]) -> String {
    numbers
        .iter()
        .map(|x| six_digits(*x))
        .collect::<Vec<_>>()
        .join(", ")
}

fn quoted_list<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    words.into_iter().map(quote).collect::<Vec<_>>().join(", ")
}

/// Returns "did you mean …?", or the list of known words.
fn suggestion(word: &str, known: &[&str], otherwise: String) -> String {
    match nearest(word, known.iter().copied()) {
        Some(near) => format!("did you mean {}?", quote(near)),
        None => otherwise,
    }
}
