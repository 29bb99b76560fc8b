//! Faults of a spec: position in the file, rule, message with the actual numbers, and help.
//!
//! This file has the data type, `render` its text output, `wording` the messages.

mod quote;
mod render;
mod suggest;
pub(crate) mod wording;

use std::fmt;

use quote::one_line;
pub(crate) use suggest::unknown_name;
pub use wording::Help;

/// A position in the spec's text; lines and columns count from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

/// A location in the spec: in its text and in its structure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Location {
    /// Position in the text.
    pub position: Position,
    /// Path in the structure: `links[2].inertia.xx`; empty for the whole file.
    pub path: String,
}

/// The severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The spec is refused.
    Fault,
    /// The spec is accepted; the user should know.
    Warning,
}

/// An error or a warning about a spec.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Fault or warning.
    pub severity: Severity,
    /// Position in the text.
    pub position: Position,
    /// Path in the structure: `links[2].inertia.xx`.
    pub path: String,
    /// Stable name of the violated rule: `unknown-parent`.
    pub rule: &'static str,
    /// The error, with the actual numbers.
    pub message: String,
    /// Advice.
    pub help: Option<String>,
}

impl Fault {
    /// Returns a fault at `location` against `rule`.
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

    /// Adds advice to the finding.
    pub fn with_help(self, help: impl Into<String>) -> Self {
        Fault {
            help: Some(one_line(help.into())),
            ..self
        }
    }

    /// Marks the finding as a consequence of others.
    pub(crate) fn following(self) -> Self {
        Fault {
            rule: FOLLOWS,
            ..self
        }
    }

    /// Changes the finding to a warning.
    pub fn into_warning(self) -> Self {
        Fault {
            severity: Severity::Warning,
            ..self
        }
    }
}

/// The rule of findings that are consequences of others. They refuse the spec and are not shown.
const FOLLOWS: &str = "follows";

/// All findings of one run, in the order of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults(pub Vec<Fault>);

impl Faults {
    /// Adds a finding.
    pub fn push(&mut self, fault: Fault) {
        self.0.push(fault);
    }

    /// Returns whether a finding refuses the spec.
    pub fn any_fault(&self) -> bool {
        self.0.iter().any(|f| f.severity == Severity::Fault)
    }

    /// Returns whether a finding refuses the value of this key of the file.
    pub fn any_in(&self, key: &str) -> bool {
        let inside = |f: &Fault| match f.path.strip_prefix(key) {
            Some(rest) => rest.is_empty() || rest.starts_with(['.', '[']),
            None => false,
        };
        self.0
            .iter()
            .any(|f| f.severity == Severity::Fault && inside(f))
    }

    /// Returns the number of findings that refuse the spec.
    pub fn count(&self) -> usize {
        self.0
            .iter()
            .filter(|f| f.severity == Severity::Fault)
            .count()
    }

    /// Returns the number of findings that refuse the spec, in words: `1 fault`, `3 faults`.
    pub fn tally(&self) -> String {
        match self.count() {
            1 => "1 fault".into(),
            n => format!("{n} faults"),
        }
    }

    /// Removes findings that are consequences of others.
    pub(crate) fn forget_following(&mut self) {
        self.0.retain(|f| f.rule != FOLLOWS);
    }

    /// Sorts by position; the order of findings at one position does not change.
    pub fn sort(&mut self) {
        self.0.sort_by_key(|f| f.position);
    }
}

impl Position {
    /// The start of the file.
    pub const START: Position = Position { line: 1, column: 1 };
}

impl Location {
    /// Returns the location of the whole file.
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
