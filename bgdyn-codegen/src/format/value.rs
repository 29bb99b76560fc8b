//! A number of a file with its unit, and vectors of numbers.

use bgdyn_runtime::Dd;

use super::Located;
use crate::unit::Unit;

/// A number in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// Its value in SI units, read as a decimal.
    pub value: Dd,
    /// Its unit in the file.
    pub unit: Option<&'static Unit>,
    /// Its text in the file.
    pub text: String,
    /// Name of the run-time parameter with this default, if it is one.
    pub parameter: Option<Located<String>>,
}

/// Three numbers.
pub type Vector = [Located<Number>; 3];
