//! Compiled code equals the evaluator in every scalar: single precision, double-double, lanes of
//! registers, dual numbers with derivatives along random directions.

use bgdyn::runtime::Dd;
use bgdyn::runtime::num_dual::{Dual64, HyperDual64};
use bgdyn::runtime::wide::{f32x8, f64x4, f64x8};
use compiled::puma560::Puma560;
use compiled::scara::Scara;
use compiled::torso::Torso;

use crate::agreement::agrees;
use crate::rounded::Rounded;
use crate::tested::Tested;

fn in_both<C: Tested, E: Tested<Refused = C::Refused>>() {
    let refused = agrees::<C, E>(&Scara::default())
        + agrees::<C, E>(&Puma560::default())
        + agrees::<C, E>(&Torso::default());
    assert_eq!(refused, 0);
}

#[test]
fn single_precision() {
    in_both::<f32, f32>();
}

/// Compiled code has constants of one word.
#[test]
fn double_double() {
    in_both::<Dd, Rounded>();
}

#[test]
fn lanes() {
    in_both::<f64x4, f64x4>();
    in_both::<f64x8, f64x8>();
    in_both::<f32x8, f32x8>();
}

#[test]
fn dual_numbers() {
    in_both::<Dual64, Dual64>();
    in_both::<HyperDual64, HyperDual64>();
}
