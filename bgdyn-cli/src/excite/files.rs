//! The files of a motion: all are written, or none.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

/// Checks before the search whether files can be written into a folder; `copy` is the name and text of a file that a
/// user may have there already, with other content.
///
/// # Errors
/// All that hinders.
pub(crate) fn check(folder: &Path, names: &[String], copy: (&str, &str)) -> Result<()> {
    let mut reasons = Vec::new();
    let base = existing(folder);
    if !base.is_dir() {
        bail!("{} is not a folder: nothing can be written", base.display());
    }
    let probe = base.join(format!(".{}.part", copy.0));
    match fs::File::create(&probe) {
        Ok(_) => drop(fs::remove_file(&probe)),
        Err(why) => reasons.push(format!("{} cannot be written: {why}", base.display())),
    }
    for name in names {
        let path = folder.join(name);
        let Ok(found) = fs::metadata(&path) else {
            continue;
        };
        if !found.is_file() || found.permissions().readonly() {
            reasons.push(format!(
                "{} cannot be replaced: move it, or choose another folder",
                path.display()
            ));
        }
    }
    let path = folder.join(copy.0);
    if path.is_file() && fs::read(&path).is_ok_and(|old| old != copy.1.as_bytes()) {
        reasons.push(format!(
            "{} has other content than the spec, whose copy has this name: choose another folder",
            path.display()
        ));
    }
    match reasons.is_empty() {
        true => Ok(()),
        false => bail!("{}", reasons.join("\nbgdyn: ")),
    }
}

/// Returns the nearest part of a path that exists.
fn existing(folder: &Path) -> PathBuf {
    let found = folder.ancestors().find(|path| path.exists());
    match found {
        Some(path) => path.into(),
        None => ".".into(),
    }
}

/// Writes all files: under other names first, which are then replaced, so that a full disk leaves none of them.
///
/// # Errors
/// The file that cannot be written.
pub(crate) fn write(folder: &Path, files: &[(String, String)]) -> Result<()> {
    let new = !folder.exists();
    fs::create_dir_all(folder)
        .with_context(|| format!("{} cannot be created", folder.display()))?;
    let part = |name: &String| folder.join(format!(".{name}.part"));
    let written = files.iter().try_for_each(|(name, text)| {
        let path = part(name);
        fs::write(&path, text).with_context(|| format!("{} cannot be written", path.display()))
    });
    let written = written.and_then(|()| {
        files.iter().try_for_each(|(name, _)| {
            let path = folder.join(name);
            fs::rename(part(name), &path)
                .with_context(|| format!("{} cannot be written", path.display()))
        })
    });
    if written.is_err() {
        for (name, _) in files {
            let _ = fs::remove_file(part(name));
        }
        // Removes an empty folder only.
        let _ = new.then(|| fs::remove_dir(folder));
    }
    written
}
