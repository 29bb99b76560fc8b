//! A number of a file with its unit, and vectors of numbers.

use bgdyn_runtime::Dd;

use super::Located;
use crate::unit::Unit;

/// A number as written.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// Its value in SI units, read as a decimal.
    pub value: Dd,
    /// The unit written behind it.
    pub unit: Option<&'static Unit>,
    /// As it stands in the file.
    pub text: String,
    /// Name of the run-time parameter whose default it is, if it is written as one.
    pub parameter: Option<Located<String>>,
}

/// Three numbers.
pub type Vector = [Located<Number>; 3];
