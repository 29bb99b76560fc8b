//! Faults as text: one headline each, and an excerpt of the source with a caret.

use super::{Fault, Faults, Severity};

/// How many characters of a source line an excerpt shows.
const EXCERPT_WIDTH: usize = 100;

impl Fault {
    /// `FILE:LINE:COLUMN: links[2].inertia: message [rule]`, on one line.
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

    /// The headline, the source line with a caret, the way out. Ends with a line break.
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

impl Faults {
    /// Every finding with its excerpt, an empty line between them.
    pub fn render(&self, file: &str, source: &str) -> String {
        self.0
            .iter()
            .map(|f| f.render(file, source))
            .collect::<Vec<_>>()
            .join("\n")
    }
}

/// Line `number` (from 1) of `source`, by YAML's line breaks: LF, CR LF, CR.
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

/// What of `line` is shown, and how many columns stand before the caret.
fn excerpt(line: &str, column: usize) -> (String, usize) {
    let characters: Vec<char> = line.chars().collect();
    let place = column.saturating_sub(1).min(characters.len());
    let start = if characters.len() <= EXCERPT_WIDTH {
        0
    } else {
        place.saturating_sub(EXCERPT_WIDTH / 2)
    };
    let printable = |c: &char| if c.is_control() { ' ' } else { *c };
    let shown: String = characters[start..]
        .iter()
        .take(EXCERPT_WIDTH)
        .map(printable)
        .collect();
    (shown.trim_end().to_owned(), place - start)
}

#[cfg(test)]
mod tests {
    use crate::fault::{Fault, Place, Position};

    fn fault(line: usize, column: usize) -> Fault {
        let place = Place {
            position: Position { line, column },
            path: "links[0].mass".into(),
        };
        Fault::new(&place, "negative-mass", "the mass is -1").with_help("leave it out")
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
