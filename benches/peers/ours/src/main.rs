//! `ours ROBOT OPERATION [LANES]`: prints the time of a call, ns, and the sum of all outputs over all
//! states, as every peer does; with LANES (4 or 8) the time of a state in lanes. With `PEERS_VALUES` it prints
//! all outputs instead, for as many states as this says, a line each.
#![forbid(unsafe_code)]

use std::hint::black_box;
use std::process::ExitCode;

use benches::clock;
use benches::inputs::{Input, Lanes, inputs_of};
use benches::joints::joint_kinds;
use benches::states::{State, states_of};
use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::runtime::wide::{f64x4, f64x8};

/// The line to print; `None` if the model does not have the operation.
type Outcome = Option<String>;

/// Times an operation of a robot in a number of lanes.
type Timed = fn(&str, usize) -> Outcome;

/// Times `call`, and adds up the `outputs` of its results over all states; or prints them, if that is asked.
fn measure<T: Lanes, R, const N: usize, const NQ: usize>(
    states: &[State],
    call: impl Fn(&Input<T, N, NQ>) -> R,
    outputs: impl Fn(&R) -> Vec<T>,
) -> Outcome {
    let inputs = inputs_of::<T, N, NQ>(states);
    if let Ok(number) = std::env::var("PEERS_VALUES") {
        let number = number.parse().unwrap_or(0);
        let line = |input| {
            let outputs = outputs(&call(input));
            let words: Vec<String> = outputs.iter().map(|x| format!("{:e}", x.lane(0))).collect();
            words.join(" ")
        };
        let lines: Vec<String> = inputs.iter().take(number).map(line).collect();
        return Some(lines.join("\n"));
    }
    let mut sum = 0.0;
    for input in &inputs {
        for x in outputs(&call(input)) {
            sum += (0..T::LANES).map(|lane| x.lane(lane)).sum::<f64>();
        }
    }
    let time = clock::median(inputs.len(), clock::span(), |k| {
        black_box(&call(black_box(&inputs[k])));
    });
    Some(format!("{:.3} {sum:.12e}", time / T::LANES as f64))
}

/// Returns all entries, column by column.
fn entries<T: Lanes, const R: usize, const C: usize>(m: &SMatrix<T, R, C>) -> Vec<T> {
    m.iter().copied().collect()
}

/// Returns the entries of the upper triangle, because some peers compute only that.
fn upper<T: Lanes, const N: usize>(m: &SMatrix<T, N, N>) -> Vec<T> {
    let places = (0..N).flat_map(|j| (0..=j).map(move |i| (i, j)));
    places.map(|place| m[place]).collect()
}

/// The operations of a model, including `derivatives` if it is small.
macro_rules! time {
    ($model:expr, $scalar:ty, $n:expr, $nq:expr, $states:expr, $operation:expr; $size:ident) => {{
        let model = $model;
        match $operation {
            "inverse_dynamics" => measure::<$scalar, SVector<$scalar, { $n }>, { $n }, { $nq }>(
                $states,
                |s| model.inverse_dynamics(&s.q, &s.v, &s.a),
                entries,
            ),
            "mass_matrix" => measure::<$scalar, SMatrix<$scalar, { $n }, { $n }>, { $n }, { $nq }>(
                $states,
                |s| model.mass_matrix(&s.q),
                upper,
            ),
            "forward_dynamics" => measure::<$scalar, _, { $n }, { $nq }>(
                $states,
                |s| model.forward_dynamics(&s.q, &s.v, &s.tau),
                |r| entries(r.as_ref().expect("a regular mass matrix")),
            ),
            operation => time!(@derivatives $size model $scalar, $n, $nq, $states, operation),
        }
    }};
    (@derivatives large $model:ident $scalar:ty, $n:expr, $nq:expr, $states:expr, $operation:expr) => {{
        let _ = ($model, $states, $operation);
        None
    }};
    (@derivatives small $model:ident $scalar:ty, $n:expr, $nq:expr, $states:expr, $operation:expr) => {
        match $operation {
            "inverse_dynamics_derivatives" => measure::<$scalar, _, { $n }, { $nq }>(
                $states,
                |s| $model.inverse_dynamics_derivatives(&s.q, &s.v, &s.a),
                |[q, v]| [entries(q), entries(v)].concat(),
            ),
            "forward_dynamics_derivatives" => measure::<$scalar, _, { $n }, { $nq }>(
                $states,
                |s| $model.forward_dynamics_derivatives(&s.q, &s.v, &s.tau),
                |r| {
                    let [q, v, _] = r.as_ref().expect("a regular mass matrix");
                    [entries(q), entries(v)].concat()
                },
            ),
            _ => None,
        }
    };
}

/// A function for each robot, and the list of them.
macro_rules! robots {
    ($($size:ident $module:ident $model:ident $spec:literal,)*) => {
        mod timed {
            use super::*;
            $(#[allow(clippy::result_large_err, reason = "in lanes it has the accelerations")]
            pub(super) fn $module(operation: &str, lanes: usize) -> Outcome {
                const N: usize = super::$module::NV;
                const NQ: usize = super::$module::NQ;
                let mechanism = benches::read($spec.as_ref()).unwrap_or_else(|e| panic!("{e}"));
                let kinds = joint_kinds(&mechanism).unwrap_or_else(|e| panic!("{e}"));
                let states = &states_of(&kinds);
                robots!(@lanes $size $module $model states, operation, lanes)
            })*
        }

        const ROBOTS: &[(&str, Timed)] = &[$((stringify!($module), timed::$module)),*];
    };
    (@lanes large $module:ident $model:ident $states:ident, $operation:ident, $lanes:ident) => {
        match $lanes {
            1 => time!(super::$module::$model::<f64>::default(), f64, N, NQ, $states, $operation; large),
            _ => None,
        }
    };
    (@lanes small $module:ident $model:ident $states:ident, $operation:ident, $lanes:ident) => {
        match $lanes {
            1 => time!(super::$module::$model::<f64>::default(), f64, N, NQ, $states, $operation; small),
            4 => time!(super::$module::$model::<f64x4>::default(), f64x4, N, NQ, $states, $operation; small),
            8 => time!(super::$module::$model::<f64x8>::default(), f64x8, N, NQ, $states, $operation; small),
            _ => None,
        }
    };
}
include!(concat!(env!("OUT_DIR"), "/robots.rs"));

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (robot, operation, lanes) = match &arguments[..] {
        [robot, operation] => (robot, operation, 1),
        [robot, operation, lanes] => (robot, operation, lanes.parse().unwrap_or(0)),
        _ => {
            eprintln!("usage: ours ROBOT OPERATION [LANES]");
            return ExitCode::from(2);
        }
    };
    let Some((_, timed)) = ROBOTS.iter().find(|(name, _)| name == robot) else {
        let known: Vec<&str> = ROBOTS.iter().map(|(name, _)| *name).collect();
        eprintln!("no robot is called {robot}: there are {}", known.join(", "));
        return ExitCode::from(2);
    };
    match timed(operation, lanes) {
        Some(line) => {
            println!("{line}");
            ExitCode::SUCCESS
        }
        None => {
            eprintln!("{robot} has no {operation} in {lanes} lanes");
            ExitCode::from(3)
        }
    }
}
