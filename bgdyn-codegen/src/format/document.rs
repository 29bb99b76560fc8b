//! A mechanism's file as data: links, joints, inertias, frames.

use super::{Field, Located, Number, Raw, Vector};
use crate::fault::Location;

/// A mechanism's file.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    /// Location of the file's mapping.
    pub location: Location,
    /// Whether everything in the file was parsed; nothing is built from an incomplete spec.
    pub complete: bool,
    /// Version of the format.
    pub format: Field<Number>,
    /// Name of the mechanism.
    pub name: Field<String>,
    /// Its original name elsewhere.
    pub label: Field<String>,
    /// Text for the documentation.
    pub description: Field<String>,
    /// Acceleration of free fall, world axes.
    pub gravity: Field<Vector>,
    /// `fixed`, `given`, or an invalid word.
    pub base: Field<String>,
    /// Angle below which a direction is rounded to the exact one.
    pub snap: Field<Number>,
    /// The links; entries that are no mapping are omitted.
    pub links: Field<Vec<LinkSpec>>,
    /// The named frames; entries that are no mapping are omitted.
    pub frames: Field<Vec<FrameSpec>>,
    /// The constraints, by name, not parsed.
    pub constraints: Field<Vec<Raw>>,
    /// The planes that wheels and other contacts touch, by name, not parsed.
    pub planes: Field<Vec<Raw>>,
    /// The pairs that may touch, by name, not parsed.
    pub contacts: Field<Vec<Raw>>,
    /// The loops; entries that are no mapping are omitted.
    pub loops: Field<Vec<LoopSpec>>,
    /// Joints that follow no others, although constraints or loops contain them.
    pub independent: Field<Vec<Located<String>>>,
    /// Joints with drives, of a mechanism with loops; absent: the independent ones.
    pub actuated: Field<Vec<Located<String>>>,
    /// The effects besides the links, by name, not parsed.
    pub effects: Field<Vec<Raw>>,
}

/// An entry of `links`.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkSpec {
    /// Location of the link's mapping.
    pub location: Location,
    /// Its name.
    pub name: Field<String>,
    /// Its original name elsewhere.
    pub label: Field<String>,
    /// Name of the parent link.
    pub parent: Field<String>,
    /// Its joint to the parent.
    pub joint: Field<JointSpec>,
    /// Mass.
    pub mass: Field<Number>,
    /// Centre of mass.
    pub com: Field<Vector>,
    /// Tensor, or solid.
    pub inertia: Field<InertiaSpec>,
    /// `allow`, or an invalid word.
    pub nonphysical: Field<String>,
}

/// A link's `joint`.
#[derive(Clone, Debug, PartialEq)]
pub struct JointSpec {
    /// Location of the joint's mapping.
    pub location: Location,
    /// Its name.
    pub name: Field<String>,
    /// Its original name elsewhere.
    pub label: Field<String>,
    /// The word of the key `type`.
    pub kind: Field<String>,
    /// Direction of its axis, of any length; a letter denotes a unit vector.
    pub axis: Field<Vector>,
    /// Direction of the second axis of a joint with two.
    pub axis2: Field<Vector>,
    /// Advance of a helical joint along its axis: a length per turn, or a length per turn or per radian.
    pub lead: Field<Number>,
    /// The joint that this one mimics.
    pub mimic: Field<MimicSpec>,
    /// `any`: a quaternion of any length is accepted.
    pub quaternion: Field<String>,
    /// Pose of the link in the parent.
    pub origin: Field<Origin>,
    /// Limits.
    pub limits: Field<LimitsSpec>,
}

/// A joint's `mimic`: position = ratio · the other's position + offset.
#[derive(Clone, Debug, PartialEq)]
pub struct MimicSpec {
    /// Name of the other joint.
    pub joint: Field<String>,
    /// Units of this joint per unit of the other; 1 if absent.
    pub ratio: Field<Number>,
    /// Position where the other joint's position is zero; 0 if absent.
    pub offset: Field<Number>,
}

/// The keys of [`LimitsSpec::parts`].
pub const LIMIT_PARTS: [&str; 4] = ["turn", "slide", "first", "second"];

/// A pose: `xyz` and `rpy`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Origin {
    /// Displacement.
    pub xyz: Field<Vector>,
    /// Roll, pitch, yaw about fixed axes.
    pub rpy: Field<Vector>,
}

/// A joint's `limits`.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitsSpec {
    /// Smallest coordinate.
    pub lower: Field<Number>,
    /// Largest coordinate.
    pub upper: Field<Number>,
    /// Largest speed.
    pub velocity: Field<Number>,
    /// Largest effort.
    pub effort: Field<Number>,
    /// Limits of the parts of a cylindrical or universal joint, in the order of [`LIMIT_PARTS`].
    pub parts: Vec<Field<LimitsSpec>>,
}

/// A link's `inertia`: entries of a tensor, or a solid of uniform density.
#[derive(Clone, Debug, PartialEq)]
pub struct InertiaSpec {
    /// xx, yy, zz, xy, xz, yz: entries of the tensor.
    pub entries: [Field<Number>; 6],
    /// xy, xz, yz: products of inertia, ∫xy dm, in place of the tensor's entries.
    pub products: Field<[Field<Number>; 3]>,
    /// `com` or `origin`: the reference point of the tensor.
    pub about: Field<String>,
    /// Axes of the entries, or of the solid, in the link's axes.
    pub rpy: Field<Vector>,
    /// The kind of solid: `box`, …
    pub solid: Field<String>,
    /// Edges of a box.
    pub size: Field<Vector>,
    /// Lengths of a solid, in the order of [`LENGTHS`].
    pub lengths: [Field<Number>; 3],
    /// Axis of a round solid; a letter denotes a unit vector.
    pub axis: Field<Vector>,
}

/// The keys of [`InertiaSpec::lengths`].
pub const LENGTHS: [&str; 3] = ["radius", "inner_radius", "length"];

/// An entry of `frames`.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameSpec {
    /// Location of the frame's mapping.
    pub location: Location,
    /// Its name.
    pub name: Field<String>,
    /// Its original name elsewhere.
    pub label: Field<String>,
    /// The link it is fixed to.
    pub link: Field<String>,
    /// Its pose on the link.
    pub origin: Field<Origin>,
}

/// An entry of `loops`.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopSpec {
    /// Location of the loop's mapping.
    pub location: Location,
    /// Its name.
    pub name: Field<String>,
    /// The word of the key `type`.
    pub kind: Field<String>,
    /// One place.
    pub a: Field<LoopEndSpec>,
    /// The place it is connected to.
    pub b: Field<LoopEndSpec>,
    /// Axis in the axes of both places; z if absent.
    pub axis: Field<Vector>,
    /// Length of a rod.
    pub length: Field<Number>,
    /// The branch: `left`, `right`, `parallel` or `crossed`.
    pub branch: Field<String>,
    /// Positions of joints near the branch.
    pub near: Field<Vec<(Located<String>, Located<Number>)>>,
    /// Whether its rows may follow from others: `allow`.
    pub redundant: Field<String>,
    /// The gap by which rows that follow from others may be open.
    pub tolerance: Field<Number>,
}

impl LoopSpec {
    /// Returns whether it is a parallelogram that is closed by joints that follow.
    pub fn is_parallel(&self) -> bool {
        self.branch.value().is_some_and(|word| word == "parallel")
    }
}

/// One place of a loop: a link with an origin on it, or a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopEndSpec {
    /// Location of its mapping.
    pub location: Location,
    /// The link, or `world`.
    pub link: Field<String>,
    /// Its pose on the link.
    pub origin: Field<Origin>,
    /// A named frame, in place of both.
    pub frame: Field<String>,
}
