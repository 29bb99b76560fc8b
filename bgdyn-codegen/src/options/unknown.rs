//! Names and options that the mechanism or the scene does not have.

use std::fmt;

/// An option whose value may be invalid for the mechanism or the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OptionName {
    /// An entry of [`Options::methods`](super::Options::methods).
    Methods,
    /// An entry of [`Options::frames`](super::Options::frames).
    Frames,
    /// The bundle with this index: 0 is its name, 1 its first method.
    Bundle(usize),
    /// The whole option, by its name.
    Whole(&'static str),
}

/// A requested name or option that the mechanism or the scene does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownName {
    /// The option.
    pub option: OptionName,
    /// Its index in the option's list.
    pub index: usize,
    /// The error, and advice.
    pub message: String,
}

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl UnknownName {
    /// Returns the error of an option that is invalid here.
    pub(super) fn whole(name: &'static str, message: String) -> Self {
        UnknownName {
            option: OptionName::Whole(name),
            index: 0,
            message,
        }
    }
}
