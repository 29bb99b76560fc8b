//! A mechanism's file as data: links, joints, inertias, frames.

use super::{Field, Number, Raw, Vector};
use crate::fault::Location;

/// A mechanism's file.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    /// The file's mapping.
    pub location: Location,
    /// Whether everything in the file could be read; nothing is built from half a spec.
    pub complete: bool,
    /// Version of the format.
    pub format: Field<Number>,
    /// Name of the mechanism.
    pub name: Field<String>,
    /// Its name elsewhere.
    pub label: Field<String>,
    /// Text for the docs.
    pub description: Field<String>,
    /// Acceleration of free fall, world axes.
    pub gravity: Field<Vector>,
    /// Angle within which directions are taken as exact.
    pub snap: Field<Number>,
    /// The links; those that are no mapping are left out.
    pub links: Field<Vec<LinkSpec>>,
    /// The named frames; those that are no mapping are left out.
    pub frames: Field<Vec<FrameSpec>>,
    /// What acts in it beside its links, by name, unread.
    pub effects: Field<Vec<Raw>>,
}

/// An entry of `links`.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkSpec {
    /// The link's mapping.
    pub location: Location,
    /// Its name.
    pub name: Field<String>,
    /// Its name elsewhere.
    pub label: Field<String>,
    /// Name of the link that carries it.
    pub parent: Field<String>,
    /// How it is carried.
    pub joint: Field<JointSpec>,
    /// Mass.
    pub mass: Field<Number>,
    /// Centre of mass.
    pub com: Field<Vector>,
    /// Tensor, or the solid that it is of.
    pub inertia: Field<InertiaSpec>,
    /// `allow`, or a slip.
    pub nonphysical: Field<String>,
}

/// A link's `joint`.
#[derive(Clone, Debug, PartialEq)]
pub struct JointSpec {
    /// The joint's mapping.
    pub location: Location,
    /// Its name.
    pub name: Field<String>,
    /// Its name elsewhere.
    pub label: Field<String>,
    /// The word after `type`.
    pub kind: Field<String>,
    /// Direction of its axis, of any length; a letter is read as the unit vector it stands for.
    pub axis: Field<Vector>,
    /// Place of the link in the parent.
    pub origin: Field<Origin>,
    /// Limits.
    pub limits: Field<LimitsSpec>,
}

/// A placement: `xyz` and `rpy`.
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
}

/// A link's `inertia`: entries of a tensor, or a solid of even density.
#[derive(Clone, Debug, PartialEq)]
pub struct InertiaSpec {
    /// xx, yy, zz, xy, xz, yz: entries of the tensor.
    pub entries: [Field<Number>; 6],
    /// xy, xz, yz: products of inertia, ∫xy dm, in place of the tensor's entries.
    pub products: Field<[Field<Number>; 3]>,
    /// `com` or `origin`: the point that the tensor is about.
    pub about: Field<String>,
    /// Axes of the entries, or of the solid, in the link's.
    pub rpy: Field<Vector>,
    /// What solid it is: `box`, …
    pub solid: Field<String>,
    /// Edges of a box.
    pub size: Field<Vector>,
    /// Lengths of a solid, in the order of [`LENGTHS`].
    pub lengths: [Field<Number>; 3],
    /// Axis of a round solid; a letter is read as the unit vector it stands for.
    pub axis: Field<Vector>,
}

/// The keys of [`InertiaSpec::lengths`].
pub const LENGTHS: [&str; 3] = ["radius", "inner_radius", "length"];

/// An entry of `frames`.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameSpec {
    /// The frame's mapping.
    pub location: Location,
    /// Its name.
    pub name: Field<String>,
    /// Its name elsewhere.
    pub label: Field<String>,
    /// The link it is fixed to.
    pub link: Field<String>,
    /// Its place on the link.
    pub origin: Field<Origin>,
}
