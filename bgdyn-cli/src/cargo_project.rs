//! A scratch project that the user's cargo builds. It is not deleted, so that the next call compiles less.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use anyhow::{Context, Result, bail};

/// A scratch crate for one purpose.
pub(crate) struct CargoProject {
    folder: PathBuf,
}

impl CargoProject {
    /// Creates the crate with this name. It depends on `bgdyn`, a path or a version, and on these other
    /// crates of the same repository and version.
    ///
    /// # Errors
    /// If its folder cannot be created.
    pub fn new(name: &str, bgdyn: &str, others: &[&str]) -> Result<Self> {
        let source = |inside: &str| -> Result<String> {
            Ok(match Path::new(bgdyn).join("Cargo.toml").is_file() {
                true => format!(
                    "path = {:?}",
                    fs::canonicalize(Path::new(bgdyn).join(inside))?
                ),
                false => format!("version = {bgdyn:?}"),
            })
        };
        let folder = cache().join("bgdyn").join(name);
        fs::create_dir_all(folder.join("src"))
            .with_context(|| format!("{} cannot be made", folder.display()))?;
        let mut manifest = format!(
            "[package]\nname = {name:?}\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[dependencies]\nbgdyn = {{ {}, default-features = false }}\n",
            source(".")?
        );
        for other in others {
            manifest += &format!("{other} = {{ {} }}\n", source(other)?);
        }
        let project = CargoProject { folder };
        project.write("Cargo.toml", &(manifest + "\n[workspace]\n"))?;
        Ok(project)
    }

    /// Writes one of its files, if the content changes.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, name: &str, text: &str) -> Result<()> {
        let path = self.folder.join(name);
        if fs::read_to_string(&path).is_ok_and(|old| old == text) {
            return Ok(());
        }
        fs::write(&path, text).with_context(|| format!("{} cannot be written", path.display()))
    }

    /// Builds and runs it, and returns its output.
    ///
    /// # Errors
    /// If there is no cargo, if cargo cannot get the crates, or if the program fails.
    pub fn run(&self) -> Result<String> {
        let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let done = Command::new(cargo)
            .args(["run", "--release", "--quiet"])
            .current_dir(&self.folder)
            .output()
            .context("cargo cannot be run")?;
        if !done.status.success() {
            let text = String::from_utf8_lossy(&done.stderr);
            let first: Vec<&str> = text.lines().filter(|l| !l.is_empty()).take(3).collect();
            bail!("{}", first.join("; "));
        }
        String::from_utf8(done.stdout).context("the program's output")
    }
}

/// Returns the user's cache folder.
fn cache() -> PathBuf {
    let named = env::var_os("XDG_CACHE_HOME").map(PathBuf::from);
    let home = env::var_os("HOME").or_else(|| env::var_os("USERPROFILE"));
    named
        .or_else(|| home.map(|home| PathBuf::from(home).join(".cache")))
        .unwrap_or_else(env::temp_dir)
}
