//! Messages about the start of a scene with loops, and of joints that follow others.

use super::assembly::gap_text;
use super::{quote, quoted_list, six_digits};
use crate::fault::{Fault, Location};

/// `gap`: distance in m and angle in rad of the closest assembly found; `nearest`: the last closed positions on the way.
pub(crate) fn start_is_open(
    location: &Location,
    (closes, touches): (&str, bool),
    gap: (f64, f64),
    nearest: &[(String, f64, &str)],
) -> Fault {
    let what = match touches {
        true => format!("`{closes}` does not touch its plane"),
        false => format!("the loop `{closes}` does not close"),
    };
    let message = format!(
        "{what} at these positions: in the closest assembly found it misses by {}",
        gap_text(gap)
    );
    let help = match nearest {
        [] => "give fewer positions, or others".to_owned(),
        _ => format!(
            "on the way from the closed position of the mechanism (`bgdyn check`) the nearest that closes is {}; give fewer positions, or others",
            positions(nearest)
        ),
    };
    Fault::new(location, "open-start", message).with_help(help)
}

pub(crate) fn start_beyond_meeting_branches(
    location: &Location,
    loops: &[String],
    at: &[(String, f64, &str)],
) -> Fault {
    let message = format!(
        "on the way to these positions two branches of the loops ({}) meet, at {}: beyond it the branch of the mechanism is not determined",
        quoted_list(loops.iter().map(String::as_str)),
        positions(at)
    );
    Fault::new(location, "other-branch", message).with_help(
        "give positions on this side of it, or choose a start beyond it in the mechanism with `near`",
    )
}

/// Returns "`crank` 0.5 rad, `slide` 0.2 m".
fn positions(of: &[(String, f64, &str)]) -> String {
    let texts: Vec<String> = (of.iter())
        .map(|(name, x, unit)| format!("`{name}` {} {unit}", six_digits(*x)))
        .collect();
    texts.join(", ")
}

pub(crate) fn start_on_other_branch(location: &Location, loops: &[String]) -> Fault {
    let names = quoted_list(loops.iter().map(String::as_str));
    let message = format!(
        "these positions are on another branch of the loops ({names}) than the mechanism, or singular"
    );
    Fault::new(location, "other-branch", message).with_help(
        "give other positions, or choose the branch of a loop in the mechanism with `branch` or `near`",
    )
}

pub(crate) fn start_contradicts(
    location: &Location,
    name: &str,
    (given, closed): (f64, f64),
    unit: &str,
) -> Fault {
    let message = format!(
        "`{name}` is {given} {unit} here, but the loops and the other values make it {closed:.6} {unit}"
    );
    Fault::new(location, "contradicting-start", message).with_help(format!(
        "leave `{name}` out, or one of the others that are given"
    ))
}

pub(crate) fn pose_contradicts(location: &Location, joint: &str) -> Fault {
    let message = format!(
        "the orientation of `{joint}` is not one at which the loops close with the other values"
    );
    Fault::new(location, "contradicting-start", message).with_help(format!(
        "leave the orientation of `{joint}` out, or others of the values that are given"
    ))
}

/// `leaders`: the joints that it follows.
pub(crate) fn initial_of_follower(
    location: &Location,
    name: &str,
    (joint, leaders): (&str, &[&str]),
) -> Fault {
    let message = follows(name, (joint, leaders));
    Fault::new(location, "initial-of-follower", message).with_help("give the start of these joints")
}

/// Returns why a joint that follows others has no start of its own.
pub(crate) fn follows(name: &str, (joint, leaders): (&str, &[&str])) -> String {
    let leaders = quoted_list(leaders.iter().copied());
    let name = quote(name);
    format!(
        "{name} is no part of the state: the joint {} follows {leaders}",
        quote(joint)
    )
}

/// `part` is by how much less than elsewhere the joint moves with the others.
pub(crate) fn start_stands_still(
    location: &Location,
    name: &str,
    (given, unit): (f64, &str),
    part: f64,
) -> Fault {
    let message = format!(
        "`{name}` is {given} {unit} here, but at these positions the joint stands still whatever the others do: it moves with them by {part:.1e} of what it does elsewhere"
    );
    Fault::new(location, "singular-start", message).with_help(format!(
        "give the velocity of another joint in place of `{name}`, or other positions"
    ))
}
