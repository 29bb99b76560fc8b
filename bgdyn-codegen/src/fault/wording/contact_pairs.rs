//! Messages about the entries of `contacts`.

use super::{quote, six_digits, six_digits_each};
use crate::fault::{Fault, Location};

pub(crate) fn contact_without_key(
    location: &Location,
    name: &str,
    (key, about): (&str, &str),
) -> Fault {
    let message = format!("the contact {} has no `{key}`", quote(name));
    Fault::new(location, "missing-key", message).with_help(format!("write `{key}`: {about}"))
}

pub(crate) fn contact_pair_named_twice(location: &Location, name: &str) -> Fault {
    let message = format!("two contacts have the name {}", quote(name));
    Fault::new(location, "repeated-name", message).with_help(
        "the corners of a box and the ends of a capsule have the name of their entry and a number: rename one entry",
    )
}

pub(crate) fn contact_pair_moves_nothing(location: &Location, name: &str) -> Fault {
    let message = format!(
        "the contact {} is of a link with itself, or of two links that no joint moves relative to each other",
        quote(name)
    );
    Fault::new(location, "contact-moves-nothing", message).with_help(
        "name a link that moves, or another plane with `on`, or another link with `with`",
    )
}

pub(crate) fn contact_gap_constant(location: &Location, name: &str, gap: f64) -> Fault {
    let message = format!(
        "the gap of the contact {} is {} m at every position",
        quote(name),
        six_digits(gap)
    );
    Fault::new(location, "contact-moves-nothing", message)
        .with_help("joints only turn it in place: correct `at`, or leave the contact out")
}

pub(crate) fn contact_radius_negative(
    location: &Location,
    (key, name): (&str, &str),
    text: &str,
) -> Fault {
    let message = format!("`{key}` of the contact {} is {text}", quote(name));
    Fault::new(location, "radius-not-positive", message)
        .with_help("write a positive length, or 0 for a point")
}

pub(crate) fn contact_radius_is_parameter(location: &Location, name: &str) -> Fault {
    let message = format!(
        "a radius of the contact {} is a run-time parameter",
        quote(name)
    );
    Fault::new(location, "parameter-not-possible", message).with_help("write a number")
}

pub(crate) fn contact_of_points(location: &Location, name: &str) -> Fault {
    let message = format!("the contact {} is of two points", quote(name));
    Fault::new(location, "contact-of-points", message)
        .with_help("give one of them a `radius` or a `with_radius`: two points have no normal")
}

pub(crate) fn contact_on_and_with(location: &Location, name: &str) -> Fault {
    let message = format!("the contact {} has both `on` and `with`", quote(name));
    Fault::new(location, "unused-key", message).with_help(
        "leave one of them out: a contact is with a plane, or with another sphere; write two contacts for both",
    )
}

pub(crate) fn contact_key_without_with(location: &Location, key: &str) -> Fault {
    let message = format!("`{key}` without `with`");
    Fault::new(location, "unused-key", message)
        .with_help("name the link of the other sphere with `with`, or leave the key out")
}

pub(crate) fn capsule_with_size(location: &Location, name: &str) -> Fault {
    let message = format!("the contact {} has both `to` and `size`", quote(name));
    Fault::new(location, "unused-key", message).with_help(
        "leave one of them out: `to` is the other end of a capsule, `size` has the edges of a box",
    )
}

pub(crate) fn capsule_without_length(location: &Location, name: &str) -> Fault {
    let message = format!("both ends of the capsule {} are at one place", quote(name));
    Fault::new(location, "value-not-positive", message)
        .with_help("leave `to` out for a sphere, or correct it: it is a place, not a difference")
}

pub(crate) fn box_edge_not_positive(location: &Location, name: &str, edges: &[f64; 3]) -> Fault {
    let message = format!(
        "the edges of the box {} are {} m",
        quote(name),
        six_digits_each(edges)
    );
    Fault::new(location, "value-not-positive", message).with_help("write three positive lengths")
}

pub(crate) fn contact_of_given_base(location: &Location, name: &str) -> Fault {
    let message = format!(
        "the contact {} is with a plane of the world, in which `base: given` has no pose",
        quote(name)
    );
    Fault::new(location, "contact-of-given-base", message).with_help(
        "fix the plane to a link with `link`, or give the first link a `floating` joint instead of `base: given`",
    )
}

// The effect

/// `both` is whether both are given.
pub(crate) fn not_one_stiffness(location: &Location, effect: &str, both: bool) -> Fault {
    let message = match both {
        true => format!(
            "{} has both `stiffness` and `linear_stiffness`",
            quote(effect)
        ),
        false => format!("{} has no stiffness", quote(effect)),
    };
    Fault::new(location, "effect-missing", message).with_help(
        "write one: `stiffness: 2e6 N/m^1.5` is Hertz's force k δ^(3/2), `linear_stiffness: 1e5 N/m` a force k δ",
    )
}

pub(crate) fn damping_beside_restitution(location: &Location, effect: &str) -> Fault {
    let message = format!("{} has `damping` beside `restitution`", quote(effect));
    Fault::new(location, "effect-damping", message).with_help(
        "leave one of them out: the damping follows from `restitution` and `impact_speed`",
    )
}

pub(crate) fn restitution_alone(
    location: &Location,
    effect: &str,
    [given, missing]: [&str; 2],
) -> Fault {
    let message = format!("{} has `{given}` without `{missing}`", quote(effect));
    Fault::new(location, "effect-damping", message).with_help(
        "write both: an impact at the speed `impact_speed` keeps the part `restitution` of it",
    )
}

/// `both` is whether both are given.
pub(crate) fn width_or_bristles(location: &Location, effect: &str, both: bool) -> Fault {
    let message = match both {
        true => format!("{} has both `width` and `bristles`", quote(effect)),
        false => format!(
            "{} has friction without `width` or `bristles`",
            quote(effect)
        ),
    };
    Fault::new(location, "effect-friction", message).with_help(
        "write one: `width` is the slip over which smooth friction rises, `bristles` hold",
    )
}

pub(crate) fn bristles_without_release(location: &Location, effect: &str) -> Fault {
    let message = format!("{} has `bristles` without `release`", quote(effect));
    Fault::new(location, "effect-missing", message).with_help(
        "add `release`, the time in which bristles without contact return to rest: `1 ms`",
    )
}

pub(crate) fn contact_key_alone(
    location: &Location,
    effect: &str,
    [key, needed]: [&str; 2],
) -> Fault {
    let message = format!("{} has `{key}` without `{needed}`", quote(effect));
    Fault::new(location, "effect-missing", message)
        .with_help(format!("add `{needed}`, or leave `{key}` out"))
}

pub(crate) fn contact_with_two_laws(location: &Location, contact: &str, other: &str) -> Fault {
    let message = format!(
        "the contact {} has a law already: {}",
        quote(contact),
        quote(other)
    );
    Fault::new(location, "effect-contacts", message)
        .with_help("leave one of the two effects out of the scene")
}

pub(crate) fn bristles_of_spheres(location: &Location, contact: &str) -> Fault {
    let message = format!(
        "the contact {} is of two spheres: their plane of contact has no axes for bristles",
        quote(contact)
    );
    Fault::new(location, "effect-friction", message)
        .with_help("write `width` instead of `bristles`")
}

pub(crate) fn canonical_of_rigid_contacts(
    location: &Location,
    element: &str,
    (method, solving): (&str, &str),
) -> Fault {
    let message = format!(
        "the effect {} is a rigid contact, and `{method}` integrates momenta: scenes with rigid contacts have no canonical form",
        quote(element)
    );
    Fault::new(location, "integration", message).with_help(format!(
        "write `integration: {{ method: {solving}, step: 1 ms }}`, or take `compliant_contact`"
    ))
}

/// `most` from event to event, and in steps for contacts.
pub(crate) fn too_many_event_contacts(
    location: &Location,
    (method, solving): (&str, &str),
    number: usize,
    most: (usize, usize),
) -> Fault {
    let message = format!(
        "the scene has {number} rigid contacts, and `{method}` goes from event to event with at most {}; `{solving}` takes {}",
        most.0, most.1
    );
    Fault::new(location, "integration", message).with_help(format!(
        "write `integration: {{ method: {solving}, step: 1 ms }}`, name fewer of them in `contacts`, or take `compliant_contact`"
    ))
}

pub(crate) fn too_many_rigid_contacts(location: &Location, number: usize, most: usize) -> Fault {
    let message = format!("the scene has {number} rigid contacts; the solver takes {most}");
    Fault::new(location, "effect-contacts", message)
        .with_help("name fewer of them in `contacts`, or take `compliant_contact`")
}

pub(crate) fn rigid_contact_beside_modes(location: &Location, element: &str, mode: &str) -> Fault {
    let message = format!(
        "the effect {} is a rigid contact beside `{mode}`, which can hold its joint: both are not solved together",
        quote(element)
    );
    Fault::new(location, "effect-contacts", message).with_help(
        "take a friction without modes, `coulomb_smooth`, `stribeck` or `lugre`, or `compliant_contact`",
    )
}

pub(crate) fn rigid_contact_overlaps(location: &Location, contact: &str, depth: f64) -> Fault {
    let message = format!(
        "the surfaces of the contact {} overlap by {} m at the start",
        quote(contact),
        six_digits(depth)
    );
    Fault::new(location, "start-overlaps", message)
        .with_help("change `initial` so that its gap is 0 or more, or take `compliant_contact`")
}
