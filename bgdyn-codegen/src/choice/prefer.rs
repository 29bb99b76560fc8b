//! The function that is generated for a method: the one with the least cost, or the most accurate one.

use std::rc::Rc;

use super::choose::Choice;
use super::most_accurate::most_accurate;
use crate::function::Function;
use crate::method::Method;
use crate::passes::{finish, finish_in_order};

/// What the choice among several functions for a method goes by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Preference {
    /// The fewest operations.
    #[default]
    Operations,
    /// The fewest digits lost in `f64`, by [`crate::conditioning::rounding_error::rounding_error`];
    /// operations decide between equals.
    Accuracy,
}

impl Preference {
    /// Every preference there is.
    pub const ALL: [Preference; 2] = [Preference::Operations, Preference::Accuracy];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Preference::Operations => "operations",
            Preference::Accuracy => "accuracy",
        }
    }
}

/// The function that is generated for a method, after the last passes; `None` where no formulation makes
/// the method.
pub fn prefer(choice: &Choice<'_>, method: Method, preference: Preference) -> Option<Function> {
    match preference {
        Preference::Operations => choice
            .function(method)
            .map(|f| finish(Rc::unwrap_or_clone(f))),
        Preference::Accuracy => {
            most_accurate(choice.prepared.graph, method, choice.asked).map(finish_in_order)
        }
    }
}
