//! Derivatives of the accelerations by parameters.

use super::{Argument, Entries, ParameterSet, Shape};

/// A derivative of the accelerations under given efforts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ParameterDerivatives {
    /// ∂q̈/∂π_b = −M⁻¹ Y_b, by base parameters.
    Base,
    /// ∂q̈/∂p, by the run-time parameters of the mechanism; their number.
    RunTime(usize),
}

impl ParameterDerivatives {
    /// Returns both, for this number of run-time parameters.
    pub fn all(run_time: usize) -> [ParameterDerivatives; 2] {
        [
            ParameterDerivatives::Base,
            ParameterDerivatives::RunTime(run_time),
        ]
    }

    /// Returns its name.
    pub fn name(self) -> &'static str {
        match self {
            ParameterDerivatives::Base => "parameter_derivatives",
            ParameterDerivatives::RunTime(_) => "run_time_parameter_derivatives",
        }
    }

    /// Returns what its columns belong to.
    pub fn set(self) -> ParameterSet {
        match self {
            ParameterDerivatives::Base => ParameterSet::Base,
            ParameterDerivatives::RunTime(number) => ParameterSet::RunTime(number),
        }
    }

    pub(super) fn arguments(self) -> &'static [Argument] {
        &[Argument::Q, Argument::V, Argument::Tau]
    }

    pub(super) fn shape(self) -> Shape {
        Shape::Checked(Entries::ParameterColumns(self.set()))
    }

    pub(super) fn summary(self) -> &'static str {
        match self {
            ParameterDerivatives::Base => {
                "Derivatives of the accelerations by base parameters, as in [`BASE_PARAMETERS`]: ∂q̈/∂π_b = −M⁻¹ Y_b(q, v, q̈)."
            }
            ParameterDerivatives::RunTime(_) => {
                "Derivatives of the accelerations by run-time parameters, a column for each field of the struct: ∂q̈/∂p = −M⁻¹ ∂τ/∂p at q̈."
            }
        }
    }

    pub(super) fn units(self) -> &'static str {
        match self {
            ParameterDerivatives::Base => "accelerations per kg, kg·m, kg·m²",
            ParameterDerivatives::RunTime(_) => "accelerations per unit of the parameter",
        }
    }
}
