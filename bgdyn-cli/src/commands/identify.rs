//! `bgdyn identify`: a calibrated model from a log.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use bgdyn_codegen::format::Dimension;
use bgdyn_codegen::read_machine;
use bgdyn_identification::log::{ColumnNames, Expected, Log, Quantity, read};
use bgdyn_identification::{Identification, LogFault, Model, Options, identify};
use clap::Args;

use crate::identify::{IdentifiedMachine, Wanted, json, page, summary, table, write};
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
    /// Friction that is identified: `viscous`, `coulomb`, `offset`, or `none`
    #[arg(long, value_name = "NAMES", value_delimiter = ',', default_values_t = ["viscous".to_owned(), "coulomb".into(), "offset".into()])]
    friction: Vec<String>,
    /// Identify the rotors' reflected inertia
    #[arg(long)]
    rotors: bool,
    /// Identify these links only, separated by commas; the others keep their numbers
    #[arg(long, value_name = "LINKS", value_delimiter = ',')]
    only: Vec<String>,
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
        let (wanted, options) = (self.wanted()?, self.options()?);
        let names = self.columns.as_deref().map(ColumnNames::parse).transpose();
        let names = names
            .map_err(|why| Usage(format!("--columns: {why}")))?
            .unwrap_or_default();
        let file = SpecFile::open(&self.spec)?;
        if file.is_scene() {
            bail!("{} is a scene: give its mechanism", shown(&self.spec));
        }
        let (machine, faults) = read_machine(&file.text, Some(&file.stem));
        tell(&file.render(&faults));
        let machine =
            machine.ok_or_else(|| anyhow!("{} has {}", shown(&self.spec), faults.tally()))?;
        let identified = IdentifiedMachine::new(&machine, &wanted)
            .map_err(|faults| anyhow!("{}: {}", shown(&self.spec), faults.join("\nbgdyn: ")))?;
        let model = identified.model();
        let log = self.read(&self.log, &model, &names);
        let test = self
            .test
            .as_ref()
            .map(|path| self.read(path, &model, &names))
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

    fn wanted(&self) -> Result<Wanted> {
        let mut columns = [self.rotors, false, false, false];
        for name in &self.friction {
            match name.trim() {
                "viscous" => columns[1] = true,
                "coulomb" => columns[2] = true,
                "offset" => columns[3] = true,
                "none" if self.friction.len() == 1 => {}
                other => bail!(Usage(format!(
                    "`--friction {other}`: there are viscous, coulomb, offset, none"
                ))),
            }
        }
        Ok(Wanted {
            only: self.only.clone(),
            columns,
        })
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

    fn read(&self, path: &Path, model: &Model<'_>, names: &ColumnNames) -> Result<Log> {
        let text = crate::spec_file::read_text(path)?;
        let joints = model.joints.iter().map(|j| (j.name.clone(), j.linear));
        let unit = |text: &str, quantity: Quantity, linear: bool| {
            unit(text, quantity, linear, self.gains.is_some())
        };
        let expected = Expected {
            joints: joints.collect(),
            names: names.clone(),
            unit: &unit,
        };
        let mut log = read(text.as_bytes(), &expected).map_err(|faults| refusal(path, &faults))?;
        if let Some(gains) = &self.gains {
            let gains = read_gains(gains, model)?;
            for (tau, gain) in log.tau.iter_mut().zip(gains) {
                tau.iter_mut().for_each(|t| *t *= gain);
            }
        }
        Ok(log)
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

/// Returns the factor of a unit of the second row.
fn unit(text: &str, quantity: Quantity, linear: bool, current: bool) -> Result<f64, String> {
    let (dimension, what) = match (quantity, linear) {
        (Quantity::Time, _) => (Dimension::Time, "a time"),
        (Quantity::Position, false) => (Dimension::Angle, "the position of a joint that turns"),
        (Quantity::Position, true) => (Dimension::Length, "the position of a joint that slides"),
        (Quantity::Effort, _) if current => (Dimension::Current, "a current, with --gains"),
        (Quantity::Effort, false) => (Dimension::Torque, "the effort of a joint that turns"),
        (Quantity::Effort, true) => (Dimension::Force, "the effort of a joint that slides"),
    };
    let text = if text == "Nm" { "N*m" } else { text };
    let factor = value(&format!("1 {text}"), &[dimension]);
    factor
        .map(|f| f.to_f64())
        .map_err(|why| format!("`{text}` is no unit of {what}: {why}"))
}

/// Reads factors from currents to efforts.
fn read_gains(path: &Path, model: &Model<'_>) -> Result<Vec<f64>> {
    let text = crate::spec_file::read_text(path)?;
    let rows = crate::table::rows(&text);
    let find = |name: &str| {
        rows.iter()
            .find(|row| row.cells.first().is_some_and(|cell| cell == name))
    };
    let gain = |name: &str| -> Result<f64, String> {
        let row =
            find(name).ok_or_else(|| format!("{}: no row for joint `{name}`", shown(path)))?;
        let cell = row.cells.get(1).map_or("", String::as_str);
        let (line, column) = row.position(1);
        let number = cell
            .parse::<f64>()
            .ok()
            .filter(|x| x.is_finite() && *x != 0.0);
        number.ok_or_else(|| {
            format!(
                "{}:{line}:{column}: `{cell}` is no factor: write a number that is not 0",
                shown(path)
            )
        })
    };
    let gains: Vec<Result<f64, String>> = model.joints.iter().map(|j| gain(&j.name)).collect();
    let faults: Vec<String> = gains.iter().filter_map(|g| g.clone().err()).collect();
    match faults.is_empty() {
        true => Ok(gains.into_iter().flatten().collect()),
        false => bail!("{}", faults.join("\nbgdyn: ")),
    }
}

/// Converts faults of a log to an error; prints them.
fn refusal(path: &Path, faults: &[LogFault]) -> anyhow::Error {
    for fault in faults {
        let separator = if fault.position.is_some() { ":" } else { ": " };
        tell(&format!("{}{separator}{fault}\n", shown(path)));
    }
    let word = if faults.len() == 1 { "fault" } else { "faults" };
    anyhow!(
        "{} has {} {word}; nothing was written",
        shown(path),
        faults.len()
    )
}
