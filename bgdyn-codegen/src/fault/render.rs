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

#[cfg(test)]
mod tests {
    use crate::fault::{Fault, Faults, Location, Position};

    fn fault(line: usize, column: usize) -> Fault {
        let location = Location {
            position: Position { line, column },
            path: "links[0].mass".into(),
        };
        Fault::new(&location, "negative-mass", "the mass is -1").with_help("leave it out")
    }

    #[test]
    fn caret_stands_under_the_column() {
        let text = fault(2, 9).render("a.yaml", "format: 1\n  mass: -1\n");
        assert_eq!(
            text,
            "a.yaml:2:9: links[0].mass: the mass is -1 [negative-mass]\n  |\n2 |   mass: -1\n  |         ^\n  \
             = help: leave it out\n"
        );
    }

    /// Warnings of two causes alternating, `count` of each, and two faults like the first ones.
    fn repeated(count: usize) -> Faults {
        let warning = |line| fault(line, 1).into_warning();
        let mut faults = Faults(vec![fault(1, 1), fault(2, 1)]);
        for line in 0..count {
            faults.push(warning(10 + 2 * line));
            faults.push(warning(11 + 2 * line).with_help("write 0 there"));
        }
        faults
    }

    #[test]
    fn many_warnings_of_one_cause_are_one_with_a_count() {
        let text = repeated(40).render("a.yaml", "");
        let headlines = text.lines().filter(|l| l.starts_with("a.yaml:")).count();
        assert_eq!(headlines, 4, "{text}");
        for places in [
            "12:1, 14:1, 16:1, 18:1, 20:1, …",
            "13:1, 15:1, 17:1, 19:1, 21:1, …",
        ] {
            let line = format!(" = 39 more of the same cause, at {places}\n");
            assert!(text.contains(&line), "{text}");
        }
        assert_eq!(text.matches("= help: write 0 there").count(), 1);
    }

    #[test]
    fn few_warnings_and_all_faults_are_shown_one_by_one() {
        let text = repeated(3).render("a.yaml", "");
        assert_eq!(text.lines().filter(|l| l.starts_with("a.yaml:")).count(), 8);
        let faults = Faults((1..50).map(|line| fault(line, 1)).collect());
        let text = faults.render("a.yaml", "");
        assert_eq!(
            text.lines().filter(|l| l.starts_with("a.yaml:")).count(),
            49
        );
    }

    #[test]
    fn places_outside_the_text_have_no_excerpt() {
        assert!(!fault(9, 9).render("a.yaml", "format: 1\n").contains('|'));
        assert!(
            fault(1, 90)
                .render("a.yaml", "format: 1\n")
                .contains("1 | format: 1")
        );
    }

    #[test]
    fn carriage_returns_break_lines() {
        for source in ["a\r\nb: 2", "a\rb: 2", "a\nb: 2"] {
            assert!(
                fault(2, 1).render("a.yaml", source).contains("2 | b: 2\n"),
                "{source:?}"
            );
        }
    }

    #[test]
    fn long_lines_are_cut_around_the_caret() {
        let source = format!("{}!{}", "é".repeat(300), "b".repeat(300));
        let text = fault(1, 301).render("a.yaml", &source);
        let lines: Vec<Vec<char>> = text.lines().map(|l| l.chars().collect()).collect();
        let caret = lines[3].iter().position(|c| *c == '^').expect("a caret");
        assert_eq!(lines[2][caret], '!');
        assert!(lines[2].len() < 120);
    }
}
