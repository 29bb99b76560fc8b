//! Double-double numbers: the scalar that checks the accuracy of generated code.

mod angle;
mod arithmetic;
mod constants;
mod digits;
mod elementary;
mod number;
mod scalar;
mod text;

pub(crate) use angle::{Turn, inverse_tau_digits};

pub use digits::Digits;
pub use number::Dd;
pub use text::ParseDdError;
