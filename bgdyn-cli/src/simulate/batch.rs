//! Runs a scene many times, with a row of results for each run.

use std::iter::once;
use std::num::NonZeroUsize;

use bgdyn_codegen::scene::Override;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

use super::batch_values::{BatchValues, Given};
use crate::table;

use super::difference::range;
use super::plant::{Evaluated, PreparedScene};
use super::report;
use super::run_recorder::record_from;
use super::run_table::{Column, Way, headed};

/// The results of a run of a batch.
#[derive(Clone, Debug)]
pub struct RunSummary {
    /// Of each recorded quantity: the final value, the least, the largest; empty if the run did not start.
    pub outputs: Vec<[f64; 3]>,
    /// The energy drift, relative to the energy that could move.
    pub drift: f64,
    /// Time at the end, s.
    pub t: f64,
    /// The reason for an early end, or for a run that did not start.
    pub failure: Option<String>,
}

/// Runs a scene for every row of `varied`, with this number of threads; `watch` receives the number of
/// finished runs.
pub(crate) fn run(
    system: &SceneEquations,
    plant: &Evaluated<'_>,
    way: &Way,
    (fixed, varied): (&[Given], &BatchValues),
    threads: NonZeroUsize,
    watch: impl FnMut(usize),
) -> Vec<RunSummary> {
    let functions = plant.functions();
    let one = |values: &Vec<f64>| {
        let overrides = varied.overrides_of_run(fixed, values);
        summarized(system, &functions, way, &overrides)
    };
    bgdyn_sim::batch::batch(&varied.runs, threads, one, watch)
}

/// Runs a scene with these values in place of those in its files.
pub fn summarized(
    system: &SceneEquations,
    functions: &PreparedScene,
    way: &Way,
    overrides: &[(Override, Dd)],
) -> RunSummary {
    let system = match system.with_overrides(overrides) {
        Ok(system) => system,
        Err(faults) => return refused(&faults),
    };
    let run = record_from(functions.start(&system), way, &mut |_| {});
    let last = run.rows.last().map_or(&[][..], |row| &row.values);
    let outputs = last.iter().enumerate().map(|(i, &end)| {
        let (low, high) = range(run.rows.iter().map(|row| row.values[i]));
        [end, low, high]
    });
    RunSummary {
        outputs: outputs.collect(),
        drift: report::drift(&run),
        t: run.t,
        failure: run.failure,
    }
}

fn refused(faults: &bgdyn_codegen::fault::Faults) -> RunSummary {
    let why: Vec<&str> = faults.0.iter().map(|f| f.message.as_str()).collect();
    RunSummary {
        outputs: vec![],
        drift: f64::NAN,
        t: 0.0,
        failure: Some(why.join("; ")),
    }
}

/// Returns the runs as comma-separated values.
pub(crate) fn csv(columns: &[Column], varied: &BatchValues, summaries: &[RunSummary]) -> String {
    let mut header = vec!["run".to_owned()];
    header.extend(varied.quantities.iter().map(|q| headed(&q.name, q.unit)));
    for column in columns {
        let parts = ["end", "min", "max"];
        header.extend(parts.map(|part| headed(&format!("{} {part}", column.name), column.unit)));
    }
    header.extend(["drift [1]", "t end [s]", "status", "reason"].map(str::to_owned));
    let runs = varied.runs.iter().zip(summaries).enumerate();
    let rows = runs.map(|(i, (values, run))| {
        let mut row = vec![(i + 1).to_string()];
        row.extend(values.iter().map(|x| format!("{x:?}")));
        for k in 0..columns.len() {
            match run.outputs.get(k) {
                Some(output) => row.extend(output.map(|x| format!("{x:?}"))),
                None => row.extend([const { String::new() }; 3]),
            }
        }
        row.push(match run.drift.is_nan() {
            true => String::new(),
            false => format!("{:?}", run.drift),
        });
        row.push(format!("{:?}", run.t));
        row.push(
            if run.failure.is_none() {
                "ok"
            } else {
                "failed"
            }
            .to_owned(),
        );
        row.push(run.failure.clone().unwrap_or_default());
        row
    });
    table::write_csv(once(header).chain(rows))
}
