//! The book's pages show what the command prints: every `$ bgdyn …` of a `console` block is run.
//!
//! Output may be elided by a line `…`. `<!-- change: A => B -->` before a block changes the page's
//! spec for that block.

use std::fs;
use std::path::Path;

use super::{bgdyn_in, root, scratch};

/// Pages, and the folder in which a reader stands.
const PAGES: [(&str, &str); 2] = [
    ("docs/first_model.md", "examples/first_model"),
    ("docs/tests_to_copy.md", "examples/first_model"),
];

/// A command with what the page says that it prints.
#[derive(Default)]
struct Shown {
    command: String,
    output: String,
    changes: Vec<(String, String)>,
}

/// The commands of a page's `console` blocks.
fn shown(page: &str) -> Vec<Shown> {
    let mut all: Vec<Shown> = Vec::new();
    let (mut inside, mut changes) = (false, Vec::new());
    for line in page.lines() {
        let change = line.strip_prefix("<!-- change: ");
        if let Some(change) = change.and_then(|c| c.strip_suffix(" -->")) {
            let (from, to) = change.split_once(" => ").expect("A => B");
            changes.push((from.to_owned(), to.to_owned()));
        } else if line == "```console" {
            inside = true;
        } else if line == "```" && inside {
            (inside, changes) = (false, Vec::new());
        } else if let (true, Some(command)) = (inside, line.strip_prefix("$ ")) {
            all.push(Shown {
                command: command.to_owned(),
                changes: changes.clone(),
                ..Shown::default()
            });
        } else if let (true, Some(last)) = (inside, all.last_mut()) {
            last.output += &format!("{line}\n");
        }
    }
    all
}

/// Whether `text` is `pattern` with something in place of its lines `…`.
fn matches(pattern: &str, text: &str) -> bool {
    let Some((head, tail)) = pattern.split_once("…\n") else {
        return pattern == text;
    };
    let rest = text.strip_prefix(head);
    let starts = |rest: &str| {
        let ends = std::iter::once(0).chain(rest.match_indices('\n').map(|(i, _)| i + 1));
        ends.collect::<Vec<_>>()
    };
    rest.is_some_and(|rest| {
        starts(rest)
            .into_iter()
            .any(|at| matches(tail, &rest[at..]))
    })
}

/// The folder of a command: the reader's, or one with the changed spec.
fn folder(reader: &Path, shown: &Shown) -> std::path::PathBuf {
    if shown.changes.is_empty() {
        return reader.to_owned();
    }
    let spec = "specs/head.yaml";
    let mut text = fs::read_to_string(reader.join(spec)).expect("the page's spec");
    for (from, to) in &shown.changes {
        assert!(text.contains(from), "nothing to change: {from}");
        text = text.replace(from, to);
    }
    let path = scratch("book", spec, text);
    Path::new(path.trim_end_matches(spec)).to_owned()
}

#[test]
fn pages_show_what_the_command_prints() {
    let mut commands = 0;
    for (page, reader) in PAGES {
        let text = fs::read_to_string(root().join(page)).expect("the page");
        for shown in shown(&text) {
            let Some(arguments) = shown.command.strip_prefix("bgdyn ") else {
                continue;
            };
            let arguments: Vec<&str> = arguments.split(' ').collect();
            let run = bgdyn_in(&folder(&root().join(reader), &shown), &arguments);
            let printed = run.stdout + &run.stderr;
            assert!(
                matches(&shown.output, &printed),
                "{page}: `{}` prints\n{printed}",
                shown.command
            );
            commands += 1;
        }
    }
    assert!(commands >= 4, "{commands} commands found");
}

#[test]
fn elided_lines_stand_for_any_others() {
    assert!(matches("a\n…\nd\n", "a\nb\nc\nd\n"));
    assert!(matches("…\nd\n…\n", "a\nd\ne\n"));
    assert!(!matches("a\n…\nd\n", "a\nb\nc\n"));
    assert!(!matches("a\n", "a\nb\n"));
}
