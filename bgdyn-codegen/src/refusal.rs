//! The reasons for which a spec or a scene is refused.

use crate::fault::Faults;
use crate::options::Unknown;
use crate::verify::Difference;

/// Why there is no module.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// What is wrong with the spec.
    Spec(Faults),
    /// What is wrong with the mechanism that a scene names.
    Mechanism {
        /// Its path, as the scene writes it.
        path: String,
        /// Its text.
        text: String,
        /// What is wrong with it.
        faults: Faults,
        /// What is wrong with the scene besides.
        scene: Faults,
    },
    /// Names asked for that the mechanism does not have, options that have no place here.
    Options(Vec<Unknown>),
    /// Functions that do not equal equation (6): a fault of the generator.
    Unequal(Vec<Difference>),
}

impl Refusal {
    /// An error where functions do not equal equation (6).
    pub(crate) fn unless_equal(differences: Vec<Difference>) -> Result<(), Refusal> {
        match differences.is_empty() {
            true => Ok(()),
            false => Err(Refusal::Unequal(differences)),
        }
    }
}
