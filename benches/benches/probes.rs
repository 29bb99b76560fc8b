//! The program that `instructions` counts: each method of each robot of `specs/` over the same states, in
//! a function of its own. `probes NAME …` omits the named ones: `palletiser::double::bias`.

use std::hint::black_box;

use benches::body::{bodies, slides};
use benches::counts::CALLS;
use benches::inputs::{Input, Lanes, inputs};
use benches::states::states;
use bgdyn::runtime::wide::f64x4;

/// The generated modules.
mod models {
    include!(concat!(env!("OUT_DIR"), "/models.rs"));
}

/// Returns the first states of a mechanism.
fn first<T: Lanes, const N: usize>(spec: &str) -> Vec<Input<T, N>> {
    let mechanism = benches::read(spec.as_ref()).expect("a spec");
    let mut all = inputs(&states(&slides(&bodies(&mechanism))));
    all.truncate(CALLS);
    all
}

/// A module for a scalar, with one function for each method; the counts of its calls are found by its
/// name.
macro_rules! probes {
    ($model:ident, $spec:literal, $scalar:ident as $module:ident, $($name:ident: |$m:ident, $s:ident| $call:expr;)*) => {
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

            pub fn run(left_out: &[String]) {
                let (model, states) = (black_box($model::default()), first::<$scalar, NV>($spec));
                let module = module_path!().split_once("::").map_or("", |(_, module)| module);
                let counted = |name: &str| !left_out.contains(&format!("{module}::{name}"));
                $( if counted(stringify!($name)) { $name(&model, &states); } )*
            }
        }
    };
}

macro_rules! robots {
    ($($robot:ident $model:ident $jacobian:ident $tip:literal $spec:literal,)*) => {
        $(
            mod $robot {
                use super::models::$robot::{$model, NV};
                use super::*;

                robots!(@scalar $model $jacobian $spec f64 as double);
                robots!(@scalar $model $jacobian $spec f32 as single);
                robots!(@scalar $model $jacobian $spec f64x4 as lanes);
            }
        )*

        fn main() {
            let left_out: Vec<String> = std::env::args().skip(1).collect();
            $(
                $robot::double::run(&left_out);
                $robot::single::run(&left_out);
                $robot::lanes::run(&left_out);
            )*
        }
    };
    (@scalar $model:ident $jacobian:ident $spec:literal $scalar:ident as $module:ident) => {
        probes! { $model, $spec, $scalar as $module,
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
