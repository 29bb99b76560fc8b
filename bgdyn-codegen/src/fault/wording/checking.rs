//! Messages about a mechanism: names, the tree, joints, masses, directions.

use super::{quote, quoted_list, six_digits, suggestion};
use crate::fault::{Fault, Location};
use crate::name::{is_keyword, to_identifier};
use crate::unit::Dimension;

// Names

pub(crate) fn not_identifier(location: &Location, name: &str) -> Fault {
    let why = if is_keyword(name) {
        "a keyword of Rust"
    } else {
        "not a snake_case identifier"
    };
    let help = match to_identifier(name) {
        Some(better) => format!(
            "call it {}; `label` can keep the other name",
            quote(&better)
        ),
        None => "use letters a–z, digits and single `_`, a letter first".to_owned(),
    };
    Fault::new(location, "name", format!("{} is {why}", quote(name))).with_help(help)
}

pub(crate) fn world_is_reserved(location: &Location) -> Fault {
    Fault::new(
        location,
        "reserved-name",
        "`world` is the name of the fixed base",
    )
    .with_help("choose another name; a link without `parent` is attached to the world")
}

pub(crate) fn repeated_name(
    location: &Location,
    name: &str,
    what: &str,
    first: &Location,
) -> Fault {
    let message = format!(
        "the name {} is already used; names are unique among {what}",
        quote(name)
    );
    let (path, line) = (&first.path, first.position.line);
    Fault::new(location, "repeated-name", message).with_help(format!(
        "`{path}` on line {line} has this name; choose another"
    ))
}

pub(crate) fn repeated_mount(location: &Location, name: &str, first: &Location) -> Fault {
    let message = format!(
        "this link's joint is called {} by default, and another joint has that name",
        quote(name)
    );
    let (path, line) = (&first.path, first.position.line);
    Fault::new(location, "repeated-name", message).with_help(format!(
        "`{path}` on line {line} has this name; give one of the joints another `name`"
    ))
}

pub(crate) fn no_name(location: &Location) -> Fault {
    Fault::new(
        location,
        "no-name",
        "there is no name: the text comes from no file and has no key `name`",
    )
    .with_help("add `name: my_arm`")
}

pub(crate) fn taken_name(location: &Location, name: &str) -> Fault {
    let message = format!(
        "the mechanism {} would give the struct `T`, the name of its own type parameter",
        quote(name)
    );
    Fault::new(location, "name", message).with_help("write a longer name: `t_arm`")
}

pub(crate) fn stem_not_identifier(location: &Location, stem: &str) -> Fault {
    let why = if is_keyword(stem) {
        "a keyword of Rust"
    } else {
        "not a snake_case identifier"
    };
    let message = format!(
        "the mechanism takes its name from the file, but {} is {why}",
        quote(stem)
    );
    let fault = Fault::new(location, "name", message);
    match to_identifier(stem) {
        Some(better) => fault.with_help(format!("rename the file to `{better}.yaml`")),
        None => fault.with_help("rename the file"),
    }
}

pub(crate) fn name_differs_from_file(location: &Location, name: &str, stem: &str) -> Fault {
    let message = format!(
        "the name is {}, but the file is called {}",
        quote(name),
        quote(stem)
    );
    Fault::new(location, "name-differs-from-file", message).with_help(format!(
        "rename the file to `{name}.yaml`, or leave `name` out"
    ))
}

// Run-time parameters

pub(crate) fn parameter_not_identifier(location: &Location, name: &str) -> Fault {
    let fault = not_identifier(location, name);
    match to_identifier(name) {
        Some(better) => fault.with_help(format!("call it {}", quote(&better))),
        None => fault,
    }
}

pub(crate) fn parameter_is_method(location: &Location, name: &str) -> Fault {
    let message = format!("{} is a method of the generated struct", quote(name));
    Fault::new(location, "reserved-name", message)
        .with_help("a parameter becomes a field next to the methods: choose another name")
}

pub(crate) fn parameter_has_two_values(
    location: &Location,
    name: &str,
    (here, there): (&str, &str),
    first: &Location,
) -> Fault {
    let (path, line) = (&first.path, first.position.line);
    let message = format!(
        "the parameter {} is {here} here and {there} at `{path}` on line {line}",
        quote(name)
    );
    Fault::new(location, "parameter-conflict", message)
        .with_help("one name is one number: write the same value, or choose another name")
}

pub(crate) fn parameter_measures_two(
    location: &Location,
    name: &str,
    (here, there): (Dimension, Dimension),
    first: &Location,
) -> Fault {
    let (path, line) = (&first.path, first.position.line);
    let message = format!(
        "the parameter {} is {here} here and {there} at `{path}` on line {line}",
        quote(name)
    );
    Fault::new(location, "parameter-conflict", message)
        .with_help("one name is one number: choose another name")
}

// The tree

pub(crate) fn no_links(location: &Location) -> Fault {
    Fault::new(location, "no-links", "the list of links is empty")
        .with_help("add at least one link")
}

pub(crate) fn unknown_link(
    location: &Location,
    rule: &'static str,
    name: &str,
    known: &[&str],
    is_frame: bool,
) -> Fault {
    if is_frame {
        return Fault::new(
            location,
            rule,
            format!("{} is a frame, not a link", quote(name)),
        )
        .with_help("name the link that the frame is on");
    }
    let mut words: Vec<&str> = known.iter().copied().take(8).collect();
    words.push(if known.len() > 8 { "…" } else { "world" });
    let links = format!(
        "the links are {}",
        quoted_list(words.iter().copied()).replace("`…`", "…")
    );
    let nearest: Vec<&str> = known.iter().copied().chain(["world"]).collect();
    Fault::new(location, rule, format!("no link is called {}", quote(name)))
        .with_help(suggestion(name, &nearest, links))
}

pub(crate) fn circle(location: &Location, names: &[&str]) -> Fault {
    let Some(first) = names.first() else {
        return Fault::new(location, "cyclic-parents", "links are their own ancestors");
    };
    if names.len() == 1 {
        return Fault::new(
            location,
            "cyclic-parents",
            format!("{} is its own parent", quote(first)),
        )
        .with_help("leave `parent` out if the link is attached to the world");
    }
    let shown = names.iter().copied().take(12);
    let cut = if names.len() > 12 {
        ["…"].as_slice()
    } else {
        &[]
    };
    let path: Vec<&str> = shown.chain(cut.iter().copied()).chain([*first]).collect();
    let message = format!(
        "the links are their own ancestors: {} (each is the child of the next)",
        path.join(" → ")
    );
    Fault::new(location, "cyclic-parents", message)
        .with_help("give one of them `world` or another link as its parent; a kinematic loop cannot be written with `parent`")
}

// Joints

pub(crate) fn unknown_joint_type(location: &Location, word: &str, known: &[&str]) -> Fault {
    let fault = Fault::new(
        location,
        "unknown-joint-type",
        format!("no joint type is called {}", quote(word)),
    );
    let types = format!("the types are {}", quoted_list(known.iter().copied()));
    if word == "ball" {
        return fault.with_help(format!("write `spherical`; {types}"));
    }
    fault.with_help(suggestion(word, known, types))
}

pub(crate) fn moving_joint_without_name(location: &Location) -> Fault {
    Fault::new(
        location,
        "missing-key",
        "a moving joint needs a `name`: its coordinate is called by it",
    )
    .with_help("add `name: …`, unique among the joints")
}

pub(crate) fn axis_of_fixed_joint(location: &Location) -> Fault {
    Fault::new(location, "axis-of-fixed-joint", "a fixed joint has no axis")
        .with_help("leave `axis` out, or change `type`")
}

pub(crate) fn limits_of_fixed_joint(location: &Location) -> Fault {
    Fault::new(
        location,
        "limits-of-fixed-joint",
        "a fixed joint has no limits",
    )
    .with_help("leave `limits` out, or change `type`")
}

pub(crate) fn position_limit(location: &Location, kind: &str) -> Fault {
    let message = format!("a {kind} joint has no position limits");
    Fault::new(location, "position-limit", message)
        .with_help("leave it out, or write `type: revolute`")
}

pub(crate) fn lower_above_upper(location: &Location, lower: &str, upper: &str) -> Fault {
    let message = format!("`lower` ({lower}) is above `upper` ({upper})");
    Fault::new(location, "lower-above-upper", message).with_help("exchange them")
}

pub(crate) fn negative_limit(location: &Location, text: &str) -> Fault {
    let message = format!(
        "the limit is {}; it is a magnitude and holds in both directions",
        quote(text)
    );
    Fault::new(location, "negative-limit", message).with_help("leave out the minus sign")
}

pub(crate) fn unknown_axis(location: &Location, text: &str) -> Fault {
    Fault::new(
        location,
        "unknown-axis",
        format!("{} is not an axis", quote(text)),
    )
    .with_help("write `x`, `y`, `z`, `-x`, `-y`, `-z` or a direction `[0, 0, 1]`")
}

pub(crate) fn zero_axis(location: &Location) -> Fault {
    Fault::new(location, "zero-axis", "the axis [0, 0, 0] has no direction")
        .with_help("write `x`, `y`, `z` or a direction such as `[0, 0, 1]`")
}

// Masses

pub(crate) fn negative_mass(location: &Location, text: &str) -> Fault {
    Fault::new(
        location,
        "negative-mass",
        format!("the mass is negative: {text}"),
    )
    .with_help("a mass is 0 (which may be left out) or positive, in kg")
}

pub(crate) fn no_coordinates(location: &Location) -> Fault {
    let message = "no joint moves: the mechanism has no coordinate (NQ 0, NV 0), so no motion can be computed";
    Fault::new(location, "no-coordinates", message)
        .with_help(
            "give a joint a type that moves, such as `revolute`; a base that moves freely has `joint: { name: base, type: floating }`",
        )
        .into_warning()
}

// Effects

pub(crate) fn constant_distance(
    location: &Location,
    effect: &str,
    [a, b]: [&str; 2],
    distance: f64,
) -> Fault {
    let (effect, distance) = (quote(effect), six_digits(distance));
    let message = if a == b {
        format!("{effect} acts between {} and itself", quote(a))
    } else {
        format!(
            "{effect} acts between {} and {}, which are {distance} m apart in every position",
            quote(a),
            quote(b)
        )
    };
    Fault::new(location, "constant-distance", message).with_help(
        "the distance must be able to change: name two links or frames whose distance varies with a coordinate",
    )
}

/// Returns a warning about an effect at a site where it has no influence.
/// `sites` are the place at which the effect acts, or two between which it acts.
pub(crate) fn no_motion_there(location: &Location, effect: &str, sites: &[&str]) -> Fault {
    let effect = quote(effect);
    let mut moved = sites.iter().rev().map(|site| quote(site));
    let moved = moved
        .next()
        .into_iter()
        .chain(moved.map(|site| format!("against {site}")));
    let moved = moved.collect::<Vec<_>>().join(" ");
    let message =
        format!("{effect} does nothing: no joint moves {moved} in a direction in which it acts");
    let help = "name a link or a frame that a joint moves, or another direction";
    let fault = Fault::new(location, "no-motion", message).with_help(help);
    fault.into_warning()
}

// Directions

pub(crate) fn snap_out_of_range(location: &Location, text: &str) -> Fault {
    Fault::new(
        location,
        "snap-out-of-range",
        format!("{} is outside 0 … 1e-3 rad", quote(text)),
    )
    .with_help("`snap: 1e-4` makes rounded quarter turns such as 1.5708 exact")
}

pub(crate) fn angle_out_of_range(location: &Location, text: &str, most: f64) -> Fault {
    let message = format!("the angle {} is beyond ±{most} rad", quote(text));
    Fault::new(location, "angle-out-of-range", message)
        .with_help("angles are in rad; write `90 deg` for degrees")
}

pub(crate) fn nearly_quarter_turn(location: &Location, off: &[(&str, f64)]) -> Fault {
    let parts: Vec<String> = off
        .iter()
        .map(|(name, off)| format!("{name} is {} rad", six_digits(*off)))
        .collect();
    let message = format!(
        "{} off a multiple of 90 deg; kept as written",
        parts.join(", ")
    );
    nearly(location, message, "write the exact angle (`90 deg`)")
}

pub(crate) fn nearly_axis(location: &Location, off: &[(&str, f64)]) -> Fault {
    let parts: Vec<String> = off
        .iter()
        .map(|(name, off)| format!("{name} is {}", six_digits(*off)))
        .collect();
    let message = format!(
        "{} of the axis's length, nearly 0; kept as written",
        parts.join(", ")
    );
    nearly(location, message, "write 0 there")
}

fn nearly(location: &Location, message: String, way: &str) -> Fault {
    Fault::new(location, "nearly-exact", message)
        .with_help(format!(
            "{way}, or `snap: 1e-4` at the top: exact zeros save operations"
        ))
        .into_warning()
}
