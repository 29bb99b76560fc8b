//! Finds the imports between the files of a crate, by parsing their text.
//!
//! A name that a module only re-exports (`pub use`) counts as that of the defining file; `mod`
//! declarations and code under `#[cfg(test)]` do not count. Methods called on a value have no path and are
//! not found.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::words::code;

/// The target of a name in a module: its file, or another path.
type Names = BTreeMap<String, Vec<String>>;

/// A module with its own file.
struct Module {
    file: PathBuf,
    /// Names that it re-exports, and their paths from the root of the crate.
    passed_on: Names,
    /// Paths from the root of the crate that its code uses.
    used: BTreeSet<Vec<String>>,
}

/// The modules of a crate, by their paths from its root.
type Modules = BTreeMap<Vec<String>, Module>;

/// The imports of a file: names by file.
pub type Imports = BTreeMap<PathBuf, BTreeMap<PathBuf, BTreeSet<String>>>;

/// Returns the imports between all files of a crate.
pub fn imports(source: &Path) -> Imports {
    let modules = modules(source);
    let mut imports = Imports::new();
    for module in modules.values() {
        let own = imports.entry(module.file.clone()).or_default();
        for path in &module.used {
            let Some((file, name)) = definition(&modules, path, 0) else {
                continue;
            };
            if file != module.file {
                own.entry(file).or_default().insert(name);
            }
        }
    }
    imports
}

/// Returns the file that defines a path's name, and the name in it. A path to a module alone is its file.
fn definition(modules: &Modules, path: &[String], depth: usize) -> Option<(PathBuf, String)> {
    assert!(depth < 32, "{path:?} is passed on without end");
    let length = (0..=path.len()).rev();
    let own = length
        .map(|n| &path[..n])
        .find(|p| modules.contains_key(*p))?;
    let module = &modules[own];
    let Some(name) = path.get(own.len()) else {
        let name = path.last().cloned().unwrap_or_else(|| "crate".into());
        return Some((module.file.clone(), name));
    };
    if let Some(target) = module.passed_on.get(name) {
        // A name of another crate, or one that a module re-exports under its own path.
        if target.as_slice() == &path[..=own.len()] {
            return None;
        }
        let rest = path[own.len() + 1..].iter().cloned();
        let target: Vec<String> = target.iter().cloned().chain(rest).collect();
        return definition(modules, &target, depth + 1);
    }
    Some((module.file.clone(), name.clone()))
}

/// The modules of the crate with this folder of sources.
fn modules(source: &Path) -> Modules {
    let mut files = Vec::new();
    collect(source, &mut files);
    let mut texts = BTreeMap::new();
    for file in files {
        let below = file.strip_prefix(source).expect("a file of the folder");
        let mut path: Vec<String> = below
            .with_extension("")
            .iter()
            .map(|part| part.to_string_lossy().into_owned())
            .collect();
        if path.last().is_some_and(|p| p == "mod") || path == ["lib"] {
            path.pop();
        }
        if path == ["main"] {
            continue;
        }
        let text = fs::read_to_string(&file).expect("a readable file");
        texts.insert(path, (below.to_owned(), code(&text)));
    }
    let paths: BTreeSet<Vec<String>> = texts.keys().cloned().collect();
    let module = |(path, (file, code)): (Vec<String>, (PathBuf, Vec<String>))| {
        let (passed_on, used) = paths_of(&code, &path, &paths);
        let module = Module {
            file,
            passed_on,
            used,
        };
        (path, module)
    };
    texts.into_iter().map(module).collect()
}

/// The Rust files of a folder and its folders.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
}

/// Returns the names that a module re-exports, and the paths that it uses, from the root of the crate.
fn paths_of(
    code: &[String],
    own: &[String],
    modules: &BTreeSet<Vec<String>>,
) -> (Names, BTreeSet<Vec<String>>) {
    let (mut passed_on, mut used) = (Names::new(), BTreeSet::new());
    let mut imported = Names::new();
    // The words of the module's own code, without its imports.
    let mut words = BTreeSet::new();
    let mut i = 0;
    while i < code.len() {
        let starts = i == 0 || code[i - 1] != "::";
        if code[i] == "use" {
            let is_public = i > 0 && (code[i - 1] == "pub" || code[i - 1] == ")");
            let mut all = Vec::new();
            i += 1;
            tree(code, &mut i, &[], &mut all);
            for (path, name) in all {
                let path = absolute(&path, own, modules);
                if is_public {
                    passed_on.insert(name, path.unwrap_or_default());
                } else if let Some(path) = path {
                    imported.insert(name, path.clone());
                    used.insert(path);
                }
            }
            continue;
        }
        let before = i.checked_sub(1).map_or("", |i| code[i].as_str());
        let after = code.get(i + 1).map_or("", String::as_str);
        // Exclude declared names of modules, functions and fields, and methods.
        if !matches!(before, "mod" | "fn" | "." | "::") && after != ":" {
            words.insert(code[i].as_str());
        }
        let is_path = code.get(i + 1).is_some_and(|next| next == "::");
        if starts && is_path {
            let mut path = vec![code[i].clone()];
            while code.get(i + 1).is_some_and(|next| next == "::") {
                match code.get(i + 2) {
                    Some(part) if part != "<" => path.push(part.clone()),
                    _ => break,
                }
                i += 2;
            }
            // The path of an imported module continues that of its import.
            if let Some(first) = imported.get(&path[0]) {
                let rest = path[1..].iter().cloned();
                used.insert(first.iter().cloned().chain(rest).collect());
            } else if let Some(path) = absolute(&path, own, modules) {
                used.insert(path);
            }
        }
        i += 1;
    }
    // A name that a module re-exports and uses is imported as well.
    for (name, path) in &passed_on {
        if words.contains(name.as_str()) && !path.is_empty() {
            used.insert(path.clone());
        }
    }
    // The name of a module alone is no import; the path after it is one, if it exists.
    let bare = |path: &Vec<String>| {
        let longer = used
            .iter()
            .any(|p| p.len() > path.len() && p.starts_with(path));
        modules.contains(path) && longer
    };
    let bare: Vec<Vec<String>> = used.iter().filter(|p| bare(p)).cloned().collect();
    bare.iter().for_each(|path| {
        used.remove(path);
    });
    (passed_on, used)
}

/// Returns the paths of a tree after `use`, each with the name that it gets.
fn tree(code: &[String], i: &mut usize, before: &[String], all: &mut Vec<(Vec<String>, String)>) {
    let mut path = before.to_vec();
    while let Some(word) = code.get(*i) {
        *i += 1;
        match word.as_str() {
            "::" => {}
            "{" => {
                while code.get(*i).is_some_and(|next| next != "}") {
                    tree(code, i, &path, all);
                    // After the comma; or after another token in the body of a macro.
                    if code.get(*i).is_some_and(|next| next != "}") {
                        *i += 1;
                    }
                }
                *i += 1;
                return;
            }
            "as" => {
                let name = code.get(*i).cloned().unwrap_or_default();
                *i += 1;
                all.push((path, name));
                return;
            }
            "," | "}" | ";" => {
                *i -= 1;
                break;
            }
            "self" if !path.is_empty() => {}
            word => path.push(word.to_owned()),
        }
    }
    let name = path.last().cloned().unwrap_or_default();
    all.push((path, name));
}

/// Returns a path from the root of the crate; `None` if it leads to another crate.
fn absolute(
    path: &[String],
    own: &[String],
    modules: &BTreeSet<Vec<String>>,
) -> Option<Vec<String>> {
    let (mut place, mut rest) = match path[0].as_str() {
        "crate" => (Vec::new(), &path[1..]),
        "self" => (own.to_vec(), &path[1..]),
        "super" => (own.to_vec(), path),
        first => {
            let child: Vec<String> = own.iter().cloned().chain([first.to_owned()]).collect();
            if !modules.contains(&child) {
                return None;
            }
            (own.to_vec(), path)
        }
    };
    while rest.first().is_some_and(|part| part == "super") {
        place.pop();
        rest = &rest[1..];
    }
    place.extend(rest.iter().cloned());
    Some(place)
}
