//! Times generated code: measured in a scratch project, or estimated.

use std::fmt::Write;

use anyhow::{Context, Result, anyhow};
use bgdyn_codegen::emit::{OutputOptions, scene_module, source_text, struct_ident};
use bgdyn_codegen::expr::Operations;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection::scene_functions;
use bgdyn_codegen::system::SceneEquations;

use crate::cargo_project::CargoProject;

/// Number of states in which a scene is timed, around its start.
const STATES: usize = 64;

/// The program's own part of the scratch crate.
const HEAD: &str = r#"//! Written by `bgdyn ops --per-effect`.
use std::hint::black_box;
use std::time::Instant;
use bgdyn::runtime::{FixedVector, HybridSystem, StateVector};

/// Numbers that spread evenly over −1 … 1: multiples of the golden ratio.
fn spread() -> impl FnMut() -> f64 {
    let mut k = 0.0_f64;
    move || {
        k += 1.0;
        2.0 * (0.618_033_988_749_894_9 * k).fract() - 1.0
    }
}

/// Median of nine rounds, ns per call of the derivative.
fn time<S: HybridSystem<f64>>(scene: &S) -> f64 {
    let (start, modes) = scene.start();
    let mut unit = spread();
    let states: Vec<S::State> = (0..STATES)
        .map(|_| {
            S::State::from_entries(|i| {
                let x = start.entries()[i];
                x + unit() * if x.abs() > 10.0 { 0.01 * x } else { 0.3 }
            })
        })
        .collect();
    let input = S::Inputs::from_entries(|_| unit());
    let mut rounds = Vec::new();
    let mut calls = 64;
    while rounds.len() < 9 {
        let begin = Instant::now();
        for k in 0..calls {
            let y = black_box(&states[k % STATES]);
            let _ = black_box(scene.derivative(y, black_box(&modes), black_box(&input), 0.0).is_ok());
        }
        let spent = begin.elapsed().as_secs_f64();
        if spent < 2e-3 && calls < 1 << 24 {
            calls *= 2;
            continue;
        }
        rounds.push(1e9 * spent / calls as f64);
    }
    rounds.sort_by(f64::total_cmp);
    rounds[4]
}
"#;

/// Returns ns per call of the derivative of each scene.
///
/// # Errors
/// If there is no cargo, or cargo cannot get the crates.
pub(crate) fn times(systems: &[SceneEquations], bgdyn: &str) -> Result<Vec<f64>> {
    let project = CargoProject::new("times", bgdyn, &[])?;
    let (mut modules, mut calls) = (String::new(), String::new());
    for (i, system) in systems.iter().enumerate() {
        let place = OutputOptions::source_text("a scene".into());
        let place = place
            .with_module(&format!("v{i}"))
            .map_err(|e| anyhow!(e))?;
        let functions = scene_functions(system, &Options::default());
        let text = source_text(scene_module(system, &functions, &place));
        project.write(&format!("src/v{i}.rs"), &text)?;
        writeln!(modules, "include!(\"v{i}.rs\");")?;
        let scene = struct_ident(&system.scene.name);
        writeln!(
            calls,
            "    println!(\"{{}}\", time(&v{i}::{scene}::<f64>::default()));"
        )?;
    }
    let main =
        format!("{HEAD}\nconst STATES: usize = {STATES};\n{modules}\nfn main() {{\n{calls}}}\n");
    project.write("src/main.rs", &main)?;
    let text = project.run()?;
    let numbers = text
        .lines()
        .map(|line| line.parse::<f64>().context("a time"));
    numbers.collect()
}

/// Estimates a call's time from its operations, ns: for a machine of 3 GHz that starts two operations per
/// cycle and waits for one in three.
pub(crate) fn estimate(o: Operations) -> f64 {
    let quick = (o.total() + o.other) as f64;
    0.4 * quick + 4.0 * (o.div + o.sqrt) as f64 + 12.0 * o.sincos as f64
}
