//! Packages outside of the workspace that depend on bgdyn as a user's do.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const MANIFEST: &str = r#"
[package]
name = "NAME"
version = "0.0.0"
edition = "2024"

[dependencies]
CRATE = { package = "bgdyn", path = "BGDYN" }

[build-dependencies]
bgdyn-codegen = { path = "BGDYN/bgdyn-codegen", features = ["source"] }

[workspace]

[profile.dev]
debug = false
"#;

/// A package below `target/`, with a target folder that later runs and other packages reuse.
pub struct Outside {
    /// Its folder.
    pub folder: PathBuf,
}

impl Outside {
    /// Writes the manifest of an empty package. `workspace` is the folder of bgdyn, which the package calls `crate_name`.
    pub fn new(workspace: &Path, name: &str, crate_name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let package = Outside { folder };
        let bgdyn = workspace.display().to_string().replace('\\', "/");
        let manifest = MANIFEST.replace("NAME", name).replace("CRATE", crate_name);
        package.write("Cargo.toml", &manifest.replace("BGDYN", &bgdyn));
        if let Ok(lock) = fs::read_to_string(workspace.join("Cargo.lock")) {
            package.write("Cargo.lock", &lock);
        }
        package
    }

    /// Writes a file of the package.
    pub fn write(&self, file: &str, text: &str) {
        let path = self.folder.join(file);
        fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
        fs::write(path, text).expect("a file");
    }

    /// Returns a call of Cargo in the package.
    pub fn cargo(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO"));
        command
            .args(arguments)
            .args(["--offline", "--color", "never"]);
        command.current_dir(&self.folder);
        let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("outside");
        command.env("CARGO_TARGET_DIR", target);
        // What is compiled is compiled once.
        command
            .env("CARGO_INCREMENTAL", "0")
            .env_remove("RUSTFLAGS");
        command
    }
}
