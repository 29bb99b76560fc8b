//! Times of machine code made at run time and of tapes over those of the same functions compiled by rustc: methods of
//! arms, and runs of scenes. All contenders in turn, medians of the rounds. Fails where a result has other bits.
//!
//! `cargo bench -p benches_machine_code` prints the tables of docs/machine_code.md.

use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use benches::clock;
use benches::states::{STATES, State, states};
use benches_machine_code::models;
use bgdyn_cli::simulate::{Evaluated, Form};
use bgdyn_codegen::engine::{CallArguments, Callable, Engine};
use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::tape::Tape;
use bgdyn_jit::Jit;
use bgdyn_sim::{Rk4, Run, StateVector};
use nalgebra::SVector;

/// Number of rounds.
const ROUNDS: usize = 15;
/// Duration of the timing of one contender in a round.
const SPAN: Duration = Duration::from_millis(8);
/// Steps of a run of a scene, and their length, s.
const STEPS: usize = 500;
const STEP: f64 = 1e-4;

/// The timed methods.
const METHODS: [Method; 4] = [
    Method::InverseDynamics,
    Method::MassMatrix,
    Method::ForwardDynamics,
    Method::ForwardDynamicsDerivatives,
];

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Returns the duration of a call, s.
fn timed<R>(call: impl FnOnce() -> R) -> f64 {
    let start = Instant::now();
    black_box(call());
    start.elapsed().as_secs_f64()
}

/// A function by both engines.
struct Prepared {
    code: bgdyn_jit::MachineCode,
    tape: Box<dyn Callable>,
    /// Time to machine code, ms.
    making: f64,
}

impl Prepared {
    fn new(jit: &Jit, function: &Function) -> Self {
        let make = || jit.compile(function).expect("machine code");
        Prepared {
            making: 1e3 * median((0..ROUNDS).map(|_| timed(make)).collect()),
            code: make(),
            tape: Tape.prepare(function),
        }
    }
}

/// Prints the times of a method: of a call of rustc's code by the index of a state, and of both engines.
fn report(name: &str, function: &Function, jit: &Jit, states: &[State], rustc: &dyn Fn(usize)) {
    let prepared = Prepared::new(jit, function);
    let arguments: Vec<CallArguments<'_>> = states
        .iter()
        .map(|state| CallArguments {
            q: &state.q,
            v: &state.v,
            a: &state.a,
            u: &state.tau,
            ..CallArguments::default()
        })
        .collect();
    for from in &arguments {
        assert_eq!(
            prepared.code.value(from),
            prepared.tape.value(from),
            "{name}"
        );
    }
    let mut out = vec![0.0; prepared.tape.results()];
    let mut rounds = [vec![], vec![], vec![]];
    for _ in 0..ROUNDS {
        rounds[0].push(clock::median(STATES, SPAN, rustc));
        let engines: [&dyn Callable; 2] = [&prepared.code, &*prepared.tape];
        for (times, engine) in rounds[1..].iter_mut().zip(engines) {
            times.push(clock::median(STATES, SPAN, |k| {
                engine.call(black_box(&arguments[k]), &mut out);
                black_box(&mut out);
            }));
        }
    }
    let [rustc, code, tape] = rounds.map(median);
    println!(
        "| `{name}` | {} | {rustc:.0} ns | {:.2} | {:.2} | {:.1} | {:.1} |",
        function.name(),
        code / rustc,
        tape / rustc,
        prepared.making,
        prepared.code.bytes() as f64 / 1e3
    );
}

/// Reads a mechanism and returns it with states.
fn arm(path: &Path) -> (Mechanism, Vec<State>) {
    let mechanism = benches::read(path).expect("a spec");
    let slides = benches::body::slides(&benches::body::bodies(&mechanism));
    (mechanism, states(&slides))
}

macro_rules! arms {
    ($($module:ident $model:ident $spec:literal,)*) => {
        /// Prints the times of all methods of the arms; only those of the first one if `quick`.
        fn all_arms(jit: &Jit, quick: bool) {
            $(if !quick || stringify!($module) == "scara" {
                const N: usize = models::$module::NV;
                let (mechanism, states) = arm($spec.as_ref());
                let of = |numbers: &[f64]| SVector::<f64, N>::from_column_slice(numbers);
                let inputs: Vec<_> =
                    states.iter().map(|s| [&s.q, &s.v, &s.a, &s.tau].map(|x| of(x))).collect();
                let model = models::$module::$model::<f64>::default();
                for method in METHODS {
                    let function = selection::function(&mechanism, method, &Options::default());
                    let function = function.expect("every formulation knows it");
                    let rustc = |k: usize| {
                        let [q, v, a, tau] = black_box(&inputs[k]);
                        match method {
                            Method::InverseDynamics => _ = black_box(model.inverse_dynamics(q, v, a)),
                            Method::MassMatrix => _ = black_box(model.mass_matrix(q)),
                            Method::ForwardDynamics => _ = black_box(model.forward_dynamics(q, v, tau)),
                            _ => _ = black_box(model.forward_dynamics_derivatives(q, v, tau)),
                        }
                    };
                    report(stringify!($module), &function, jit, &states, &rustc);
                }
            })*
        }
    };
}

/// Returns the equations of a scene.
fn equations(path: &Path) -> SceneEquations {
    let read = |path: &Path| std::fs::read_to_string(path).map_err(|e| e.to_string());
    let text = read(path).expect("a scene's file");
    let load = |file: &str| read(&beside(path, file));
    let read = bgdyn_codegen::read_scene(&text, &stem(path), load);
    read.expect("a sound scene").0
}

/// Runs a scene by an engine; returns the time and the last state.
fn run(plant: &Evaluated<'_>) -> (f64, Vec<f64>) {
    let begin = plant.begin();
    let mut run = Run::by(Rk4, plant.clone(), begin);
    let time = timed(|| {
        for _ in 0..STEPS {
            run.step(STEP).expect("the scene goes on");
        }
    });
    (time, run.y().entries().to_vec())
}

macro_rules! scenes {
    ($($module:ident $model:ident $path:literal,)*) => {
        /// Prints the times of runs of the scenes; only those of the first one if `quick`.
        fn all_scenes(jit: &Jit, quick: bool) {
            $(if !quick || stringify!($module) == "stick_slip" {
                let system = equations($path.as_ref());
                let making = timed(|| Evaluated::new(jit, &system, Form::Natural, false))
                    - timed(|| Evaluated::new(&Tape, &system, Form::Natural, false));
                let engines: [&dyn Engine; 2] = [jit, &Tape];
                let plants = engines.map(|e| Evaluated::new(e, &system, Form::Natural, false));
                let scene = models::$module::$model::<f64>::default();
                let mut rounds = [vec![], vec![], vec![]];
                for _ in 0..ROUNDS {
                    let mut compiled = Run::new(&scene);
                    rounds[0].push(timed(|| {
                        for _ in 0..STEPS {
                            compiled.step(STEP).expect("the scene goes on");
                        }
                    }));
                    let states = [0, 1].map(|k| {
                        let (time, state) = run(&plants[k]);
                        rounds[1 + k].push(time);
                        state
                    });
                    let compiled = compiled.y().entries().to_vec();
                    assert_eq!(states, [compiled.clone(), compiled], stringify!($module));
                }
                let [rustc, code, tape] = rounds.map(median);
                println!(
                    "| `{}` | {:.2} µs | {:.2} | {:.2} | {:.2} | {:.0} | {} |",
                    stringify!($module),
                    1e6 * rustc / STEPS as f64,
                    code / rustc,
                    tape / rustc,
                    tape / code,
                    1e3 * making,
                    plants[0].engine(),
                );
            })*
        }
    };
}
include!(concat!(env!("OUT_DIR"), "/calls.rs"));

fn main() {
    // `cargo test` runs benchmarks without this argument, to check that they run.
    let quick = !std::env::args().any(|argument| argument == "--bench");
    let jit = match Jit::new() {
        Ok(jit) => jit,
        Err(why) => return println!("no machine code: {why}"),
    };
    println!("{jit:?}\n");
    println!("| arm | method | rustc | machine code / rustc | tape / rustc | made in, ms | kB |");
    println!("|---|---|---|---|---|---|---|");
    all_arms(&jit, quick);
    println!(
        "\n| scene | step by rustc | machine code / rustc | tape / rustc | tape / machine code | made in, ms | by |"
    );
    println!("|---|---|---|---|---|---|---|");
    all_scenes(&jit, quick);
}
