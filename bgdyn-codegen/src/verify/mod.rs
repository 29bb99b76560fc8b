//! Verification: compares each function in double-double with the literal sum of equation (6).
//!
//! Functions are compared at a few states, before they are written.
//!
//! The literal inverse dynamics P(q, v, a) is sufficient for almost every method, because the others
//! follow from it: M x = P(q, 0, x) − P(q, 0, 0), P(q, v, q̈) = τ for the accelerations of forward
//! dynamics, derivatives from P in dual numbers. The states are the same in every run.

mod actuated;
mod compare;
mod contacts;
mod directional;
mod dual;
mod literal_values;
mod mechanism;
mod open_tree;
mod operational;
mod parameters;
mod payload;
mod regressor;
mod rigid_contacts;
mod scene;
mod states;

use std::fmt;

pub use mechanism::{check_functions, check_model};
pub use scene::check_scene;

/// A difference between a function and the literal sum: an error of the generator.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Name of the mechanism or the scene.
    pub subject: String,
    /// Name of the function.
    pub function: String,
    /// Its formulation.
    pub formulation: String,
    /// The violated law.
    pub law: &'static str,
    /// The component with the largest error.
    pub component: usize,
    /// Its actual value, SI units.
    pub found: f64,
    /// Its expected value, SI units.
    pub expected: f64,
    /// The state, SI units.
    pub state: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Difference {
            subject,
            function,
            formulation,
            law,
            component,
            found,
            expected,
            state,
        } = self;
        write!(
            f,
            "`{function}` of `{subject}`, made by the formulation `{formulation}`, does not obey \
             {law}: component {component} is {found:e}, not {expected:e}, at {state}"
        )
    }
}

/// Returns the message for the user: every difference, and advice.
pub fn explain(differences: &[Difference]) -> String {
    let mut text = String::from("error[verify]: the generated code does not equal equation (6)\n");
    for difference in differences {
        text += &format!("  {difference}\n");
    }
    text += "  = help: this is a mistake in the generator, not in the file. Please report the file. \
             The option `formulation = \"literal\"` generates a mechanism by equation (6) as it is \
             written; `verify = false` skips this check";
    text
}
