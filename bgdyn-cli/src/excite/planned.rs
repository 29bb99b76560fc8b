//! A motion with all that its files tell of it.

use bgdyn_identification::Model;
use bgdyn_identification::excite::{Excitation, JointLimits, Keep};
use bgdyn_identification::fault::short;

/// A motion, and what it was planned for.
pub(crate) struct Planned<'a> {
    /// What is to be identified.
    pub(crate) model: &'a Model<'a>,
    /// Limits of joints, less the margin.
    pub(crate) limits: &'a [JointLimits],
    /// Share of the limits that stays free.
    pub(crate) margin: f64,
    /// Planes.
    pub(crate) keeps: &'a [Keep],
    /// The motion.
    pub(crate) found: &'a Excitation,
    /// Values that the command chose, and effects that the efforts do not contain.
    pub(crate) remarks: &'a [String],
}

impl Planned<'_> {
    /// Returns what to change if a log of the motion would not show all parameters.
    pub(crate) fn weakness(&self) -> Option<String> {
        self.found.is_weak().then(|| {
            format!(
                "a log of this motion would not show all {} base parameters: the condition number {} is above {}. Take more --harmonics, a longer --period, more --starts or larger limits, or identify less (--only, --friction)",
                self.found.base.len(),
                short(self.found.condition[2][0]),
                Excitation::WEAK
            )
        })
    }
}
