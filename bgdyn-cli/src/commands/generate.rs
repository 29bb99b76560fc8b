//! `bgdyn generate`: prints the source text of a module.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow};
use bgdyn_codegen::emit::{OutputOptions, source_text};
use bgdyn_codegen::pipeline::generate_file;
use clap::Args;

use crate::output::{print, tell};
use crate::spec_file::{GeneratorArgs, SpecFile, is_stdin, read_text};
use crate::usage::Usage;

/// Write the generated Rust source
#[derive(Args)]
#[command(
    after_help = "Example:\n  bgdyn generate specs/scara.yaml -o scara.rs\n  bgdyn generate specs/scara.yaml -o scara.rs --check   # exit 1 if scara.rs is not up to date\n  bgdyn generate specs/scara.yaml --plain   # infix formulas"
)]
pub(crate) struct Generate {
    /// The spec
    file: PathBuf,
    /// Output file [default: stdout]
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Write nothing; fail if the output file differs from what would be written
    #[arg(long, requires = "output")]
    check: bool,
    /// Name of the module [default: the name of the file]
    #[arg(long, value_name = "NAME")]
    module: Option<String>,
    /// Visibility of the module
    #[arg(long, value_name = "RUST", default_value = "pub")]
    visibility: String,
    /// Path of bgdyn in the crate that includes the file
    #[arg(long = "crate", value_name = "PATH", default_value = "::bgdyn")]
    bgdyn: String,
    /// Do not compare the functions with equation (6)
    #[arg(long)]
    no_verify: bool,
    /// Write infix formulas, for reading and review: `a * b + c` in place of `T::mul_add(a, b, c)`.
    /// The statements are those of the compiled code; this text itself does not compile
    #[arg(long)]
    plain: bool,
    #[command(flatten)]
    asked: GeneratorArgs,
}

impl Generate {
    pub(crate) fn run(self) -> Result<()> {
        let (mut options, place) = (self.asked.options()?, self.place().map_err(Usage)?);
        options.verify = !self.no_verify;
        let spec = SpecFile::open(&self.file)?;
        let load = |path: &str| spec.load(path);
        let (tokens, warnings) = generate_file(&spec.text, &spec.stem, &place, &options, load)
            .map_err(|r| spec.refused(r))?;
        tell(&spec.render(&warnings));
        let text = source_text(tokens);
        match &self.output {
            None => print(&text),
            Some(path) if self.check => self.compare(path, &text),
            Some(path) => std::fs::write(path, text)
                .with_context(|| format!("{} cannot be written", path.display())),
        }
    }

    fn place(&self) -> std::result::Result<OutputOptions, String> {
        let source = match is_stdin(&self.file) {
            true => "standard input".into(),
            false => self.file.file_name().unwrap_or_default().to_string_lossy(),
        };
        let place = OutputOptions {
            plain: self.plain,
            ..OutputOptions::source_text(source.into_owned())
        };
        let place = place
            .with_crate(&self.bgdyn)?
            .with_visibility(&self.visibility)?;
        match &self.module {
            Some(module) => place.with_module(module),
            None => Ok(place),
        }
    }

    /// Fails unless the file at `path` contains `text`.
    fn compare(&self, path: &Path, text: &str) -> Result<()> {
        let found = read_text(path)?;
        if found == text {
            return Ok(());
        }
        let mut lines = (1..).zip(found.lines().zip(text.lines()));
        let differs = lines.find(|(_, (found, wanted))| found != wanted);
        let line = differs.map_or_else(
            || found.lines().count().min(text.lines().count()) + 1,
            |(number, _)| number,
        );
        Err(anyhow!(
            "{}:{line}:1: this is not what {} gives; write it anew with `bgdyn generate`",
            path.display(),
            self.file.display()
        ))
    }
}
