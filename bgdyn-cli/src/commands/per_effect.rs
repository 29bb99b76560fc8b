//! `bgdyn ops SCENE --per-effect`: prints the cost of each effect.

use anyhow::Result;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::system::SceneEquations;
use nalgebra::DMatrix;
use serde::Serialize;

use crate::output::{print, tell};
use crate::timing::{estimate, times};

/// A scene with some of its effects.
#[derive(Serialize)]
struct VariantCost {
    /// The variant: effects added so far, or all except one.
    effects: Vec<String>,
    /// Multiplications and additions of the derivative.
    ops: usize,
    /// Number of states.
    states: usize,
    /// ns per call of the derivative.
    ns: f64,
    /// Whether `ns` is estimated from the operations.
    estimated: bool,
    /// 1 / |λ| of the fastest mode at the start, s; null if there is none.
    fastest_time_constant: Option<f64>,
    #[serde(skip)]
    title: String,
}

/// Prints the table of a scene's effects: added one at a time, and all except one.
pub(super) fn report(whole: &SceneEquations, json: bool, bgdyn: &str) -> Result<()> {
    let (titles, systems): (Vec<String>, Vec<SceneEquations>) =
        variants(whole)?.into_iter().unzip();
    let functions: Vec<Function> = systems
        .iter()
        .map(|s| s.function(SceneFunction::Derivative))
        .collect();
    let measured = times(&systems, bgdyn);
    if let Err(why) = &measured {
        tell(&format!(
            "bgdyn: times are estimated from operations: {why:#}\n"
        ));
    }
    let rows: Vec<VariantCost> = titles
        .into_iter()
        .enumerate()
        .map(|(i, title)| {
            let (system, function) = (&systems[i], &functions[i]);
            let operations = function.operations();
            let layout = &system.scene.layout;
            VariantCost {
                effects: names(system),
                ops: operations.total(),
                states: layout.nq() + layout.nv() + layout.nx(),
                ns: measured
                    .as_ref()
                    .map_or_else(|_| estimate(operations), |t| t[i]),
                estimated: measured.is_err(),
                fastest_time_constant: fastest(system, function),
                title,
            }
        })
        .collect();
    match json {
        true => print(&(serde_json::to_string_pretty(&rows)? + "\n")),
        false => print(&table(&rows)),
    }
}

fn names(system: &SceneEquations) -> Vec<String> {
    system
        .scene
        .elements
        .iter()
        .map(|e| e.name.clone())
        .collect()
}

/// Returns the scene without effects, with one more each time, and without each one in turn.
fn variants(whole: &SceneEquations) -> Result<Vec<(String, SceneEquations)>> {
    let all = names(whole);
    let with = |names: &[&String]| {
        let scene = whole.scene.with_effects(|e| names.contains(&&e.name));
        SceneEquations::new(scene)
            .map_err(|_| anyhow::anyhow!("the scene cannot do without its effects"))
    };
    let mut found = vec![("links with point masses".to_owned(), with(&[])?)];
    let mut so_far: Vec<&String> = Vec::new();
    for name in &all {
        so_far.push(name);
        found.push((format!("+ {name}"), with(&so_far)?));
    }
    if all.len() > 1 {
        for name in &all {
            let rest: Vec<&String> = all.iter().filter(|n| *n != name).collect();
            found.push((format!("all but {name}"), with(&rest)?));
        }
    }
    Ok(found)
}

/// Returns 1 / |λ| of the fastest mode at the start.
fn fastest(system: &SceneEquations, derivative: &Function) -> Option<f64> {
    let slope = system.slope(derivative, &system.start())?;
    let n = slope.len();
    let matrix = DMatrix::from_fn(n, n, |i, j| slope[i][j]);
    let values = matrix.complex_eigenvalues();
    let largest = values.iter().map(|z| z.norm()).fold(0.0, f64::max);
    (largest > 1e-9).then_some(1.0 / largest)
}

fn table(rows: &[VariantCost]) -> String {
    let mut text = format!(
        "{:<40} {:>7} {:>7} {:>9} {:>14}\n",
        "effects", "mul+add", "states", "ns", "fastest, s"
    );
    for row in rows {
        let ns = match row.estimated {
            true => format!("~{:.0}", row.ns),
            false => format!("{:.1}", row.ns),
        };
        let fastest = row
            .fastest_time_constant
            .map_or("none".to_owned(), |t| format!("{t:.2e}"));
        text += &format!(
            "{:<40} {:>7} {:>7} {ns:>9} {fastest:>14}\n",
            row.title, row.ops, row.states
        );
    }
    text
}
