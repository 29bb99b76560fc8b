//! A spec as the commands read it.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow};
use bgdyn_codegen::fault::Faults;
use bgdyn_codegen::formulation::{self, FORMULATIONS};
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::model::Options;

/// A file and its text.
pub(crate) struct SpecFile {
    pub(crate) path: PathBuf,
    pub(crate) text: String,
    pub(crate) stem: String,
}

impl SpecFile {
    /// Reads the file.
    pub(crate) fn open(path: &Path) -> Result<Self> {
        let text = std::fs::read_to_string(path)
            .with_context(|| format!("{} cannot be read", path.display()))?;
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
        if !faults.0.is_empty() {
            eprint!("{}", self.render(&faults));
        }
        mechanism.ok_or_else(|| anyhow!("{} has {} faults", self.path.display(), faults.count()))
    }
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
        .ok_or_else(|| anyhow!("no formulation `{name}`; there are {}", known()))?;
    Ok(Options {
        formulation: Some(formulation),
        ..Options::default()
    })
}
