//! Returns the function that is generated for a method: the one with the least cost, or the most accurate one.

use std::rc::Rc;

use super::choose::Choice;
use super::most_accurate::most_accurate;
use crate::function::Function;
use crate::method::Method;
use crate::passes::{finish, finish_in_order};

/// The criterion of choice among several functions for a method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Preference {
    /// The fewest operations.
    #[default]
    Operations,
    /// The fewest digits lost in `f64`, by [`crate::conditioning::rounding_error::rounding_error`]; for
    /// equal errors, the fewest operations.
    Accuracy,
}

impl Preference {
    /// All preferences.
    pub const ALL: [Preference; 2] = [Preference::Operations, Preference::Accuracy];

    /// Returns its name.
    pub fn name(self) -> &'static str {
        match self {
            Preference::Operations => "operations",
            Preference::Accuracy => "accuracy",
        }
    }
}

/// Returns the function that is generated for a method, after the last passes; `None` if no formulation
/// creates the method.
pub fn prefer(choice: &Choice<'_>, method: Method, preference: Preference) -> Option<Function> {
    let function = preferred(choice, method, preference)?;
    Some(match preference {
        Preference::Operations => finish(function),
        Preference::Accuracy => finish_in_order(function),
    })
}

/// Returns the same function before the last passes: in one block.
pub(crate) fn preferred(
    choice: &Choice<'_>,
    method: Method,
    preference: Preference,
) -> Option<Function> {
    match preference {
        Preference::Operations => choice.function(method).map(Rc::unwrap_or_clone),
        Preference::Accuracy => most_accurate(choice.prepared.graph, method, choice.asked),
    }
}
