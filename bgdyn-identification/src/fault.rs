//! Faults of a log: where, which rule, the numbers seen, the way out.

use std::fmt;

use bgdyn_runtime::Digits;

/// A fault of a log.
#[derive(Clone, Debug, PartialEq)]
pub struct LogFault {
    /// Line and column in the file, from 1; `None` for a fault of the whole log.
    pub position: Option<(usize, usize)>,
    /// Stable name of the violated rule: `not-finite`.
    pub rule: &'static str,
    /// The error, with the actual numbers.
    pub message: String,
    /// The way out.
    pub help: String,
}

impl LogFault {
    /// Returns a fault at a line and column.
    pub fn at(line: usize, column: usize, rule: &'static str, message: String) -> Self {
        LogFault {
            position: Some((line, column)),
            ..Self::whole(rule, message)
        }
    }

    /// Returns a fault of the whole log.
    pub fn whole(rule: &'static str, message: String) -> Self {
        LogFault {
            position: None,
            rule,
            message,
            help: String::new(),
        }
    }

    /// Adds the way out.
    pub fn with_help(self, help: impl Into<String>) -> Self {
        LogFault {
            help: help.into(),
            ..self
        }
    }
}

impl fmt::Display for LogFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((line, column)) = self.position {
            write!(f, "{line}:{column}: ")?;
        }
        write!(f, "{} [{}]", self.message, self.rule)?;
        match self.help.as_str() {
            "" => Ok(()),
            help => write!(f, "\n  help: {help}"),
        }
    }
}

/// Keeps the first faults of a rule, and counts the others: a log with a wrong column has one in each row.
#[derive(Clone, Debug, Default)]
pub struct LogFaults {
    all: Vec<LogFault>,
    counts: Vec<(&'static str, usize)>,
}

/// So many faults of one rule are reported singly.
const SHOWN: usize = 5;

impl LogFaults {
    /// Adds a fault.
    pub fn push(&mut self, fault: LogFault) {
        let known = self.counts.iter_mut().find(|(rule, _)| *rule == fault.rule);
        let count = match known {
            Some((_, count)) => {
                *count += 1;
                *count
            }
            None => {
                self.counts.push((fault.rule, 1));
                1
            }
        };
        if count <= SHOWN {
            self.all.push(fault);
        }
    }

    /// Returns whether there are none.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Returns the faults, with a line for each rule that has more of them.
    pub fn into_vec(self) -> Vec<LogFault> {
        let more = self.counts.iter().filter(|(_, count)| *count > SHOWN);
        let more = more.map(|(rule, count)| {
            LogFault::whole(rule, format!("… and {} more of this rule", count - SHOWN))
        });
        let more: Vec<LogFault> = more.collect();
        self.all.into_iter().chain(more).collect()
    }
}

/// Returns a number with four digits.
pub fn short(x: f64) -> String {
    Digits::new(x, 4).to_string()
}
