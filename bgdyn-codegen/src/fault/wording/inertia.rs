//! Messages about inertia tensors and solids.

use super::{quote, quoted_list, six_digits, six_digits_each, suggestion};
use crate::fault::{Fault, Location};

pub(crate) fn not_semidefinite(location: &Location, moments: [f64; 3]) -> Fault {
    let message = format!(
        "no body has this tensor: it is not positive semidefinite, its principal moments are {} kg·m²",
        six_digits_each(&moments)
    );
    Fault::new(location, "not-semidefinite", message).with_help(
        "check signs and units; `xy`, `xz`, `yz` are the tensor's entries (for ∫xy dm write \
         `products: { xy: … }`), about the centre of mass (else write `about: origin`)",
    )
}

pub(crate) fn triangle_inequality(location: &Location, moments: [f64; 3]) -> Fault {
    let [a, b, c] = moments.map(six_digits);
    let short = six_digits(moments[2] - moments[0] - moments[1]);
    let message = format!(
        "no body has this tensor: its principal moments are {a}, {b}, {c} kg·m², and {a} + {b} falls short of {c} by {short}"
    );
    Fault::new(location, "triangle-inequality", message)
        .with_help("check the numbers, or write `nonphysical: allow` in the link if they are meant")
}

pub(crate) fn nonphysical_word(location: &Location, word: &str) -> Fault {
    Fault::new(
        location,
        "nonphysical-word",
        format!("{} is not a value of `nonphysical`", quote(word)),
    )
    .with_help("write `nonphysical: allow`, or leave it out")
}

// Solids, and reference points of tensors

pub(crate) fn unknown_solid(location: &Location, word: &str, known: &[&str]) -> Fault {
    let help = suggestion(
        word,
        known,
        format!("solids are {}", quoted_list(known.iter().copied())),
    );
    let message = format!("no solid is called {}", quote(word));
    Fault::new(location, "unknown-solid", message).with_help(help)
}

pub(crate) fn missing_dimension(location: &Location, solid: &str, key: &str) -> Fault {
    Fault::new(
        location,
        "missing-dimension",
        format!("a {solid} needs `{key}`"),
    )
    .with_help(format!("write `{key}: …` next to `solid: {solid}`"))
}

pub(crate) fn dimension_of_another(location: &Location, solid: &str, key: &str) -> Fault {
    Fault::new(
        location,
        "misplaced-dimension",
        format!("a {solid} has no `{key}`"),
    )
    .with_help(format!("leave `{key}` out, or choose another solid"))
}

pub(crate) fn dimension_without_solid(location: &Location, key: &str, known: &[&str]) -> Fault {
    let message = format!("`{key}` is a dimension of a solid, but there is no `solid`");
    let known = quoted_list(known.iter().copied());
    Fault::new(location, "misplaced-dimension", message).with_help(format!(
        "write `solid: …` with one of {known}, or leave `{key}` out"
    ))
}

pub(crate) fn two_tensors(location: &Location, key: &str, other: &str) -> Fault {
    let message = format!("`{key}` and `{other}` both set the same entries of the tensor");
    Fault::new(location, "two-tensors", message).with_help("keep one of the two")
}

pub(crate) fn solid_without_mass(location: &Location) -> Fault {
    Fault::new(
        location,
        "solid-without-mass",
        "a solid without mass has no inertia",
    )
    .with_help("give the link a `mass`, or leave `inertia` out")
}

pub(crate) fn solid_of_parameter(location: &Location) -> Fault {
    let message =
        "the mass is a run-time parameter, and the tensor of a solid would change with it";
    Fault::new(location, "solid-of-parameter", message).with_help(
        "make the tensor's entries parameters of their own: `xx: { parameter: …, value: … }`",
    )
}

pub(crate) fn not_a_length(location: &Location, text: &str) -> Fault {
    Fault::new(
        location,
        "solid-dimension",
        format!("{} cannot be a length of a solid", quote(text)),
    )
    .with_help("lengths are above 0, in m or with a unit: `40 mm`")
}

pub(crate) fn inner_radius(location: &Location, inner: &str, outer: &str) -> Fault {
    let message = format!(
        "the inner radius {} is not below the outer one, {}",
        quote(inner),
        quote(outer)
    );
    Fault::new(location, "solid-dimension", message)
        .with_help("exchange them, or leave `inner_radius` out")
}

pub(crate) fn about_word(location: &Location, word: &str) -> Fault {
    Fault::new(
        location,
        "about-word",
        format!("a tensor cannot be about {}", quote(word)),
    )
    .with_help("write `com`, the centre of mass (the default), or `origin`, the origin of the link")
}

pub(crate) fn parameter_about_origin(location: &Location, what: &str) -> Fault {
    let message =
        format!("a tensor about the origin changes with the {what}, which is a run-time parameter");
    Fault::new(location, "parameter-about-origin", message)
        .with_help("give the tensor about the centre of mass")
}

pub(crate) fn no_inertia(location: &Location, joint: &str) -> Fault {
    let message = format!("nothing that the joint {} moves has inertia", quote(joint));
    Fault::new(location, "no-inertia", message)
        .with_help(
            "give a link outboard of it `mass` or `inertia`; without, forward dynamics fails in every state, and only a scene with a rotor or a payload there can be simulated",
        )
        .into_warning()
}
