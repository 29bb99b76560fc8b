//! Times the generated methods in `f64`, and the ratio of the textbook recursions' times to them: both
//! alternately over the same states, medians of the rounds. Then the same in eight lanes, per state.

use std::hint::black_box;
use std::time::Duration;

use benches::body::{bodies, slides};
use benches::clock;
use benches::inputs::{Input, inputs};
use benches::plain::Plain;
use benches::states::{STATES, State, states};
use bgdyn::runtime::wide::f64x8;

/// Number of rounds.
const ROUNDS: usize = 5;
/// Duration of the timing of one method in a round.
const SPAN: Duration = Duration::from_millis(4);
/// Number of states of a call in lanes.
const LANES: usize = 8;

const METHODS: [&str; 6] = [
    "inverse dynamics",
    "mass matrix",
    "forward dynamics",
    "bias",
    "gravity",
    "Jacobian",
];

/// The timed calls of a method: in `f64`, in lanes, and by the textbook; the argument is the index of the
/// call's input.
struct Calls<'a> {
    alone: Box<dyn FnMut(usize) + 'a>,
    lanes: Box<dyn FnMut(usize) + 'a>,
    textbook: Box<dyn FnMut(usize) + 'a>,
}

/// Times of a state, ns, and the ratio of the textbook's times to them.
struct Times {
    alone: (f64, f64),
    lanes: (f64, f64),
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn times(mut calls: Calls<'_>) -> Times {
    let rounds: Vec<[f64; 3]> = (0..ROUNDS)
        .map(|_| {
            let alone = clock::median(STATES, SPAN, &mut calls.alone);
            let lanes = clock::median(STATES / LANES, SPAN, &mut calls.lanes) / LANES as f64;
            let textbook = clock::median(STATES, SPAN, &mut calls.textbook);
            [alone, lanes, textbook]
        })
        .collect();
    let compared = |ours: usize| {
        let time = median(rounds.iter().map(|round| round[ours]));
        let ratio = median(rounds.iter().map(|round| round[2] / round[ours]));
        (time, ratio)
    };
    Times {
        alone: compared(0),
        lanes: compared(1),
    }
}

/// The generated modules.
mod models {
    include!(concat!(env!("OUT_DIR"), "/models.rs"));
}

/// The three implementations of a method.
macro_rules! method {
    ($module:ident, $model:ident, $data:ident, $n:ident, $plain:ident, |$m:ident, $s:ident| $call:expr) => {{
        use models::$module::$model as Model;
        let Data {
            states,
            mechanism,
            tip,
        } = $data;
        let alone = inputs::<f64, $n>(states);
        let lanes = inputs::<f64x8, $n>(states);
        let same = inputs::<f64, $n>(states);
        let mut plain = Plain::<f64>::new(mechanism, tip);
        times(Calls {
            alone: Box::new(move |k| {
                let ($m, $s) = (Model::<f64>::default(), black_box(&alone[k]));
                black_box(&$call);
            }),
            lanes: Box::new(move |k| {
                let ($m, $s) = (Model::<f64x8>::default(), black_box(&lanes[k]));
                black_box(&$call);
            }),
            textbook: Box::new(move |k| {
                let input: &Input<f64, $n> = black_box(&same[k]);
                plain.$plain(input);
                black_box(&mut plain);
            }),
        })
    }};
}

/// The data for timing all methods of a robot.
struct Data<'a> {
    states: &'a [State],
    mechanism: &'a bgdyn_codegen::mechanism::Mechanism,
    tip: &'a str,
}

macro_rules! robots {
    ($($module:ident $model:ident $jacobian:ident $tip:literal $spec:literal,)*) => {$(
        fn $module() -> [Times; METHODS.len()] {
            const N: usize = models::$module::NV;
            let mechanism = &benches::read($spec.as_ref()).expect("a spec");
            let states = &states(&slides(&bodies(mechanism)));
            let data = &Data { states, mechanism, tip: $tip };
            [
                method!($module, $model, data, N, inverse_dynamics,
                    |m, s| m.inverse_dynamics(&s.q, &s.v, &s.a)),
                method!($module, $model, data, N, mass_matrix, |m, s| m.mass_matrix(&s.q)),
                method!($module, $model, data, N, forward_dynamics,
                    |m, s| m.forward_dynamics(&s.q, &s.v, &s.tau)),
                method!($module, $model, data, N, bias, |m, s| m.bias(&s.q, &s.v)),
                method!($module, $model, data, N, gravity, |m, s| m.gravity(&s.q)),
                method!($module, $model, data, N, jacobian, |m, s| m.$jacobian(&s.q)),
            ]
        }
    )*

        const ROBOTS: &[(&str, fn() -> [Times; METHODS.len()])] = &[$((stringify!($module), $module)),*];
    };
}
include!(concat!(env!("OUT_DIR"), "/robots.rs"));

fn main() {
    // `cargo test --benches` runs benchmarks without this argument, to check that they run.
    let robots = match std::env::args().any(|argument| argument == "--bench") {
        true => ROBOTS,
        false => &ROBOTS[..1],
    };
    let times: Vec<_> = robots
        .iter()
        .map(|(name, times)| (*name, times()))
        .collect();
    let columns = METHODS.join(" | ");
    let rule = "---|".repeat(METHODS.len());
    for (lanes, which) in [(false, "one state a call"), (true, "eight lanes")] {
        println!("\nns per state in f64, {which}; in brackets: the textbook's time over it\n");
        println!("| robot | {columns} |\n|---|{rule}");
        for (name, times) in &times {
            let cells = times.iter().map(|t| if lanes { t.lanes } else { t.alone });
            let cells = cells.map(|(time, ratio)| format!("{time:.1} ({ratio:.1})"));
            println!("| {name} | {} |", cells.collect::<Vec<_>>().join(" | "));
        }
    }
}
