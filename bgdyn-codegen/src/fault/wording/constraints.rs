//! Messages about constraints.

use super::{quote, quoted_list, six_digits, suggestion};
use crate::fault::{Fault, Location};
use crate::unit::Dimension;

pub(crate) fn constraint_has_taken_name(location: &Location, name: &str) -> Fault {
    let message = format!(
        "{} is the name of a link, a joint, a frame or an effect already",
        quote(name)
    );
    Fault::new(location, "repeated-name", message)
        .with_help("choose another name for the constraint")
}

pub(crate) fn constraint_without_type(location: &Location, name: &str, words: &[&str]) -> Fault {
    let message = format!("the constraint {} has no `type`", quote(name));
    let words = quoted_list(words.iter().copied());
    Fault::new(location, "missing-key", message)
        .with_help(format!("add `type:` with one of {words}"))
}

pub(crate) fn unknown_constraint_type(location: &Location, word: &str, words: &[&str]) -> Fault {
    let message = format!("{} is not a type of constraint", quote(word));
    let list = format!("the types are {}", quoted_list(words.iter().copied()));
    Fault::new(location, "unknown-constraint-type", message)
        .with_help(suggestion(word, words, list))
}

pub(crate) fn constraint_without_key(
    location: &Location,
    name: &str,
    (key, about): (&str, &str),
) -> Fault {
    let message = format!("the constraint {} has no `{key}`", quote(name));
    Fault::new(location, "missing-key", message).with_help(format!("add `{key}`: {about}"))
}

pub(crate) fn unknown_constrained_joint(location: &Location, name: &str, known: &[&str]) -> Fault {
    let message = format!("no joint has the name {}", quote(name));
    let list = format!(
        "the joints of one degree of freedom are {}",
        quoted_list(known.iter().copied())
    );
    Fault::new(location, "unknown-name", message).with_help(suggestion(name, known, list))
}

pub(crate) fn constraint_on_joint(location: &Location, name: &str, keyword: &str) -> Fault {
    let message = format!(
        "{} is a {keyword} joint, and such constraints are for joints of one degree of freedom",
        quote(name)
    );
    Fault::new(location, "constraint-on-joint", message)
        .with_help("name revolute, continuous, prismatic or helical joints")
}

pub(crate) fn empty_row(location: &Location, name: &str) -> Fault {
    let message = format!("the constraint {} contains no joint", quote(name));
    Fault::new(location, "empty-row", message)
        .with_help("list at least two joints with their coefficients: `{ left: 1, right: -1 }`")
}

pub(crate) fn zero_coefficient(location: &Location, joint: &str) -> Fault {
    let message = format!("the coefficient of {} is 0", quote(joint));
    Fault::new(location, "zero-coefficient", message).with_help("leave the joint out")
}

/// `dimensions` are those of the first term and of this one.
pub(crate) fn mixed_row(
    location: &Location,
    joint: &str,
    (first, own): (Dimension, Dimension),
) -> Fault {
    let word = |dimension: Dimension| match dimension {
        Dimension::Length => "a length",
        _ => "an angle",
    };
    let message = format!(
        "the term of {} is {}, and the first term is {}",
        quote(joint),
        word(own),
        word(first)
    );
    Fault::new(location, "mixed-row", message).with_help(
        "give the coefficient a unit: `rad/m` makes a displacement an angle, `m/rad` or `mm/turn` makes an angle a displacement",
    )
}

pub(crate) fn independent_follower(location: &Location, joint: &str, leaders: &[&str]) -> Fault {
    let message = format!(
        "`{joint}` is listed as `independent`, and it has `mimic`: it follows {}",
        quoted_list(leaders.iter().copied())
    );
    Fault::new(location, "independent-follower", message)
        .with_help("write a constraint `gear` in place of `mimic`, or list another joint")
}

/// `of` is "constraint" or "loop".
pub(crate) fn row_of_independents(
    location: &Location,
    (of, name): (&str, &str),
    joints: &[&str],
) -> Fault {
    let message = format!(
        "the {of} {} relates {} only, which are all `independent`",
        quote(name),
        quoted_list(joints.iter().copied())
    );
    Fault::new(location, "too-many-independents", message).with_help(format!(
        "take one of them out of `independent`: the {of} makes it follow"
    ))
}

/// Returns the sum of rows with factors: "2 · `a` + -1 · `b`".
fn combination(rows: &[(&str, f64)]) -> String {
    let term = |(name, factor): &(&str, f64)| format!("{} · {}", six_digits(*factor), quote(name));
    rows.iter().map(term).collect::<Vec<_>>().join(" + ")
}

/// `of` is "constraint" or "loop".
pub(crate) fn dependent_row(
    location: &Location,
    (of, name): (&str, &str),
    others: &[(&str, f64)],
) -> Fault {
    let message = match others {
        [] => format!(
            "the terms of the {of} {} cancel: it says nothing",
            quote(name)
        ),
        _ => format!(
            "the {of} {} follows from others: it is {}",
            quote(name),
            combination(others)
        ),
    };
    Fault::new(location, "dependent-row", message).with_help("leave it out")
}

/// `of` is "constraint" or "loop".
pub(crate) fn contradicting_row(
    location: &Location,
    (of, name): (&str, &str),
    others: &[(&str, f64)],
    gap: f64,
) -> Fault {
    let gap = six_digits(gap);
    let message = match others {
        [] => format!(
            "the terms of the {of} {} cancel, and their sum should be {gap}",
            quote(name)
        ),
        _ => format!(
            "the {of} {} contradicts others: its coefficients are those of {}, its offset differs by {gap}",
            quote(name),
            combination(others)
        ),
    };
    Fault::new(location, "contradicting-rows", message)
        .with_help("leave one of them out, or correct an `offset`")
}

pub(crate) fn constraint_empty_range(
    location: &Location,
    leader: &str,
    [lower, upper]: [f64; 2],
) -> Fault {
    let message = format!(
        "no position of {} keeps the limits of the joints that follow it: it would be at least {} and at most {}",
        quote(leader),
        six_digits(lower),
        six_digits(upper)
    );
    Fault::new(location, "constraint-empty-range", message)
        .with_help("change a coefficient, `offset` or one of the limits")
}

/// `at` is the position that is left; `None` for rows on velocities.
/// The rows are those of constraints or loops: the word, and the name.
pub(crate) fn no_motion_left(
    location: &Location,
    joint: &str,
    rows: &[(&str, &str)],
    at: Option<f64>,
) -> Fault {
    let names = rows.iter().map(|(_, name)| *name);
    let rows = match rows {
        [(of, row)] => format!("the {of} {} leaves", quote(row)),
        _ if rows.iter().any(|(of, _)| *of == "loop") => {
            format!("{} together leave", quoted_list(names))
        }
        _ => format!("the constraints {} together leave", quoted_list(names)),
    };
    let rest = match at {
        Some(at) => format!("it is fixed at {}", six_digits(at)),
        None => "its velocity is 0".into(),
    };
    let message = format!("{rows} the joint `{joint}` no motion: {rest}");
    Fault::new(location, "no-motion-left", message)
        .with_help("make the joint `fixed`, or take one constraint away")
}

pub(crate) fn prescribed_twice(location: &Location, joint: &str, other: &str) -> Fault {
    let message = format!("the constraint `{other}` prescribes `{joint}` already");
    Fault::new(location, "prescribed-twice", message).with_help("leave one of them out")
}

pub(crate) fn prescribed_in_row(location: &Location, joint: &str, row: &str) -> Fault {
    let message = format!(
        "`{joint}` is prescribed, and the constraint {} relates it to other joints",
        quote(row)
    );
    Fault::new(location, "prescribed-row", message)
        .with_help("prescribe each of these joints in place of the relation, or none of them")
}

pub(crate) fn prescribed_follower(location: &Location, joint: &str, leaders: &[&str]) -> Fault {
    let message = format!(
        "`{joint}` is prescribed, and it has `mimic`: it follows {}",
        quoted_list(leaders.iter().copied())
    );
    Fault::new(location, "prescribed-follower", message)
        .with_help("leave `mimic` out, and give the joint the motion that it would have")
}

pub(crate) fn prescribed_leader(location: &Location, joint: &str, follower: &str) -> Fault {
    let message = format!("`{joint}` is prescribed, and `{follower}` follows it");
    Fault::new(location, "prescribed-leader", message).with_help(format!(
        "prescribe `{follower}` as well, in place of its `mimic`"
    ))
}

pub(crate) fn prescribed_independent(location: &Location, joint: &str) -> Fault {
    let message = format!("`{joint}` is prescribed, and it is listed as `independent`");
    Fault::new(location, "prescribed-independent", message)
        .with_help("take it out of `independent`: a prescribed joint has no velocity in v")
}

pub(crate) fn parameter_of_prescribed(location: &Location, name: &str, joint: &str) -> Fault {
    let message = format!(
        "the parameter {} has a name that the prescribed joint `{joint}` uses for its motion",
        quote(name)
    );
    Fault::new(location, "parameter-of-prescribed", message).with_help("choose another name")
}

pub(crate) fn prescribed_with_loops(location: &Location, joint: &str) -> Fault {
    let message = format!(
        "`{joint}` is prescribed, and the mechanism has loops, wheels or knife edges: prescribed joints beside these are not supported yet"
    );
    Fault::new(location, "prescribed-with-loops", message).with_help(
        "leave the constraint out: the effort of the joint's drive is that of inverse dynamics, if the joint is `independent`",
    )
}
