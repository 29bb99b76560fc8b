//! `bgdyn excite`: a motion that shows the parameters.

use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow, bail};
use bgdyn_codegen::bond_graph;
use bgdyn_codegen::format::Dimension;
use bgdyn_codegen::machine::Machine;
use bgdyn_identification::excite::{Effort, Keep, Noise, Request, efforts_of_file, excite};
use bgdyn_identification::log::{ColumnNames, Log, quality, unsound};
use bgdyn_identification::{LogFault, Model};
use clap::{Args, ValueEnum};

use super::logs::{Parts, column_names, machine, read_log, refusal};
use crate::excite::{
    Asked, FramePoints, Plane, Planned, check, joint_limits, json, missing_effects, page, scene,
    summary, table, write,
};
use crate::identify::of_each_joint;
use crate::output::print;
use crate::quantity::positive;
use crate::simulate::progress::Progress;
use crate::spec_file::SpecFile;
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
    /// Number of random motions
    #[arg(long, value_name = "N", default_value = "60")]
    starts: usize,
    /// Number of the best ones that are improved
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

impl From<NoiseOption> for Noise {
    fn from(noise: NoiseOption) -> Self {
        match noise {
            NoiseOption::Relative => Noise::Relative,
            NoiseOption::Equal => Noise::Equal,
        }
    }
}

/// Rows of the table at most.
const MOST_ROWS: f64 = 1e6;

impl Excite {
    pub(crate) fn run(self) -> Result<()> {
        let (period, rate) = self.times()?;
        let asked = Asked::read(
            &self.margin,
            self.speed.as_deref(),
            self.acceleration.as_deref(),
        );
        let asked = asked.map_err(Usage)?;
        let planes = self.planes()?;
        let wanted = self.parts.wanted()?;
        let names = column_names(self.columns.as_deref())?;
        let file = SpecFile::open(&self.spec)?;
        let (machine, identified) = machine(&file, &wanted)?;
        let model = identified.model();
        let mut points = FramePoints::default();
        // Faults of all parts, before one stops.
        let mut reasons = Vec::new();
        let mut kept = |why: anyhow::Error| reasons.push(format!("{why:#}"));
        let keeps = keeps(&planes, &machine, &mut points).map_err(&mut kept);
        let refused = |faults: Vec<LogFault>| refusal(&self.spec, &faults);
        let limits = joint_limits(&model.joints, &asked).map_err(refused);
        let limits = limits.map_err(&mut kept);
        let effects = of_each_joint(&machine);
        let missing = missing_effects(&effects, &identified.effects, &model.joints);
        let missing = missing.map_err(refused).map_err(&mut kept);
        let prior = self.prior.as_ref();
        let prior = prior.map(|path| sound_log(path, &model, &names));
        let prior = prior.transpose().map_err(&mut kept);
        let targets = self.output.as_ref().map_or(Ok(()), |folder| {
            let (names, copy) = (file_names(&file.stem), (&file.stem, &file.text));
            check(folder, &names, (&format!("{}.yaml", copy.0), copy.1))
        });
        let targets = targets.map_err(&mut kept);
        let (Ok(keeps), Ok((limits, mut remarks)), Ok(missing), Ok(prior), Ok(())) =
            (keeps, limits, missing, prior, targets)
        else {
            bail!("{}", reasons.join("\nbgdyn: "));
        };
        remarks.extend(missing);
        let request = Request {
            limits: &limits,
            keeps: &keeps,
            points: &points,
            harmonics: self.harmonics,
            period,
            effort: self.effort(),
            noise: self.noise.into(),
            prior: prior.as_ref(),
        };
        let mut progress = Progress::new("planning");
        let found = excite(&model, &request, &mut |share| progress.at(share));
        drop(progress);
        let found = found.map_err(refused)?;
        let plan = Planned {
            model: &model,
            limits: &limits,
            margin: asked.margin,
            keeps: &keeps,
            found: &found,
            remarks: &remarks,
        };
        if let Some(folder) = &self.output {
            write(folder, &files(&file, &machine, &plan, rate))?;
        }
        match self.json {
            true => print(&format!("{:#}\n", json(&plan))),
            false => print(&summary(&plan)),
        }
    }

    /// Returns how far the search goes.
    fn effort(&self) -> Effort {
        Effort {
            starts: self.starts,
            ascents: self.ascents,
            steps: self.steps,
            seed: self.seed,
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
        let rows = rate * period;
        if rows > MOST_ROWS {
            bail!(Usage(format!(
                "`--rate {}`: {rows:.0} rows in {}: write at most {:.0} Hz, for {MOST_ROWS} rows",
                self.rate,
                self.period,
                MOST_ROWS / period
            )));
        }
        Ok((period, rate))
    }

    /// Reads the planes.
    fn planes(&self) -> Result<Vec<Plane>> {
        let all = self.keep.iter().map(|text| Plane::read(text));
        Ok(all_or_faults(all).map_err(Usage)?)
    }
}

/// Returns all values, or all faults, a line each.
fn all_or_faults<T>(all: impl Iterator<Item = Result<T, String>>) -> Result<Vec<T>, String> {
    let (mut values, mut faults) = (Vec::new(), Vec::new());
    for one in all {
        match one {
            Ok(value) => values.push(value),
            Err(fault) => faults.push(fault),
        }
    }
    match faults.is_empty() {
        true => Ok(values),
        false => Err(faults.join("\nbgdyn: ")),
    }
}

/// Returns the planes with the points that are kept.
fn keeps(planes: &[Plane], machine: &Machine, points: &mut FramePoints) -> Result<Vec<Keep>> {
    let graph = bond_graph::build(&machine.mechanism);
    let all = planes.iter();
    all_or_faults(all.map(|plane| plane.keep(&machine.mechanism, &graph, points)))
        .map_err(|faults| anyhow!(faults))
}

/// Returns the names of the files of a motion: table, coefficients, scene, page, the copy of the spec.
fn file_names(stem: &str) -> [String; 5] {
    let of = |end: &str| format!("{stem}{end}");
    [
        "_motion.csv",
        "_motion.json",
        "_motion.scene.yaml",
        "_motion.html",
        ".yaml",
    ]
    .map(of)
}

/// Returns the files of a motion, in the order of [`file_names`].
fn files(
    file: &SpecFile,
    machine: &Machine,
    plan: &Planned<'_>,
    rate: f64,
) -> Vec<(String, String)> {
    let names = file_names(&file.stem);
    let Planned { model, found, .. } = plan;
    let efforts = |t: f64| efforts_of_file(model, &found.motion.at(t));
    let texts = [
        table(&file.stem, model, found, &efforts, rate),
        format!("{:#}\n", json(plan)),
        scene(&names[4], machine, model, found),
        page::page(&format!("{}_motion", file.stem), plan, &efforts),
        file.text.clone(),
    ];
    names.into_iter().zip(texts).collect()
}

/// Reads an earlier log, and refuses what `identify` would refuse.
fn sound_log(path: &Path, model: &Model<'_>, names: &ColumnNames) -> Result<Log> {
    let log = read_log(path, model, names, None)?;
    let faults = unsound(&log, &quality(&log, &model.joints), &model.joints);
    match faults.is_empty() {
        true => Ok(log),
        false => Err(refusal(path, &faults)),
    }
}
