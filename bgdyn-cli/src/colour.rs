//! Colours messages on a terminal, line by line.

use std::env::var_os;
use std::io::{IsTerminal, stderr};
use std::sync::OnceLock;

use clap::ValueEnum;

/// When stderr has colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Colour {
    /// On a terminal
    #[default]
    Auto,
    /// Also in a file or a pipe
    Always,
    /// Without
    Never,
}

/// Whether stderr has colours, once decided.
static WANTED: OnceLock<bool> = OnceLock::new();

const RED: &str = "1;31";
const YELLOW: &str = "1;33";
const BLUE: &str = "34";
const GREEN: &str = "32";

impl Colour {
    /// Sets the use of colours on stderr.
    pub(crate) fn choose(self) {
        let _ = WANTED.set(match self {
            Colour::Always => true,
            Colour::Never => false,
            Colour::Auto => by_surroundings(),
        });
    }
}

/// Returns whether the terminal and the usual environment variables permit colours.
fn by_surroundings() -> bool {
    let set = |name| var_os(name).is_some_and(|value| !value.is_empty());
    let forced = var_os("CLICOLOR_FORCE").is_some_and(|value| !value.is_empty() && value != "0");
    let dumb = var_os("TERM").is_some_and(|term| term == "dumb");
    !set("NO_COLOR") && (forced || (stderr().is_terminal() && !dumb))
}

/// Returns the text for stderr, with colours if they are in use.
pub(crate) fn painted(text: &str) -> String {
    match WANTED.get() {
        Some(true) => text.split_inclusive('\n').map(line).collect(),
        _ => text.to_owned(),
    }
}

/// Returns one line, coloured according to its beginning.
fn line(line: &str) -> String {
    let (text, end) = match line.strip_suffix('\n') {
        Some(text) => (text, "\n"),
        None => (line, ""),
    };
    let paint =
        |colour: &str, head: &str, rest: &str| format!("\x1b[{colour}m{head}\x1b[0m{rest}{end}");
    for (word, colour) in [
        ("bgdyn: warning:", YELLOW),
        ("bgdyn:", RED),
        ("warning:", YELLOW),
        ("renamed:", GREEN),
        ("written:", GREEN),
    ] {
        if let Some(rest) = text.strip_prefix(word) {
            return paint(colour, word, rest);
        }
    }
    let margin = text.trim_start_matches(|c: char| c == ' ' || c.is_ascii_digit());
    let head = text.len() - margin.len();
    if let Some(rest) = margin.strip_prefix("= ") {
        return paint(BLUE, &text[..head + 1], &format!(" {rest}"));
    }
    if margin.starts_with('|')
        && (text.starts_with(' ') || text.starts_with(|c: char| c.is_ascii_digit()))
    {
        let rest = &margin[1..];
        return match rest.trim() {
            "^" => paint(
                BLUE,
                &text[..head + 1],
                &format!("\x1b[{RED}m{rest}\x1b[0m"),
            ),
            _ => paint(BLUE, &text[..head + 1], rest),
        };
    }
    match split_location(text) {
        Some((place, rest)) if rest.starts_with(" warning:") => {
            let rest = &rest[" warning:".len()..];
            paint("1", place, &format!(" \x1b[{YELLOW}mwarning:\x1b[0m{rest}"))
        }
        Some((place, rest)) => paint(RED, place, rest),
        None => line.to_owned(),
    }
}

/// Splits a line into `FILE:LINE:COLUMN:` and the rest.
fn split_location(text: &str) -> Option<(&str, &str)> {
    let end = text.find(": ")?;
    let mut parts = text[..end].rsplitn(3, ':');
    let number = |part: Option<&str>| {
        part.is_some_and(|p| !p.is_empty() && p.bytes().all(|b| b.is_ascii_digit()))
    };
    let placed = number(parts.next()) && number(parts.next()) && parts.next().is_some();
    placed.then(|| text.split_at(end + 1))
}
