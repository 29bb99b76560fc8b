//! Motions and limits of joints, as generated modules state them.

/// The motion that a joint allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// About the axis: the coordinate is an angle, rad.
    Rotation,
    /// Along the axis: the coordinate is a displacement, m.
    Translation,
}

/// Limits of a joint as its spec states them; infinite where it states none. Generated functions
/// clip nothing.
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
