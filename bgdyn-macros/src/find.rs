//! Finds the spec's file.

use std::path::{Path, PathBuf};

use proc_macro2::Span;

/// The file meant by `written`: beside the calling source file, in the package's directory, or in
/// its `specs/` and `specs/scenes/`. Two different files of that name are an error, and so is none.
pub(crate) fn find(written: &str, span: Span) -> Result<PathBuf, String> {
    choose(written, &places(span), &here())
}

/// The only file called `written` in the places; messages shorten paths below `here`.
fn choose(written: &str, places: &[PathBuf], here: &Path) -> Result<PathBuf, String> {
    let candidates: Vec<PathBuf> = places.iter().map(|p| p.join(written)).collect();
    let mut found: Vec<(PathBuf, &PathBuf)> = Vec::new();
    for candidate in &candidates {
        if let Ok(path) = candidate.canonicalize()
            && path.is_file()
            && !found.iter().any(|(known, _)| *known == path)
        {
            found.push((path, candidate));
        }
    }
    let list = |paths: &mut dyn Iterator<Item = &PathBuf>| -> String {
        paths
            .map(|p| format!("\n  {}", shown(p, here).display()))
            .collect()
    };
    match found.as_slice() {
        // By the name it was asked for, which a link's target need not have.
        [(_, only)] => Ok((*only).clone()),
        [] => Err(format!(
            "bgdyn: no file `{written}`; looked for{}",
            list(&mut candidates.iter())
        )),
        several => Err(format!(
            "bgdyn: `{written}` could mean any of{}\nwrite a path that leaves only one of them",
            list(&mut several.iter().map(|(_, candidate)| *candidate))
        )),
    }
}

/// The directory in which the compiler runs: the root of the workspace, as a rule.
fn here() -> PathBuf {
    std::env::current_dir().unwrap_or_default()
}

/// The path as rustc shows paths: from the directory in which it runs, if below that.
fn shown<'p>(path: &'p Path, here: &Path) -> &'p Path {
    path.strip_prefix(here).unwrap_or(path)
}

fn places(span: Span) -> Vec<PathBuf> {
    let mut places = Vec::new();
    // An editor's server may not know the source file; what it knows is enough.
    if let Some(source) = span.unwrap().local_file()
        && let Some(folder) = source.parent()
    {
        places.push(here().join(folder));
    }
    if let Some(manifest) = std::env::var_os("CARGO_MANIFEST_DIR") {
        let manifest = PathBuf::from(manifest);
        let specs = manifest.join("specs");
        let scenes = specs.join("scenes");
        places.extend([manifest, specs, scenes]);
    }
    places
}

/// The file's name.
pub(crate) fn file_name(path: &Path) -> String {
    path.file_name()
        .map(|n| n.to_string_lossy().into_owned())
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// A directory of this test's own, with empty files.
    fn scratch(name: &str, files: &[&str]) -> PathBuf {
        let root = std::env::temp_dir().join(format!("bgdyn-find-{name}-{}", std::process::id()));
        fs::remove_dir_all(&root).ok();
        for file in files {
            let path = root.join(file);
            fs::create_dir_all(path.parent().expect("a parent")).expect("a directory");
            fs::write(path, "").expect("a file");
        }
        root.canonicalize().expect("the directory is there")
    }

    /// Where the macro looks when `src/main.rs` calls it.
    fn search(root: &Path, written: &str) -> Result<PathBuf, String> {
        let places = ["src", "", "specs"].map(|p| root.join(p));
        let found = choose(written, &places, root);
        found.map(|path| shown(&path, root).to_path_buf())
    }

    #[test]
    fn every_place_is_searched() {
        let files = ["src/a.yaml", "b.yaml", "specs/c.yaml", "specs/d.yaml/e"];
        let root = scratch("every", &files);
        for (written, file) in [
            ("a.yaml", "src/a.yaml"),
            ("../src/a.yaml", "src/../src/a.yaml"),
            ("b.yaml", "b.yaml"),
            ("../b.yaml", "src/../b.yaml"),
            ("c.yaml", "specs/c.yaml"),
            ("specs/c.yaml", "specs/c.yaml"),
        ] {
            assert_eq!(
                search(&root, written).as_deref(),
                Ok(Path::new(file)),
                "{written}"
            );
        }
        let whole = root.join("b.yaml");
        let found = search(&root, &whole.display().to_string());
        assert_eq!(found.as_deref(), Ok(Path::new("b.yaml")));
        let message = search(&root, "d.yaml").expect_err("a directory is no file");
        assert_eq!(
            message,
            "bgdyn: no file `d.yaml`; looked for\n  src/d.yaml\n  d.yaml\n  specs/d.yaml"
        );
        fs::remove_dir_all(root).expect("it was there");
    }

    #[test]
    fn two_files_are_one_too_many() {
        let root = scratch("two", &["src/a.yaml", "specs/a.yaml"]);
        let message = search(&root, "a.yaml").expect_err("two files");
        assert_eq!(
            message,
            "bgdyn: `a.yaml` could mean any of\n  src/a.yaml\n  specs/a.yaml\n\
             write a path that leaves only one of them"
        );
        // The same file by two ways is one.
        let places = [root.join("src"), root.join("specs/../src")];
        assert!(choose("a.yaml", &places, &root).is_ok());
        fs::remove_dir_all(root).expect("it was there");
    }
}
