//! Double-double placeholder.
/// Double-double.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dd;
