//! What the commands about logs have in common: the machine, what of it is identified, and tables of motions.

use std::path::Path;

use anyhow::{Result, anyhow, bail};
use bgdyn_codegen::format::Dimension;
use bgdyn_codegen::machine::Machine;
use bgdyn_codegen::read_machine;
use bgdyn_identification::log::{ColumnNames, Expected, Log, Quantity, read};
use bgdyn_identification::{LogFault, Model};
use clap::Args;

use crate::identify::{IdentifiedMachine, Wanted};
use crate::output::tell;
use crate::quantity::value;
use crate::spec_file::{SpecFile, shown};
use crate::usage::Usage;

/// What is identified.
#[derive(Args)]
pub(super) struct Parts {
    /// Friction that is identified: `viscous`, `coulomb`, `offset`, or `none`
    #[arg(long, value_name = "NAMES", value_delimiter = ',', default_values_t = ["viscous".to_owned(), "coulomb".into(), "offset".into()])]
    pub(super) friction: Vec<String>,
    /// Identify the rotors' reflected inertia
    #[arg(long)]
    pub(super) rotors: bool,
    /// Identify these links only, separated by commas; the others keep their numbers
    #[arg(long, value_name = "LINKS", value_delimiter = ',')]
    pub(super) only: Vec<String>,
}

impl Parts {
    pub(super) fn wanted(&self) -> Result<Wanted> {
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
}

/// Reads the option `--columns`.
pub(super) fn column_names(text: Option<&str>) -> Result<ColumnNames> {
    let names = text.map(ColumnNames::parse).transpose();
    let names = names.map_err(|why| Usage(format!("--columns: {why}")))?;
    Ok(names.unwrap_or_default())
}

/// Returns the machine of a spec, and what is identified of it.
pub(super) fn machine(file: &SpecFile, wanted: &Wanted) -> Result<(Machine, IdentifiedMachine)> {
    if file.is_scene() {
        bail!("{} is a scene: give its mechanism", shown(&file.path));
    }
    let (machine, faults) = read_machine(&file.text, Some(&file.stem));
    tell(&file.render(&faults));
    let machine = machine.ok_or_else(|| anyhow!("{} has {}", shown(&file.path), faults.tally()))?;
    let identified = IdentifiedMachine::new(&machine, wanted)
        .map_err(|faults| anyhow!("{}: {}", shown(&file.path), faults.join("\nbgdyn: ")))?;
    Ok((machine, identified))
}

/// Reads a log; `gains` are factors from currents to efforts.
pub(super) fn read_log(
    path: &Path,
    model: &Model<'_>,
    names: &ColumnNames,
    gains: Option<&Path>,
) -> Result<Log> {
    let text = crate::spec_file::read_text(path)?;
    let joints = model.joints.iter().map(|j| (j.name.clone(), j.linear));
    let unit = |text: &str, quantity: Quantity, linear: bool| {
        unit(text, quantity, linear, gains.is_some())
    };
    let expected = Expected {
        joints: joints.collect(),
        names: names.clone(),
        unit: &unit,
    };
    let mut log = read(text.as_bytes(), &expected).map_err(|faults| refusal(path, &faults))?;
    if let Some(gains) = gains {
        let gains = read_gains(gains, model)?;
        for (tau, gain) in log.tau.iter_mut().zip(gains) {
            tau.iter_mut().for_each(|t| *t *= gain);
        }
    }
    Ok(log)
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
pub(super) fn refusal(path: &Path, faults: &[LogFault]) -> anyhow::Error {
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
