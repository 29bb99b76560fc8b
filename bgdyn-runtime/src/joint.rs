//! Motions and limits of joints, and joints with quasi-velocities.

/// The motion that a joint allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// A rotation about the axis: the coordinate is an angle, rad.
    Rotation,
    /// A translation along the axis: the coordinate is a displacement, m.
    Translation,
}

/// Limits of a joint from its spec; infinite if the spec states none. Generated functions do not enforce
/// them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Smallest coordinate: rad, m.
    pub lower: f64,
    /// Largest coordinate: rad, m.
    pub upper: f64,
    /// Largest speed: rad/s, m/s.
    pub velocity: f64,
    /// Largest effort: N·m, N.
    pub effort: f64,
}

/// A joint whose velocities are not the rates of its positions, by its components in the state of a scene, or in q and v
/// of a mechanism.
/// [`crate::manifold`] describes positions and velocities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QuasiJoint {
    /// Its type.
    pub kind: QuasiJointKind,
    /// Index of its first position.
    pub position: usize,
    /// Index of its first velocity.
    pub velocity: usize,
}

/// The type of a joint with quasi-velocities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QuasiJointKind {
    /// [`crate::manifold::planar`]: three positions, three velocities.
    Planar,
    /// [`crate::manifold::spherical`]: a quaternion, three velocities.
    Spherical,
    /// [`crate::manifold::floating`]: three lengths and a quaternion, six velocities.
    Floating,
}

impl QuasiJointKind {
    /// Returns the type with this module of [`crate::manifold`]: `"floating"`. `None` for other names.
    pub fn of_module(module: &str) -> Option<Self> {
        match module {
            "planar" => Some(QuasiJointKind::Planar),
            "spherical" => Some(QuasiJointKind::Spherical),
            "floating" => Some(QuasiJointKind::Floating),
            _ => None,
        }
    }
}

impl QuasiJoint {
    /// Returns the number of its positions.
    pub const fn positions(&self) -> usize {
        match self.kind {
            QuasiJointKind::Planar => 3,
            QuasiJointKind::Spherical => 4,
            QuasiJointKind::Floating => 7,
        }
    }

    /// Returns the number of its velocities.
    pub const fn velocities(&self) -> usize {
        match self.kind {
            QuasiJointKind::Planar | QuasiJointKind::Spherical => 3,
            QuasiJointKind::Floating => 6,
        }
    }

    /// Returns the index of the first component, x, of its quaternion x, y, z, w. `None` for a
    /// planar joint.
    pub const fn quaternion(&self) -> Option<usize> {
        match self.kind {
            QuasiJointKind::Planar => None,
            QuasiJointKind::Spherical => Some(self.position),
            QuasiJointKind::Floating => Some(self.position + 3),
        }
    }
}
