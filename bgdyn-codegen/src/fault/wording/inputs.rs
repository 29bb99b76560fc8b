//! Messages about a scene's inputs: signals, controllers, tables.

use super::{quote, unknown_name};
use crate::fault::{Fault, Location};

pub(crate) fn unknown_input(location: &Location, name: &str, known: &[&str]) -> Fault {
    let message = unknown_name("input", name, known, &known.join(", "));
    Fault::new(location, "unknown-input", message)
        .with_help("an input is the effort of a joint, or an input that an effect declares")
}

/// `known` lists the possible sources of an input.
pub(crate) fn not_one_source(location: &Location, known: &str) -> Fault {
    Fault::new(location, "drive", "an input has exactly one source")
        .with_help(format!("write one of {known}"))
}

pub(crate) fn unknown_source(location: &Location, word: &str, known: &str) -> Fault {
    let message = format!("no signal and no controller is called {}", quote(word));
    Fault::new(location, "drive", message).with_help(format!("write one of {known}"))
}

// Controllers

pub(crate) fn computed_torque_without_effort(location: &Location) -> Fault {
    let message =
        "`computed_torque` computes the effort of a joint, and this input is not such an effort";
    Fault::new(location, "drive", message)
        .with_help("use `pd`, whose gains have this input's unit, or `given`")
}

pub(crate) fn controller_without_joint(location: &Location, word: &str) -> Fault {
    let message = format!("`{word}` controls the position of a joint, and this input has no joint");
    Fault::new(location, "drive", message)
        .with_help("use `constant`, `harmonic`, `table` or `given`")
}

pub(crate) fn controller_of_quasi_velocity(location: &Location, velocity: &str) -> Fault {
    let message = format!(
        "a controller follows a position, and `{velocity}` is a velocity in link axes: no position has it as its rate"
    );
    Fault::new(location, "drive", message).with_help(
        "write `given` and compute the effort in Rust code: `difference` of the mechanism is the error of a pose",
    )
}

pub(crate) fn controller_without_target(location: &Location) -> Fault {
    Fault::new(location, "missing-key", "the controller has no `target`")
        .with_help("add `target: …`: a number, or a signal such as `{ ramp: … }`")
}

// Tables

pub(crate) fn not_a_point(location: &Location) -> Fault {
    Fault::new(location, "drive", "a point is a time and a value").with_help("write `[0.5 s, 2]`")
}

pub(crate) fn times_not_increasing(location: &Location, text: &str) -> Fault {
    let message = format!("the time {text} is not later than the time before it");
    Fault::new(location, "drive", message).with_help("times must increase from point to point")
}

pub(crate) fn empty_table(location: &Location) -> Fault {
    Fault::new(location, "drive", "the table has no points")
        .with_help("write `[[0 s, 0], [1 s, 2]]`")
}
