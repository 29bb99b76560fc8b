//! Many runs of a scene, with a row of results for each.

use std::fmt::Write;
use std::num::NonZeroUsize;

use bgdyn_codegen::system::SceneEquations;

use super::batch_values::{BatchValues, Given};
use super::difference::range;
use super::plant::Evaluated;
use super::report;
use super::run_recorder::record_from;
use super::run_table::{Column, Way};

/// The results of a run of a batch.
pub(crate) struct RunSummary {
    /// Of each output: at the end, the least, the largest.
    pub(crate) outputs: Vec<[f64; 3]>,
    /// What the energy's account lacks, of the energy that could move.
    pub(crate) drift: f64,
    /// When it ended, s.
    pub(crate) t: f64,
    /// Why it ended early, or was not begun.
    pub(crate) failure: Option<String>,
}

/// Runs a scene for every row of `varied`, by so many threads; `watch` hears how many are done.
pub(crate) fn run(
    system: &SceneEquations,
    plant: &Evaluated<'_>,
    way: &Way,
    (fixed, varied): (&[Given], &BatchValues),
    threads: NonZeroUsize,
    watch: impl FnMut(usize),
) -> Vec<RunSummary> {
    let one = |values: &Vec<f64>| {
        let system = match system.with_overrides(&varied.given(fixed, values)) {
            Ok(system) => system,
            Err(faults) => return refused(&faults),
        };
        let run = record_from(plant.with_overrides(&system), way, &mut |_| {});
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
    };
    bgdyn_sim::batch::batch(&varied.runs, threads, one, watch)
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

/// The runs as a table with commas.
pub(crate) fn csv(columns: &[Column], varied: &BatchValues, told: &[RunSummary]) -> String {
    let one = |unit: &str| {
        if unit.is_empty() {
            "1".to_owned()
        } else {
            unit.to_owned()
        }
    };
    let mut text = String::from("run");
    for quantity in &varied.quantities {
        let _ = write!(text, ",{} [{}]", quantity.name, one(quantity.unit));
    }
    for column in columns {
        for part in ["end", "min", "max"] {
            let _ = write!(text, ",{} {part} [{}]", column.name, one(column.unit));
        }
    }
    text += ",drift [1],t end [s],status,reason\n";
    for (i, (values, run)) in varied.runs.iter().zip(told).enumerate() {
        let _ = write!(text, "{}", i + 1);
        for value in values {
            let _ = write!(text, ",{value:?}");
        }
        for k in 0..columns.len() {
            for part in 0..3 {
                text.push(',');
                if let Some(output) = run.outputs.get(k) {
                    let _ = write!(text, "{:?}", output[part]);
                }
            }
        }
        let (status, reason) = match &run.failure {
            None => ("ok", String::new()),
            Some(reason) => ("failed", format!("\"{}\"", reason.replace('"', "\"\""))),
        };
        let drift = match run.drift.is_nan() {
            true => String::new(),
            false => format!("{:?}", run.drift),
        };
        let _ = writeln!(text, ",{drift},{:?},{status},{reason}", run.t);
    }
    text
}
