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
