//! Checks that the book's pages show the command's output: every `$ bgdyn …` of a `console` block is run.
//!
//! A line `…` replaces omitted output. `<!-- change: A => B -->` before a block changes the page's spec
//! for that block. A block of Rust after `<!-- generated: SPEC -->` is part of the generated code for that
//! spec.

use std::fs;
use std::path::Path;

use super::{bgdyn, bgdyn_in, root, scratch};

/// Pages, and the folders of their commands.
const PAGES: [(&str, &str); 5] = [
    ("docs/first_model.md", "examples/first_model"),
    ("docs/tests_to_copy.md", "examples/first_model"),
    ("docs/generated_code.md", "."),
    ("docs/paper_to_code.md", "."),
    ("docs/loops.md", "."),
];

/// A command with its output on the page.
#[derive(Default)]
struct Shown {
    command: String,
    output: String,
    changes: Vec<(String, String)>,
}

/// Returns the commands of a page's `console` blocks.
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

/// Returns whether `text` is `pattern` with any text in place of its lines `…`.
fn matches(pattern: &str, text: &str) -> bool {
    let mut pieces = pattern.split("…\n");
    let Some(mut rest) = pieces.next().and_then(|first| text.strip_prefix(first)) else {
        return false;
    };
    let mut last = None;
    for piece in pieces {
        let Some(at) = rest.find(piece) else {
            return false;
        };
        (rest, last) = (&rest[at + piece.len()..], Some(piece));
    }
    rest.is_empty() || last.is_some_and(|last| text.ends_with(last))
}

/// Returns the folder of a command, or one with the changed spec.
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
    assert!(commands >= 10, "{commands} commands found");
}

/// Returns the excerpts of generated code on a page: the spec, and the text.
fn excerpts(page: &str) -> Vec<(&str, &str)> {
    let marked = page.split("<!-- generated: ").skip(1);
    marked
        .map(|rest| {
            let (spec, rest) = rest.split_once(" -->\n```rust,ignore\n").expect("a block");
            (spec, rest.split_once("```").expect("its end").0)
        })
        .collect()
}

#[test]
fn excerpts_are_what_is_generated() {
    let unindented = |text: &str| -> String {
        let lines = text.lines().map(|line| format!("{}\n", line.trim_start()));
        lines.collect()
    };
    for (page, least) in [("README.md", 1), ("docs/generated_code.md", 9)] {
        let text = fs::read_to_string(root().join(page)).expect("the page");
        let excerpts = excerpts(&text);
        assert!(excerpts.len() >= least, "{page}: {}", excerpts.len());
        for (spec, excerpt) in excerpts {
            let generated = bgdyn(&["generate", spec]).good();
            let found = unindented(&generated).contains(&unindented(excerpt));
            assert!(
                found,
                "{page}: not in what is generated for {spec}:\n{excerpt}"
            );
        }
    }
}

/// Returns the anchor of a heading on a code host.
fn anchor(heading: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || " -_".contains(*c);
    let kept: String = heading.to_lowercase().chars().filter(kept).collect();
    kept.replace(' ', "-")
}

/// Returns the targets of a page's links, except web addresses.
fn links(page: &str) -> Vec<&str> {
    let ends = page.split("](").skip(1);
    let targets = ends.filter_map(|rest| Some(rest.split_once(')')?.0));
    let local = targets.filter(|target| !target.contains("://") && !target.contains(' '));
    local.collect()
}

#[test]
fn links_lead_somewhere() {
    let folder = fs::read_dir(root().join("docs")).expect("the book");
    let pages = folder.map(|entry| entry.expect("an entry").path());
    let pages = pages.filter(|path| path.extension().is_some_and(|e| e == "md"));
    let front = ["README.md", "ARCHITECTURE.md"].map(|name| root().join(name));
    let mut lost = Vec::new();
    for path in pages.chain(front) {
        let text = fs::read_to_string(&path).expect("a page");
        for link in links(&text) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let target = match file {
                "" => path.clone(),
                file => path.with_file_name("").join(file),
            };
            let found = target.exists() && {
                let there = fs::read_to_string(&target).unwrap_or_default();
                let mut headings = there.lines().filter(|line| line.starts_with('#'));
                heading.is_empty()
                    || headings.any(|line| anchor(line.trim_start_matches('#').trim()) == heading)
            };
            if !found {
                lost.push(format!("{}: {link}", path.display()));
            }
        }
    }
    assert!(lost.is_empty(), "{}", lost.join("\n"));
}

#[test]
fn elided_lines_stand_for_any_others() {
    assert!(matches("a\n…\nd\n", "a\nb\nc\nd\n"));
    assert!(matches("…\nd\n…\n", "a\nd\ne\n"));
    assert!(!matches("a\n…\nd\n", "a\nb\nc\n"));
    assert!(!matches("a\n", "a\nb\n"));
}
