//! A spec as the commands read it.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use bgdyn_codegen::fault::Faults;
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::model::{
    Options, Refusal, Unknown, beside, formulation_named, preference_named, read_scene, stem,
};
use bgdyn_codegen::system::System;
use bgdyn_codegen::verify::explain;
use clap::Args;

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
        if is_urdf(&text) {
            let shown = path.display();
            bail!(
                "{shown}:1:1: this is a URDF, not a spec: `bgdyn import {shown}` writes the spec of it [urdf-given]"
            );
        }
        Ok(SpecFile {
            path: path.to_path_buf(),
            text,
            stem: stem(path),
        })
    }

    /// The mechanism, if the spec passes, and all that was found.
    pub(crate) fn read(&self) -> (Option<Mechanism>, Faults) {
        bgdyn_codegen::read(&self.text, Some(&self.stem))
    }

    /// Whether it is a scene's file.
    pub(crate) fn is_scene(&self) -> bool {
        bgdyn_codegen::spec::is_scene(&self.text)
    }

    /// The text of a file named from this one.
    pub(crate) fn load(&self, path: &str) -> Result<String, String> {
        std::fs::read_to_string(beside(&self.path, path)).map_err(|e| e.to_string())
    }

    /// The scene, if it and its mechanism pass, and all that was found.
    pub(crate) fn read_scene(&self) -> Result<(System, Faults), Refusal> {
        read_scene(&self.text, &self.stem, |path| self.load(path))
    }

    /// The scene; what was found goes to stderr.
    pub(crate) fn scene(&self) -> Result<System> {
        let (system, warnings) = self.read_scene().map_err(|r| self.refused(r))?;
        tell(&self.render(&warnings));
        Ok(system)
    }

    /// A refusal as an error; its faults go to stderr.
    pub(crate) fn refused(&self, refusal: Refusal) -> anyhow::Error {
        let shown = self.path.display();
        match refusal {
            Refusal::Spec(faults) => {
                tell(&self.render(&faults));
                anyhow!("{shown} has {}", faults.tally())
            }
            Refusal::Mechanism {
                path,
                text,
                faults,
                scene,
            } => {
                let file = beside(&self.path, &path);
                tell(&self.render(&scene));
                tell(&faults.render(&file.display().to_string(), &text));
                let its = format!("{} has {}", file.display(), faults.tally());
                match scene.any_fault() {
                    true => anyhow!("{shown} has {}, {its}", scene.tally()),
                    false => anyhow!("{its}"),
                }
            }
            Refusal::Unequal(differences) => anyhow!("{shown}: {}", explain(&differences)),
            Refusal::Options(names) => unknown(names).into(),
        }
    }

    /// What was found, for people.
    pub(crate) fn render(&self, faults: &Faults) -> String {
        faults.render(&self.path.display().to_string(), &self.text)
    }

    /// The mechanism; what was found goes to stderr.
    pub(crate) fn mechanism(&self) -> Result<Mechanism> {
        let (mechanism, faults) = self.read();
        tell(&self.render(&faults));
        mechanism.ok_or_else(|| anyhow!("{} has {}", self.path.display(), faults.tally()))
    }
}

/// Whether a text is XML with a robot in it. The beginning decides first: a spec may quote XML.
fn is_urdf(text: &str) -> bool {
    let text = text.trim_start_matches('\u{feff}').trim_start();
    let xml = ["<?xml", "<!--", "<robot"];
    xml.iter().any(|start| text.starts_with(start)) && text.contains("<robot")
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

/// The generator's options, as the command line gives them.
#[derive(Args)]
pub(crate) struct Asked {
    /// These methods only, separated by commas; `dynamics` stands for those of the trait
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    methods: Option<Vec<String>>,
    /// Pose, velocity, Jacobian and J̇ v of these links and frames only, separated by commas
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    frames: Option<Vec<String>>,
    /// The first derivatives as well
    #[arg(long)]
    derivatives: bool,
    /// Of a scene: the Jacobian ∂ẏ/∂y and ∂ẏ/∂t as well
    #[arg(long)]
    jacobian: bool,
    /// Of a scene: the canonical form as well, momenta in place of velocities
    #[arg(long)]
    canonical: bool,
    #[command(flatten)]
    choice: Choice,
}

/// What the formulations are chosen by.
#[derive(Args)]
pub(crate) struct Choice {
    /// One formulation for every method
    #[arg(long, value_name = "NAME")]
    formulation: Option<String>,
    /// Choose by the fewest `operations`, or by `accuracy`: the fewest digits lost in f64
    #[arg(long, value_name = "NAME", default_value = "operations")]
    prefer: String,
}

impl Asked {
    pub(crate) fn options(&self) -> Result<Options> {
        Ok(Options {
            derivatives: self.derivatives,
            jacobian: self.jacobian,
            canonical: self.canonical,
            methods: self.methods.clone(),
            frames: self.frames.clone(),
            ..self.choice.options()?
        })
    }
}

impl Choice {
    /// Options with this choice.
    pub(crate) fn options(&self) -> Result<Options> {
        let formulation = self.formulation.as_deref().map(formulation_named);
        Ok(Options {
            formulation: formulation.transpose().map_err(Usage)?,
            prefer: preference_named(&self.prefer).map_err(Usage)?,
            ..Options::default()
        })
    }
}

/// Names asked for in vain are bad usage.
pub(crate) fn unknown(names: Vec<Unknown>) -> Usage {
    let lines: Vec<String> = names.into_iter().map(|u| u.message).collect();
    Usage(lines.join("\nbgdyn: "))
}
