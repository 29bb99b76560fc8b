//! `ours ROBOT OPERATION [LANES]`: prints the time of a call, ns, and the sum of all outputs over all
//! states, as every peer does; with LANES (4 or 8) the time of a state in lanes.
#![forbid(unsafe_code)]

use std::hint::black_box;
use std::process::ExitCode;

use benches::body::{bodies, slides};
use benches::clock;
use benches::inputs::{Input, Lanes, inputs};
use benches::states::{State, states};
use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::runtime::wide::{f64x4, f64x8};

/// Time of a state and sum of the outputs; `None` if the model does not have the operation.
type Outcome = Option<(f64, f64)>;

/// Times an operation of a robot in a number of lanes.
type Timed = fn(&str, usize) -> Outcome;

/// Times `call`, and adds up the values of `sum` for its results.
fn measure<T: Lanes, R, const N: usize>(
    states: &[State],
    call: impl Fn(&Input<T, N>) -> R,
    sum: impl Fn(&R) -> T,
) -> Outcome {
    let inputs = inputs::<T, N>(states);
    let mut all = 0.0;
    for input in &inputs {
        let some = sum(&call(input));
        all += (0..T::LANES).map(|lane| some.lane(lane)).sum::<f64>();
    }
    let time = clock::median(inputs.len(), clock::span(), |k| {
        black_box(&call(black_box(&inputs[k])));
    });
    Some((time / T::LANES as f64, all))
}

fn total<T: Lanes, const R: usize, const C: usize>(m: &SMatrix<T, R, C>) -> T {
    m.iter().fold(T::from_f64(0.0), |sum, &x| sum + x)
}

/// Returns the sum of the upper triangle, because some peers compute only that.
fn upper<T: Lanes, const N: usize>(m: &SMatrix<T, N, N>) -> T {
    let columns = (0..N).flat_map(|j| (0..=j).map(move |i| (i, j)));
    columns.fold(T::from_f64(0.0), |sum, place| sum + m[place])
}

/// The operations of a model, including `derivatives` if it is small.
macro_rules! time {
    ($model:expr, $scalar:ty, $n:expr, $states:expr, $operation:expr; $size:ident) => {{
        let model = $model;
        match $operation {
            "inverse_dynamics" => measure::<$scalar, SVector<$scalar, { $n }>, { $n }>(
                $states,
                |s| model.inverse_dynamics(&s.q, &s.v, &s.a),
                total,
            ),
            "mass_matrix" => measure::<$scalar, SMatrix<$scalar, { $n }, { $n }>, { $n }>(
                $states,
                |s| model.mass_matrix(&s.q),
                upper,
            ),
            "forward_dynamics" => measure::<$scalar, _, { $n }>(
                $states,
                |s| model.forward_dynamics(&s.q, &s.v, &s.tau),
                |r| total(r.as_ref().expect("a regular mass matrix")),
            ),
            operation => time!(@derivatives $size model $scalar, $n, $states, operation),
        }
    }};
    (@derivatives large $model:ident $scalar:ty, $n:expr, $states:expr, $operation:expr) => {{
        let _ = ($model, $states, $operation);
        None
    }};
    (@derivatives small $model:ident $scalar:ty, $n:expr, $states:expr, $operation:expr) => {
        match $operation {
            "inverse_dynamics_derivatives" => measure::<$scalar, _, { $n }>(
                $states,
                |s| $model.inverse_dynamics_derivatives(&s.q, &s.v, &s.a),
                |[q, v]| total(q) + total(v),
            ),
            "forward_dynamics_derivatives" => measure::<$scalar, _, { $n }>(
                $states,
                |s| $model.forward_dynamics_derivatives(&s.q, &s.v, &s.tau),
                |r| {
                    let [q, v, _] = r.as_ref().expect("a regular mass matrix");
                    total(q) + total(v)
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
                let mechanism = benches::read($spec.as_ref()).unwrap_or_else(|e| panic!("{e}"));
                let states = &states(&slides(&bodies(&mechanism)));
                robots!(@lanes $size $module $model states, operation, lanes)
            })*
        }

        const ROBOTS: &[(&str, Timed)] = &[$((stringify!($module), timed::$module)),*];
    };
    (@lanes large $module:ident $model:ident $states:ident, $operation:ident, $lanes:ident) => {
        match $lanes {
            1 => time!(super::$module::$model::<f64>::default(), f64, N, $states, $operation; large),
            _ => None,
        }
    };
    (@lanes small $module:ident $model:ident $states:ident, $operation:ident, $lanes:ident) => {
        match $lanes {
            1 => time!(super::$module::$model::<f64>::default(), f64, N, $states, $operation; small),
            4 => time!(super::$module::$model::<f64x4>::default(), f64x4, N, $states, $operation; small),
            8 => time!(super::$module::$model::<f64x8>::default(), f64x8, N, $states, $operation; small),
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
        Some((time, sum)) => {
            println!("{time:.3} {sum:.12e}");
            ExitCode::SUCCESS
        }
        None => {
            eprintln!("{robot} has no {operation} in {lanes} lanes");
            ExitCode::from(3)
        }
    }
}
