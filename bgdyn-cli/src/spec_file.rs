//! A spec as the commands read it.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow};
use bgdyn_codegen::fault::Faults;
use bgdyn_codegen::formulation::{self, FORMULATIONS};
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::model::Options;

use crate::output::tell;
use crate::usage::Usage;

/// A file and its text.
pub(crate) struct SpecFile {
    pub(crate) path: PathBuf,
    pub(crate) text: String,
    pub(crate) stem: String,
}

impl SpecFile {
    /// Reads the file.
    pub(crate) fn open(path: &Path) -> Result<Self> {
        let text = read_text(path)?;
        let name = path
            .file_name()
            .map(|n| n.to_string_lossy().into_owned())
            .unwrap_or_default();
        let stem = name.split('.').next().unwrap_or_default().to_string();
        Ok(SpecFile {
            path: path.to_path_buf(),
            text,
            stem,
        })
    }

    /// The mechanism, if the spec passes, and all that was found.
    pub(crate) fn read(&self) -> (Option<Mechanism>, Faults) {
        bgdyn_codegen::read(&self.text, Some(&self.stem))
    }

    /// What was found, for people.
    pub(crate) fn render(&self, faults: &Faults) -> String {
        faults.render(&self.path.display().to_string(), &self.text)
    }

    /// The mechanism; what was found goes to stderr.
    pub(crate) fn mechanism(&self) -> Result<Mechanism> {
        let (mechanism, faults) = self.read();
        tell(&self.render(&faults));
        mechanism.ok_or_else(|| anyhow!("{} has {} faults", self.path.display(), faults.count()))
    }
}

/// A file's text.
pub(crate) fn read_text(path: &Path) -> Result<String> {
    let shown = path.display();
    let bytes = std::fs::read(path).with_context(|| format!("{shown} cannot be read"))?;
    String::from_utf8(bytes).map_err(|error| {
        let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = good.iter().filter(|byte| **byte == b'\n').count() + 1;
        anyhow!("{shown}:{line}:1: this line is not UTF-8: convert the file first")
    })
}

/// The generator's options from the command line's.
pub(crate) fn options(formulation: Option<&str>) -> Result<Options> {
    let Some(name) = formulation else {
        return Ok(Options::default());
    };
    let known = || {
        FORMULATIONS
            .iter()
            .map(|f| f.name())
            .collect::<Vec<_>>()
            .join(", ")
    };
    let formulation = formulation::by_name(name)
        .ok_or_else(|| Usage(format!("no formulation `{name}`; there are {}", known())))?;
    Ok(Options {
        formulation: Some(formulation),
        ..Options::default()
    })
}
