//! Faults of a spec: where in the file, which rule, the numbers seen, the way out.

use std::fmt;

/// A place in the spec's text; lines and columns count from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
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

/// All that was found in one run, in the order of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults(pub Vec<Fault>);

impl Faults {
    /// Whether anything refuses the spec.
    pub fn any_fault(&self) -> bool {
        self.0.iter().any(|f| f.severity == Severity::Fault)
    }

    /// How many findings refuse the spec.
    pub fn count(&self) -> usize {
        self.0.iter().filter(|f| f.severity == Severity::Fault).count()
    }

    /// Sorts by position; findings at one place keep their order.
    pub fn sort(&mut self) {
        self.0.sort_by_key(|f| f.position);
    }
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.line, self.column)
    }
}
