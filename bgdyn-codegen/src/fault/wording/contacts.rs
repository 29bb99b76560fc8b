//! Messages about wheels, balls and knife edges.

use super::{quote, quoted_list, six_digits, suggestion};
use crate::fault::{Fault, Location};

pub(crate) fn unknown_site(location: &Location, name: &str, known: &[&str]) -> Fault {
    let message = format!("no link and no frame has the name {}", quote(name));
    let list = format!(
        "links and frames are {}",
        quoted_list(known.iter().copied())
    );
    Fault::new(location, "unknown-place", message).with_help(suggestion(name, known, list))
}

pub(crate) fn unknown_plane(location: &Location, name: &str, known: &[&str]) -> Fault {
    let message = format!("no plane has the name {}", quote(name));
    let list = match known {
        [] => "write it under `planes`, or leave `on` out: then the plane is the world's x–y plane"
            .to_owned(),
        _ => format!("the planes are {}", quoted_list(known.iter().copied())),
    };
    Fault::new(location, "unknown-plane", message).with_help(suggestion(name, known, list))
}

pub(crate) fn radius_not_positive(
    location: &Location,
    (what, name): (&str, &str),
    radius: f64,
) -> Fault {
    let message = format!(
        "the {what} of the wheel {} is {} m",
        quote(name),
        six_digits(radius)
    );
    Fault::new(location, "radius-not-positive", message)
        .with_help("write a positive length; an edge without a wheel is a `knife_edge`")
}

pub(crate) fn radius_is_parameter(location: &Location, (what, name): (&str, &str)) -> Fault {
    let message = format!(
        "the {what} of the wheel {} is a run-time parameter",
        quote(name)
    );
    Fault::new(location, "parameter-not-possible", message)
        .with_help("write a number: rows of constraints are solved with numbers")
}

pub(crate) fn key_beside_radii(location: &Location, key: &str) -> Fault {
    let message = format!("`{key}` beside `radii`, which are those of an ellipsoid");
    Fault::new(location, "unused-key", message).with_help(format!(
        "leave `{key}` out, or `radii`: a wheel has `axis`, `radius` and perhaps `crown_radius`, a ball `radius`"
    ))
}

pub(crate) fn crown_of_ball(location: &Location) -> Fault {
    Fault::new(
        location,
        "unused-key",
        "`crown_radius` without `axis`: a ball has no sections",
    )
    .with_help("give the wheel's axle with `axis`, or leave `crown_radius` out")
}

pub(crate) fn rows_of_ball(location: &Location) -> Fault {
    Fault::new(
        location,
        "unused-key",
        "a ball has no `rows` to choose from",
    )
    .with_help(
        "leave `rows` out, or give the wheel's axle with `axis`: a ball slips in no direction",
    )
}

pub(crate) fn unknown_row(location: &Location, word: &str, words: &[&str]) -> Fault {
    let message = format!("{} is not a direction in which wheels slip", quote(word));
    let list = format!("the directions are {}", quoted_list(words.iter().copied()));
    Fault::new(location, "unknown-row", message).with_help(suggestion(word, words, list))
}

pub(crate) fn no_rows(location: &Location, words: &[&str]) -> Fault {
    let list = quoted_list(words.iter().copied());
    Fault::new(location, "no-rows", "the wheel slips in every direction").with_help(format!(
        "list at least one of {list}, or leave the constraint out"
    ))
}

pub(crate) fn contact_moves_nothing(location: &Location, name: &str) -> Fault {
    let message = format!(
        "no joint moves the place of the constraint {} relative to its plane",
        quote(name)
    );
    Fault::new(location, "contact-moves-nothing", message)
        .with_help("name a link that moves, or another plane with `on`")
}

pub(crate) fn wheel_lies_flat(location: &Location, name: &str) -> Fault {
    let message = format!(
        "the wheel {} lies flat on its plane: its axle is along the normal",
        quote(name)
    );
    Fault::new(location, "wheel-lies-flat", message)
        .with_help("correct `axis`, the direction of the axle in the axes of the wheel's link; or the plane's `normal`")
}

/// `open` is the height above that of contact, m.
pub(crate) fn wheel_never_touches(
    location: &Location,
    name: &str,
    (open, sizes): (f64, &[f64]),
) -> Fault {
    let side = if open > 0.0 { "above" } else { "below" };
    let sizes: Vec<String> = sizes.iter().map(|x| six_digits(*x)).collect();
    let sizes = match &sizes[..] {
        [radius] => format!("a radius of {radius} m"),
        [radius, crown] => format!("a radius of {radius} m and a crown radius of {crown} m"),
        half_axes => format!("half-axes of {} m", half_axes.join(", ")),
    };
    let message = format!(
        "the wheel {} cannot touch its plane: at every position its lowest point is {} m {side} it, with {sizes}",
        quote(name),
        six_digits(open.abs())
    );
    Fault::new(location, "wheel-never-touches", message).with_help(
        "put its centre one radius above the plane: correct the origins of the joints, or `offset` of the plane",
    )
}

pub(crate) fn dependent_contact_row(
    location: &Location,
    (name, row): (&str, &str),
    others: &[(String, f64)],
) -> Fault {
    let terms = others
        .iter()
        .map(|(name, factor)| format!("{} · `{name}`", six_digits(*factor)));
    let message = format!(
        "the row `{row}` of the constraint {} follows from other rows: at the start it is {}",
        quote(name),
        terms.collect::<Vec<_>>().join(" + ")
    );
    Fault::new(location, "dependent-row", message).with_help(
        "of wheels on one axle only one is held along it: write `rows: [longitudinal]` for the others, or leave one constraint out",
    )
}
