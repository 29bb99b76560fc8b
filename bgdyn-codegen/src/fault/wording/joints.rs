//! Messages about joint types and their keys.

use super::{quote, quoted_list, six_digits, suggestion};
use crate::fault::{Fault, Location};
use crate::unit::Dimension;

pub(crate) fn axis_of_joint(location: &Location, keyword: &str) -> Fault {
    let message = format!("a {keyword} joint has no axis");
    Fault::new(location, "axis-of-joint", message)
        .with_help("leave `axis` out; `origin: { rpy: … }` rotates the joint's axes")
}

pub(crate) fn no_second_axis(location: &Location, keyword: &str) -> Fault {
    let message = format!("a joint of type `{keyword}` needs its second axis");
    Fault::new(location, "no-second-axis", message)
        .with_help("add `axis2: y`, in link axes at zero; the first motion carries it along")
}

pub(crate) fn parallel_axes(location: &Location, both_rotate: bool) -> Fault {
    let (motions, one) = match both_rotate {
        true => ("rotations", "revolute"),
        false => ("translations", "prismatic"),
    };
    let message = format!("`axis2` is parallel to `axis`: the two {motions} are one");
    Fault::new(location, "parallel-axes", message)
        .with_help(format!("choose another `axis2`, or write `type: {one}`"))
}

pub(crate) fn key_of_other_joint(
    location: &Location,
    key: &str,
    keyword: &str,
    other: &str,
) -> Fault {
    let message = format!("a {keyword} joint has no `{key}`");
    Fault::new(location, "key-of-other-joint", message)
        .with_help(format!("leave `{key}` out, or write `type: {other}`"))
}

pub(crate) fn no_lead(location: &Location) -> Fault {
    Fault::new(location, "no-lead", "a helical joint needs its lead").with_help(
        "add `lead: 5 mm`, the travel along the axis for a full turn, or `lead: 0.8 mm/rad`",
    )
}

pub(crate) fn zero_lead(location: &Location) -> Fault {
    Fault::new(
        location,
        "zero-lead",
        "a screw with lead 0 does not advance",
    )
    .with_help("write `type: revolute` without `lead`")
}

pub(crate) fn unknown_quaternion(location: &Location, word: &str) -> Fault {
    let message = format!("`quaternion` is `any` or absent, not {}", quote(word));
    Fault::new(location, "unknown-quaternion", message).with_help(
        "`any` accepts quaternions of any length; without the key their length must be 1",
    )
}

pub(crate) fn limits_of_joint(location: &Location, keyword: &str) -> Fault {
    let message = format!("a {keyword} joint has no limits in this format");
    Fault::new(location, "limits-of-joint", message).with_help("leave `limits` out")
}

pub(crate) fn limits_of_part(location: &Location, keyword: &str, part: &str) -> Fault {
    let message = format!("a {keyword} joint has no part `{part}`");
    Fault::new(location, "limits-of-part", message).with_help(
        "`turn` and `slide` belong to `cylindrical`, `first` and `second` to `universal`",
    )
}

pub(crate) fn limits_of_chain(location: &Location, keyword: &str, parts: &[&str]) -> Fault {
    let message = format!("a {keyword} joint has limits for each of its parts");
    let example = format!("{{ {}: {{ lower: …, upper: … }} }}", parts.join(": {…}, "));
    Fault::new(location, "limits-of-chain", message).with_help(format!("write `limits: {example}`"))
}

pub(crate) fn mimic_of_joint(location: &Location, keyword: &str) -> Fault {
    let message = format!("a {keyword} joint cannot mimic: it does not have one coordinate");
    Fault::new(location, "mimic-of-joint", message)
        .with_help("`mimic` belongs to `revolute`, `continuous`, `prismatic` and `helical` joints")
}

pub(crate) fn unknown_leader(location: &Location, name: &str, known: &[&str]) -> Fault {
    let message = format!("no joint is called {}", quote(name));
    let all = format!(
        "the joints are {}",
        quoted_list(known.iter().copied().take(12))
    );
    Fault::new(location, "unknown-leader", message).with_help(suggestion(name, known, all))
}

pub(crate) fn leader_of_type(location: &Location, name: &str, keyword: &str) -> Fault {
    let message = format!(
        "{} is a {keyword} joint; only a joint with one coordinate can be mimicked",
        quote(name)
    );
    Fault::new(location, "leader-of-type", message)
        .with_help("name a revolute, continuous, prismatic or helical joint")
}

pub(crate) fn ratio_needed(location: &Location, leader: &str, of: Dimension) -> Fault {
    let message = format!("`mimic` of {} needs a ratio: {of}", quote(leader));
    let units: Vec<&str> = of.units().collect();
    Fault::new(location, "ratio-needed", message).with_help(format!(
        "add `ratio: …`, a number in {}, or with a unit: {}",
        of.si(),
        quoted_list(units)
    ))
}

pub(crate) fn oblique_axes(location: &Location, degrees: f64) -> Fault {
    let message = format!(
        "`axis2` is at {}° to `axis`, not at a right angle",
        six_digits(degrees)
    );
    Fault::new(location, "oblique-axes", message)
        .with_help("the axes of two rotations in a joint are usually perpendicular; if these are not, ignore this")
        .into_warning()
}

pub(crate) fn floating_on_link(location: &Location, joint: &str, parent: &str) -> Fault {
    let message = format!(
        "the floating joint {} is on the link {}: its position and velocity are relative to that link",
        quote(joint),
        quote(parent)
    );
    Fault::new(location, "floating-on-link", message)
        .with_help("leave `parent` out to have them in the world")
        .into_warning()
}

pub(crate) fn zero_ratio(location: &Location) -> Fault {
    Fault::new(
        location,
        "zero-ratio",
        "with ratio 0 the joint does not move",
    )
    .with_help("write `type: fixed`, or a ratio that is not 0")
}

pub(crate) fn mimic_circle(location: &Location, names: &[&str]) -> Fault {
    let mut circle: Vec<&str> = names.to_vec();
    circle.extend(names.first());
    let message = format!(
        "these joints mimic each other in a circle: {}",
        circle.join(" → ")
    );
    Fault::new(location, "mimic-circle", message)
        .with_help("leave `mimic` out of one of them: it is then the coordinate of all")
}

pub(crate) fn mimic_empty_range(
    location: &Location,
    leader: &str,
    (lower, upper): (Option<f64>, Option<f64>),
) -> Fault {
    let (lower, upper) = (lower.unwrap_or_default(), upper.unwrap_or_default());
    let message = format!(
        "no position of {} keeps the limits of both joints: it would be at least {} and at most {}",
        quote(leader),
        six_digits(lower),
        six_digits(upper)
    );
    Fault::new(location, "mimic-empty-range", message)
        .with_help("change `ratio`, `offset` or one of the limits")
}

pub(crate) fn unknown_base(location: &Location, word: &str) -> Fault {
    let message = format!("`base` is `fixed` or `given`, not {}", quote(word));
    Fault::new(location, "unknown-base", message).with_help(
        "`fixed` is the default; with `given` the motion of the base is given at run time",
    )
}

pub(crate) fn parameter_of_base(location: &Location, name: &str) -> Fault {
    let message = format!(
        "the parameter {} has a name that `base: given` uses for the motion of the base",
        quote(name)
    );
    Fault::new(location, "parameter-of-base", message).with_help("choose another name")
}
