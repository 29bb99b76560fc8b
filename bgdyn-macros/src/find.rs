//! Where the spec is.

use std::path::{Path, PathBuf};

use proc_macro2::Span;

/// The file meant by `written`: beside the calling source file, in the package's directory, or in
/// its `specs/`. Two different files of that name are an error, and so is none.
pub(crate) fn find(written: &str, span: Span) -> Result<PathBuf, String> {
    let places = places(span);
    let mut found: Vec<PathBuf> = Vec::new();
    for place in &places {
        // An editor's server may not know the source file; what it knows is enough.
        if let Ok(path) = place.join(written).canonicalize()
            && path.is_file()
            && !found.contains(&path)
        {
            found.push(path);
        }
    }
    let list = |paths: &[PathBuf]| {
        paths
            .iter()
            .map(|p| format!("\n  {}", p.display()))
            .collect::<String>()
    };
    match found.as_slice() {
        [only] => Ok(only.clone()),
        [] => {
            let tried: Vec<PathBuf> = places.iter().map(|p| p.join(written)).collect();
            Err(format!(
                "bgdyn: no file `{written}`; looked for{}",
                list(&tried)
            ))
        }
        several => Err(format!(
            "bgdyn: `{written}` could mean any of{}\nwrite a path that leaves only one of them",
            list(several)
        )),
    }
}

fn places(span: Span) -> Vec<PathBuf> {
    let mut places = Vec::new();
    // Relative to the directory in which the compiler runs.
    if let Some(source) = span.unwrap().local_file()
        && let Some(folder) = source.parent()
    {
        let here = std::env::current_dir().unwrap_or_default();
        places.push(here.join(folder));
    }
    if let Some(manifest) = std::env::var_os("CARGO_MANIFEST_DIR") {
        let manifest = PathBuf::from(manifest);
        let specs = manifest.join("specs");
        places.push(manifest);
        places.push(specs);
    }
    places
}

/// The file's name.
pub(crate) fn file_name(path: &Path) -> String {
    path.file_name()
        .map(|n| n.to_string_lossy().into_owned())
        .unwrap_or_default()
}

/// The file's name up to its first dot: the module's name.
pub(crate) fn stem(path: &Path) -> Result<String, String> {
    let name = file_name(path);
    match name.split('.').next() {
        Some(stem) if !stem.is_empty() => Ok(stem.to_string()),
        _ => Err(format!(
            "bgdyn: the file name `{name}` gives the module no name"
        )),
    }
}
