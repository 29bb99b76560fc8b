//! Prints faults: a headline for each, and an excerpt of the source with a caret.

use super::{Fault, Faults, Severity};

/// Largest number of characters of a source line in an excerpt.
const EXCERPT_WIDTH: usize = 100;
/// Largest number of warnings of one cause that are shown one by one.
const REPEATS: usize = 3;
/// Number of repeated warnings whose position is shown.
const PLACES: usize = 5;

impl Fault {
    /// Returns `FILE:LINE:COLUMN: links[2].inertia: message [rule]`, on one line.
    pub fn headline(&self, file: &str) -> String {
        let mut line = format!("{file}:{}: ", self.position);
        if self.severity == Severity::Warning {
            line += "warning: ";
        }
        if !self.path.is_empty() {
            line += &format!("{}: ", self.path);
        }
        line + &format!("{} [{}]", self.message, self.rule)
    }

    /// Returns the headline, the source line with a caret, and the advice. Ends with a line break.
    pub fn render(&self, file: &str, source: &str) -> String {
        let mut text = self.headline(file) + "\n";
        let number = self.position.line.to_string();
        let margin = " ".repeat(number.len());
        if let Some(line) = source_line(source, self.position.line) {
            let (shown, caret) = excerpt(line, self.position.column);
            let pad = " ".repeat(caret);
            text += &format!("{margin} |\n{number} | {shown}\n{margin} | {pad}^\n");
        }
        if let Some(help) = &self.help {
            text += &format!("{margin} = help: {help}\n");
        }
        text
    }
}

impl Fault {
    /// Returns whether both are warnings by the same rule with the same advice.
    fn has_the_cause_of(&self, other: &Fault) -> bool {
        let both = [self, other];
        both.iter().all(|f| f.severity == Severity::Warning)
            && self.rule == other.rule
            && self.help == other.help
    }
}

impl Faults {
    /// Returns every finding with its excerpt, with empty lines between them. Of more than three warnings
    /// of one cause (the same rule, the same advice) only the first is shown, with the number and the
    /// first positions of the others. Faults are shown one by one.
    pub fn render(&self, file: &str, source: &str) -> String {
        let mut texts = Vec::new();
        for (i, fault) in self.0.iter().enumerate() {
            let alike = |other: &&Fault| fault.has_the_cause_of(other);
            let count = self.0.iter().filter(alike).count();
            if count <= REPEATS {
                texts.push(fault.render(file, source));
            } else if !self.0[..i].iter().any(|other| alike(&other)) {
                let others: Vec<&Fault> = self.0[i + 1..].iter().filter(alike).collect();
                texts.push(fault.render(file, source) + &more(&others));
            }
        }
        texts.join("\n")
    }
}

/// Returns ` = 442 more of the same cause, at 9:5, 12:5, 15:5, …`.
fn more(others: &[&Fault]) -> String {
    let shown = others.iter().take(PLACES).map(|f| f.position.to_string());
    let mut places: Vec<String> = shown.collect();
    if others.len() > PLACES {
        places.push("…".into());
    }
    let places = places.join(", ");
    format!(" = {} more of the same cause, at {places}\n", others.len())
}

/// Returns line `number` (from 1) of `source`, by YAML's line breaks: LF, CR LF, CR.
fn source_line(source: &str, number: usize) -> Option<&str> {
    let mut rest = source;
    for _ in 1..number {
        let end = rest.find(['\n', '\r'])?;
        let width = if rest[end..].starts_with("\r\n") {
            2
        } else {
            1
        };
        rest = &rest[end + width..];
    }
    let line = rest.split(['\n', '\r']).next().unwrap_or(rest);
    (!line.trim().is_empty()).then_some(line)
}

/// Returns the visible part of `line`, and the number of columns before the caret.
fn excerpt(line: &str, column: usize) -> (String, usize) {
    let characters: Vec<char> = line.chars().collect();
    let location = column.saturating_sub(1).min(characters.len());
    let start = if characters.len() <= EXCERPT_WIDTH {
        0
    } else {
        location.saturating_sub(EXCERPT_WIDTH / 2)
    };
    let printable = |c: &char| if c.is_control() { ' ' } else { *c };
    let shown: String = characters[start..]
        .iter()
        .take(EXCERPT_WIDTH)
        .map(printable)
        .collect();
    (shown.trim_end().to_owned(), location - start)
}
