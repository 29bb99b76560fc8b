//! `bgdyn simulate` for many runs: options and report.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use bgdyn_codegen::scene::Scene;
use bgdyn_codegen::system::SceneEquations;
use clap::Args;

use crate::output::print;
use crate::simulate::batch_values::{self, BatchValues, Given};
use crate::simulate::progress::Progress;
use crate::simulate::report::{number, quantity, short};
use crate::simulate::{Column, Evaluated, Way, batch};
use crate::spec_file::read_text;
use crate::usage::Usage;

/// Number of failed runs that are reported one by one.
const FAILURES: usize = 10;

/// Options for many runs instead of one.
#[derive(Args)]
#[command(
    next_help_heading = "Many runs: NAME_batch.csv and NAME_batch.svg in place of one run's files"
)]
pub(super) struct Many {
    /// One run per row of a CSV table: names of initial states and parameters in the first
    /// line, values with units or in SI units
    #[arg(long, value_name = "FILE", conflicts_with_all = ["sweep", "random"])]
    batch: Option<PathBuf>,
    /// Sweep N values from FROM to TO, both included. May be repeated: every combination is run
    #[arg(
        long,
        value_name = "NAME=FROM:TO:N",
        conflicts_with = "random",
        allow_hyphen_values = true
    )]
    sweep: Vec<String>,
    /// Draw a value uniformly between LOW and HIGH for each run. May be repeated
    #[arg(
        long,
        value_name = "NAME=LOW:HIGH",
        requires = "runs",
        allow_hyphen_values = true
    )]
    random: Vec<String>,
    /// Number of random runs
    #[arg(long, value_name = "N", requires = "random")]
    runs: Option<usize>,
    /// Seed of the random numbers: the same seed gives the same runs
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Number of runs in parallel [default: number of cores]. Does not change the results
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
}

/// The parts of a batch.
pub(super) struct Batch<'a> {
    pub(super) name: &'a str,
    pub(super) out: &'a Path,
    pub(super) system: &'a SceneEquations,
    pub(super) plant: &'a Evaluated<'a>,
    pub(super) way: Way,
    pub(super) columns: &'a [Column],
}

impl Many {
    /// Returns the values of the selected runs; `None` for a single run.
    pub(super) fn varied(&self, scene: &Scene) -> Result<Option<BatchValues>> {
        if let Some(path) = &self.batch {
            let text = read_text(path)?;
            return batch_values::table(scene, &text, &path.display().to_string()).map(Some);
        }
        if !self.sweep.is_empty() {
            return Ok(Some(batch_values::grid(scene, &self.sweep)?));
        }
        if let Some(runs) = self.runs {
            let varied = batch_values::chance(scene, &self.random, runs, self.seed)?;
            return Ok(Some(varied));
        }
        Ok(None)
    }

    /// Runs the batch, writes table and plot.
    pub(super) fn run(&self, of: &Batch<'_>, given: &[Given], varied: &BatchValues) -> Result<()> {
        let twice = varied.quantities.iter();
        if let Some(s) = twice.clone().find(|&s| given.iter().any(|(g, _)| g == s)) {
            let message = format!("`{}` is set, and varied as well: leave one of them", s.name);
            return Err(Usage(message).into());
        }
        let threads = self.threads.unwrap_or_else(bgdyn_sim::batch::cores);
        let total = varied.runs.len();
        let mut progress = Progress::new("runs");
        let watch = |done: usize| progress.at(done as f64 / total as f64);
        let summaries = batch::run(
            of.system,
            of.plant,
            &of.way,
            (given, varied),
            threads,
            watch,
        );
        drop(progress);
        let out = of.out;
        std::fs::create_dir_all(out)
            .with_context(|| format!("the folder {} cannot be made", out.display()))?;
        let table = out.join(format!("{}_batch.csv", of.name));
        let shown = |path: &Path| format!("{} cannot be written", path.display());
        std::fs::write(&table, batch::csv(of.columns, varied, &summaries))
            .with_context(|| shown(&table))?;
        let written = format!("written: {} ({total} runs)", table.display());
        #[cfg(feature = "plot")]
        let written = {
            let picture = out.join(format!("{}_batch.svg", of.name));
            let svg = crate::simulate::batch_plot::plot(of.name, of.columns, (varied, &summaries));
            std::fs::write(&picture, svg).with_context(|| shown(&picture))?;
            format!("{written}, {}", picture.display())
        };
        print(&(written + "\n"))?;
        let drift = summaries.iter().filter(|run| run.failure.is_none());
        let drift = drift.map(|run| run.drift).fold(0.0, f64::max);
        print(&format!(
            "largest drift: {} of the energy that could move\n",
            number(drift)
        ))?;
        let failed: Vec<_> = summaries.iter().enumerate().collect();
        let failed: Vec<_> = failed
            .into_iter()
            .filter_map(|(i, run)| Some((i, run, run.failure.as_ref()?)))
            .collect();
        for (i, run, reason) in failed.iter().take(FAILURES) {
            let values = varied.quantities.iter().zip(&varied.runs[*i]);
            let values: Vec<String> = values
                .map(|(s, x)| format!("{} = {}", s.name, quantity(*x, s.unit)))
                .collect();
            let (run, t) = (i + 1, short(run.t));
            print(&format!(
                "run {run}, {}: ends at t = {t} s: {reason}\n",
                values.join(", ")
            ))?;
        }
        match failed.len() {
            0 => Ok(()),
            n => bail!("{n} of {total} runs failed"),
        }
    }
}
