//! Motions and limits of joints.

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
