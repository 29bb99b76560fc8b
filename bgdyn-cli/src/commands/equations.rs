//! `bgdyn equations`: prints the efforts of a small mechanism in closed form.

use std::path::PathBuf;

use anyhow::{Context, Result, anyhow};
use bgdyn_codegen::closed_form::{LIMIT, NoClosedForm, closed_form, latex, text};
use clap::{Args, ValueEnum};

use crate::output::print;
use crate::spec_file::SpecFile;
use crate::usage::Usage;

/// Write the equations of motion of a small mechanism in closed form
#[derive(Args)]
#[command(
    after_help = "Example:\n  bgdyn equations specs/cart_pole.yaml\n  bgdyn equations specs/scara.yaml --format latex -o scara.tex"
)]
pub(crate) struct Equations {
    /// The spec
    file: PathBuf,
    /// Output format
    #[arg(long, value_enum, default_value_t = EquationFormat::Text)]
    format: EquationFormat,
    /// Output file [default: stdout]
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Significant digits of the numbers, 1 to 17
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u8).range(1..=17))]
    digits: u8,
    /// Largest number of terms, summed over all efforts
    #[arg(long, value_name = "N", default_value_t = LIMIT)]
    limit: usize,
}

/// How equations are written.
#[derive(Clone, Copy, ValueEnum)]
enum EquationFormat {
    /// Plain Unicode, for a terminal
    Text,
    /// LaTeX, for the package amsmath
    Latex,
}

impl Equations {
    pub(crate) fn run(self) -> Result<()> {
        let spec = SpecFile::open(&self.file)?;
        if spec.is_scene() {
            let message = "`equations` is for mechanisms: name the file that the scene names";
            return Err(Usage(message.into()).into());
        }
        let mechanism = spec.mechanism()?;
        let form = closed_form(&mechanism, self.limit).map_err(|refused| self.refused(&refused))?;
        let digits = usize::from(self.digits);
        let written = match self.format {
            EquationFormat::Text => text(&form, digits),
            EquationFormat::Latex => latex(&form, digits),
        };
        match &self.output {
            None => print(&written),
            Some(path) => std::fs::write(path, written)
                .with_context(|| format!("{} cannot be written", path.display())),
        }
    }

    /// Returns a refusal with advice.
    fn refused(&self, refused: &NoClosedForm) -> anyhow::Error {
        let (file, limit) = (self.file.display(), self.limit);
        match refused {
            NoClosedForm::NotTrigonometric
            | NoClosedForm::MovingBase
            | NoClosedForm::Prescribed { .. }
            | NoClosedForm::Loop { .. }
            | NoClosedForm::Joint { .. } => {
                anyhow!("{file}: no closed form: {refused}")
            }
            _ => anyhow!(
                "{file}: too long for a closed form: {refused}, and the limit is {limit} terms; \
                 give joints that may stand still the type `fixed`, or allow more by `--limit N`"
            ),
        }
    }
}
