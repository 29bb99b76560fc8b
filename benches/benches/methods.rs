//! Times every method of every robot of `specs/`: generated in `f64`, `f32` and eight lanes (a call is
//! eight states: compare items per second), and by the textbook's recursions in `f64` and `f32`.
//!
//! `cargo bench --bench methods -- puma560` runs those of one robot.

use benches::body::{bodies, slides};
use benches::inputs::{Input, Lanes, inputs};
use benches::plain::Plain;
use benches::states::states;
use bgdyn::nalgebra::RealField;
use bgdyn::runtime::wide::f64x8;
use divan::Bencher;
use divan::counter::ItemsCount;

fn main() {
    divan::main();
}

/// Times `call` over all states in turn.
fn generated<T: Lanes, R, const N: usize>(
    bencher: Bencher<'_, '_>,
    spec: &str,
    mut call: impl FnMut(&Input<T, N>) -> R,
) {
    let mechanism = benches::read(spec.as_ref()).expect("a spec");
    let inputs = inputs::<T, N>(&states(&slides(&bodies(&mechanism))));
    let mut k = 0;
    bencher.counter(ItemsCount::new(T::LANES)).bench_local(|| {
        k = (k + 1) % inputs.len();
        call(divan::black_box(&inputs[k]))
    });
}

/// Times the same by the textbook.
fn textbook<T: Lanes + RealField, const N: usize>(
    bencher: Bencher<'_, '_>,
    spec: &str,
    tip: &str,
    call: impl Fn(&mut Plain<T>, &Input<T, N>),
) {
    let mechanism = benches::read(spec.as_ref()).expect("a spec");
    let mut plain = Plain::new(&mechanism, tip);
    generated::<T, _, N>(bencher, spec, |s| {
        call(divan::black_box(&mut plain), s);
    });
}

/// The generated modules.
mod models {
    include!(concat!(env!("OUT_DIR"), "/models.rs"));
}

/// A method of a robot, generated and by the textbook.
macro_rules! method {
    ($model:ident, $spec:literal, $tip:literal, $name:ident, $textbook:ident, $plain:ident,
     |$m:ident, $s:ident| $call:expr) => {
        #[divan::bench(types = [f64, f32, f64x8])]
        fn $name<T: Lanes>(bencher: Bencher<'_, '_>) {
            let $m = $model::<T>::default();
            generated::<T, _, NV>(bencher, $spec, |$s| $call);
        }

        #[divan::bench(types = [f64, f32])]
        fn $textbook<T: Lanes + RealField>(bencher: Bencher<'_, '_>) {
            textbook::<T, NV>(bencher, $spec, $tip, Plain::$plain);
        }
    };
}

macro_rules! robots {
    ($($module:ident $model:ident $jacobian:ident $tip:literal $spec:literal,)*) => {$(
        mod $module {
            use super::models::$module::{$model, NV};
            use super::*;

            method! { $model, $spec, $tip, inverse_dynamics, inverse_dynamics_textbook,
                inverse_dynamics, |m, s| m.inverse_dynamics(&s.q, &s.v, &s.a) }
            method! { $model, $spec, $tip, mass_matrix, mass_matrix_textbook,
                mass_matrix, |m, s| m.mass_matrix(&s.q) }
            method! { $model, $spec, $tip, forward_dynamics, forward_dynamics_textbook,
                forward_dynamics, |m, s| m.forward_dynamics(&s.q, &s.v, &s.tau) }
            method! { $model, $spec, $tip, bias, bias_textbook, bias, |m, s| m.bias(&s.q, &s.v) }
            method! { $model, $spec, $tip, gravity, gravity_textbook, gravity, |m, s| m.gravity(&s.q) }
            method! { $model, $spec, $tip, jacobian, jacobian_textbook, jacobian, |m, s| m.$jacobian(&s.q) }
        }
    )*};
}
include!(concat!(env!("OUT_DIR"), "/robots.rs"));
