//! What the file says of a wheel, a ball or a knife edge; its places are those of a numbered tree.

use bgdyn_runtime::Dd;

use crate::fault::Location;
use crate::format::{Located, Vector};

/// A constraint on the velocity of a place.
#[derive(Clone, Debug)]
pub struct ContactEntry {
    /// The name of the constraint.
    pub name: String,
    /// The location of its entry.
    pub location: Location,
    /// The link or frame.
    pub at: Located<String>,
    /// What touches.
    pub kind: ContactKind,
}

/// What touches, in the axes of the link or frame.
#[derive(Clone, Debug)]
pub enum ContactKind {
    /// A knife edge.
    Edge {
        /// The direction along which it does not move.
        direction: Located<Vector>,
    },
    /// A wheel, a ball or an ellipsoid.
    Rolling {
        /// The axle of a wheel.
        axle: Option<Located<Vector>>,
        /// Its size.
        size: RollingSize,
        /// Where a wheel slips.
        slip: Slip,
        /// The name of its plane; `None` for the world's x–y plane.
        on: Option<Located<String>>,
    },
}

/// The size of a body that rolls, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RollingSize {
    /// The radius of a wheel or a ball; of a tyre that of the circle through the middles of its sections, and the radius
    /// of these, else 0.
    Radius(Dd, Dd),
    /// The half-axes of an ellipsoid along the axes of its link or frame.
    HalfAxes([Dd; 3]),
}

/// The directions in which a wheel may slip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slip {
    /// Across the axle.
    pub longitudinal: bool,
    /// Along the axle.
    pub lateral: bool,
}

impl Slip {
    /// It slips in no direction.
    pub(super) const NONE: Self = Slip {
        longitudinal: false,
        lateral: false,
    };
}
