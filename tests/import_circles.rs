//! No circles of imports between the files of a crate.
//!
//! A file that uses another stands above it: what is read first never needs what is read later. A name
//! that a module only passes on (`pub use`) counts as the file that defines it; `mod` declarations and
//! code under `#[cfg(test)]` do not count. Methods called on a value leave no path and are not seen.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The crates whose files are held to it, by their folders.
const CRATES: &[&str] = &["bgdyn-accuracy", "bgdyn-cli", "bgdyn-codegen", "bgdyn-runtime", "bgdyn-sim"];

/// Where a name of a module leads: to its file, or to another path.
type Names = BTreeMap<String, Vec<String>>;

/// A module of a file of its own.
struct Module {
    file: PathBuf,
    /// Names that it passes on, and the paths from the root of the crate that they stand for.
    passed_on: Names,
    /// Paths from the root of the crate that its code uses.
    used: BTreeSet<Vec<String>>,
}

/// The modules of a crate, by their paths from its root.
type Modules = BTreeMap<Vec<String>, Module>;

/// What a file takes from others: names by file.
type Imports = BTreeMap<PathBuf, BTreeMap<PathBuf, BTreeSet<String>>>;

#[test]
fn files_of_a_crate_import_each_other_in_one_direction() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = String::new();
    for name in CRATES {
        let source = root.join(name).join("src");
        let imports = imports(&source);
        assert!(imports.len() > 5, "{name}: no files are found");
        for circle in circles(&imports) {
            found += &description(name, &imports, &circle);
        }
    }
    assert!(found.is_empty(), "circles of imports:\n{found}");
}

/// A circle, one line for each import in it.
fn description(name: &str, imports: &Imports, circle: &BTreeSet<PathBuf>) -> String {
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

/// Which file of a crate takes what from which.
fn imports(source: &Path) -> Imports {
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

/// The file that defines what a path names, and the name there. A path to a module alone is its file.
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
        // A name of another crate, or one that a module passes on under its own path.
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

/// The words and signs of a file, without comments, texts and what is under `#[cfg(test)]`.
fn code(text: &str) -> Vec<String> {
    without_tests(words(text))
}

/// Words and signs: `::` is one sign; comments and texts are left out.
fn words(text: &str) -> Vec<String> {
    let c: Vec<char> = text.chars().collect();
    let at = |i: usize| c.get(i).copied().unwrap_or('\0');
    let (mut words, mut i) = (Vec::new(), 0);
    while i < c.len() {
        let raw =
            c[i] == 'r' && (at(i + 1) == '"' || (at(i + 1) == '#' && "#\"".contains(at(i + 2))));
        if c[i] == '/' && at(i + 1) == '/' {
            while i < c.len() && c[i] != '\n' {
                i += 1;
            }
        } else if c[i] == '/' && at(i + 1) == '*' {
            i += 2;
            while i < c.len() && !(c[i] == '*' && at(i + 1) == '/') {
                i += 1;
            }
            i += 2;
        } else if raw {
            let hashes = (i + 1..).take_while(|&k| at(k) == '#').count();
            i += hashes + 2;
            let ends = |i: usize| at(i) == '"' && (1..=hashes).all(|k| at(i + k) == '#');
            while i < c.len() && !ends(i) {
                i += 1;
            }
            i += hashes + 1;
        } else if c[i] == '"' {
            i += 1;
            while i < c.len() && c[i] != '"' {
                i += if c[i] == '\\' { 2 } else { 1 };
            }
            i += 1;
        } else if c[i] == '\'' && (at(i + 1) == '\\' || at(i + 2) == '\'') {
            // A character; else a lifetime.
            i += if at(i + 1) == '\\' { 3 } else { 2 };
            while i < c.len() && c[i] != '\'' {
                i += 1;
            }
            i += 1;
        } else if c[i].is_alphanumeric() || c[i] == '_' {
            let start = i;
            while i < c.len() && (c[i].is_alphanumeric() || c[i] == '_') {
                i += 1;
            }
            words.push(c[start..i].iter().collect());
        } else if c[i] == ':' && at(i + 1) == ':' {
            words.push("::".into());
            i += 2;
        } else {
            if !c[i].is_whitespace() {
                words.push(c[i].to_string());
            }
            i += 1;
        }
    }
    words
}

/// Without each item that follows `#[cfg(test)]`: up to its `;` or its last brace.
fn without_tests(words: Vec<String>) -> Vec<String> {
    let mark = ["#", "[", "cfg", "(", "test", ")", "]"];
    let (mut left, mut i) = (Vec::new(), 0);
    while i < words.len() {
        if !words[i..].iter().take(mark.len()).eq(mark.iter()) {
            left.push(words[i].clone());
            i += 1;
            continue;
        }
        let mut depth = 0;
        while i < words.len() {
            match words[i].as_str() {
                "{" => depth += 1,
                "}" => depth -= 1,
                _ => {}
            }
            let ends = words[i] == "}" || words[i] == ";";
            i += 1;
            if ends && depth == 0 {
                break;
            }
        }
    }
    left
}

/// The names that a module passes on, and the paths that it uses, from the root of the crate.
fn paths_of(
    code: &[String],
    own: &[String],
    modules: &BTreeSet<Vec<String>>,
) -> (Names, BTreeSet<Vec<String>>) {
    let (mut passed_on, mut used) = (Names::new(), BTreeSet::new());
    let mut imported = Names::new();
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
            // A module that was imported goes on by the path of its import.
            if let Some(first) = imported.get(&path[0]) {
                let rest = path[1..].iter().cloned();
                used.insert(first.iter().cloned().chain(rest).collect());
            } else if let Some(path) = absolute(&path, own, modules) {
                used.insert(path);
            }
        }
        i += 1;
    }
    // The name of a module is no import of its own: the path after it is one, if there is any.
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

/// The paths of a tree after `use`, each with the name that it gets.
fn tree(code: &[String], i: &mut usize, before: &[String], all: &mut Vec<(Vec<String>, String)>) {
    let mut path = before.to_vec();
    while let Some(word) = code.get(*i) {
        *i += 1;
        match word.as_str() {
            "::" => {}
            "{" => {
                while code.get(*i).is_some_and(|next| next != "}") {
                    tree(code, i, &path, all);
                    // Past the comma; or past a sign that no import has, in the body of a macro.
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

/// A path from the root of the crate; `None` where it leads to another crate.
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

/// The files that reach each other by imports, in sets of more than one.
fn circles(imports: &Imports) -> Vec<BTreeSet<PathBuf>> {
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

/// Writes a small crate to a folder and gives its circles, as names of files.
fn circles_of(name: &str, files: &[(&str, &str)]) -> Vec<Vec<String>> {
    let folder = std::env::temp_dir().join(format!("import_circles_{name}_{}", std::process::id()));
    for (file, text) in files {
        let path = folder.join(file);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a new folder");
        fs::write(path, text).expect("a new file");
    }
    let found = circles(&imports(&folder));
    fs::remove_dir_all(&folder).expect("a folder of this test");
    let names = |circle: BTreeSet<PathBuf>| {
        let name = |path: PathBuf| path.to_string_lossy().replace('\\', "/");
        circle.into_iter().map(name).collect()
    };
    found.into_iter().map(names).collect()
}

#[test]
fn a_circle_through_a_name_that_a_module_passes_on_is_found() {
    let files = [
        ("lib.rs", "mod a; mod b; mod c; pub use c::C;"),
        ("a.rs", "use crate::b::{self, B}; pub fn a() { b::f(); }"),
        ("b/mod.rs", "mod inner; pub use inner::B; pub fn f() {}"),
        ("b/inner.rs", "use crate::C; pub struct B(C);"),
        ("c.rs", "pub struct C; fn c() { let _ = crate::a::a; }"),
    ];
    assert_eq!(
        circles_of("passed_on", &files),
        [["a.rs", "b/inner.rs", "c.rs"]]
    );
}

#[test]
fn a_child_that_uses_what_its_parent_defines_is_found() {
    let files = [
        ("lib.rs", "mod parent;"),
        (
            "parent/mod.rs",
            "mod child; pub struct P; pub fn f() { child::g() }",
        ),
        ("parent/child.rs", "use super::P; pub fn g() {}"),
    ];
    let wanted = [["parent/child.rs", "parent/mod.rs"]];
    assert_eq!(circles_of("parent", &files), wanted);
}

#[test]
fn tests_comments_texts_and_declarations_are_no_imports() {
    let files = [
        ("lib.rs", "mod parent;"),
        (
            "parent/mod.rs",
            "mod child; pub use child::g; // crate::parent::child::g\n pub struct P;",
        ),
        (
            "parent/child.rs",
            "use super::P; pub fn g() -> &'static str { \"crate::x\" }\n\
             #[cfg(test)] mod tests { use super::super::other::x; }",
        ),
        ("parent/other.rs", "use super::g; pub fn x() {}"),
    ];
    assert!(circles_of("none", &files).is_empty());
}
