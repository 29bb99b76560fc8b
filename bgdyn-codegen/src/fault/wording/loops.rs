//! Messages about loops.

use super::{quote, quoted_list, six_digits, suggestion};
use crate::fault::{Fault, Location};

pub(crate) fn loop_has_taken_name(location: &Location, name: &str) -> Fault {
    let message = format!(
        "{} is the name of a link, a joint, a frame, a constraint, an effect or another loop already",
        quote(name)
    );
    Fault::new(location, "repeated-name", message).with_help("choose another name for the loop")
}

pub(crate) fn unknown_loop_type(location: &Location, word: &str, words: &[&str]) -> Fault {
    let message = format!("{} is not a type of loop", quote(word));
    let list = format!("the types are {}", quoted_list(words.iter().copied()));
    Fault::new(location, "unknown-loop-type", message).with_help(suggestion(word, words, list))
}

pub(crate) fn loop_end_missing(location: &Location) -> Fault {
    Fault::new(
        location,
        "missing-key",
        "the place has neither `link` nor `frame`",
    )
    .with_help("write `{ link: …, origin: { xyz: [x, y, z] } }`, or `{ frame: … }`")
}

pub(crate) fn loop_end_twice(location: &Location) -> Fault {
    Fault::new(
        location,
        "place-twice",
        "the place has a `link` and a `frame`",
    )
    .with_help("leave one of them out: a frame is on a link already")
}

pub(crate) fn unknown_frame(location: &Location, name: &str, known: &[&str]) -> Fault {
    let message = format!("no frame has the name {}", quote(name));
    let list = match known {
        [] => "the file has no frames: name a `link`".to_owned(),
        _ => format!("the frames are {}", quoted_list(known.iter().copied())),
    };
    Fault::new(location, "unknown-frame", message).with_help(suggestion(name, known, list))
}

pub(crate) fn loop_closes_nothing(location: &Location, name: &str) -> Fault {
    let message = format!("the loop {} connects two places of one link", quote(name));
    Fault::new(location, "closes-nothing", message)
        .with_help("name places on two links that move relative to each other")
}

pub(crate) fn loop_through_joint(
    location: &Location,
    name: &str,
    joint: &str,
    keyword: &str,
) -> Fault {
    let message = format!(
        "the loop {} goes through {}, a {keyword} joint whose velocity alone follows others by a constraint of type `linear`: its position is no function of theirs",
        quote(name),
        quote(joint)
    );
    Fault::new(location, "loop-through-joint", message)
        .with_help("write `type: gear`, a relation of positions, or close the loop elsewhere")
}

pub(crate) fn rod_without_length(location: &Location) -> Fault {
    Fault::new(
        location,
        "missing-key",
        "a loop of type `distance` has no `length`",
    )
    .with_help("add `length:`, the length of the rod")
}

pub(crate) fn rod_length(location: &Location, text: &str) -> Fault {
    let message = format!("the length of the rod is {text}");
    Fault::new(location, "length-not-positive", message).with_help("write a positive length")
}

pub(crate) fn loop_key_unused(location: &Location, key: &str, keyword: &str, of: &str) -> Fault {
    let message = format!("a loop of type `{keyword}` has no `{key}`");
    Fault::new(location, "unused-key", message)
        .with_help(format!("leave it out: `{key}` belongs to `{of}`"))
}

pub(crate) fn unknown_branch(location: &Location, word: &str) -> Fault {
    let message = format!("{} is not a branch", quote(word));
    let help = "write `left` or `right`: the side of the line from the joint of a's link to the joint of b's link on which the places lie; `parallel` or `crossed` for a parallelogram; or give positions on the branch with `near`";
    Fault::new(location, "unknown-branch", message).with_help(help)
}

/// `branch` is "parallel" or "crossed".
pub(crate) fn parallelogram_without_pin(
    location: &Location,
    (name, branch): (&str, &str),
    keyword: &str,
) -> Fault {
    let message = format!(
        "the loop {} has the branch `{branch}`, and the type `{keyword}`",
        quote(name)
    );
    Fault::new(location, "not-a-parallelogram", message).with_help(
        "parallelograms are closed by `type: hinge`, or by `type: point` in a plane; leave `branch` out for other loops",
    )
}

pub(crate) fn parallelogram_with_joint(
    location: &Location,
    (name, branch): (&str, &str),
    (joint, keyword): (&str, &str),
) -> Fault {
    let message = format!(
        "the loop {} has the branch `{branch}`, and goes through {}, a {keyword} joint",
        quote(name),
        quote(joint)
    );
    Fault::new(location, "not-a-parallelogram", message)
        .with_help("the joints of a parallelogram are revolute; leave `branch` out for other loops")
}

pub(crate) fn parallelogram_axes(location: &Location, (name, branch): (&str, &str)) -> Fault {
    let message = format!(
        "the loop {} has the branch `{branch}`, and its axes are not parallel",
        quote(name)
    );
    Fault::new(location, "not-a-parallelogram", message).with_help(
        "a parallelogram has revolute joints with parallel axes, and with `hinge` the `axis` of both places points the same way; leave `branch` out for other loops",
    )
}

pub(crate) fn not_a_parallelogram(
    location: &Location,
    (name, branch): (&str, &str),
    sides: &[f64],
) -> Fault {
    let message = format!(
        "the loop {} has the branch `{branch}`, and is no parallelogram: its sides are {}",
        quote(name),
        lengths(sides)
    );
    Fault::new(location, "not-a-parallelogram", message).with_help(
        "correct the places, so that opposite sides are equal; or write `branch: left` or `branch: right`, or leave it out",
    )
}

pub(crate) fn rounded_parallelogram(
    location: &Location,
    (name, branch): (&str, &str),
    (sides, differences): (&[f64], &[f64]),
) -> Fault {
    let differences: Vec<String> = (differences.iter())
        .map(|x| format!("{} m", six_digits(*x)))
        .collect();
    let message = format!(
        "the loop {} has the branch `{branch}`, and is almost a parallelogram: opposite ones of its sides {} differ, by {}",
        quote(name),
        lengths(sides),
        differences.join(" and ")
    );
    Fault::new(location, "not-a-parallelogram", message).with_help(
        "lengths seem to be rounded: write them exactly (the same digits, fractions of pi for angles); or write `branch: left` or `branch: right`, and the loop closes as it is",
    )
}

pub(crate) fn crossed_rhombus(location: &Location, name: &str, [a, b]: [f64; 2]) -> Fault {
    let message = format!(
        "the loop {} has the branch `crossed`, and all its sides are equal: {}",
        quote(name),
        lengths(&[a, b, a, b])
    );
    Fault::new(location, "crossed-rhombus", message).with_help(
        "on that branch links lie on each other: write `branch: parallel`, or make two opposite sides longer",
    )
}

pub(crate) fn parallel_with_key(location: &Location, key: &str) -> Fault {
    let message = format!("a loop with `branch: parallel` has no `{key}`");
    Fault::new(location, "unused-key", message).with_help(
        "leave it out: the branch is that on which opposite sides stay parallel, at every position and exactly",
    )
}

/// Returns "0.4, 0.3, 0.4 and 0.2 m".
fn lengths(sides: &[f64]) -> String {
    let all: Vec<String> = sides.iter().map(|side| six_digits(*side)).collect();
    match all.split_last() {
        None => "all zero".into(),
        Some((last, [])) => format!("{last} m"),
        Some((last, others)) => format!("{} and {last} m", others.join(", ")),
    }
}

pub(crate) fn branch_of_spatial_loop(location: &Location) -> Fault {
    let message =
        "only loops with parallel axes, between two moving links, have a left and a right branch";
    Fault::new(location, "branch-of-spatial-loop", message)
        .with_help("give positions on the branch: `near: { elbow: 30 deg }`")
}

/// `unit` is empty for a number without one.
pub(crate) fn loop_row_never_holds(
    location: &Location,
    (name, row): (&str, &str),
    (value, unit): (f64, &str),
) -> Fault {
    let measured = format!("{} {unit}", six_digits(value));
    let message = format!(
        "the loop {} can never close: its row `{row}` is {} at every position of the joints",
        quote(name),
        measured.trim_end()
    );
    Fault::new(location, "loop-never-closes", message)
        .with_help("correct the places: `origin` and `axis` of `a` and `b`, or the origins of the joints in the loop; a gap of rounded lengths may be within a `tolerance`")
}

pub(crate) fn redundant_word(location: &Location, word: &str) -> Fault {
    let message = format!("{} is not a value of `redundant`", quote(word));
    Fault::new(location, "redundant-word", message)
        .with_help("write `redundant: allow`, or leave it out")
}

/// `counts`: velocities of the joints in loops, rows that are independent somewhere, rows at closed positions.
pub(crate) fn paradoxical_loop(
    location: &Location,
    (name, rows): (&str, &[String]),
    (moving, off, on): (usize, usize, usize),
) -> Fault {
    let message = format!(
        "the loop {} moves by its lengths only (paradoxical): {moving} velocities less {off} rows would leave {}, and at closed positions {} move, because {} from others there",
        quote(name),
        moving.saturating_sub(off),
        moving.saturating_sub(on),
        match rows {
            [one] => format!("the row `{one}` follows"),
            _ => format!(
                "the rows {} follow",
                quoted_list(rows.iter().map(String::as_str))
            ),
        }
    );
    Fault::new(location, "paradoxical-loop", message).with_help(
        "nothing, if that is meant: these rows are left out, and their forces are not determined",
    )
}

pub(crate) fn dependent_loop_row(
    location: &Location,
    (name, row): (&str, &str),
    others: &[(String, f64)],
) -> Fault {
    let terms = others
        .iter()
        .map(|(name, factor)| format!("{} · `{name}`", six_digits(*factor)));
    let terms: Vec<String> = terms.collect();
    let message = match terms.as_slice() {
        [] => format!("the row `{row}` of the loop {} moves no joint", quote(name)),
        _ => format!(
            "the row `{row}` of the loop {} follows from other rows: at the start it is {}",
            quote(name),
            terms.join(" + ")
        ),
    };
    Fault::new(location, "dependent-row", message).with_help(
        "choose a type of loop with fewer rows (`point` in place of `hinge`), or free a joint; or write `redundant: allow` in the loop: such rows are then left out, and their forces are not determined",
    )
}

pub(crate) fn nothing_left_to_move(location: &Location, rows: usize, joints: usize) -> Fault {
    let message =
        format!("nothing is left to move: the loops have {rows} rows for {joints} velocities");
    Fault::new(location, "nothing-left-to-move", message).with_help("remove a loop, or add a joint")
}

pub(crate) fn too_many_independents(location: &Location, listed: &[&str], most: usize) -> Fault {
    let message = format!(
        "{} joints of the loops are listed as `independent` ({}), and the loops leave {most}",
        listed.len(),
        quoted_list(listed.iter().copied())
    );
    Fault::new(location, "too-many-independents", message).with_help("shorten the list")
}

pub(crate) fn independents_do_not_determine(location: &Location, listed: &[&str]) -> Fault {
    let message = match listed {
        [] => "no choice of independent joints determines the others".to_owned(),
        _ => format!(
            "the independent joints {} do not determine the others",
            quoted_list(listed.iter().copied())
        ),
    };
    Fault::new(location, "independents-do-not-determine", message)
        .with_help("list other joints as `independent`")
}
