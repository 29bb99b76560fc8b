//! `bgdyn identify`: a calibrated model from a log.

use std::path::PathBuf;

use anyhow::{Context, Result, anyhow, bail};
use bgdyn_codegen::format::Dimension;
use bgdyn_codegen::read_machine;
use bgdyn_identification::log::Log;
use bgdyn_identification::{Identification, LogFault, Model, Options, identify};
use clap::Args;

use super::logs::{Parts, column_names, machine, read_log, refusal};
use crate::identify::{IdentifiedMachine, json, page, summary, table, write};
use crate::output::{print, tell};
use crate::quantity::{positive, value};
use crate::simulate::progress::Progress;
use crate::spec_file::{SpecFile, shown};
use crate::usage::Usage;

/// Identify masses, friction and rotors from a log; write the spec with the numbers, and a report
///
/// The log is a CSV table with a header: `time`, and `q_JOINT`, `tau_JOINT` for each joint; a second row may have
/// units. Positions and efforts suffice: velocities are found by differentiation.
#[derive(Args)]
#[command(
    after_help = "Example:\n  bgdyn identify arm.yaml train.csv --test other.csv --rotors -o arm_identified.yaml --report report\n  bgdyn identify arm.yaml log.csv --columns q=joint_{}_pos,tau=joint_{}_effort --only payload\n\nExit 1 for a log that cannot be used; nothing is written then."
)]
pub(crate) struct Identify {
    /// The mechanism
    spec: PathBuf,
    /// The log
    log: PathBuf,
    /// Judge the result on this log [default: the last third of LOG, which is not identified from then]
    #[arg(long, value_name = "LOG")]
    test: Option<PathBuf>,
    /// Write the spec with the numbers found
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write the report page into this folder
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    /// Names of the columns; `{}` is the joint's name, or its number from 1
    #[arg(long, value_name = "KEY=PATTERN,…")]
    columns: Option<String>,
    /// Cut of the low-pass filter, such as `10 Hz` [default: from the spectrum of the positions]
    #[arg(long, value_name = "HZ")]
    cut: Option<String>,
    #[command(flatten)]
    parts: Parts,
    /// Weight of the numbers in the file: 1 means that to change a body by itself costs one deviation
    #[arg(long, value_name = "X", default_value = "1")]
    prior: f64,
    /// Table `joint,gain` of factors from the efforts' columns to efforts, such as N·m per A
    #[arg(long, value_name = "CSV")]
    gains: Option<PathBuf>,
    /// Leave out rows of joints that are slower than this, such as `10 mrad/s`
    #[arg(long, value_name = "SPEED")]
    skip_below: Option<String>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

impl Identify {
    pub(crate) fn run(self) -> Result<()> {
        let (wanted, options) = (self.parts.wanted()?, self.options()?);
        let names = column_names(self.columns.as_deref())?;
        let file = SpecFile::open(&self.spec)?;
        let (_, identified) = machine(&file, &wanted)?;
        let model = identified.model();
        let gains = self.gains.as_deref();
        let log = read_log(&self.log, &model, &names, gains);
        let test = self
            .test
            .as_ref()
            .map(|path| read_log(path, &model, &names, gains))
            .transpose();
        // Faults of both logs, before either stops.
        let (log, test) = match (log, test) {
            (Err(first), Err(second)) => bail!("{first:#}\nbgdyn: {second:#}"),
            (log, test) => (log?, test?),
        };
        let found = run_steps(&model, &log, test.as_ref(), &options);
        let found = found.map_err(|faults| refusal(&self.log, &faults))?;
        self.finish(&file, &identified, &found)
    }

    fn finish(
        &self,
        file: &SpecFile,
        identified: &IdentifiedMachine,
        found: &Identification,
    ) -> Result<()> {
        let model = identified.model();
        if let Some(output) = &self.output {
            let written = write(&file.text, identified, found)
                .map_err(|why| anyhow!("{}: {why}", shown(&self.spec)))?;
            let stem = output
                .file_stem()
                .map_or("written".into(), |s| s.to_string_lossy().into_owned());
            let text = written.named(&stem);
            let (machine, faults) = read_machine(&text, Some(&stem));
            if machine.is_none() {
                tell(&faults.render(&shown(output), &text));
                bail!(
                    "the spec with the numbers found has {}: nothing was written",
                    faults.tally()
                );
            }
            std::fs::write(output, text)
                .with_context(|| format!("{} cannot be written", shown(output)))?;
        }
        if let Some(folder) = &self.report {
            std::fs::create_dir_all(folder)
                .with_context(|| format!("{} cannot be created", folder.display()))?;
            let path = folder.join(format!("{}.html", file.stem));
            let text = page::page(&file.stem, &model, found, &summary(identified, found));
            std::fs::write(&path, text)
                .with_context(|| format!("{} cannot be written", path.display()))?;
        }
        match self.json {
            true => print(&format!("{:#}\n", json(&model, found))),
            false => print(&format!(
                "{}\n{}",
                summary(identified, found),
                table(&model, found)
            )),
        }
    }

    fn options(&self) -> Result<Options> {
        if !(self.prior > 0.0 && self.prior.is_finite()) {
            bail!(Usage(format!(
                "`--prior {}`: write a number greater than 0",
                self.prior
            )));
        }
        let speed = match &self.skip_below {
            None => 0.0,
            Some(text) => value(text, &[Dimension::AngularSpeed, Dimension::Speed])
                .map_err(|why| Usage(format!("`--skip-below {text}`: {why}")))?
                .to_f64()
                .abs(),
        };
        Ok(Options {
            cut: positive("cut", self.cut.as_ref(), Dimension::Frequency)?,
            prior: self.prior,
            skip_below: speed,
        })
    }
}

fn run_steps(
    model: &Model<'_>,
    log: &Log,
    test: Option<&Log>,
    options: &Options,
) -> Result<Identification, Vec<LogFault>> {
    let mut progress = Progress::new("identifying");
    identify(model, log, test, options, &mut |_, share| {
        progress.at(share)
    })
}
