//! The data of the arm in its generated module that the report and the plot need besides the methods.

use bgdyn::nalgebra::Point3;
use bgdyn::runtime::{Limits, Motion, Operations};

use super::Joints;

/// The data of the arm in a generated module.
pub struct Machine<const N: usize> {
    /// `JOINT_NAMES`
    pub names: [&'static str; N],
    /// `JOINT_MOTIONS`
    pub motions: [Motion; N],
    /// `JOINT_LIMITS`
    pub limits: [Limits; N],
    /// `OPERATIONS`
    pub operations: &'static [(&'static str, Operations)],
    /// Position of the frame `tool`, in world axes, m: from `pose_tool`.
    pub tool: fn(&Joints<N>) -> Point3<f64>,
}

/// A joint's name, units and limits.
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Whether it is a rotation; otherwise it is a translation.
    pub turns: bool,
    /// Its limits.
    pub limits: Limits,
}

impl Joint {
    /// Returns the factor and the unit for printing positions.
    pub fn position_unit(&self) -> (f64, &'static str) {
        if self.turns {
            (1f64.to_degrees(), "°")
        } else {
            (1e3, "mm")
        }
    }

    /// Returns the factor and the unit for printing errors.
    pub fn error_unit(&self) -> (f64, &'static str) {
        if self.turns {
            (1e3, "mrad")
        } else {
            (1e3, "mm")
        }
    }

    /// Returns the unit of efforts.
    pub fn effort_unit(&self) -> &'static str {
        if self.turns { "N·m" } else { "N" }
    }
}

impl<const N: usize> Machine<N> {
    /// Returns the joint of coordinate `i`.
    pub fn joint(&self, i: usize) -> Joint {
        Joint {
            name: self.names[i].replace('_', " "),
            turns: self.motions[i] == Motion::Rotation,
            limits: self.limits[i],
        }
    }

    /// Returns the operations of one call of the generated method.
    pub fn operations(&self, method: &str) -> Option<&Operations> {
        let found = self.operations.iter().find(|(name, _)| *name == method);
        found.map(|(_, operations)| operations)
    }
}

/// The [`Machine`] of a generated module with a frame `tool`.
macro_rules! machine {
    ($module:ident, $model:ident) => {
        $crate::common::machine::Machine {
            names: $module::JOINT_NAMES,
            motions: $module::JOINT_MOTIONS,
            limits: $module::JOINT_LIMITS,
            operations: &$module::OPERATIONS,
            tool: |q| $module::$model::default().pose_tool(q).translation.into(),
        }
    };
}
pub(crate) use machine;
