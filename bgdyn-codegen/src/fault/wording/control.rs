//! Messages about sampled control.

use super::{quote, unknown_name};
use crate::fault::{Fault, Location};

/// The rule of all of them.
const RULE: &str = "control";

pub(crate) fn nothing_to_sample(location: &Location) -> Fault {
    Fault::new(
        location,
        RULE,
        "no input of the scene has a controller that could be sampled",
    )
    .with_help(
        "give an input a `pd`, a `pid`, a `computed_torque` or a `hold`, or leave `control` out",
    )
}

pub(crate) fn control_without_period(location: &Location) -> Fault {
    Fault::new(location, "missing-key", "`control` has no `period`")
        .with_help("add `period: 1 ms`, the time between two samples")
}

pub(crate) fn control_not_positive(location: &Location, key: &str, text: &str) -> Fault {
    let message = format!("{} is {text}", quote(key));
    let help = match key {
        "period" => "a period is positive: `1 ms`",
        _ => "it must not be negative",
    };
    Fault::new(location, RULE, message).with_help(help)
}

/// `delay` in s, how many periods at most, and these in s.
pub(crate) fn delay_too_long(
    location: &Location,
    (delay, periods, most): (f64, usize, f64),
) -> Fault {
    let message = format!("the delay of {delay} s is longer than {periods} periods, {most} s");
    Fault::new(location, RULE, message).with_help("shorten the delay, or lengthen the period")
}

pub(crate) fn unknown_hold(location: &Location) -> Fault {
    Fault::new(
        location,
        RULE,
        "values of controllers are held by `zero_order`",
    )
    .with_help("write `hold: zero_order`, or leave it out")
}

pub(crate) fn not_a_seed(location: &Location, text: &str) -> Fault {
    let message = format!("the seed {text} is no integer from 0 to 2⁵³");
    Fault::new(location, RULE, message).with_help("write `seed: 1`")
}

pub(crate) fn unknown_channel(location: &Location, name: &str, known: &[&str]) -> Fault {
    let message = unknown_name("channel", name, known, &known.join(", "));
    Fault::new(location, RULE, message)
        .with_help("sensors are at joints of the state, and efforts are those of controllers")
}

pub(crate) fn canonical_of_control(location: &Location, (name, natural): (&str, &str)) -> Fault {
    let message =
        format!("`{name}` integrates momenta, and sampled controllers measure velocities");
    Fault::new(location, RULE, message).with_help(format!("write `method: {natural}`"))
}

// The model of the controllers

/// The rule of these.
const MODEL: &str = "controller-model";

/// A fault of the controllers' model, which says so.
pub(crate) fn of_controller_model(fault: Fault) -> Fault {
    let message = format!("in the model of the controllers: {}", fault.message);
    Fault { message, ..fault }
}

pub(crate) fn no_computed_torque(location: &Location) -> Fault {
    let message = "no input of the scene is a `computed_torque`, which would use the model";
    Fault::new(location, MODEL, message)
        .with_help("`pd`, `pid` and `hold` need no model: leave `controller_model` out")
}

/// `what` is a position, a velocity, a state, a mode or an input.
pub(crate) fn controller_needs(location: &Location, what: &str, name: &str) -> Fault {
    let message = format!(
        "the model of the controllers has the {what} {}, which the scene does not have",
        quote(name)
    );
    let help = match what {
        "mode" => "leave that effect out of the model's `effects`, or take `coulomb_smooth`",
        _ => {
            "a controller measures the state of the scene: leave out what adds to it, or rename it"
        }
    };
    Fault::new(location, MODEL, message).with_help(help)
}

pub(crate) fn unknown_parameter_of_controllers(
    location: &Location,
    name: &str,
    known: &[&str],
) -> Fault {
    let message = match known.is_empty() {
        true => format!("{} is no run-time parameter: there are none", quote(name)),
        false => unknown_name("run-time parameter", name, known, &known.join(", ")),
    };
    of_controller_model(
        Fault::new(location, "unknown-name", message)
            .with_help("`parameters` are those of the model's mechanism and effects"),
    )
}

pub(crate) fn controller_mechanism_unreadable(location: &Location, path: &str, why: &str) -> Fault {
    let message = format!("the mechanism {} cannot be read: {why}", quote(path));
    of_controller_model(
        Fault::new(location, "no-mechanism", message)
            .with_help("write its path relative to the scene's folder"),
    )
}
