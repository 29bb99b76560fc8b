//! Tests of scalars: double-double, `f32` and `f64`, lanes, dual numbers, their sines, text and JSON.

mod dd_arithmetic;
mod dd_elementary;
mod dd_text;
mod digits;
#[cfg(feature = "num-dual")]
mod dual;
#[path = "../exact/mod.rs"]
mod exact;
#[cfg(feature = "wide")]
mod lanes;
// That of the generator, whose crate depends on this one.
#[allow(dead_code)]
#[path = "../../src/random.rs"]
mod random;
mod scalars;
#[cfg(feature = "serde")]
mod serial;
mod sine;
mod tanh;
