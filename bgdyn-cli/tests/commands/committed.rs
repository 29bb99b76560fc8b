//! Tests the committed figures and tables: counts are those of the generator, numbers are short.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use bgdyn_accuracy::generate::{ALL_BUT, ablations, measured, operations};
use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::read_scene;
use bgdyn_codegen::system::SceneEquations;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn scene(name: &str) -> SceneEquations {
    let path = root().join(format!("specs/scenes/{name}.scene.yaml"));
    let load = |mechanism: &str| Ok(text(&beside(&path, mechanism)));
    let read = read_scene(&text(&path), &stem(&path), load);
    read.unwrap_or_else(|_| panic!("{name} is refused")).0
}

/// The operations in `docs/accuracy/costs.csv`, which the figures of effects show, for all effects and
/// without each family.
#[test]
fn operations_of_effects_are_those_of_the_generator() {
    let mut table: BTreeMap<String, BTreeMap<String, usize>> = BTreeMap::new();
    let file = root().join("docs/accuracy/costs.csv");
    let mut reader = csv::Reader::from_path(file).expect("the table");
    for row in reader.records() {
        let row = row.expect("a row");
        let count = row[2].parse().expect("a count");
        let scene = table.entry(row[0].to_owned()).or_default();
        scene.insert(row[1].to_owned(), count);
    }
    assert!(!table.is_empty());
    for (name, written) in table {
        let full = measured(&scene(&name)).expect("an output to measure");
        let without = ablations(&full).into_iter().filter_map(|ablation| {
            let system = ablation.system?;
            let listed = ablation.effects.starts_with(ALL_BUT);
            listed.then(|| (ablation.effects, operations(&system)))
        });
        let all = std::iter::once(("all".to_owned(), operations(&full)));
        let counted: BTreeMap<String, usize> = all.chain(without).collect();
        assert_eq!(written, counted, "{name}");
    }
}

/// Returns the files with this extension below a folder.
fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files(&path, extension));
        } else if path.extension().is_some_and(|e| e == extension) {
            found.push(path);
        }
    }
    found
}

/// Returns the numbers in a text with more than six significant digits.
fn long_numbers(text: &str) -> Vec<&str> {
    let words = text.split(|c: char| !(c.is_ascii_digit() || c == '.'));
    let is_long = |word: &&str| {
        let digits = word.replace('.', "");
        let fraction = word.contains('.');
        let digits = digits.trim_start_matches('0');
        let digits = match fraction {
            true => digits,
            false => digits.trim_end_matches('0'),
        };
        digits.len() > 6
    };
    words.filter(is_long).collect()
}

#[test]
fn long_numbers_are_recognised() {
    assert_eq!(
        long_numbers("0.001234567 m, 12.3456, 2026-11-25, 10000000"),
        ["0.001234567"]
    );
    assert_eq!(
        long_numbers("1.0000001 and 1234567"),
        ["1.0000001", "1234567"]
    );
}

/// Texts and titles of the figures in `docs/`, and the titles of its pages, have numbers of at most six
/// digits.
#[test]
fn figures_and_titles_have_short_numbers() {
    let docs = root().join("docs");
    let mut texts = 0;
    for path in files(&docs, "svg") {
        let svg = text(&path);
        for element in ["text", "title"] {
            for part in svg.split(&format!("<{element}")).skip(1) {
                let part = part.split(&format!("</{element}>")).next();
                let words = part.and_then(|part| part.split_once('>'));
                let words = words.map_or("", |(_, words)| words);
                let found = long_numbers(words);
                assert!(
                    found.is_empty(),
                    "{}: {found:?} in `{words}`",
                    path.display()
                );
                texts += 1;
            }
        }
    }
    assert!(texts > 1000, "{texts} texts");
    for path in files(&docs, "md") {
        let page = text(&path);
        for title in page.lines().filter(|line| line.starts_with('#')) {
            let found = long_numbers(title);
            assert!(
                found.is_empty(),
                "{}: {found:?} in `{title}`",
                path.display()
            );
        }
    }
}
