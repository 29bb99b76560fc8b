//! Contacts as types of loops: their words in the spec. Their rows are those of each contact.

use super::closing::ClosingType;

/// The knife edge.
pub static KNIFE_EDGE: ClosingType = ClosingType {
    keyword: "knife_edge",
    about: "The place does not move along one of its directions.",
    rows: &[],
    axial: false,
    length: false,
    coincident: false,
};

/// The disc.
pub static DISC: ClosingType = ClosingType {
    keyword: "rolling",
    about: "A thin wheel rolls on a plane without slipping.",
    rows: &[],
    axial: true,
    length: false,
    coincident: false,
};

/// The ellipsoid.
pub static ELLIPSOID: ClosingType = ClosingType {
    keyword: "rolling",
    about: "An ellipsoid rolls on a plane without slipping.",
    rows: &[],
    axial: false,
    length: false,
    coincident: false,
};

/// The sphere.
pub static SPHERE: ClosingType = ClosingType {
    keyword: "rolling",
    about: "A ball rolls on a plane without slipping.",
    rows: &[],
    axial: false,
    length: false,
    coincident: false,
};
