//! `ours ROBOT OPERATION [LANES]`: prints the time of a call, ns, and the sum of all outputs over all
//! states, as every peer does; with LANES (4 or 8) the time of a state in lanes. With `PEERS_VALUES` it prints
//! all outputs instead, for as many states as this says, a line each.
#![forbid(unsafe_code)]

use std::process::ExitCode;

use benches::joints::joint_kinds;
use benches::outcome::{Outcome, Timed, answer, entries, measure, upper};
use benches::states::states_of;
use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::runtime::wide::{f64x4, f64x8};

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
    ($($module:ident $model:ident $size:ident $spec:literal,)*) => {
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
include!(concat!(env!("OUT_DIR"), "/models.rs"));
include!(concat!(env!("OUT_DIR"), "/robots.rs"));

fn main() -> ExitCode {
    answer("ours", ROBOTS)
}
