//! The layers of a crate: which file or folder may import which.
//!
//! A list has one line for each, the lowest layer first: `NAME: PERMITTED IMPORTS`. A name is a path below
//! `src` without `.rs`; a file belongs to the longest name that is a prefix of its path.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use crate::read::Imports;

/// The imports of each layer.
type Arrows = BTreeMap<String, BTreeSet<String>>;

/// The lines of a list, in order.
fn lines(list: &str) -> Vec<(&str, Vec<&str>)> {
    let lines = list
        .lines()
        .filter(|l| !l.is_empty() && !l.starts_with('#'));
    lines
        .map(|line| {
            let (name, allowed) = line.split_once(':').expect("`NAME: WHAT IT MAY IMPORT`");
            (name, allowed.split_whitespace().collect())
        })
        .collect()
}

/// Returns the layer of a file; a file without a name in the list is a layer of its own.
fn layer(file: &Path, list: &[(&str, Vec<&str>)]) -> String {
    let own = file.with_extension("").to_string_lossy().replace('\\', "/");
    let holds = |name: &&str| {
        let rest = own.strip_prefix(*name);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
    };
    let names = list.iter().map(|(name, _)| *name).filter(holds);
    let longest = names.max_by_key(|name| name.len());
    longest.map_or(own.clone(), str::to_owned)
}

/// Returns the imports between layers, without those of the crate's root, which lists all modules.
pub fn arrows(imports: &Imports, list: &str) -> Arrows {
    let list = lines(list);
    let mut arrows = Arrows::new();
    for (file, others) in imports
        .iter()
        .filter(|(file, _)| *file != Path::new("lib.rs"))
    {
        let own = layer(file, &list);
        let others = others.keys().filter(|f| *f != Path::new("lib.rs"));
        let mut others: BTreeSet<String> = others.map(|other| layer(other, &list)).collect();
        others.remove(&own);
        arrows.entry(own).or_default().extend(others);
    }
    arrows
}

/// Returns the imports that differ from the list, or those in the list that point upwards.
pub fn differences(found: &Arrows, list: &str) -> Vec<String> {
    let list = lines(list);
    let mut wrong = Vec::new();
    for (own, used) in found {
        let Some((_, allowed)) = list.iter().find(|(name, _)| name == own) else {
            wrong.push(format!("`{own}` has no line in the list"));
            continue;
        };
        for other in used.iter().filter(|o| !allowed.contains(&o.as_str())) {
            wrong.push(format!(
                "`{own}` imports `{other}`, which its line does not allow"
            ));
        }
        for other in allowed.iter().filter(|o| !used.contains(**o)) {
            wrong.push(format!(
                "`{own}` does not import `{other}`: take it out of its line"
            ));
        }
    }
    for (i, (own, allowed)) in list.iter().enumerate() {
        if !found.contains_key(*own) {
            wrong.push(format!("there is no `{own}`: take its line out"));
        }
        for other in allowed {
            let is_below = list[..i].iter().any(|(name, _)| name == other);
            if !is_below {
                wrong.push(format!(
                    "`{own}` may import `{other}`, which is not above it in the list"
                ));
            }
        }
    }
    wrong
}
