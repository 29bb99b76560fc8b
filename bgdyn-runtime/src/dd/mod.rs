//! Double-double numbers: the scalar with which generated code is checked.

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
