//! Runs the study of one scene: reference solution, runs, times.

use std::fmt;

use crate::clock::times;
use crate::configuration::{Configuration, Grid, RunError, StepControl};
use crate::cost::{Cost, costs};
use crate::integrate::{distance, numbers};
use crate::row::{Row, Status};
use crate::step_sequence::{Effort, ErrorScale, Trial, step_sequence};
use crate::table::{records, write_csv};
use crate::test_case::TestCase;

/// The subject of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyInfo {
    /// The scene's name.
    pub scene: String,
    /// Its description, in a line.
    pub description: String,
    /// The measured output.
    pub output: String,
    /// Its unit.
    pub unit: String,
    /// End of the runs, s.
    pub end: f64,
    /// Number of samples for the comparison.
    pub samples: usize,
    /// Whether its laws have kinks.
    pub kinked: bool,
    /// The size of the motion of the output from its start.
    pub size: f64,
    /// Errors in `f64` below this are due to rounding, or to the reference.
    pub floor: f64,
    /// The estimated error of the reference: the difference from one with a hundred times the tolerance.
    pub reference_error: f64,
}

/// A scene's study.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// The subject.
    pub facts: StudyInfo,
    /// The results.
    pub rows: Vec<Row>,
    /// The cost of the scene with all effects, and without each.
    pub costs: Vec<Cost>,
}

/// The reason why a scene cannot be studied.
#[derive(Clone, Debug, PartialEq)]
pub enum Failed {
    /// It has no reference.
    NoReference,
    /// Its reference's run ends early.
    Reference(RunError),
    /// The measured output, of this name, does not move.
    Still(String),
    /// Two references differ by this fraction of the motion.
    Uncertain(f64),
}

impl fmt::Display for Failed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failed::NoReference => f.write_str("the scene has no reference"),
            Failed::Reference(stop) => write!(f, "the reference ends early: {stop}"),
            Failed::Still(output) => write!(
                f,
                "the measured output `{output}` does not move, so that its errors say nothing: the first site among the scene's `outputs` is measured, else the first coordinate, else the first; name one that moves"
            ),
            Failed::Uncertain(part) => write!(
                f,
                "two references differ by {part:.1e} of the motion of the measured output: it hardly moves, or the scene is chaotic; a shorter end (`--end`) may help"
            ),
        }
    }
}

impl std::error::Error for Failed {}

/// References that differ by more than this fraction of the motion are not usable.
const MAX_REFERENCE_ERROR: f64 = 1e-6;

/// An output that moves by no more than this fraction of its distance from its origin is at rest: the motion is rounding.
const STILL: f64 = 1e-14;

/// Studies a scene.
///
/// # Errors
/// If there is no usable reference.
pub fn study(test_case: &TestCase, effort: &Effort) -> Result<Study, Failed> {
    let grid = Grid {
        end: test_case.end,
        samples: effort.samples,
    };
    let run = test_case.reference.as_ref().ok_or(Failed::NoReference)?;
    let (fine, coarse) = test_case.tolerances;
    let reference = run(&grid, fine).map_err(Failed::Reference)?;
    let error = distance(&reference, &run(&grid, coarse).map_err(Failed::Reference)?);
    let reference = numbers(reference);
    let zero = vec![vec![0.0; reference[0].len()]; reference.len()];
    let (size, largest) = (largest_motion(&reference), distance(&reference, &zero));
    if size <= STILL * largest {
        return Err(Failed::Still(test_case.output.clone()));
    }
    if error.is_nan() || error > MAX_REFERENCE_ERROR * size {
        return Err(Failed::Uncertain(error / size));
    }
    let scale = ErrorScale {
        largest: largest.max(size),
        reference: &reference,
        error,
        size,
    };
    let mut tried: Vec<(&Configuration, Trial)> = Vec::new();
    for configuration in &test_case.configurations {
        let steps = step_sequence(configuration, &grid, &scale, effort);
        tried.extend(steps.into_iter().map(|t| (configuration, t)));
    }
    for ablation in &test_case.ablations {
        let step_control = own_step_control(test_case, &grid);
        // A motion far from the reference is a result here, not a failure.
        let far = ErrorScale {
            size: f64::INFINITY,
            ..scale
        };
        tried.push((ablation, far.attempt(ablation, &grid, step_control)));
    }
    Ok(Study {
        facts: StudyInfo {
            scene: test_case.scene.clone(),
            description: test_case.description.clone(),
            output: test_case.output.clone(),
            unit: test_case.unit.clone(),
            end: test_case.end,
            samples: effort.samples,
            kinked: test_case.kinked,
            size,
            floor: scale.floor(f64::EPSILON),
            reference_error: error,
        },
        rows: rows(&test_case.scene, &tried, &grid, effort),
        costs: costs(&test_case.prices, grid.end, effort),
    })
}

/// Returns the distance of an output from its first sample.
fn largest_motion(reference: &[Vec<f64>]) -> f64 {
    let still = vec![reference[0].clone(); reference.len()];
    distance(reference, &still)
}

/// Returns the scene's own step control; a fixed step is adjusted to the interval between samples.
fn own_step_control(test_case: &TestCase, grid: &Grid) -> StepControl {
    match test_case.own.1 {
        StepControl::Step(h) => {
            StepControl::Step(grid.interval() / grid.parts(h.min(grid.interval())) as f64)
        }
        tolerance => tolerance,
    }
}

/// Returns the rows of the trials, with times.
fn rows(scene: &str, tried: &[(&Configuration, Trial)], grid: &Grid, effort: &Effort) -> Vec<Row> {
    let measured = |t: &Trial| matches!(t.outcome, Ok((_, None)));
    let jobs = tried.iter().filter(|(_, t)| measured(t));
    let jobs: Vec<(&Configuration, StepControl)> =
        jobs.map(|(c, t)| (*c, t.step_control)).collect();
    let mut times = times(&jobs, grid, effort).into_iter();
    let row = |(configuration, t): &(&Configuration, Trial)| {
        let (error, ns, status) = match &t.outcome {
            Ok((error, None)) => (Some(*error), times.next(), Status::Ok),
            Ok((error, Some(ns))) => {
                let ns = ns / (1e3 * grid.end);
                (Some(*error), Some(ns), Status::Estimated)
            }
            Err(stop) => (None, None, Status::Failed(stop.to_string())),
        };
        Row {
            scene: scene.into(),
            effects: configuration.effects.clone(),
            method: configuration.method.clone(),
            step_control: t.step_control,
            scalar: configuration.scalar.into(),
            formulation: configuration.formulation.clone(),
            error,
            ns,
            status,
        }
    };
    tried.iter().map(row).collect()
}

impl Study {
    /// Converts to text, for programs that measure and programs that display: CSV records of facts, costs
    /// and rows, each with its kind as the first field.
    pub fn write(&self) -> String {
        let record = |kind: &str, fields: &[String]| {
            let kind = std::iter::once(kind.to_owned());
            kind.chain(fields.iter().cloned()).collect::<Vec<_>>()
        };
        let facts = record(FACTS, &self.facts.record());
        let costs = self.costs.iter().map(|cost| record(COST, &cost.record()));
        let rows = self.rows.iter().map(|row| record(ROW, &row.record()));
        write_csv(std::iter::once(facts).chain(costs).chain(rows))
    }

    /// Parses the studies in a text of [`Study::write`], one after the other; `None` if the text is
    /// invalid.
    pub fn read(text: &str) -> Option<Vec<Study>> {
        let mut all: Vec<Study> = Vec::new();
        for mut fields in records(text) {
            match fields.remove(0).as_str() {
                FACTS => all.push(Study {
                    facts: StudyInfo::of_record(fields)?,
                    rows: Vec::new(),
                    costs: Vec::new(),
                }),
                COST => all.last_mut()?.costs.push(Cost::of_record(fields)?),
                ROW => all.last_mut()?.rows.push(Row::of_record(fields)?),
                _ => return None,
            }
        }
        Some(all)
    }

    /// Returns whether times were measured.
    pub fn is_measured(&self) -> bool {
        !self.rows.iter().any(|r| r.status == Status::Estimated)
    }
}

/// The kinds of records in the text of a study.
const FACTS: &str = "facts";
const COST: &str = "cost";
const ROW: &str = "row";

impl StudyInfo {
    fn record(&self) -> [String; 10] {
        let number = |x: f64| format!("{x:e}");
        [
            self.scene.clone(),
            self.description.clone(),
            self.output.clone(),
            self.unit.clone(),
            self.samples.to_string(),
            self.kinked.to_string(),
            number(self.end),
            number(self.size),
            number(self.floor),
            number(self.reference_error),
        ]
    }

    fn of_record(fields: Vec<String>) -> Option<StudyInfo> {
        let [
            scene,
            description,
            output,
            unit,
            samples,
            kinked,
            end,
            size,
            floor,
            error,
        ] = <[String; 10]>::try_from(fields).ok()?;
        Some(StudyInfo {
            scene,
            description,
            output,
            unit,
            end: end.parse().ok()?,
            samples: samples.parse().ok()?,
            kinked: kinked.parse().ok()?,
            size: size.parse().ok()?,
            floor: floor.parse().ok()?,
            reference_error: error.parse().ok()?,
        })
    }
}
