//! Double-double numbers: the reference scalar that generated code is checked against.

mod angle;
mod arithmetic;
mod constants;
mod elementary;
mod number;
mod scalar;
mod text;

pub(crate) use angle::{Turn, inverse_tau_digits};

pub use number::Dd;
pub use text::ParseDdError;
