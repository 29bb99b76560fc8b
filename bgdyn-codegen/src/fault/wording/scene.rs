//! Messages about a scene: its mechanism, its locked joints, its state, its outputs, its integration.

use super::{quote, quoted_list, six_digits, unknown_name};
use crate::fault::{Fault, Location};

pub(crate) fn unknown_scene_version(location: &Location, text: &str) -> Fault {
    let message = format!("this scene is of version {text}; only version 1 is known");
    Fault::new(location, "version", message).with_help("write `scene: 1`")
}

// The mechanism

pub(crate) fn mechanism_unreadable(location: &Location, path: &str, why: &str) -> Fault {
    let message = format!("the mechanism `{path}` cannot be read: {why}");
    Fault::new(location, "no-mechanism", message)
        .with_help("write its path relative to the scene's folder")
}

pub(crate) fn moving_base(location: &Location, path: &str) -> Fault {
    let message = format!(
        "`{path}` has `base: given`: a scene computes the motion of its mechanism, the base included"
    );
    Fault::new(location, "moving-base", message).with_help(
        "take a mechanism without `base: given`; for a base that moves, a root with a joint (`floating`, `planar`, …)",
    )
}

pub(crate) fn no_inertia_in_scene(location: &Location, joint: &str) -> Fault {
    let message = format!(
        "in this scene the joint `{joint}` moves nothing that has inertia: its acceleration is undetermined"
    );
    Fault::new(location, "no-inertia", message)
        .with_help(
            "add the effect `inertia` or a rotor, or lock the joint; `inverse` can be used as it is",
        )
        .into_warning()
}

pub(crate) fn unknown_locked_joint(location: &Location, name: &str, joints: &[&str]) -> Fault {
    let message = unknown_name("moving joint", name, joints, &joints.join(", "));
    Fault::new(location, "unknown-name", message)
        .with_help("`lock` takes joints and the positions that they keep: `wrist: 30 deg`")
}

/// `why` is the message of a fault of the mechanism with locked joints.
pub(crate) fn locks_contradict(location: &Location, joints: &[&str], why: &str) -> Fault {
    let names = quoted_list(joints.iter().copied());
    let message = format!("the loops of the mechanism do not allow {names} to be locked: {why}");
    Fault::new(location, "locks-contradict", message)
        .with_help("lock fewer joints: those that the loops hold then are locked with them")
}

pub(crate) fn lock_of_follower(location: &Location, joint: &str, leaders: &[String]) -> Fault {
    let leaders = quoted_list(leaders.iter().map(String::as_str));
    let message = format!("`{joint}` follows {leaders}");
    Fault::new(location, "follower", message).with_help(format!(
        "lock {leaders}: joints that follow locked ones are locked with them"
    ))
}

/// `constraints` are loops or joints, the others the method of the scene and the same on velocities.
pub(crate) fn canonical_of_constraints(
    location: &Location,
    constraints: &[&str],
    (name, natural): (&str, &str),
) -> Fault {
    let message = format!(
        "`{name}` integrates momenta, and scenes with constraints ({}) have no canonical form yet",
        quoted_list(constraints.iter().copied())
    );
    Fault::new(location, "canonical-of-constraints", message)
        .with_help(format!("write `{natural}`: the same method on velocities"))
}

pub(crate) fn effect_beyond_prescribed(
    location: &Location,
    (effect, keyword): (&str, &str),
    site: &str,
    joint: &str,
) -> Fault {
    let message = format!(
        "`{effect}` is a `{keyword}` at `{site}`, which the prescribed joint `{joint}` moves: scenes do not compute the effort of its drive against such effects yet"
    );
    Fault::new(location, "effect-beyond-prescribed", message).with_help(format!(
        "leave the effect out, lock `{joint}`, or take a mechanism in which it is free, with a controller as its input"
    ))
}

/// `names` are the method of the scene and the same on velocities.
pub(crate) fn canonical_of_prescribed(
    location: &Location,
    joint: &str,
    (name, natural): (&str, &str),
) -> Fault {
    let message = format!(
        "`{name}` integrates momenta, and the motion of `{joint}` is prescribed: the canonical form has no such joints"
    );
    Fault::new(location, "canonical-prescribed", message)
        .with_help(format!("write `method: {natural}`"))
}

pub(crate) fn rate_of_prescribed(location: &Location, name: &str, joint: &str) -> Fault {
    let message = format!("`{name}` follows from the motion of the prescribed joint `{joint}`");
    Fault::new(location, "rate-of-prescribed", message).with_help(format!(
        "give the course of `{joint}` only; with `{joint}: given` the caller gives its rate and acceleration too"
    ))
}

pub(crate) fn prescribed_with_corners(location: &Location, joint: &str, step: bool) -> Fault {
    let what = match step {
        true => "a step, or contains one: it jumps",
        false => "a table, or contains one: its velocity jumps at every point",
    };
    let message = format!(
        "the course of the prescribed joint `{joint}` is {what}, which takes an infinite effort"
    );
    Fault::new(location, "prescribed-with-corners", message).with_help(
        "write `constant`, `ramp`, `harmonic`, `sum`, `trapezoidal` or `quintic`, or `given` with position, rate and acceleration from Rust code",
    )
}

pub(crate) fn lock_of_several(location: &Location, joint: &str, kind: &str) -> Fault {
    let message = format!(
        "`{joint}` is a {kind} joint: `lock` takes joints of one degree of freedom, with their position"
    );
    Fault::new(location, "lock-of-several", message)
        .with_help("for this scene write a mechanism in which the joint is `fixed`")
}

// The state and its start

pub(crate) fn repeated_state_or_input(location: &Location, name: &str) -> Fault {
    let message = format!("two state variables or two inputs are called `{name}`");
    Fault::new(location, "repeated-name", message)
        .with_help("give one of the effects or inputs another name")
}

/// `joint` is an example of a joint that begins with a pose, if there is one.
pub(crate) fn unknown_initial(
    location: &Location,
    name: &str,
    known: &[&str],
    joint: Option<&str>,
) -> Fault {
    let message = unknown_name("state variable", name, known, &known.join(", "));
    let fault = Fault::new(location, "unknown-name", message);
    match joint {
        None => fault.with_help("a position is called as its joint, a velocity `shoulder_rate`"),
        Some(joint) => fault.with_help(format!(
            "the position of a joint of one degree is called as the joint, its velocity `shoulder_rate`; a \
             spherical or floating joint begins with a pose: `{joint}: {{ rpy: [0, 0, 90 deg] }}`"
        )),
    }
}

pub(crate) fn position_twice(location: &Location, position: &str, joint: &str) -> Fault {
    let message = format!("`{position}` is also part of the pose of `{joint}`");
    Fault::new(location, "initial", message).with_help("leave one of them out")
}

pub(crate) fn unknown_pose_key(location: &Location, key: &str, known: &[&str]) -> Fault {
    let message = unknown_name("key of a pose", key, known, &known.join(", "));
    Fault::new(location, "unknown-key", message)
        .with_help("`xyz` is the origin of the link in the joint's origin; `rpy` or `quaternion` (x, y, z, w) turns its axes")
}

pub(crate) fn orientation_twice(location: &Location, joint: &str) -> Fault {
    let message = format!("`rpy` and `quaternion` both give the orientation of `{joint}`");
    Fault::new(location, "initial", message).with_help("leave one of them out")
}

pub(crate) fn not_so_many_numbers(
    location: &Location,
    found: usize,
    wanted: usize,
    example: &str,
) -> Fault {
    let message = format!("a list of {found} numbers; {wanted} are needed");
    Fault::new(location, "initial", message).with_help(format!("for example {example}"))
}

/// Returns what is wrong with a quaternion of this length. `any` if every length but 0 is an orientation.
pub(crate) fn length_of_quaternion(joint: &str, any: bool, length: f64) -> String {
    let rule = match any {
        true => "with `quaternion: any` every length but 0 is an orientation",
        false => "the length of an orientation is 1, within 1e-6",
    };
    let length = six_digits(length);
    format!("the quaternion of `{joint}` has the length {length}; {rule}")
}

pub(crate) fn quaternion_length(location: &Location, joint: &str, any: bool, length: f64) -> Fault {
    let scaled = if any || length == 0.0 {
        ""
    } else {
        "divide its components by the length, or "
    };
    let message = length_of_quaternion(joint, any, length);
    Fault::new(location, "quaternion-length", message).with_help(format!(
        "{scaled}write the angles: `{joint}: {{ rpy: [0, 0, 90 deg] }}`"
    ))
}

/// `part` is the share of the way from the mechanism's own position up to which the loops close.
/// `natural` is the same method on velocities.
pub(crate) fn canonical_of_quasi_velocities(
    location: &Location,
    method: &str,
    joint: &str,
    natural: &str,
) -> Fault {
    let message = format!(
        "`{method}` integrates momenta; those of the joint `{joint}` belong to quasi-velocities and are not canonical: their equations are Lie–Poisson, on which the method is not symplectic"
    );
    Fault::new(location, "canonical-form", message).with_help(format!(
        "use `{natural}`, which conserves the length of quaternions"
    ))
}

/// `value` and `least` with their units.
pub(crate) fn initial_below_least(
    location: &Location,
    name: &str,
    (value, least): (&str, &str),
    way_out: &str,
) -> Fault {
    let message = format!("`{name}` starts at {value}, which is less than {least}");
    Fault::new(location, "initial", message).with_help(way_out)
}

/// The two values and their units.
pub(crate) fn parameter_twice(location: &Location, name: &str, values: [(f64, &str); 2]) -> Fault {
    let [first, second] = values.map(|(x, unit)| format!("{} {unit}", six_digits(x)));
    let message = format!(
        "the parameter `{name}` has two values: {} and {}",
        first.trim_end(),
        second.trim_end()
    );
    Fault::new(location, "parameter-twice", message).with_help("give one of them another name")
}

// Outputs

pub(crate) fn unknown_output(location: &Location, name: &str, known: &[&str]) -> Fault {
    let message = unknown_name("output", name, known, &known.join(", "));
    Fault::new(location, "unknown-output", message).with_help(
        "an output is a state variable, a link, a frame, or a quantity that an effect reports",
    )
}

// Integration

pub(crate) fn no_step_control(location: &Location, method: &str, controlled: &[&str]) -> Fault {
    let message = format!("`{method}` takes steps of constant length: it has no `tolerance`");
    Fault::new(location, "integration", message).with_help(format!(
        "write `step: 1 ms`, or choose one of {}",
        controlled.join(", ")
    ))
}

pub(crate) fn step_and_tolerance(location: &Location, method: &str) -> Fault {
    let message = format!("`{method}` takes a `step` or a `tolerance`, not both");
    Fault::new(location, "integration", message).with_help("leave one of them out")
}

pub(crate) fn integration_not_positive(
    location: &Location,
    key: &str,
    text: &str,
    example: &str,
) -> Fault {
    let rule = match key {
        "tolerance" => "integration",
        _ => "time",
    };
    let message = format!("`{key}` is {text}: it must be greater than 0");
    Fault::new(location, rule, message).with_help(format!("write {example}"))
}

pub(crate) fn unknown_integrator(location: &Location, word: &str, known: &[&str]) -> Fault {
    let message = unknown_name("integration method", word, known, &known.join(", "));
    Fault::new(location, "unknown-name", message).with_help("leave `method` out for `rk4`")
}

pub(crate) fn unknown_impact_law(location: &Location, word: &str, known: &[&str]) -> Fault {
    let message = unknown_name("law of impacts", word, known, &known.join(", "));
    Fault::new(location, "unknown-name", message).with_help("leave `impacts` out for `newton`")
}

pub(crate) fn impacts_without_contacts(location: &Location) -> Fault {
    let message = "`impacts` is a law for rigid contacts: the scene has none".to_owned();
    Fault::new(location, "integration", message)
        .with_help("leave `impacts` out, or write an effect `rigid_contact`")
}

pub(crate) fn impacts_of_time_stepping(location: &Location, method: &str) -> Fault {
    let message = format!("`{method}` has Newton's law at impacts, and `impacts` is another");
    Fault::new(location, "integration", message).with_help(
        "leave `impacts` out, or choose a `method` that goes from event to event, such as `dop853`",
    )
}

// Overrides

/// `what` is the kind of value that is looked for; the scene has none.
pub(crate) fn no_such_override(what: &str, name: &str) -> String {
    format!("no {what} is called {}: the scene has none", quote(name))
}

pub(crate) fn ambiguous_override(name: &str) -> String {
    let name = quote(name);
    format!("{name} is a part of the state and a parameter: rename the parameter")
}
