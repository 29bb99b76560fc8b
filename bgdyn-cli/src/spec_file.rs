//! A mechanism's or scene's text with its path: what it contains, and its findings as text.

use std::io::Read;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use bgdyn_codegen::fault::{Fault, Faults, Location};
use bgdyn_codegen::files::{beside, mechanism_of, stem};
use bgdyn_codegen::format::{parse, parse_scene};
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::options::{
    BundleOption, Options, UnknownName, formulation_named, preference_named,
};
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::verify::explain;
use bgdyn_codegen::{SpecText, read_scene};
use clap::Args;

use crate::output::tell;
use crate::usage::Usage;

/// A file and its text.
#[derive(Debug)]
pub struct SpecFile {
    /// The path as printed in messages; a scene's mechanism is found relative to it.
    pub path: PathBuf,
    /// The text.
    pub text: String,
    /// The stem of the file, which names the mechanism or the scene.
    pub stem: String,
    /// The text of the mechanism that a scene names; without it the file is read.
    pub mechanism: Option<String>,
}

/// The path that means standard input.
const STDIN: &str = "-";
/// The default name of a spec from standard input.
pub(crate) const STDIN_NAME: &str = "stdin";

/// Returns whether the path means standard input.
pub(crate) fn is_stdin(path: &Path) -> bool {
    path.as_os_str() == STDIN
}

/// Returns a path as printed in messages.
pub(crate) fn shown(path: &Path) -> String {
    match is_stdin(path) {
        true => "<stdin>".into(),
        false => path.display().to_string(),
    }
}

impl SpecFile {
    /// Reads the file, or standard input for `-`.
    pub(crate) fn open(path: &Path) -> Result<Self> {
        let file = SpecFile::read_any(path)?;
        match file.urdf() {
            Some(fault) => bail!("{}", fault.headline(&shown(path))),
            None => Ok(file),
        }
    }

    /// Reads a file of any content.
    ///
    /// # Errors
    /// If it cannot be read, or is not UTF-8.
    pub fn read_any(path: &Path) -> Result<Self> {
        let text = read_text(path)?;
        let stem = match is_stdin(path) {
            true => written_name(&text).unwrap_or_else(|| STDIN_NAME.into()),
            false => stem(path),
        };
        Ok(SpecFile {
            path: shown(path).into(),
            text,
            stem,
            mechanism: None,
        })
    }

    /// Returns a fault if the file is a URDF.
    pub fn urdf(&self) -> Option<Fault> {
        is_urdf(&self.text).then(|| {
            let file = match self.path.to_str() {
                Some("<stdin>") => STDIN.into(),
                _ => self.path.display().to_string(),
            };
            let message =
                format!("this is a URDF, not a spec: `bgdyn import {file}` writes the spec of it");
            Fault::new(&Location::file(), "urdf-given", message)
        })
    }

    /// Returns the mechanism, if the spec is valid, and all findings.
    pub fn read(&self) -> (Option<Mechanism>, Faults) {
        bgdyn_codegen::read(&self.text, Some(&self.stem))
    }

    /// Returns whether it is a scene's file.
    pub fn is_scene(&self) -> bool {
        bgdyn_codegen::format::is_scene(&self.text)
    }

    /// Returns the text of a mechanism that a scene names, from its path relative to this file.
    ///
    /// # Errors
    /// The reason why it cannot be read.
    pub fn load(&self, path: &str) -> Result<String, String> {
        match &self.mechanism {
            Some(text) if mechanism_of(&self.text).is_none_or(|own| own == path) => {
                Ok(text.clone())
            }
            Some(_) => Err("only the text of the scene's `mechanism` was given".into()),
            None => std::fs::read_to_string(beside(&self.path, path)).map_err(|e| e.to_string()),
        }
    }

    /// Returns the text with its surroundings; `load` is [`Self::load`].
    pub fn with_load<'a>(
        &'a self,
        load: &'a dyn Fn(&str) -> Result<String, String>,
    ) -> SpecText<'a> {
        SpecText {
            text: &self.text,
            stem: &self.stem,
            load,
        }
    }

    /// Returns the scene, if it and its mechanism are valid, and all findings.
    ///
    /// # Errors
    /// The faults of the scene or of its mechanism.
    pub fn read_scene(&self) -> Result<(SceneEquations, Faults), Refusal> {
        read_scene(&self.text, &self.stem, |path| self.load(path))
    }

    /// Returns the scene; prints the findings to stderr.
    pub(crate) fn scene(&self) -> Result<SceneEquations> {
        let (system, warnings) = self.read_scene().map_err(|r| self.refused(r))?;
        tell(&self.render(&warnings));
        Ok(system)
    }

    /// Converts a refusal to an error; prints its faults to stderr.
    pub(crate) fn refused(&self, refusal: Refusal) -> anyhow::Error {
        if let Refusal::Options(names) = refusal {
            return unknown(names).into();
        }
        let (message, why) = self.refusal(refusal);
        tell(&message);
        anyhow!(why)
    }

    /// Returns a refusal's faults as text, and their number in words.
    pub fn refusal(&self, refusal: Refusal) -> (String, String) {
        let shown = self.path.display();
        match refusal {
            Refusal::Spec(faults) => (
                self.render(&faults),
                format!("{shown} has {}", faults.tally()),
            ),
            Refusal::Mechanism {
                path,
                text,
                faults,
                scene,
            } => {
                let file = beside(&self.path, &path).display().to_string();
                let own = self.render(&scene);
                let parts = [own, faults.render(&file, &text)];
                let messages: Vec<String> = parts.into_iter().filter(|p| !p.is_empty()).collect();
                let its = format!("{file} has {}", faults.tally());
                let why = match scene.any_fault() {
                    true => format!("{shown} has {}, {its}", scene.tally()),
                    false => its,
                };
                (messages.join("\n"), why)
            }
            Refusal::Unequal(differences) => {
                (String::new(), format!("{shown}: {}", explain(&differences)))
            }
            Refusal::Options(names) => (String::new(), unknown(names).0),
        }
    }

    /// Returns a refusal's faults, each with its file if that is another one.
    pub(crate) fn findings(&self, refusal: &Refusal) -> Vec<(Option<String>, Fault)> {
        match refusal {
            Refusal::Spec(faults) => faults.0.iter().map(|f| (None, f.clone())).collect(),
            Refusal::Mechanism {
                path,
                faults,
                scene,
                ..
            } => {
                let file = beside(&self.path, path).display().to_string();
                let own = scene.0.iter().map(|f| (None, f.clone()));
                let its = faults.0.iter().map(|f| (Some(file.clone()), f.clone()));
                own.chain(its).collect()
            }
            Refusal::Unequal(_) | Refusal::Options(_) => Vec::new(),
        }
    }

    /// Returns the findings as text.
    pub fn render(&self, faults: &Faults) -> String {
        faults.render(&self.path.display().to_string(), &self.text)
    }

    /// Returns the mechanism; prints the findings to stderr.
    pub(crate) fn mechanism(&self) -> Result<Mechanism> {
        let (mechanism, faults) = self.read();
        tell(&self.render(&faults));
        mechanism.ok_or_else(|| anyhow!("{} has {}", self.path.display(), faults.tally()))
    }
}

/// Returns the name that a spec or a scene gives itself with `name:`.
pub fn written_name(text: &str) -> Option<String> {
    let name = match bgdyn_codegen::format::is_scene(text) {
        true => parse_scene(text).0?.name,
        false => parse(text).0?.name,
    };
    name.value().cloned()
}

/// Returns whether a text is XML with a robot in it. The beginning decides first: a spec may quote XML.
fn is_urdf(text: &str) -> bool {
    let text = text.trim_start_matches('\u{feff}').trim_start();
    let xml = ["<?xml", "<!--", "<robot"];
    xml.iter().any(|start| text.starts_with(start)) && text.contains("<robot")
}

/// Returns a file's text, or that of standard input for `-`.
pub(crate) fn read_text(path: &Path) -> Result<String> {
    let shown = shown(path);
    let bytes = match is_stdin(path) {
        true => stdin_bytes(),
        false => std::fs::read(path),
    };
    let bytes = bytes.with_context(|| format!("{shown} cannot be read"))?;
    String::from_utf8(bytes).map_err(|error| {
        let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = good.iter().filter(|byte| **byte == b'\n').count() + 1;
        anyhow!("{shown}:{line}:1: this line is not UTF-8: convert the file first")
    })
}

fn stdin_bytes() -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    std::io::stdin().lock().read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The options of the generator on the command line.
#[derive(Args)]
pub(crate) struct GeneratorArgs {
    /// Generate only these methods, separated by commas; `dynamics` means those of the trait `Dynamics`
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    methods: Option<Vec<String>>,
    /// Generate pose, velocity, Jacobian and J̇ v of these links and frames only, separated by commas
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    frames: Option<Vec<String>>,
    /// Generate several methods as one function that returns all of their results; as often as wanted
    #[arg(long = "bundle", value_name = "NAME=METHOD,…", value_parser = bundle)]
    bundles: Vec<BundleOption>,
    /// Generate the first derivatives as well
    #[arg(long)]
    derivatives: bool,
    /// Generate regressors, the parameters of the bodies and base parameters as well
    #[arg(long)]
    identification: bool,
    /// For a scene: generate the Jacobian ∂ẏ/∂y and ∂ẏ/∂t as well
    #[arg(long)]
    jacobian: bool,
    /// For a scene: generate the Jacobian by the inputs, ∂ẏ/∂u, as well
    #[arg(long)]
    input_jacobian: bool,
    /// For a scene: generate the canonical form as well (momenta in place of velocities)
    #[arg(long)]
    canonical: bool,
    #[command(flatten)]
    choice: Choice,
}

/// How the formulation of each method is chosen.
#[derive(Args)]
pub(crate) struct Choice {
    /// Use this formulation for every method
    #[arg(long, value_name = "NAME")]
    formulation: Option<String>,
    /// Choose the formulation with the fewest `operations`, or the most accurate (`accuracy`): the fewest digits lost in f64
    #[arg(long, value_name = "NAME", default_value = "operations")]
    prefer: String,
}

impl GeneratorArgs {
    pub(crate) fn options(&self) -> Result<Options> {
        Ok(Options {
            derivatives: self.derivatives,
            identification: self.identification,
            jacobian: self.jacobian,
            input_jacobian: self.input_jacobian,
            canonical: self.canonical,
            methods: self.methods.clone(),
            frames: self.frames.clone(),
            bundles: self.bundles.clone(),
            ..self.choice.options()?
        })
    }
}

/// Reads `control=mass_matrix,bias`.
fn bundle(text: &str) -> Result<BundleOption, String> {
    let Some((name, methods)) = text.split_once('=') else {
        return Err("write a name and its methods: control=mass_matrix,bias".into());
    };
    let methods = methods.split(',').map(str::trim);
    let methods = methods.filter(|method| !method.is_empty());
    Ok(BundleOption {
        name: name.trim().into(),
        methods: methods.map(String::from).collect(),
    })
}

impl Choice {
    /// Returns options with this choice.
    pub(crate) fn options(&self) -> Result<Options> {
        let formulation = self.formulation.as_deref().map(formulation_named);
        Ok(Options {
            formulation: formulation.transpose().map_err(Usage)?,
            prefer: preference_named(&self.prefer).map_err(Usage)?,
            ..Options::default()
        })
    }
}

/// Converts unknown names to a usage error.
pub(crate) fn unknown(names: Vec<UnknownName>) -> Usage {
    let lines: Vec<String> = names.into_iter().map(|u| u.message).collect();
    Usage(lines.join("\nbgdyn: "))
}
