//! Messages about the numbers of an effect: their signs, their order, valid combinations.

use super::Help;
use crate::fault::{Fault, Location};

/// `why` is the physical rule that a negative number violates; also in the functions below.
pub(crate) fn negative_value(location: &Location, key: &str, text: &str, why: Help) -> Fault {
    let message = format!("`{key}` is {text}: it must not be negative");
    Fault::new(location, "effect-sign", message).with_help(why.text())
}

pub(crate) fn value_not_positive(location: &Location, key: &str, text: &str, why: Help) -> Fault {
    let message = format!("`{key}` is {text}: it must be greater than 0");
    Fault::new(location, "effect-sign", message).with_help(why.text())
}

pub(crate) fn value_above_one(location: &Location, key: &str, text: &str, why: Help) -> Fault {
    let message = format!("`{key}` is {text}: it must be at most 1");
    Fault::new(location, "effect-sign", message).with_help(why.text())
}

pub(crate) fn value_cannot_be_parameter(location: &Location, key: &str, keyword: &str) -> Fault {
    let message = format!("`{key}` of a `{keyword}` cannot be a run-time parameter");
    Fault::new(location, "misplaced-parameter", message).with_help("write a plain number")
}

/// The keys and the texts of their numbers: first the number that must not be greater.
pub(crate) fn values_out_of_order(
    location: &Location,
    (small, small_text): (&str, &str),
    (large, large_text): (&str, &str),
    why: Help,
) -> Fault {
    let message = format!("`{large}` is {large_text}, which is less than `{small}`, {small_text}");
    Fault::new(location, "effect-order", message).with_help(why.text())
}

/// `given` are the keys in the file; exactly one of `keys` is required.
pub(crate) fn not_one_port(
    location: &Location,
    effect: &str,
    given: &[&str],
    keys: &[&str],
) -> Fault {
    let message = match given {
        [] => format!("`{effect}` does not say where it acts"),
        several => format!(
            "`{effect}` acts at one place only, but has `{}`",
            several.join("` and `")
        ),
    };
    Fault::new(location, "effect-place", message)
        .with_help(format!("write one of `{}`", keys.join("`, `")))
}
