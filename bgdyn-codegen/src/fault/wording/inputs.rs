//! Messages about a scene's inputs: signals, controllers, tables.

use super::scene::length_of_quaternion;
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

/// `followed` are the joints in loops with computed torques, `ways` the independent joints that move them and have none.
pub(crate) fn followed_joints_do_not_fit(
    location: &Location,
    followed: &[&str],
    ways: &[&str],
) -> Fault {
    let (number, names) = (followed.len(), followed.join("`, `"));
    let moved = match ways {
        [] => "no independent joint that is not followed itself".to_owned(),
        ways => format!("the independent joints `{}`", ways.join("`, `")),
    };
    let message = format!(
        "`computed_torque` of {number} {} in loops, `{names}`: {moved} move {}, {} velocities",
        if number == 1 { "joint" } else { "joints" },
        if number == 1 { "it" } else { "them" },
        ways.len()
    );
    let help = match ways.len().checked_sub(number) {
        Some(more) => format!(
            "the motion is undetermined: follow {more} more of these joints, independent or not; or use `pd`, which follows one joint alone"
        ),
        None => format!(
            "the targets contradict each other: leave {} of them out",
            number - ways.len()
        ),
    };
    Fault::new(location, "followed-joints", message).with_help(help)
}

/// `rank` is the number of independent joints whose motion is determined.
pub(crate) fn followed_joints_do_not_determine(
    location: &Location,
    (followed, ways): (&[&str], &[&str]),
    rank: usize,
) -> Fault {
    let message = format!(
        "the joints `{}` with `computed_torque` determine {rank} of the {} independent velocities `{}` at closed positions: the motion of some follows from that of others",
        followed.join("`, `"),
        ways.len(),
        ways.join("`, `")
    );
    Fault::new(location, "followed-joints", message)
        .with_help("follow other joints of the loops, or independent ones")
}

pub(crate) fn controller_without_joint(location: &Location, word: &str) -> Fault {
    let message = format!("`{word}` controls the position of a joint, and this input has no joint");
    Fault::new(location, "drive", message)
        .with_help("use `constant`, `harmonic`, `table` or `given`")
}

pub(crate) fn controller_of_dependent(location: &Location, velocity: &str) -> Fault {
    let message = format!(
        "a controller follows a position, and `{velocity}` is a velocity in link axes that follows from others: no position has it as its rate"
    );
    Fault::new(location, "drive", message).with_help(
        "control independent joints, or write `given` and compute the effort in Rust code",
    )
}

pub(crate) fn hold_of_constrained(location: &Location, joint: &str) -> Fault {
    let message = format!(
        "some velocities of `{joint}` follow from others through constraints: a controller cannot hold its pose"
    );
    Fault::new(location, "drive", message)
        .with_help("drive the efforts of single velocities, by their names in `JOINT_NAMES`")
}

/// `joint` is the joint of the velocity.
pub(crate) fn controller_of_quasi_velocity(
    location: &Location,
    velocity: &str,
    joint: &str,
) -> Fault {
    let message = format!(
        "a controller follows a position, and `{velocity}` is a velocity in link axes: no position has it as its rate"
    );
    Fault::new(location, "drive", message).with_help(format!(
        "write `{joint}: {{ hold: … }}`, which holds the pose of the joint; or `given`, and compute the effort in Rust code: `difference` of the mechanism is the error of a pose"
    ))
}

pub(crate) fn controller_without_target(location: &Location) -> Fault {
    Fault::new(location, "missing-key", "the controller has no `target`")
        .with_help("add `target: …`: a number, or a signal such as `{ ramp: … }`")
}

// Holds of poses

pub(crate) fn hold_of_one_degree(location: &Location) -> Fault {
    let message = "`hold` holds the pose of a planar, spherical or floating joint, by the joint's name; this input is a single effort";
    Fault::new(location, "drive", message)
        .with_help("use `pd` for the effort of a joint of one degree of freedom")
}

/// `first` is the first of its efforts.
pub(crate) fn not_a_hold(
    location: &Location,
    (joint, kind): (&str, &str),
    first: &str,
    example: &str,
) -> Fault {
    let message = format!(
        "`{joint}` is a {kind} joint with several efforts; the only source for all of them is `hold`"
    );
    let example = example.trim_matches('`');
    Fault::new(location, "drive", message).with_help(format!(
        "write `{joint}: {{ hold: {example} }}`, or drive each effort by its name: `{first}: …`"
    ))
}

pub(crate) fn hold_of_nothing(location: &Location, known: &[&str]) -> Fault {
    let known = known.join("`, `");
    Fault::new(location, "missing-key", "the joint is held at nothing")
        .with_help(format!("add one or more of `{known}`"))
}

pub(crate) fn unknown_part_of_pose(
    location: &Location,
    key: &str,
    (joint, kind): (&str, &str),
    known: &[&str],
) -> Fault {
    let message = unknown_name("part of the pose", key, known, &known.join(", "));
    Fault::new(location, "unknown-key", message).with_help(format!(
        "`{joint}` is a {kind} joint: it holds {}",
        known.join(" and ")
    ))
}

pub(crate) fn hold_without_key(location: &Location, part: &str, key: &str) -> Fault {
    let message = format!("`{part}` has no `{key}`");
    let help = match (key, part) {
        ("target", "attitude") => {
            "add `target: { rpy: [0, 0, 90 deg] }` or `target: { quaternion: [0, 0, 0, 1] }`"
        }
        ("target", "position") => "add `target: […]`: a number or a signal for each axis",
        ("target", _) => "add `target: …`: a number or a signal",
        _ => "add `stiffness: …`: a number, or a list with one for each axis",
    };
    Fault::new(location, "missing-key", message).with_help(help)
}

pub(crate) fn not_one_orientation(location: &Location) -> Fault {
    Fault::new(
        location,
        "drive",
        "the target of an attitude is one orientation",
    )
    .with_help("write `{ rpy: [0, 0, 90 deg] }` or `{ quaternion: [0, 0, 0, 1] }`")
}

pub(crate) fn target_of_other_length(
    location: &Location,
    found: usize,
    wanted: usize,
    example: &str,
) -> Fault {
    let message = format!("a list of {found}; {wanted} are needed");
    Fault::new(location, "drive", message).with_help(format!("for example {example}"))
}

pub(crate) fn target_quaternion_length(
    location: &Location,
    joint: &str,
    any: bool,
    length: f64,
) -> Fault {
    let message = length_of_quaternion(joint, any, length);
    Fault::new(location, "quaternion-length", message)
        .with_help("write the angles: `target: { rpy: [0, 0, 90 deg] }`")
}

pub(crate) fn negative_gain(location: &Location, key: &str, text: &str) -> Fault {
    let message = format!("`{key}` is {text}: it must not be negative");
    let why = match key {
        "damping" => "a negative damping would drive the motion",
        _ => "a negative stiffness pushes away from the target",
    };
    Fault::new(location, "drive", message).with_help(why)
}

pub(crate) fn input_held_too(location: &Location, input: &str, joint: &str) -> Fault {
    let message = format!("`{input}` has a source, and the `hold` of `{joint}` is another one");
    Fault::new(location, "drive", message).with_help("leave one of them out")
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

pub(crate) fn empty_sum(location: &Location) -> Fault {
    Fault::new(location, "drive", "the sum has no terms")
        .with_help("write `[0.3, { harmonic: { amplitude: 2, frequency: 1 Hz } }]`")
}

// Integral parts and limits

pub(crate) fn pid_without_integral(location: &Location) -> Fault {
    Fault::new(location, "missing-key", "`pid` has no `integral`")
        .with_help("add `integral: …`, the gain of the integral part; or use `pd`")
}

pub(crate) fn anti_windup_not_positive(location: &Location, text: &str) -> Fault {
    let message = format!("`anti_windup` is {text}: it must be positive");
    Fault::new(location, "drive", message)
        .with_help("it is the time in which the integral part follows a limit, such as `0.2 s`")
}

pub(crate) fn pid_without_anti_windup(location: &Location, name: &str) -> Fault {
    let message = format!(
        "the effort of `{name}` is limited, and its `pid` has no positive ratio stiffness/integral from which the time of `anti_windup` would follow"
    );
    Fault::new(location, "missing-key", message).with_help("add `anti_windup: 0.2 s`")
}

pub(crate) fn not_a_limit(location: &Location, least: f64, most: f64) -> Fault {
    let message =
        format!("the limits are {least} and {most}: the first must be less than the second");
    Fault::new(location, "limit", message)
        .with_help("write a positive number, `limit: 20`, or both limits, `limit: [-5, 20]`")
}

pub(crate) fn limit_beyond_effort(
    location: &Location,
    [low, high]: [f64; 2],
    effort: f64,
) -> Fault {
    let message = format!(
        "no value is within the limits {low} … {high} and within the effort {effort} of the joint in the mechanism's file"
    );
    Fault::new(location, "limit", message)
        .with_help("write limits that reach into that range, or leave `effort_limits` out")
}

pub(crate) fn limit_without_effort(location: &Location, name: &str) -> Fault {
    let message = format!("`{name}` is not what a drive gives: it has no `limit`");
    Fault::new(location, "limit", message)
        .with_help("limits are for efforts of joints, voltages of motors and openings of valves")
}

pub(crate) fn no_effort_limits(location: &Location) -> Fault {
    let message = "`effort_limits` is true, and no joint of which the effort is an input has `limits: { effort: … }`";
    Fault::new(location, "limit", message)
        .with_help("add limits to the mechanism, or `limit: …` to inputs of the scene")
}

pub(crate) fn not_a_truth(location: &Location, key: &str) -> Fault {
    let message = format!("`{key}` is true or false");
    Fault::new(location, "wrong-type", message).with_help("leave the key out for false")
}

// Motions from point to point

pub(crate) fn profile_not_positive(location: &Location, key: &str, text: &str) -> Fault {
    let message = format!("`{key}` is {text}: it must be positive");
    profile(
        location,
        message,
        "the sign of the motion is that of `to` minus `from`",
    )
}

pub(crate) fn profile(location: &Location, message: String, way_out: &str) -> Fault {
    Fault::new(location, "profile", message).with_help(way_out)
}
