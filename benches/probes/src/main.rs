//! The program that `instructions` counts: each method of each robot of `specs/` over the same states, in
//! a function of its own, `probes CALLS [NAME …]`: CALLS calls of each, without the named ones, such as
//! `palletiser::double::bias`.

// Those of the other benchmarks, which depend on the generator.
#[path = "../../src/inputs.rs"]
#[allow(dead_code)]
mod inputs;
#[path = "../../src/states.rs"]
#[allow(dead_code)]
mod states;

use std::hint::black_box;

use bgdyn::runtime::wide::f64x4;
use inputs::{Input, Lanes, inputs};
use states::states;

/// The generated modules.
mod models {
    include!(concat!(env!("OUT_DIR"), "/models.rs"));
}

/// Returns the first states of a mechanism; `slides` marks prismatic joints.
fn first<T: Lanes, const N: usize>(calls: usize, slides: &[bool]) -> Vec<Input<T, N>> {
    let mut all = inputs(&states(slides));
    all.truncate(calls);
    all
}

/// A module for a scalar, with one function for each method; the counts of its calls are found by its
/// name.
macro_rules! probes {
    ($model:ident, $slides:expr, $scalar:ident as $module:ident, $($name:ident: |$m:ident, $s:ident| $call:expr;)*) => {
        pub mod $module {
            use super::*;

            type States = [Input<$scalar, NV>];

            $(
                #[inline(never)]
                fn $name($m: &$model<$scalar>, states: &States) {
                    for $s in states {
                        let _ = black_box($call);
                    }
                }
            )*

            pub fn run(calls: usize, left_out: &[String]) {
                let (model, states) = (black_box($model::default()), first::<$scalar, NV>(calls, &$slides));
                let module = module_path!().split_once("::").map_or("", |(_, module)| module);
                let counted = |name: &str| !left_out.contains(&format!("{module}::{name}"));
                $( if counted(stringify!($name)) { $name(&model, &states); } )*
            }
        }
    };
}

macro_rules! robots {
    ($($robot:ident $model:ident $jacobian:ident $slides:expr,)*) => {
        $(
            mod $robot {
                use super::models::$robot::{$model, NV};
                use super::*;

                robots!(@scalar $model $jacobian $slides, f64 as double);
                robots!(@scalar $model $jacobian $slides, f32 as single);
                robots!(@scalar $model $jacobian $slides, f64x4 as lanes);
            }
        )*

        fn main() {
            let mut arguments = std::env::args().skip(1);
            let calls = arguments.next().and_then(|number| number.parse().ok());
            let calls = calls.expect("the number of calls of each method");
            let left_out: Vec<String> = arguments.collect();
            $(
                $robot::double::run(calls, &left_out);
                $robot::single::run(calls, &left_out);
                $robot::lanes::run(calls, &left_out);
            )*
        }
    };
    (@scalar $model:ident $jacobian:ident $slides:expr, $scalar:ident as $module:ident) => {
        probes! { $model, $slides, $scalar as $module,
            inverse_dynamics: |m, s| m.inverse_dynamics(&s.q, &s.v, &s.a);
            mass_matrix: |m, s| m.mass_matrix(&s.q);
            forward_dynamics: |m, s| m.forward_dynamics(&s.q, &s.v, &s.tau);
            bias: |m, s| m.bias(&s.q, &s.v);
            gravity: |m, s| m.gravity(&s.q);
            jacobian: |m, s| m.$jacobian(&s.q);
        }
    };
}
include!(concat!(env!("OUT_DIR"), "/robots.rs"));
