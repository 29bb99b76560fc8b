//! `bgdyn generate`: the module's source text.

use std::path::PathBuf;

use anyhow::{Context, Result, anyhow};
use bgdyn_codegen::emit::Place;
use bgdyn_codegen::model::generate_source;
use clap::Args;

use crate::output::print;
use crate::spec_file::{SpecFile, options};

/// Write the generated Rust source
#[derive(Args)]
#[command(after_help = "Example:\n  bgdyn generate specs/scara.yaml -o scara.rs")]
pub(crate) struct Generate {
    /// The spec
    file: PathBuf,
    /// Where to write it; stdout by default
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Use one formulation for every method
    #[arg(long, value_name = "NAME")]
    formulation: Option<String>,
    /// Write the first derivatives as well
    #[arg(long)]
    derivatives: bool,
}

impl Generate {
    pub(crate) fn run(self) -> Result<()> {
        let mut options = options(self.formulation.as_deref())?;
        options.derivatives = self.derivatives;
        let spec = SpecFile::open(&self.file)?;
        // Says what was found, warnings too.
        spec.mechanism()?;
        let source = self
            .file
            .file_name()
            .map(|n| n.to_string_lossy().into_owned());
        let place = Place::source_text(source.unwrap_or_default());
        let text = generate_source(&spec.text, &spec.stem, &place, &options)
            .map_err(|faults| anyhow!("{}", spec.render(&faults)))?;
        match &self.output {
            None => print(&text)?,
            Some(path) => std::fs::write(path, text)
                .with_context(|| format!("{} cannot be written", path.display()))?,
        }
        Ok(())
    }
}
