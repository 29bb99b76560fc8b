//! `bgdyn excite`: a motion that shows the parameters.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use bgdyn_codegen::bond_graph;
use bgdyn_codegen::format::Dimension;
use bgdyn_codegen::machine::Machine;
use bgdyn_identification::excite::{
    Effort, Excitation, JointLimits, Keep, Noise, Request, efforts_of_file, excite,
};
use bgdyn_identification::log::{ColumnNames, Log, quality, unsound};
use bgdyn_identification::{LogFault, Model};
use clap::{Args, ValueEnum};

use super::logs::{Parts, column_names, machine, read_log};
use crate::excite::{Asked, FramePoints, joint_limits, json, keep, page, scene, summary, table};
use crate::output::{print, tell};
use crate::quantity::positive;
use crate::simulate::progress::Progress;
use crate::spec_file::{SpecFile, shown};
use crate::usage::Usage;

/// Plan a motion from which `identify` finds masses, friction and rotors
///
/// The motion of each joint is a Fourier series, periodic and at rest at its start, within the limits of the spec. It is
/// the best of random ones, improved until the deviations of the base parameters are as small as possible (D-optimal).
#[derive(Args)]
#[command(
    after_help = "Example:\n  bgdyn excite arm.yaml --rotors --keep 'tool.z>0.1 m' -o motion\n  bgdyn simulate motion/arm_motion.scene.yaml --out run\n\nExit 1 if no motion keeps to the limits; nothing is written then."
)]
pub(crate) struct Excite {
    /// The mechanism
    spec: PathBuf,
    /// Write table, coefficients, scene and page into this folder
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Harmonics of the series, 2 or more
    #[arg(long, value_name = "K", default_value = "5")]
    harmonics: usize,
    /// Period of the motion
    #[arg(long, value_name = "TIME", default_value = "10 s")]
    period: String,
    /// Rows of the table per second
    #[arg(long, value_name = "HZ", default_value = "500 Hz")]
    rate: String,
    /// Share of the limits of positions, velocities and efforts that stays free
    #[arg(long, value_name = "SHARE", default_value = "8%")]
    margin: String,
    /// Speeds that are not exceeded either, such as `2 rad/s,0.5 m/s` [default: the limits of the spec; 2 rad/s, 0.5 m/s for joints without]
    #[arg(long, value_name = "SPEEDS")]
    speed: Option<String>,
    /// Accelerations that are not exceeded [default: 7 rad/s^2,2 m/s^2]
    #[arg(long, value_name = "ACCELERATIONS")]
    acceleration: Option<String>,
    /// Keep the origin of a frame or link on one side of a plane: `tool.z>0.1 m`; may be repeated
    #[arg(long, value_name = "PLANE")]
    keep: Vec<String>,
    #[command(flatten)]
    parts: Parts,
    /// A log that was recorded before: the motion shows what it does not
    #[arg(long, value_name = "LOG")]
    prior: Option<PathBuf>,
    /// Names of the log's columns, as for `identify`
    #[arg(long, value_name = "KEY=PATTERN,…")]
    columns: Option<String>,
    /// Noise of the efforts: in proportion to their limits, or equal for all joints
    #[arg(long, value_enum, value_name = "NOISE", default_value_t)]
    noise: NoiseOption,
    /// Random motions from which the best is taken
    #[arg(long, value_name = "N", default_value = "60")]
    starts: usize,
    /// So many of the best of them are improved
    #[arg(long, value_name = "N", default_value = "3")]
    ascents: usize,
    /// Steps of an ascent at most
    #[arg(long, value_name = "N", default_value = "150")]
    steps: usize,
    /// Seed of the random motions: the same seed gives the same files
    #[arg(long, value_name = "N", default_value = "1")]
    seed: u64,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

/// The words of `--noise`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum NoiseOption {
    /// 1 % of each joint's limit of effort, or of its largest effort where limits are missing
    #[default]
    Relative,
    /// The same for all joints
    Equal,
}

/// What was asked for and found.
struct Plan<'a> {
    machine: &'a Machine,
    model: &'a Model<'a>,
    limits: &'a [JointLimits],
    keeps: &'a [Keep],
    found: &'a Excitation,
    summary: String,
    rate: f64,
}

impl Excite {
    pub(crate) fn run(self) -> Result<()> {
        let (period, rate) = self.times()?;
        let asked = Asked::read(
            &self.margin,
            self.speed.as_deref(),
            self.acceleration.as_deref(),
        );
        let asked = asked.map_err(Usage)?;
        let wanted = self.parts.wanted()?;
        let names = column_names(self.columns.as_deref())?;
        let file = SpecFile::open(&self.spec)?;
        let (machine, identified) = machine(&file, &wanted)?;
        let model = identified.model();
        let mut points = FramePoints::default();
        let keeps = self.keeps(&machine, &mut points);
        let limits =
            joint_limits(&model.joints, &asked).map_err(|faults| refusal(&self.spec, &faults));
        let prior = self.prior.as_ref();
        let prior = prior.map(|path| sound_log(path, &model, &names));
        // Faults of all parts, before one stops.
        let mut reasons = Vec::new();
        let keeps = keeps.map_err(|why| reasons.push(why)).unwrap_or_default();
        let limits = limits.map_err(|why| reasons.push(why)).ok();
        let prior = prior.transpose().map_err(|why| reasons.push(why)).ok();
        let (Some((limits, chosen)), Some(prior), true) = (limits, prior, reasons.is_empty())
        else {
            let reasons: Vec<String> = reasons.iter().map(|why| format!("{why:#}")).collect();
            bail!("{}", reasons.join("\nbgdyn: "));
        };
        let request = Request {
            limits: &limits,
            keeps: &keeps,
            points: &points,
            harmonics: self.harmonics,
            period,
            effort: Effort {
                starts: self.starts,
                ascents: self.ascents,
                steps: self.steps,
                seed: self.seed,
            },
            noise: match self.noise {
                NoiseOption::Relative => Noise::Relative,
                NoiseOption::Equal => Noise::Equal,
            },
            prior: prior.as_ref(),
        };
        let mut progress = Progress::new("planning");
        let found = excite(&model, &request, &mut |share| progress.at(share));
        drop(progress);
        let found = found.map_err(|faults| refusal(&self.spec, &faults))?;
        let plan = Plan {
            machine: &machine,
            model: &model,
            limits: &limits,
            keeps: &keeps,
            summary: summary(&model, &limits, &keeps, &found, &chosen),
            found: &found,
            rate,
        };
        if let Some(folder) = &self.output {
            write(folder, &file, &plan)?;
        }
        match self.json {
            true => print(&format!("{:#}\n", json(&model, &limits, &keeps, &found))),
            false => print(&plan.summary),
        }
    }

    /// Returns period and rate, after a check of what belongs to them.
    fn times(&self) -> Result<(f64, f64)> {
        let period = positive("period", Some(&self.period), Dimension::Time)?.unwrap_or(10.0);
        let rate = positive("rate", Some(&self.rate), Dimension::Frequency)?.unwrap_or(500.0);
        if !(2..=100).contains(&self.harmonics) {
            bail!(Usage(format!(
                "`--harmonics {}`: write 2 to 100; one harmonic cannot begin at rest",
                self.harmonics
            )));
        }
        for (option, count) in [("starts", self.starts), ("ascents", self.ascents)] {
            if count == 0 {
                bail!(Usage(format!("`--{option} 0`: write 1 or more")));
            }
        }
        let least = 2.0 * self.harmonics as f64 / period;
        if rate <= least {
            bail!(Usage(format!(
                "`--rate {}`: {} harmonics in {} need more than {least} rows per second",
                self.rate, self.harmonics, self.period
            )));
        }
        Ok((period, rate))
    }

    fn keeps(&self, machine: &Machine, points: &mut FramePoints) -> Result<Vec<Keep>> {
        let graph = bond_graph::build(&machine.mechanism);
        let read = |text: &String, points: &mut FramePoints| {
            keep(text, &machine.mechanism, &graph, points)
                .map_err(|why| format!("`--keep {text}`: {why}"))
        };
        let all: Vec<Result<Keep, String>> = self.keep.iter().map(|t| read(t, points)).collect();
        let faults: Vec<String> = all.iter().filter_map(|k| k.clone().err()).collect();
        match faults.is_empty() {
            true => Ok(all.into_iter().flatten().collect()),
            false => bail!("{}", faults.join("\nbgdyn: ")),
        }
    }
}

/// Writes all files, after all of them are made.
fn write(folder: &Path, file: &SpecFile, plan: &Plan<'_>) -> Result<()> {
    let Plan { model, found, .. } = plan;
    let name = format!("{}_motion", file.stem);
    let spec = format!("{}.yaml", file.stem);
    let efforts = |t: f64| efforts_of_file(model, &found.motion.at(t));
    let json = json(model, plan.limits, plan.keeps, found);
    let files = [
        (
            format!("{name}.csv"),
            table(&file.stem, model, found, &efforts, plan.rate),
        ),
        (format!("{name}.json"), format!("{json:#}\n")),
        (
            format!("{name}.scene.yaml"),
            scene(&spec, plan.machine, model, found),
        ),
        (
            format!("{name}.html"),
            page::page(&name, model, plan.limits, found, &efforts, &plan.summary),
        ),
        (spec, file.text.clone()),
    ];
    std::fs::create_dir_all(folder)
        .with_context(|| format!("{} cannot be created", folder.display()))?;
    for (name, text) in files {
        let path = folder.join(name);
        // The spec beside the scene; where it is there already, it stays as it is.
        if path.exists() && std::fs::read_to_string(&path).is_ok_and(|old| old == text) {
            continue;
        }
        std::fs::write(&path, text)
            .with_context(|| format!("{} cannot be written", path.display()))?;
    }
    Ok(())
}

/// Reads an earlier log, and refuses what `identify` would refuse.
fn sound_log(path: &Path, model: &Model<'_>, names: &ColumnNames) -> Result<Log> {
    let log = read_log(path, model, names, None)?;
    let faults = unsound(&log, &quality(&log, &model.joints), &model.joints);
    match faults.is_empty() {
        true => Ok(log),
        false => Err(super::logs::refusal(path, &faults)),
    }
}

/// Converts faults to an error; prints them.
fn refusal(path: &Path, faults: &[LogFault]) -> anyhow::Error {
    for fault in faults {
        tell(&format!("{}: {fault}\n", shown(path)));
    }
    let word = if faults.len() == 1 { "fault" } else { "faults" };
    anyhow!(
        "no motion for {}: {} {word}; nothing was written",
        shown(path),
        faults.len()
    )
}
