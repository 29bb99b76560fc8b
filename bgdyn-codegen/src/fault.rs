//! Faults of a spec: position in the file, rule, message with the numbers seen, and help.
//!
//! This file holds the data, `render` their text. The messages themselves are in `wording`.

mod quote;
mod render;
mod suggest;
pub(crate) mod wording;

use std::fmt;

use quote::one_line;
pub(crate) use suggest::unknown_name;

/// A place in the spec's text; lines and columns count from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

/// A place in the spec: in its text and in its structure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Location {
    /// Where in the text.
    pub position: Position,
    /// Where in the structure: `links[2].inertia.xx`; empty for the whole file.
    pub path: String,
}

/// How grave a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The spec is refused.
    Fault,
    /// The spec is accepted; the user should know.
    Warning,
}

/// One thing wrong with a spec.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Fault or warning.
    pub severity: Severity,
    /// Where in the text.
    pub position: Position,
    /// Where in the structure: `links[2].inertia.xx`.
    pub path: String,
    /// Name of the rule broken, stable: `unknown-parent`.
    pub rule: &'static str,
    /// What is wrong, with the numbers seen.
    pub message: String,
    /// The way out.
    pub help: Option<String>,
}

impl Fault {
    /// A fault at `location` against `rule`.
    pub fn new(location: &Location, rule: &'static str, message: impl Into<String>) -> Self {
        Fault {
            severity: Severity::Fault,
            position: location.position,
            path: location.path.clone(),
            rule,
            message: one_line(message.into()),
            help: None,
        }
    }

    /// The same finding with a way out.
    pub fn with_help(self, help: impl Into<String>) -> Self {
        Fault {
            help: Some(one_line(help.into())),
            ..self
        }
    }

    /// The same finding as one that only follows from others.
    pub(crate) fn following(self) -> Self {
        Fault {
            rule: FOLLOWS,
            ..self
        }
    }

    /// The same finding as a warning.
    pub fn into_warning(self) -> Self {
        Fault {
            severity: Severity::Warning,
            ..self
        }
    }
}

/// The rule of findings that only follow from others. They refuse the spec and are not shown.
const FOLLOWS: &str = "follows";

/// All that was found in one run, in the order of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults(pub Vec<Fault>);

impl Faults {
    /// Adds a finding.
    pub fn push(&mut self, fault: Fault) {
        self.0.push(fault);
    }

    /// Whether anything refuses the spec.
    pub fn any_fault(&self) -> bool {
        self.0.iter().any(|f| f.severity == Severity::Fault)
    }

    /// Whether anything refuses what stands behind this key of the file.
    pub fn any_in(&self, key: &str) -> bool {
        let inside = |f: &Fault| match f.path.strip_prefix(key) {
            Some(rest) => rest.is_empty() || rest.starts_with(['.', '[']),
            None => false,
        };
        self.0
            .iter()
            .any(|f| f.severity == Severity::Fault && inside(f))
    }

    /// How many findings refuse the spec.
    pub fn count(&self) -> usize {
        self.0
            .iter()
            .filter(|f| f.severity == Severity::Fault)
            .count()
    }

    /// How many findings refuse the spec, in words: `1 fault`, `3 faults`.
    pub fn tally(&self) -> String {
        match self.count() {
            1 => "1 fault".into(),
            n => format!("{n} faults"),
        }
    }

    /// Leaves out what only follows from other findings.
    pub(crate) fn forget_following(&mut self) {
        self.0.retain(|f| f.rule != FOLLOWS);
    }

    /// Sorts by position; findings at one place keep their order.
    pub fn sort(&mut self) {
        self.0.sort_by_key(|f| f.position);
    }
}

impl Position {
    /// The beginning of the file.
    pub const START: Position = Position { line: 1, column: 1 };
}

impl Location {
    /// The whole file.
    pub fn file() -> Self {
        Location {
            position: Position::START,
            path: String::new(),
        }
    }
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.line, self.column)
    }
}
