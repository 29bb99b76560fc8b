//! `control ROBOT OPERATION`: prints the time of a call, ns, and the sum of all outputs over all states, as every peer
//! does. With `PEERS_VALUES` it prints all outputs instead, for as many states as this says, a line each.
//!
//! Directions are the state's other vectors: inverse dynamics goes along (τ, a, v), forward dynamics along (a, v, τ);
//! efforts are multiplied by l = τ, accelerations by l = a.
#![forbid(unsafe_code)]

use std::process::ExitCode;

use benches::inputs::Input;
use benches::joints::joint_kinds;
use benches::outcome::{Outcome, Timed, answer, entries, measure, upper};
use benches::states::{State, states_of};

/// The operations of a model.
macro_rules! operations {
    ($size:ident $module:ident $model:ident $inverse:ident $inertia:ident $states:ident, $operation:ident) => {{
        const N: usize = super::$module::NV;
        type S = Input<f64, N>;
        let m = super::$module::$model::<f64>::default();
        match $operation {
            "regressor" => measure($states, |s: &S| m.regressor(&s.q, &s.v, &s.a), entries),
            "inverse_mass_matrix" => measure(
                $states,
                |s: &S| m.inverse_mass_matrix(&s.q),
                |r| upper(r.as_ref().expect("regular")),
            ),
            "inverse_dynamics_along" => measure(
                $states,
                |s: &S| m.inverse_dynamics_along(&s.q, &s.v, &s.a, &s.tau, &s.a, &s.v),
                entries,
            ),
            "inverse_dynamics_adjoint" => measure(
                $states,
                |s: &S| m.inverse_dynamics_adjoint(&s.q, &s.v, &s.a, &s.tau),
                |r| r.iter().flat_map(entries).collect(),
            ),
            "forward_dynamics_along" => measure(
                $states,
                |s: &S| m.forward_dynamics_along(&s.q, &s.v, &s.tau, &s.a, &s.v, &s.tau),
                |r| entries(r.as_ref().expect("regular")),
            ),
            "forward_dynamics_adjoint" => measure(
                $states,
                |s: &S| m.forward_dynamics_adjoint(&s.q, &s.v, &s.tau, &s.a),
                |r| r.iter().flatten().flat_map(entries).collect(),
            ),
            "inverse_dynamics_curvature" => measure(
                $states,
                |s: &S| m.inverse_dynamics_curvature(&s.q, &s.v, &s.a, &s.tau),
                |r| r.iter().flat_map(entries).collect(),
            ),
            "mass_matrix_rate" => {
                measure($states, |s: &S| m.mass_matrix_rate(&s.q, &s.v), entries)
            }
            "centre_of_mass" => measure($states, |s: &S| m.centre_of_mass(&s.q), entries),
            "com_jacobian" => measure($states, |s: &S| m.com_jacobian(&s.q), entries),
            "centroidal_map" => measure($states, |s: &S| m.centroidal_map(&s.q), entries),
            "centroidal_momentum" => {
                measure($states, |s: &S| m.centroidal_momentum(&s.q, &s.v), entries)
            }
            "centroidal_bias" => {
                measure($states, |s: &S| m.centroidal_bias(&s.q, &s.v), entries)
            }
            "operational_inverse" => measure(
                $states,
                |s: &S| m.$inverse(&s.q),
                |r| upper(r.as_ref().expect("regular")),
            ),
            operation => operations!(@$size m $inertia $states, operation, S),
        }
    }};
    (@planar $m:ident $inertia:ident $states:ident, $operation:ident, $s:ident) => {{
        let _ = ($states, $operation);
        None
    }};
    (@spatial $m:ident $inertia:ident $states:ident, $operation:ident, $s:ident) => {
        match $operation {
            "operational_inertia" => measure(
                $states,
                |s: &$s| $m.$inertia(&s.q),
                |r| upper(r.as_ref().expect("a posture that is not singular")),
            ),
            _ => None,
        }
    };
}

/// A function for each robot, and the list of them.
macro_rules! robots {
    ($($module:ident $model:ident $size:ident $inverse:ident $inertia:ident $spec:literal,)*) => {
        mod timed {
            use super::*;
            $(pub(super) fn $module(operation: &str, lanes: usize) -> Outcome {
                if lanes > 1 {
                    return None;
                }
                let mechanism = benches::read($spec.as_ref()).unwrap_or_else(|e| panic!("{e}"));
                let kinds = joint_kinds(&mechanism).unwrap_or_else(|e| panic!("{e}"));
                let states: &[State] = &states_of(&kinds);
                operations!($size $module $model $inverse $inertia states, operation)
            })*
        }

        const ROBOTS: &[(&str, Timed)] = &[$((stringify!($module), timed::$module)),*];
    };
}
include!(concat!(env!("OUT_DIR"), "/models.rs"));
include!(concat!(env!("OUT_DIR"), "/robots.rs"));

fn main() -> ExitCode {
    answer("control", ROBOTS)
}
