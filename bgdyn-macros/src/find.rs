//! Finds the spec's file.

use std::path::{Path, PathBuf};

use proc_macro2::Span;

/// Returns the file named `written`: beside the calling source file, in the package's directory, or in its
/// `specs/` and `specs/scenes/`. It is an error if there are two different files of that name, or none.
pub(crate) fn find(written: &str, span: Span) -> Result<PathBuf, String> {
    choose(written, &places(span), &here())
}

/// Returns the only file named `written` in the directories; messages shorten paths below `here`.
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
        // Under the requested name, which can differ from that of a link's target.
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

/// Returns the directory in which the compiler runs: usually the root of the workspace.
fn here() -> PathBuf {
    std::env::current_dir().unwrap_or_default()
}

/// Returns the path as rustc prints paths: relative to the directory in which it runs, if below that.
fn shown<'p>(path: &'p Path, here: &Path) -> &'p Path {
    path.strip_prefix(here).unwrap_or(path)
}

fn places(span: Span) -> Vec<PathBuf> {
    let mut places = Vec::new();
    // An editor's server may not know the source file; the other directories are sufficient.
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

/// Returns the file's name.
pub(crate) fn file_name(path: &Path) -> String {
    path.file_name()
        .map(|n| n.to_string_lossy().into_owned())
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// Creates a directory for this test, with empty files.
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

    /// Returns the file that the macro finds if `src/main.rs` calls it.
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
        // Two paths of the same file count as one.
        let places = [root.join("src"), root.join("specs/../src")];
        assert!(choose("a.yaml", &places, &root).is_ok());
        fs::remove_dir_all(root).expect("it was there");
    }
}
