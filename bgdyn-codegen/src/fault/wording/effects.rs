//! Messages about effects: their types, their keys, the names that they refer to and define.

use super::{quoted_list, unknown_name};
use crate::fault::{Fault, Location};

// Types

pub(crate) fn effect_without_type(location: &Location, name: &str, types: &[&str]) -> Fault {
    let message = format!("the effect `{name}` has no type");
    Fault::new(location, "effect-type", message)
        .with_help(format!("add `type: …`: one of {}", types.join(", ")))
}

pub(crate) fn unknown_effect_type(location: &Location, word: &str, types: &[&str]) -> Fault {
    let all = types.join(", ");
    let message = unknown_name("type of effect", word, types, &all);
    Fault::new(location, "effect-type", message).with_help(format!("the types are {all}"))
}

pub(crate) fn type_of_mechanism_differs(
    location: &Location,
    name: &str,
    (mechanism, scene): (&str, &str),
) -> Fault {
    let message = format!("`{name}` is of type `{mechanism}` in the mechanism, not `{scene}`");
    Fault::new(location, "effect-type", message)
        .with_help("leave `type` out, or give the new effect another name")
}

// Names in a scene's list

pub(crate) fn unknown_effect(location: &Location, name: &str, known: &[&str]) -> Fault {
    let message = unknown_name("effect", name, known, &known.join(", "));
    Fault::new(location, "unknown-effect", message)
        .with_help("write a new effect with its type: `- push: { type: wrench, … }`")
}

pub(crate) fn effect_listed_twice(location: &Location, name: &str) -> Fault {
    let message = format!("the scene lists the effect `{name}` twice");
    Fault::new(location, "repeated-effect", message).with_help("leave one of them out")
}

pub(crate) fn two_of_type_at_joint(
    location: &Location,
    [first, second]: [&str; 2],
    keyword: &str,
    joint: &str,
) -> Fault {
    let message =
        format!("`{first}` and `{second}` are both of type `{keyword}` at the joint `{joint}`");
    Fault::new(location, "repeated-effect", message)
        .with_help("a joint can have one effect of this type: leave the other out")
}

// Keys and the names in their values

pub(crate) fn effect_key_missing(
    location: &Location,
    effect: &str,
    key: &str,
    about: &str,
) -> Fault {
    let message = format!("`{effect}` has no `{key}`: {about}");
    let help = match key {
        "joint" => "add `joint: …`, or `joints: all` for one effect at each joint".to_owned(),
        key => format!("add `{key}: …`"),
    };
    Fault::new(location, "missing-key", message).with_help(help)
}

pub(crate) fn joint_is_locked(location: &Location, joint: &str) -> Fault {
    let message =
        format!("the joint `{joint}` is locked in this scene, so no effect can act on it");
    Fault::new(location, "locked-joint", message)
        .with_help("leave this effect out of the scene, or do not lock the joint")
}

pub(crate) fn effect_on_prescribed(location: &Location, joint: &str) -> Fault {
    let message = format!(
        "the motion of `{joint}` is prescribed: an effect there changes no motion, only the effort of its drive"
    );
    Fault::new(location, "effect-on-prescribed", message).with_help(format!(
        "leave the effect out and add its effort to that of `drive_efforts`, or do not prescribe `{joint}`"
    ))
}

/// `kind` is the type of the joint.
pub(crate) fn no_position(
    location: &Location,
    (effect, keyword): (&str, &str),
    velocity: &str,
    kind: &str,
) -> Fault {
    let message = format!(
        "`{effect}` is a `{keyword}`, whose law reads a position; `{velocity}` is a velocity of a {kind} joint in link axes, and not the rate of any position"
    );
    Fault::new(location, "no-position", message).with_help(
        "an effect `between` two links or frames acts on any joint; dampers, friction, motors and inputs act on such velocities",
    )
}

pub(crate) fn effect_on_follower(location: &Location, joint: &str, leaders: &[String]) -> Fault {
    let names = leaders.iter().map(String::as_str);
    let message = format!(
        "`{joint}` follows {}, and has no drive of its own for this effect to act on",
        quoted_list(names)
    );
    let help = match leaders {
        [leader] => format!("write `joint: {leader}`, which has the drive of both"),
        _ => format!("let `{joint}` be one of the `independent` joints"),
    };
    Fault::new(location, "follower", message).with_help(help)
}

pub(crate) fn effect_on_dependent(location: &Location, joint: &str) -> Fault {
    let message = format!(
        "the velocity of `{joint}` follows from others through a loop: it has no drive of its own for this effect to act on"
    );
    Fault::new(location, "dependent-joint", message).with_help(format!(
        "list `{joint}` under `independent:` in the mechanism, so that another joint follows"
    ))
}

/// `keyword` is the type of the effect, which can hold its joint at rest.
pub(crate) fn hold_of_dependent(location: &Location, keyword: &str, joint: &str) -> Fault {
    let message = format!(
        "the velocity of `{joint}` follows from others through a loop, and `{keyword}` can hold a joint at rest: it acts on independent joints only"
    );
    Fault::new(location, "dependent-joint", message).with_help(format!(
        "take `coulomb_smooth` or `lugre`, which do not hold exactly, or list `{joint}` under `independent:` in the mechanism"
    ))
}

pub(crate) fn rotor_ratio_on_follower(location: &Location, joint: &str, leader: &str) -> Fault {
    let message = format!(
        "`{joint}` follows `{leader}`: a rotor there turns by its `ratio` times that of the two joints, and this `ratio` is a run-time parameter"
    );
    Fault::new(location, "follower", message).with_help(format!(
        "write a number, or `joint: {leader}` with the product of both ratios"
    ))
}

/// `keyword` is the type of the effect: a rotor, or a law that can hold its joint at rest.
pub(crate) fn effect_on_follower_of_several(
    location: &Location,
    keyword: &str,
    joint: &str,
    leaders: &[String],
) -> Fault {
    let names = leaders.iter().map(String::as_str);
    let message = format!(
        "`{joint}` follows {} together, and `{keyword}` acts on joints with a velocity of their own or that of one other joint",
        quoted_list(names)
    );
    Fault::new(location, "follower", message).with_help(format!(
        "let `{joint}` be one of the `independent` joints, so that another joint follows"
    ))
}

/// `what` is the kind of name that `key` requires: a moving joint, a hydraulic node.
pub(crate) fn unknown_reference(
    location: &Location,
    (what, word): (&str, &str),
    known: &[&str],
    (key, about): (&str, &str),
) -> Fault {
    let all = match known {
        [] => "none".to_owned(),
        known => known.join(", "),
    };
    let message = unknown_name(what, word, known, &all);
    Fault::new(location, "unknown-name", message).with_help(format!("`{key}`: {about}"))
}

/// `keys` are those of one and of several: `joint`, `joints`.
pub(crate) fn one_and_several(location: &Location, effect: &str, keys: [&'static str; 2]) -> Fault {
    let [one, several] = keys;
    let message = format!("`{effect}` has both `{one}` and `{several}`");
    Fault::new(location, rule_of(several), message).with_help("keep one of them")
}

pub(crate) fn listed_twice(location: &Location, key: &'static str, name: &str) -> Fault {
    let one = key.strip_suffix('s').unwrap_or(key);
    let message = format!("the {one} `{name}` is in the list twice");
    Fault::new(location, rule_of(key), message).with_help("leave one of them out")
}

pub(crate) fn list_of_wrong_kind(location: &Location, key: &'static str) -> Fault {
    let message = format!("`{key}` is neither `all` nor a list of {key}");
    let help = match key {
        "contacts" => {
            "write `contacts: all`, `contacts: [left_foot, right_foot]` or `contact: left_foot`"
        }
        _ => "write `joints: all`, `joints: [shoulder, elbow]` or `joint: shoulder`",
    };
    Fault::new(location, rule_of(key), message).with_help(help)
}

pub(crate) fn empty_list(location: &Location, effect: &str, key: &'static str) -> Fault {
    let message = format!("`{key}` of `{effect}` names none");
    let help = match key {
        "contacts" => "name a contact; the mechanism lists them under `contacts`",
        _ => "name a joint that moves, or leave the effect out",
    };
    Fault::new(location, rule_of(key), message).with_help(help)
}

/// Returns the rule on a key of several joints or contacts.
fn rule_of(key: &str) -> &'static str {
    match key {
        "contacts" => "effect-contacts",
        _ => "effect-joints",
    }
}

// Names that effects define

pub(crate) fn effect_has_name_of_body(location: &Location, name: &str) -> Fault {
    let message = format!("`{name}` is already the name of a joint, a link or a frame");
    Fault::new(location, "repeated-name", message)
        .with_help("give the effect another name, such as `elbow_friction`")
}

pub(crate) fn effect_has_name_of_effect(location: &Location, name: &str, other: &str) -> Fault {
    let message = format!("the effect `{other}` already uses the name `{name}`");
    Fault::new(location, "repeated-name", message).with_help(
        "the sides of a cylinder `boom` are called `boom_a` and `boom_b`: rename one of the two effects",
    )
}
