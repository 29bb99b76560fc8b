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
    /// A wheel or a ball.
    Rolling {
        /// The axle of a wheel.
        axle: Option<Located<Vector>>,
        /// Its radius, m.
        radius: Dd,
        /// Where a wheel slips.
        slip: Slip,
        /// The name of its plane; `None` for the world's x–y plane.
        on: Option<Located<String>>,
    },
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
