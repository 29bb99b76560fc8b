//! Times functions without a compiler: `cargo run --release -p bgdyn-codegen --example tape -- specs/panda.yaml …`
//! prints, for each method, the time of one call of the evaluator and of the tape, measured in turn, and the time to
//! prepare the tape. Medians.

use std::hint::black_box;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use bgdyn_codegen::engine::{CallArguments, Engine};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::files::stem;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::selection::function;
use bgdyn_codegen::tape::Tape;

const METHODS: [Method; 5] = [
    Method::InverseDynamics,
    Method::MassMatrix,
    Method::ForwardDynamics,
    Method::InverseDynamicsDerivatives,
    Method::ForwardDynamicsDerivatives,
];
const ROUNDS: usize = 21;
const STATES: usize = 64;

/// Returns random states.
fn states(mechanism: &Mechanism) -> Vec<Inputs<f64>> {
    let mut random = Random(2007);
    let mut numbers = |n: usize| (0..n).map(|_| 3.0 * random.signed()).collect::<Vec<f64>>();
    let (nq, nv) = (mechanism.nq(), mechanism.nv());
    let parameters = mechanism.parameters().iter();
    let parameters: Vec<f64> = parameters.map(|p| p.default.to_f64()).collect();
    let state = |_| Inputs {
        q: numbers(nq),
        v: numbers(nv),
        a: numbers(nv),
        u: numbers(nv),
        parameters: parameters.clone(),
        ..Inputs::default()
    };
    (0..STATES).map(state).collect()
}

/// Returns the median of the times of a call for all states, in ns for each.
fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn timed(run: impl FnOnce()) -> f64 {
    let start = Instant::now();
    run();
    start.elapsed().as_nanos() as f64
}

/// Prints the times of a function.
fn report(name: &str, function: &Function, states: &[Inputs<f64>]) {
    let tape = Tape.prepare(function);
    let mut out = vec![0.0; tape.results()];
    let (mut evaluator, mut of_tape, mut preparing) = (vec![], vec![], vec![]);
    for _ in 0..ROUNDS {
        preparing.push(timed(|| drop(black_box(Tape.prepare(function)))));
        let copies: Vec<Inputs<f64>> = states.to_vec();
        let all = timed(|| {
            for state in copies {
                black_box(function.evaluate(state));
            }
        });
        evaluator.push(all / states.len() as f64);
        let all = timed(|| {
            for state in states {
                black_box(tape.call(&CallArguments::from(state), &mut out));
            }
        });
        of_tape.push(all / states.len() as f64);
    }
    let [evaluator, of_tape, preparing] = [evaluator, of_tape, preparing].map(median);
    println!(
        "{name} {}: evaluator {evaluator:.0} ns, tape {of_tape:.0} ns, {:.1} times faster; prepared in {:.0} µs",
        function.name(),
        evaluator / of_tape,
        preparing / 1e3
    );
}

fn main() -> ExitCode {
    for path in std::env::args().skip(1) {
        let name = stem(Path::new(&path));
        let mechanism = std::fs::read_to_string(&path)
            .ok()
            .and_then(|text| bgdyn_codegen::read(&text, Some(&name)).0);
        let Some(mechanism) = mechanism else {
            eprintln!("{path} is no sound mechanism");
            return ExitCode::FAILURE;
        };
        let states = states(&mechanism);
        for method in METHODS {
            if let Some(function) = function(&mechanism, method, &Options::default()) {
                report(&name, &function, &states);
            }
        }
    }
    ExitCode::SUCCESS
}
