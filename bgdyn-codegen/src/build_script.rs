//! Generates code from a build script: writes a spec's Rust source to `OUT_DIR`.
//!
//! In `Cargo.toml`, with `bgdyn` without its macro, so that the generator is compiled only once:
//! ```toml
//! [dependencies]
//! bgdyn = { version = "0.1", default-features = false }
//! [build-dependencies]
//! bgdyn-codegen = { version = "0.1", features = ["source"] }
//! ```
//! in `build.rs`:
//! ```no_run
//! fn main() -> Result<(), bgdyn_codegen::build_script::Error> {
//!     bgdyn_codegen::build("specs/scara.yaml")?;
//!     Ok(())
//! }
//! ```
//! and in the source file that contains the module:
//! ```ignore
//! include!(concat!(env!("OUT_DIR"), "/scara.rs")); // pub mod scara { … }
//! ```
//! A change of the spec runs the script again; errors in the spec have the same text as the macro's.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::emit::{OutputOptions, source_text};
use crate::fault::{Faults, Severity};
use crate::files::{beside, stem};
use crate::options::{BundleOption, Options};
use crate::options::{formulation_named, preference_named};
use crate::pipeline::generate_module;
use crate::read::SpecText;
use crate::refusal::Refusal;
use crate::verify::explain;

/// Writes the module of a spec to `OUT_DIR`, with the default options of [`Build`].
///
/// # Errors
/// The errors of the spec, or of reading its file.
pub fn build(spec: impl AsRef<Path>) -> Result<PathBuf, Error> {
    Build::new(spec).write()
}

/// Options for the source text of a module.
#[derive(Clone, Debug)]
pub struct Build {
    spec: PathBuf,
    options: Options,
    formulation: Option<String>,
    preference: Option<String>,
    module: Option<String>,
    visibility: String,
    bgdyn: String,
}

/// The source text of a module.
#[derive(Clone, Debug)]
pub struct Source {
    /// The module's name.
    pub module: String,
    /// The text.
    pub text: String,
    /// Warnings about the spec, one line each.
    pub warnings: Vec<String>,
}

/// The error text for the user. `Debug` prints the same text, so that a build script's `main` can return
/// it.
pub struct Error(String);

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Error {}

impl Build {
    /// Starts with the spec at this path: absolute, or relative to the package's directory, in which build
    /// scripts run.
    pub fn new(spec: impl AsRef<Path>) -> Self {
        Build {
            spec: spec.as_ref().to_path_buf(),
            options: Options::default(),
            formulation: None,
            preference: None,
            module: None,
            visibility: "pub".into(),
            bgdyn: "::bgdyn".into(),
        }
    }

    /// Sets the methods to generate instead of the default ones: [`Options::methods`].
    pub fn methods<S: Into<String>>(mut self, names: impl IntoIterator<Item = S>) -> Self {
        self.options.methods = Some(names.into_iter().map(Into::into).collect());
        self
    }

    /// Sets the links and frames instead of the default ones: [`Options::frames`].
    pub fn frames<S: Into<String>>(mut self, names: impl IntoIterator<Item = S>) -> Self {
        self.options.frames = Some(names.into_iter().map(Into::into).collect());
        self
    }

    /// Adds a bundle, several methods in one call: [`Options::bundles`].
    pub fn bundle<S: Into<String>>(
        mut self,
        name: &str,
        methods: impl IntoIterator<Item = S>,
    ) -> Self {
        self.options.bundles.push(BundleOption {
            name: name.into(),
            methods: methods.into_iter().map(Into::into).collect(),
        });
        self
    }

    /// Sets whether first derivatives of inverse and forward dynamics are generated.
    pub fn derivatives(mut self, wanted: bool) -> Self {
        self.options.derivatives = wanted;
        self
    }

    /// Sets whether regressors, the parameters of the bodies and base parameters are generated.
    pub fn identification(mut self, wanted: bool) -> Self {
        self.options.identification = wanted;
        self
    }

    /// Sets whether the Jacobian of a scene's rates is generated: [`Options::jacobian`].
    pub fn jacobian(mut self, wanted: bool) -> Self {
        self.options.jacobian = wanted;
        self
    }

    /// Sets whether ∂ẏ/∂u of a scene's rates is generated: [`Options::input_jacobian`].
    pub fn input_jacobian(mut self, wanted: bool) -> Self {
        self.options.input_jacobian = wanted;
        self
    }

    /// Sets whether the canonical form of a scene is generated: [`Options::canonical`].
    pub fn canonical(mut self, wanted: bool) -> Self {
        self.options.canonical = wanted;
        self
    }

    /// Sets one formulation for every method instead of the cheapest one of each.
    pub fn formulation(mut self, name: &str) -> Self {
        self.formulation = Some(name.into());
        self
    }

    /// Sets the criterion of choice among formulations: `"operations"`, the default, or `"accuracy"`, the
    /// fewest digits lost in `f64`.
    pub fn prefer(mut self, name: &str) -> Self {
        self.preference = Some(name.into());
        self
    }

    /// Sets whether the generated functions are compared with equation (6) before they are written; the
    /// default is true: [`Options::verify`].
    pub fn verify(mut self, wanted: bool) -> Self {
        self.options.verify = wanted;
        self
    }

    /// Sets a name of the module other than the file's stem. The struct's name remains that of the stem.
    pub fn module(mut self, name: &str) -> Self {
        self.module = Some(name.into());
        self
    }

    /// Sets the module's visibility instead of `pub`: `pub(crate)`, or empty.
    pub fn visibility(mut self, visibility: &str) -> Self {
        self.visibility = visibility.into();
        self
    }

    /// Sets the path of bgdyn in the crate that includes the module, if it is not `::bgdyn`.
    pub fn bgdyn(mut self, path: &str) -> Self {
        self.bgdyn = path.into();
        self
    }

    /// Returns the source text; writes no file.
    ///
    /// # Errors
    /// The errors of the options, the file or the spec.
    pub fn source(&self) -> Result<Source, Error> {
        let shown = self.spec.display();
        let bytes = std::fs::read(&self.spec)
            .map_err(|e| Error(format!("{shown}: the spec cannot be read: {e}")))?;
        let text = String::from_utf8(bytes)
            .map_err(|_| Error(format!("{shown}: the spec is not UTF-8: convert it first")))?;
        let stem = stem(&self.spec);
        let (place, options) = (self.place()?, self.options()?);
        let spec = SpecText {
            text: &text,
            stem: &stem,
            load: &|path| self.load(path),
        };
        let (tokens, findings) =
            generate_module(&spec, &options, &place).map_err(|r| self.refused(r, &text))?;
        Ok(Source {
            module: self.module.clone().unwrap_or(stem),
            text: source_text(tokens),
            warnings: self.warnings(&findings),
        })
    }

    /// Writes the module to `OUT_DIR`, under its name with the extension `.rs`, and prints cargo's
    /// directives for running the build script again. Returns the file's path.
    ///
    /// # Errors
    /// As [`Build::source`]; also if this is not a build script, or the file cannot be written.
    pub fn write(&self) -> Result<PathBuf, Error> {
        println!("cargo::rerun-if-changed={}", self.spec.display());
        let folder = std::env::var_os("OUT_DIR")
            .ok_or_else(|| Error("OUT_DIR is not set: this is for build scripts".into()))?;
        let source = self.source()?;
        for warning in &source.warnings {
            println!("cargo::warning={warning}");
        }
        let path = Path::new(&folder).join(source.module + ".rs");
        std::fs::write(&path, source.text)
            .map_err(|e| Error(format!("{} cannot be written: {e}", path.display())))?;
        Ok(path)
    }

    /// Reads the file of a scene's mechanism, from the path in the scene.
    fn load(&self, path: &str) -> Result<String, String> {
        let path = beside(&self.spec, path);
        println!("cargo::rerun-if-changed={}", path.display());
        std::fs::read_to_string(path).map_err(|e| e.to_string())
    }

    fn options(&self) -> Result<Options, Error> {
        let named = self.formulation.as_deref().map(formulation_named);
        let preferred = self.preference.as_deref().map(preference_named);
        Ok(Options {
            formulation: named.transpose().map_err(Error)?,
            prefer: preferred.transpose().map_err(Error)?.unwrap_or_default(),
            ..self.options.clone()
        })
    }

    fn place(&self) -> Result<OutputOptions, Error> {
        let name = self.spec.file_name().map(|n| n.to_string_lossy());
        let place = OutputOptions::source_text(name.unwrap_or_default().into_owned());
        let place = place.with_crate(&self.bgdyn).map_err(Error)?;
        let place = place.with_visibility(&self.visibility).map_err(Error)?;
        match &self.module {
            Some(module) => place.with_module(module).map_err(Error),
            None => Ok(place),
        }
    }

    fn refused(&self, refusal: Refusal, text: &str) -> Error {
        let shown = self.spec.display().to_string();
        Error(match refusal {
            Refusal::Spec(faults) => {
                format!("{}\n{}", faults.render(&shown, text), faults.tally())
            }
            Refusal::Mechanism {
                path,
                text: its_text,
                faults,
                scene,
            } => {
                let its = beside(&self.spec, &path).display().to_string();
                let its = format!("{}\n{}", faults.render(&its, &its_text), faults.tally());
                match scene.any_fault() {
                    true => format!("{}\n{its}\n{}", scene.render(&shown, text), scene.tally()),
                    false => its,
                }
            }
            Refusal::Unequal(differences) => format!("{shown}: {}", explain(&differences)),
            Refusal::Options(unknown) => {
                let lines = unknown.iter().map(|u| format!("{shown}: {u}"));
                lines.collect::<Vec<_>>().join("\n")
            }
        })
    }

    fn warnings(&self, findings: &Faults) -> Vec<String> {
        let shown = self.spec.display().to_string();
        let warnings = findings
            .0
            .iter()
            .filter(|f| f.severity == Severity::Warning);
        warnings.map(|f| f.headline(&shown)).collect()
    }
}
