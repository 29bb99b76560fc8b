//! Messages about loops that do not close, close to rounding only, or on another branch.

use super::{quote, six_digits};
use crate::fault::{Fault, Location};

/// Returns a gap of a loop, distance in m and angle in rad, without a part that is far below the other one: "0.2 m".
pub(super) fn gap_text((distance, angle): (f64, f64)) -> String {
    let part = |size: f64, other: f64, unit: &str| {
        (size > 1e-6 * other).then(|| format!("{} {unit}", six_digits(size)))
    };
    let parts = [part(distance, angle, "m"), part(angle, distance, "rad")];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    match parts.is_empty() {
        true => "0 m".to_owned(),
        false => parts.join(" and "),
    }
}

/// `gap`: distance in m and angle in rad.
pub(crate) fn loop_not_assembled(location: &Location, name: &str, gap: (f64, f64)) -> Fault {
    let message = format!(
        "no position closes the loops: in the closest assembly found, {} misses by {}",
        quote(name),
        gap_text(gap)
    );
    Fault::new(location, "loop-not-assembled", message).with_help(
        "correct the lengths; or give positions near a closed one with `near: { elbow: 30 deg }`",
    )
}

/// `words`: the branch of the file, and that on which the positions close.
pub(crate) fn branch_contradicts_near(
    location: &Location,
    name: &str,
    words: [&str; 2],
    near: &[(String, f64)],
) -> Fault {
    let near: Vec<String> = (near.iter())
        .map(|(joint, x)| format!("`{joint}` {}", six_digits(*x)))
        .collect();
    let message = format!(
        "the loop {} has the branch `{}`, and its positions in `near` ({}) close on the branch `{}`",
        quote(name),
        words[0],
        near.join(", "),
        words[1]
    );
    Fault::new(location, "branch-contradicts-near", message)
        .with_help("leave one of them out, or correct it")
}

/// `branches`: those to choose from, if the loop is a parallelogram.
pub(crate) fn branches_meet_at_start(
    location: &Location,
    name: &str,
    branches: Option<&str>,
) -> Fault {
    let message = format!(
        "at the start of the mechanism two branches of the loop {} meet: how it moves from there is not determined",
        quote(name)
    );
    Fault::new(location, "singular-start", message).with_help(match branches {
        Some(branches) => format!(
            "it is a parallelogram: write {branches}; or give positions elsewhere with `near`"
        ),
        None => "give positions elsewhere, on the branch that is meant: `near: { elbow: 30 deg }`"
            .to_owned(),
    })
}

/// `open`: the most by which the row is open along the motion of the others, m or rad.
pub(crate) fn loop_held_by_rounding(
    location: &Location,
    (name, row): (&str, &str),
    (rows, joints): (usize, usize),
    open: f64,
) -> Fault {
    let message = format!(
        "the loop {} closes at single positions only, {rows} rows for {joints} velocities, and would move if its row `{row}` followed from others: lengths or angles seem to be rounded",
        quote(name)
    );
    Fault::new(location, "loop-closes-to-rounding", message).with_help(rounding_help(open))
}

/// Returns the way out where lengths are rounded; `open` is by how much rows are then open.
fn rounding_help(open: f64) -> String {
    format!(
        "write them exactly (more digits, fractions of pi); or let rows that follow from others be open by `tolerance: {:.0e} m` in the loop: they are up to {} m in closed positions around the start",
        10.0_f64.powf(open.log10().ceil()),
        six_digits(open)
    )
}

pub(crate) fn loop_closes_to_rounding(
    location: &Location,
    (name, row): (&str, &str),
    left: f64,
) -> Fault {
    let message = format!(
        "the loops close only to {}, not exactly: {} remains open (row `{row}`)",
        six_digits(left),
        quote(name)
    );
    Fault::new(location, "loop-closes-to-rounding", message).with_help(
        "the joints are at the end of their reach there: correct the lengths, or free a joint of the loop",
    )
}

/// `gaps`: that of the best position, and the largest along the motion without the rows that others determine.
pub(crate) fn loop_moves_but_for_rounding(
    location: &Location,
    name: &str,
    (left, open): (f64, f64),
) -> Fault {
    let message = format!(
        "the loop {} closes only to {} m, and would move if it closed: lengths or angles seem to be rounded",
        quote(name),
        six_digits(left)
    );
    Fault::new(location, "loop-closes-to-rounding", message).with_help(rounding_help(open))
}

pub(crate) fn tolerance_out_of_range(location: &Location, text: &str) -> Fault {
    let message = format!("the tolerance is {text}");
    Fault::new(location, "tolerance-out-of-range", message).with_help(
        "write a length above 0 and up to 1 mm, by which rounded lengths may leave the loop open",
    )
}

pub(crate) fn tolerance_exceeded(
    location: &Location,
    name: &str,
    (open, tolerance): (f64, f64),
) -> Fault {
    let message = format!(
        "in positions around the start the loop {} is open by up to {} m, more than its `tolerance` of {} m",
        quote(name),
        six_digits(open),
        six_digits(tolerance)
    );
    Fault::new(location, "tolerance-exceeded", message)
        .with_help("correct the lengths, or raise `tolerance` if that gap is meant")
}

pub(crate) fn loop_closes_at_single_positions(
    location: &Location,
    (name, row): (&str, &str),
) -> Fault {
    let message = format!(
        "the loop {} closes at single positions only: there its row `{row}` follows from others, and it opens where these move",
        quote(name)
    );
    Fault::new(location, "loop-at-single-position", message).with_help(
        "correct the lengths: the joints are at the end of their reach, or hold each other",
    )
}

pub(crate) fn branch_not_found(location: &Location, name: &str) -> Fault {
    let message = format!("the loop {} closes, but not on this branch", quote(name));
    Fault::new(location, "branch-not-found", message)
        .with_help("write the other branch, or give positions near it with `near`")
}
