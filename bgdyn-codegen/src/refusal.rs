//! The reasons for which a spec or a scene is refused.

use crate::fault::Faults;
use crate::options::UnknownName;
use crate::verify::Difference;

/// The reason why there is no module.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// The faults of the spec.
    Spec(Faults),
    /// The faults of a scene's mechanism.
    Mechanism {
        /// Its path in the scene.
        path: String,
        /// Its text.
        text: String,
        /// Its faults.
        faults: Faults,
        /// The other faults of the scene.
        scene: Faults,
    },
    /// Requested names that the mechanism does not have, and options that are invalid here.
    Options(Vec<UnknownName>),
    /// Functions that differ from equation (6): an error of the generator.
    Unequal(Vec<Difference>),
}

impl Refusal {
    /// Returns an error if functions differ from equation (6).
    pub(crate) fn unless_equal(differences: Vec<Difference>) -> Result<(), Refusal> {
        match differences.is_empty() {
            true => Ok(()),
            false => Err(Refusal::Unequal(differences)),
        }
    }
}
