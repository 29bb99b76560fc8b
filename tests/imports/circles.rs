//! Finds cycles of imports between the files of a crate.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use crate::read::Imports;

/// Returns the sets of more than one file that reach each other by imports.
pub fn circles(imports: &Imports) -> Vec<BTreeSet<PathBuf>> {
    let reached = |from: &PathBuf| {
        let mut reached = BTreeSet::new();
        let mut open = vec![from];
        while let Some(file) = open.pop() {
            for next in imports.get(file).into_iter().flat_map(BTreeMap::keys) {
                if reached.insert(next.clone()) {
                    open.push(next);
                }
            }
        }
        reached
    };
    let all: BTreeMap<&PathBuf, BTreeSet<PathBuf>> =
        imports.keys().map(|file| (file, reached(file))).collect();
    let mut circles: Vec<BTreeSet<PathBuf>> = Vec::new();
    for (file, reached) in &all {
        let back = |other: &&PathBuf| all.get(other).is_some_and(|r| r.contains(*file));
        let circle: BTreeSet<PathBuf> = reached.iter().filter(back).cloned().collect();
        if circle.len() > 1 && !circles.contains(&circle) {
            circles.push(circle);
        }
    }
    circles
}

/// Describes a cycle, one line for each import in it.
pub fn description(name: &str, imports: &Imports, circle: &BTreeSet<PathBuf>) -> String {
    let mut text = format!("{name}: {} files\n", circle.len());
    for file in circle {
        for (other, names) in imports[file].iter().filter(|(o, _)| circle.contains(*o)) {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            let (file, other) = (file.display(), other.display());
            text += &format!("  {file} -> {other}: {}\n", names.join(", "));
        }
    }
    text
}
