//! Messages about the text of a file: YAML syntax, keys, types, numbers, units.

use super::{quote, quoted_list, suggestion};
use crate::fault::quote::escape;
use crate::fault::{Fault, Location, Position};
use crate::unit::{Dimension, Unit};

fn at(position: Position) -> Location {
    Location {
        position,
        path: String::new(),
    }
}

// YAML

pub(crate) fn yaml_syntax(position: Position, info: &str) -> Fault {
    let info: String = info.chars().take(200).flat_map(escape).collect();
    Fault::new(
        &at(position),
        "yaml-syntax",
        format!("this is not valid YAML: {info}"),
    )
    .with_help("look at the lines before it as well: a bracket or a quote may be open")
}

pub(crate) fn yaml_ambiguous(position: Position) -> Fault {
    let message = "YAML readers disagree about what this is";
    Fault::new(&at(position), "yaml-syntax", message)
        .with_help("write it more plainly: quotes around text, `key: value`")
}

pub(crate) fn empty_file() -> Fault {
    Fault::new(
        &Location::file(),
        "empty-file",
        "the file contains no mechanism",
    )
    .with_help("a spec begins with `format: 1` and has a list `links`")
}

pub(crate) fn several_documents(position: Position) -> Fault {
    Fault::new(
        &at(position),
        "several-documents",
        "a second YAML document begins here",
    )
    .with_help("one mechanism per file: move it into a file of its own")
}

pub(crate) fn too_deep(position: Position, depth: usize) -> Fault {
    let message = format!("lists and mappings are nested more than {depth} deep");
    Fault::new(&at(position), "too-deep", message)
        .with_help("the format needs no more than seven levels")
}

pub(crate) fn cyclic_alias(position: Position) -> Fault {
    Fault::new(
        &at(position),
        "cyclic-alias",
        "this alias is inside the value that it refers to",
    )
    .with_help("write the values out")
}

pub(crate) fn merge_key(location: &Location) -> Fault {
    Fault::new(
        location,
        "merge-key",
        "merge keys (`<<`) are not part of the format",
    )
    .with_help("write the keys out, or use an alias for a single value")
}

pub(crate) fn tag(location: &Location, tag: &str) -> Fault {
    let message = format!(
        "YAML tags such as {} are not part of the format",
        quote(tag)
    );
    Fault::new(location, "tag", message).with_help("leave the tag out")
}

// Keys and types

pub(crate) fn not_two_names(location: &Location, count: usize) -> Fault {
    let message = format!("two names belong here, not {count}");
    Fault::new(location, "wrong-length", message).with_help("write `[one, other]`")
}

pub(crate) fn unknown_key(location: &Location, key: &str, known: &[&'static str]) -> Fault {
    let help = suggestion(
        key,
        known,
        format!("the keys here are {}", quoted_list(known.iter().copied())),
    );
    Fault::new(
        location,
        "unknown-key",
        format!("the key {} is unknown here", quote(key)),
    )
    .with_help(help)
}

pub(crate) fn key_not_text(location: &Location, known: &[&'static str]) -> Fault {
    Fault::new(location, "unknown-key", "a key must be a single word").with_help(format!(
        "the keys here are {}",
        quoted_list(known.iter().copied())
    ))
}

pub(crate) fn repeated_key(location: &Location, key: &str, first: Position) -> Fault {
    let message = format!("the key {} is written a second time", quote(key));
    Fault::new(location, "repeated-key", message).with_help(format!(
        "the first one is on line {}; remove one of them",
        first.line
    ))
}

pub(crate) fn missing_key(location: &Location, key: &str, what: &str) -> Fault {
    Fault::new(
        location,
        "missing-key",
        format!("the key {} is missing", quote(key)),
    )
    .with_help(format!("add {what}"))
}

/// The description of an expected value, and its syntax.
pub(crate) type Wanted<'a> = (&'a str, &'a str);

/// A value of a file that is of the wrong type.
#[derive(Clone, Copy)]
pub(crate) enum FoundValue<'a> {
    /// A list of this length.
    List(usize),
    /// A mapping.
    Mapping,
    /// No value.
    Nothing,
    /// A truth value with this text.
    Truth(&'a str),
    /// A number with this text.
    Number(&'a str),
    /// A text.
    Text(&'a str),
}

impl FoundValue<'_> {
    fn in_words(self) -> String {
        match self {
            FoundValue::List(length) => format!("a list of {length}"),
            FoundValue::Mapping => "a mapping".to_owned(),
            FoundValue::Nothing => "nothing".to_owned(),
            FoundValue::Truth(text) => format!("the truth value {}", quote(text)),
            FoundValue::Number(text) => format!("the number {}", quote(text)),
            FoundValue::Text(text) => format!("the text {}", quote(text)),
        }
    }
}

pub(crate) fn wrong_type(
    location: &Location,
    (what, example): Wanted<'_>,
    found: FoundValue<'_>,
) -> Fault {
    let message = format!("{what} belongs here, not {}", found.in_words());
    let help = match found {
        FoundValue::Nothing => "leave the key out if there is no value".to_owned(),
        _ => format!("write {example}"),
    };
    Fault::new(location, "wrong-type", message).with_help(help)
}

pub(crate) fn wrong_length(location: &Location, count: usize) -> Fault {
    let message = format!("three numbers belong here, not {count}");
    Fault::new(location, "wrong-length", message).with_help("write `[x, y, z]`")
}

// Numbers

pub(crate) fn not_a_number(location: &Location, text: &str, fit: &[Dimension]) -> Fault {
    let fault = Fault::new(
        location,
        "wrong-type",
        format!("{} is not a number", quote(text)),
    );
    fault.with_help(format!("write {}", expected_units(fit)))
}

pub(crate) fn not_decimal(location: &Location, text: &str) -> Fault {
    Fault::new(
        location,
        "wrong-type",
        format!("{} is not a decimal number", quote(text)),
    )
    .with_help("write it as a decimal: `16`, `1.6e-3`")
}

pub(crate) fn division_by_zero(location: &Location, text: &str) -> Fault {
    let message = format!("{} divides by zero", quote(text));
    Fault::new(location, "division-by-zero", message)
        .with_help("write a decimal, or a fraction such as `1/50`")
}

pub(crate) fn number_as_text(location: &Location, text: &str, quoted: bool) -> Fault {
    if quoted {
        return Fault::new(
            location,
            "wrong-type",
            format!(
                "the number {} is in quotes, which makes it text",
                quote(text)
            ),
        )
        .with_help("leave out the quotes");
    }
    Fault::new(
        location,
        "wrong-type",
        format!("YAML reads {} as text", quote(text)),
    )
    .with_help("leave out the leading zeros")
}

pub(crate) fn non_finite(location: &Location, text: &str) -> Fault {
    Fault::new(
        location,
        "non-finite",
        format!("{} is not a finite number", quote(text)),
    )
    .with_help("leave the key out if there is no value")
}

pub(crate) fn out_of_range(location: &Location, text: &str) -> Fault {
    let message = format!("{} is outside ±1e-100 … ±1e100", quote(text));
    Fault::new(location, "out-of-range", message)
        .with_help("leave the key out if there is no value")
}

pub(crate) fn unknown_unit(
    location: &Location,
    text: &str,
    unit: &str,
    fit: &[Dimension],
) -> Fault {
    let units: Vec<&str> = fit.iter().flat_map(|d| d.units()).collect();
    let message = format!("the unit {} in {} is unknown", quote(unit), quote(text));
    Fault::new(location, "unknown-unit", message).with_help(suggestion(
        unit,
        &units,
        format!("write {}", expected_units(fit)),
    ))
}

pub(crate) fn unit_misfit(
    location: &Location,
    text: &str,
    unit: &Unit,
    fit: &[Dimension],
) -> Fault {
    let what = fit
        .iter()
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join(" or ");
    let message = format!("{} is {}; {what} belongs here", quote(text), unit.dimension);
    Fault::new(location, "unit-misfit", message).with_help(format!("write {}", expected_units(fit)))
}

/// Returns "a number, bare (m) or with one of `m`, `cm`, `mm`".
fn expected_units(fit: &[Dimension]) -> String {
    let units: Vec<&str> = fit.iter().flat_map(|d| d.units()).collect();
    if units.is_empty() {
        return "a plain number".to_owned();
    }
    let si: Vec<&str> = fit
        .iter()
        .map(|d| d.si())
        .filter(|si| !si.is_empty())
        .collect();
    let plain = match fit.contains(&Dimension::One) {
        true => "a plain number, ",
        false => "",
    };
    format!(
        "{plain}a number in {}, or with a unit: {}",
        si.join(" or "),
        quoted_list(units)
    )
}

// Run-time parameters

pub(crate) fn misplaced_parameter(location: &Location) -> Fault {
    Fault::new(
        location,
        "misplaced-parameter",
        "a run-time parameter is not allowed here",
    )
    .with_help(
        "write the number; a link's `mass`, each component of its `com` and each entry of its \
         `inertia` may be one: `mass: { parameter: payload, value: 1.5 }`",
    )
}

pub(crate) fn unknown_format(location: &Location, text: &str, known: u32) -> Fault {
    let message = format!(
        "this spec is of format {}; only format {known} is known",
        quote(text)
    );
    Fault::new(location, "unknown-format", message).with_help(format!(
        "write `format: {known}`, or use the version of bgdyn the spec is for"
    ))
}
