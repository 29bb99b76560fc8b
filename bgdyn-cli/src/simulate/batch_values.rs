//! Values that override a scene's: from the command line, a file, a grid, or random.

use anyhow::{Result, anyhow};
use bgdyn_codegen::random::Random;
use bgdyn_codegen::scene::{Override, OverrideKind, Scene, quaternion_of_rpy};
use bgdyn_runtime::Dd;

use crate::quantity::value_in;
use crate::table::rows;
use crate::usage::Usage;

/// Largest number of runs of a batch.
const RUNS: usize = 1_000_000;

/// A quantity and its value, SI units.
pub(crate) type Given = (Override, Dd);

/// Quantities, and their values run by run.
#[derive(Default)]
pub(crate) struct BatchValues {
    pub(crate) quantities: Vec<Override>,
    pub(crate) runs: Vec<Vec<f64>>,
}

impl BatchValues {
    /// Returns the values of a run, after the values common to all runs.
    pub(crate) fn overrides_of_run(&self, fixed: &[Given], run: &[f64]) -> Vec<Given> {
        let own = self.quantities.iter().zip(run);
        let own = own.map(|(s, &x)| (s.clone(), Dd::from_f64(x)));
        fixed.iter().cloned().chain(own).collect()
    }
}

/// Parses `NAME=VALUE` of the options `--parameter` and `--initial`.
pub(crate) fn parse_fixed(
    scene: &Scene,
    parameters: &[String],
    initial: &[String],
) -> Result<Vec<Given>, Usage> {
    let mut found: Vec<Given> = Vec::new();
    let parameters = parameters.iter().map(|text| ("parameter", text));
    let initial = initial.iter().map(|text| ("initial", text));
    for (option, text) in parameters.chain(initial) {
        let wrong = |what: String| Usage(format!("`--{option} {text}`: {what}"));
        let (name, value) = text
            .split_once('=')
            .ok_or_else(|| wrong("write NAME=VALUE".into()))?;
        let is_parameter = option == "parameter";
        let what = if is_parameter {
            "parameter"
        } else {
            "part of the state"
        };
        if let Some(pose) = pose(scene, name.trim(), value).filter(|_| !is_parameter) {
            for (position, value) in pose.map_err(wrong)? {
                if found.iter().any(|(s, _)| *s == position) {
                    return Err(wrong(format!("`{}` is set twice", position.name)));
                }
                found.push((position, value));
            }
            continue;
        }
        let wanted = |kind: OverrideKind| kind.is_parameter() == is_parameter;
        let overrides = scene
            .override_named(what, name.trim(), wanted)
            .map_err(wrong)?;
        if found.iter().any(|(s, _)| *s == overrides) {
            return Err(wrong(format!("`{}` is set twice", overrides.name)));
        }
        let value = value_in(value, overrides.unit).map_err(wrong)?;
        found.push((overrides, value));
    }
    Ok(found)
}

/// Returns the positions of `JOINT.xyz`, `JOINT.rpy` or `JOINT.quaternion`; `None` if a name is no part of a
/// pose.
fn pose(scene: &Scene, name: &str, value: &str) -> Option<Result<Vec<Given>, String>> {
    let (joint, part) = name.split_once('.')?;
    let positions = scene.pose_overrides(joint, part)?;
    let (count, unit) = match part {
        "xyz" => (3, "m"),
        "rpy" => (3, "rad"),
        _ => (4, ""),
    };
    let numbers = value.split(',').map(|text| value_in(text.trim(), unit));
    let numbers: Result<Vec<Dd>, String> = numbers.collect();
    Some(numbers.and_then(|numbers| {
        let numbers = match (numbers.as_slice(), part) {
            (&[roll, pitch, yaw], "rpy") => quaternion_of_rpy([roll, pitch, yaw]).to_vec(),
            (all, _) if all.len() == count && part != "rpy" => all.to_vec(),
            (all, _) => {
                let found = all.len();
                return Err(format!(
                    "{found} numbers: write {count}, with commas between them"
                ));
            }
        };
        Ok(positions.into_iter().zip(numbers).collect())
    }))
}

/// Returns the runs of a table: names of quantities in the first line, one run per further line.
pub(crate) fn table(scene: &Scene, text: &str, shown: &str) -> Result<BatchValues> {
    let mut rows = rows(text).into_iter();
    let header = rows
        .next()
        .ok_or_else(|| anyhow!("{shown} is empty: write names of quantities in its first line"))?;
    let mut varied = BatchValues::default();
    let line = header.line;
    for field in &header.cells {
        let quantity = headed(scene, field).map_err(|e| anyhow!("{shown}:{line}: {e}"))?;
        if varied.quantities.contains(&quantity) {
            let name = &quantity.name;
            return Err(anyhow!("{shown}:{line}: `{name}` is listed twice"));
        }
        varied.quantities.push(quantity);
    }
    for row in rows {
        let (at, found, wanted) = (row.line, row.cells.len(), varied.quantities.len());
        if found != wanted {
            return Err(anyhow!(
                "{shown}:{at}: {found} values for {wanted} quantities"
            ));
        }
        let values = row.cells.iter().zip(&varied.quantities).map(|(text, s)| {
            let value = value_in(text, s.unit);
            let wrong = |what| anyhow!("{shown}:{at}: `{}`: {what}", s.name);
            Ok(value.map_err(wrong)?.to_f64())
        });
        varied.runs.push(values.collect::<Result<_>>()?);
    }
    match varied.runs.len() {
        0 => Err(anyhow!(
            "{shown} has no runs: write one line of values per run"
        )),
        n if n > RUNS => Err(anyhow!("{shown} has {n} runs: more than {RUNS}")),
        _ => Ok(varied),
    }
}

/// Returns the quantity of a column's name, with or without its unit: `shoulder`, `shoulder [rad]`.
fn headed(scene: &Scene, field: &str) -> Result<Override, String> {
    let (name, unit) = match field.split_once('[') {
        Some((name, rest)) => (name.trim(), Some(rest.trim_end_matches(']').trim())),
        None => (field, None),
    };
    let quantity = find_override(scene, name)?;
    let own = if quantity.unit.is_empty() {
        "1"
    } else {
        quantity.unit
    };
    match unit.filter(|unit| *unit != own) {
        Some(unit) => Err(format!("`{name}` in {unit}: values are in SI units, {own}")),
        None => Ok(quantity),
    }
}

fn find_override(scene: &Scene, name: &str) -> Result<Override, String> {
    scene.override_named("part of the state or parameter", name, |_| true)
}

/// Returns the runs of a grid: `NAME=FROM:TO:N` each, the last one fastest.
pub(crate) fn grid(scene: &Scene, sweeps: &[String]) -> Result<BatchValues, Usage> {
    let mut varied = BatchValues::default();
    varied.runs.push(vec![]);
    for text in sweeps {
        let wrong = |what: String| Usage(format!("`--sweep {text}`: {what}"));
        let (name, range) = text
            .split_once('=')
            .ok_or_else(|| wrong("write NAME=FROM:TO:N".into()))?;
        let quantity = new(scene, name, &varied).map_err(wrong)?;
        let parts: Vec<&str> = range.split(':').collect();
        let [from, to, n] = parts.as_slice() else {
            return Err(wrong("write NAME=FROM:TO:N".into()));
        };
        let [from, to] = ends(from, to, &quantity).map_err(wrong)?;
        let n: usize = n
            .trim()
            .parse()
            .ok()
            .filter(|n| *n >= 2)
            .ok_or_else(|| wrong(format!("`{n}`: write how many values, 2 or more")))?;
        let total = varied.runs.len().saturating_mul(n);
        if total > RUNS {
            return Err(wrong(format!("that makes {total} runs: more than {RUNS}")));
        }
        let value = |k: usize| match k + 1 == n {
            true => to,
            false => from + (to - from) * (k as f64 / (n - 1) as f64),
        };
        let longer = |run: &Vec<f64>, k| run.iter().copied().chain([value(k)]).collect();
        varied.runs = varied
            .runs
            .iter()
            .flat_map(|run| (0..n).map(move |k| longer(run, k)))
            .collect();
        varied.quantities.push(quantity);
    }
    Ok(varied)
}

/// Returns random runs: `NAME=LOW:HIGH` each, uniformly distributed and independent.
pub(crate) fn chance(
    scene: &Scene,
    ranges: &[String],
    runs: usize,
    seed: u64,
) -> Result<BatchValues, Usage> {
    let mut varied = BatchValues::default();
    let mut of = Vec::new();
    for text in ranges {
        let wrong = |what: String| Usage(format!("`--random {text}`: {what}"));
        let usage = "write NAME=LOW:HIGH";
        let (name, range) = text.split_once('=').ok_or_else(|| wrong(usage.into()))?;
        let quantity = new(scene, name, &varied).map_err(wrong)?;
        let (low, high) = range.split_once(':').ok_or_else(|| wrong(usage.into()))?;
        let [low, high] = ends(low, high, &quantity).map_err(wrong)?;
        if low > high {
            return Err(wrong(format!("{low} is above {high}: {usage}")));
        }
        of.push([low, high]);
        varied.quantities.push(quantity);
    }
    if !(1..=RUNS).contains(&runs) {
        return Err(Usage(format!(
            "`--runs {runs}`: write a number from 1 to {RUNS}"
        )));
    }
    let mut random = Random(seed);
    let one = |random: &mut Random| {
        let value = |&[low, high]: &[f64; 2]| low + (high - low) * random.unit();
        of.iter().map(value).collect()
    };
    varied.runs = (0..runs).map(|_| one(&mut random)).collect();
    Ok(varied)
}

fn new(scene: &Scene, name: &str, varied: &BatchValues) -> Result<Override, String> {
    let quantity = find_override(scene, name.trim())?;
    match varied.quantities.contains(&quantity) {
        true => Err(format!("`{}` is varied twice", quantity.name)),
        false => Ok(quantity),
    }
}

fn ends(low: &str, high: &str, quantity: &Override) -> Result<[f64; 2], String> {
    let end = |text: &str| value_in(text, quantity.unit).map(|value| value.to_f64());
    Ok([end(low)?, end(high)?])
}
