//! The arm as its generated module says: what the report and the plot need beside the methods.

use bgdyn::nalgebra::Point3;
use bgdyn::runtime::{Limits, Motion, Operations};

use super::Joints;

/// What a generated module says of the arm.
pub struct Machine<const N: usize> {
    /// `JOINT_NAMES`
    pub names: [&'static str; N],
    /// `JOINT_MOTIONS`
    pub motions: [Motion; N],
    /// `JOINT_LIMITS`
    pub limits: [Limits; N],
    /// `OPERATIONS`
    pub operations: &'static [(&'static str, Operations)],
    /// Where the frame `tool` is, in world axes, m: `pose_tool`.
    pub tool: fn(&Joints<N>) -> Point3<f64>,
}

/// A joint's name, units and limits.
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Whether it turns; otherwise it slides.
    pub turns: bool,
    /// Its limits.
    pub limits: Limits,
}

impl Joint {
    /// The factor and the unit in which people read positions.
    pub fn position_unit(&self) -> (f64, &'static str) {
        if self.turns {
            (1f64.to_degrees(), "°")
        } else {
            (1e3, "mm")
        }
    }

    /// The factor and the unit in which people read errors.
    pub fn error_unit(&self) -> (f64, &'static str) {
        if self.turns {
            (1e3, "mrad")
        } else {
            (1e3, "mm")
        }
    }

    /// The unit of efforts.
    pub fn effort_unit(&self) -> &'static str {
        if self.turns { "N·m" } else { "N" }
    }
}

impl<const N: usize> Machine<N> {
    /// The joint of coordinate `i`.
    pub fn joint(&self, i: usize) -> Joint {
        Joint {
            name: self.names[i].replace('_', " "),
            turns: self.motions[i] == Motion::Rotation,
            limits: self.limits[i],
        }
    }

    /// Operations of one call of the generated method.
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
