//! Tests bar 13 over every method with the evaluator: numbers of any size give numbers or a refusal, and a
//! component that depends on a NaN is never finite. `tests/hard_cases` does the same for five methods in
//! compiled code.

use std::fs;
use std::path::Path;

use crate::common::Robot;
use crate::common::bars::Digits;
use crate::common::rng::Rng;
use bgdyn_codegen::choice::Choice;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::files::stem;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::{Argument, Method};

/// The largest arguments: positions, everything else, and the smallest positive number.
trait Range: Digits {
    const POSITION: f64;
    const RATE: f64;
    const LEAST: f64;
}

impl Range for f64 {
    const POSITION: f64 = 1e15;
    const RATE: f64 = 1e60;
    const LEAST: f64 = 5e-324;
}

impl Range for f32 {
    const POSITION: f64 = 1e4;
    const RATE: f64 = 1e6;
    const LEAST: f64 = 1.4e-45;
}

/// Arguments: positions, velocities, accelerations, efforts.
type Lists = [Vec<f64>; 4];

/// Returns which of these a method reads.
fn read(method: Method) -> [bool; 4] {
    let takes = |argument| method.arguments().contains(&argument);
    [
        true,
        takes(Argument::V),
        takes(Argument::A),
        takes(Argument::Tau),
    ]
}

/// Returns a number of any size up to `most`, including ±0 and denormals.
fn wild<T: Range>(rng: &mut Rng, most: f64) -> f64 {
    let sign = if rng.chance(0.5) { 1.0 } else { -1.0 };
    match rng.below(8) {
        0 => sign * 0.0,
        1 => sign * T::LEAST * (1.0 + rng.unit() * 1e6).floor(),
        2 => sign * most,
        3 => rng.within(4.0),
        _ => sign * most * 10_f64.powf(-rng.unit() * 2.0 * most.log10()),
    }
}

/// Returns the results; `None` if the function refuses, which it does if an acceleration is not finite.
fn value<T: Range>(robot: &Robot, f: &Function, x: &Lists) -> Option<Vec<f64>> {
    let all = |x: &[f64]| x.iter().map(|&x| T::from_f64(x)).collect();
    let parameters = robot.mechanism.parameters().iter();
    let (found, refused) = f.evaluate(Inputs::<T> {
        q: all(&x[0]),
        v: all(&x[1]),
        a: all(&x[2]),
        u: all(&x[3]),
        parameters: parameters
            .map(|p| T::from_f64(p.default.to_f64()))
            .collect(),
        x: vec![],
        modes: vec![],
        t: None,
        passed: vec![],
    });
    let found: Vec<f64> = found.into_iter().map(T::to_f64).collect();
    let checked = f.method.shape().checked() && !found.iter().all(|x| x.is_finite());
    (refused.is_none() && !checked).then_some(found)
}

fn stays_finite<T: Range>(robot: &Robot, f: &Function, rng: &mut Rng, states: usize) {
    let n = robot.nv();
    for _ in 0..states {
        let x: Lists = std::array::from_fn(|kind| {
            let most = if kind == 0 { T::POSITION } else { T::RATE };
            (0..n).map(|_| wild::<T>(rng, most)).collect()
        });
        if let Some(found) = value::<T>(robot, f, &x) {
            assert!(
                found.iter().all(|x| x.is_finite()),
                "{} of {}{}: {x:?} gives {found:?}",
                f.name(),
                robot.mechanism.name(),
                T::MARK
            );
        }
    }
}

/// Sets each argument to NaN in turn: a result that stays finite must not depend on it.
fn never_swallowed<T: Range>(robot: &Robot, f: &Function, rng: &mut Rng) -> usize {
    let n = robot.nv();
    let usual: Lists = std::array::from_fn(|_| (0..n).map(|_| rng.within(0.9)).collect());
    let mut spoiled = 0;
    let kinds = (0..4).filter(|&kind| read(f.method)[kind]);
    for (kind, i) in kinds.flat_map(|kind| (0..n).map(move |i| (kind, i))) {
        let with = |other: f64| {
            let mut x = usual.clone();
            x[kind][i] = other;
            value::<T>(robot, f, &x)
        };
        let Some(here) = value::<T>(robot, f, &usual) else {
            continue;
        };
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let Some(found) = with(bad) else { continue };
            for (k, x) in found.iter().enumerate().filter(|(_, x)| x.is_finite()) {
                for other in [0.0, 0.5, -3.0, 1e3] {
                    let there = with(other).map(|there| there[k]);
                    assert!(
                        there.is_none_or(|there| there == here[k]),
                        "{} of {}{}: {bad} in argument {kind}[{i}] leaves [{k}] {x}",
                        f.name(),
                        robot.mechanism.name(),
                        T::MARK
                    );
                }
            }
            spoiled += 1;
        }
    }
    spoiled
}

/// Tests every method of every spec in this number of states and of states with NaN.
fn run(states: usize, usual: usize) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs");
    let mut paths: Vec<_> = fs::read_dir(folder)
        .expect("the specs")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|e| e == "yaml"))
        .collect();
    paths.sort();
    let (mut methods, mut spoiled) = (0, 0);
    for path in &paths {
        let text = fs::read_to_string(path).expect("a spec");
        let robot = Robot::read(&text, Some(&stem(path)));
        let choice = Choice::new(robot.graph, None);
        for method in Method::possible(&robot.graph.sites) {
            let f = choice.function(method).expect("every method is known");
            let mut rng = Rng::new(1300 + methods as u64);
            stays_finite::<f64>(&robot, &f, &mut rng, states);
            stays_finite::<f32>(&robot, &f, &mut rng, states);
            for _ in 0..usual {
                spoiled += never_swallowed::<f64>(&robot, &f, &mut rng);
                spoiled += never_swallowed::<f32>(&robot, &f, &mut rng);
            }
            methods += 1;
        }
    }
    println!(
        "{methods} methods of {} mechanisms, {} states, {spoiled} spoiled ones that are no refusal",
        paths.len(),
        2 * states * methods
    );
    assert!(paths.len() >= 17 && methods > 10 * paths.len() && spoiled > methods);
}

#[test]
fn every_method_at_numbers_of_any_size() {
    run(20, 1);
}

/// About a million states: `cargo test --release -p bgdyn-codegen --test digits limits -- --ignored`.
#[test]
#[ignore = "a long run, see `.ci/long`"]
fn every_method_at_a_million_states() {
    run(900, 20);
}
