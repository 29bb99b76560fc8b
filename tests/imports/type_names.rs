//! The names of a crate's types: structs, enums, unions, traits and aliases outside of any body.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::words::code;

/// Returns the type names that more than one file of a crate defines, with these files.
pub fn repeated(source: &Path, files: impl Iterator<Item = PathBuf>) -> Vec<String> {
    let mut defined: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for file in files {
        let text = fs::read_to_string(source.join(&file)).expect("a file of the crate");
        for name in type_names(&text) {
            let files = defined.entry(name).or_default();
            files.push(file.display().to_string());
        }
    }
    let repeated = defined.iter().filter(|(_, files)| files.len() > 1);
    repeated
        .map(|(name, files)| format!("{name}: {}", files.join(", ")))
        .collect()
}

/// Returns the types that a text defines outside of braces and parentheses. Those inside are associated
/// types, types of one function, and text in macros.
fn type_names(text: &str) -> Vec<String> {
    const KEYWORDS: [&str; 5] = ["struct", "enum", "union", "trait", "type"];
    let words = code(text);
    let (mut depth, mut names) = (0usize, Vec::new());
    for pair in words.windows(2) {
        match pair[0].as_str() {
            "{" | "(" => depth += 1,
            "}" | ")" => depth = depth.saturating_sub(1),
            word if depth == 0 && KEYWORDS.contains(&word) => names.push(pair[1].clone()),
            _ => {}
        }
    }
    names
}

#[test]
fn types_inside_of_bodies_do_not_count() {
    let text = "pub struct A<T>(T);\nimpl X for A { type Output = A; }\nenum B { C }\n\
                fn f() { struct D; }\npub(crate) type E = B; // struct F\ntrait G { type H; }";
    assert_eq!(type_names(text), ["A", "B", "E", "G"]);
}
