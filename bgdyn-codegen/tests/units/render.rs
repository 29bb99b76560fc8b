//! Faults and warnings as text.

use bgdyn_codegen::fault::{Fault, Faults, Location, Position};

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
