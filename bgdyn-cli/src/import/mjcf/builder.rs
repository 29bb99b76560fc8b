//! What the walk over the bodies builds, and what it needs.

use super::defaults::Defaults;
use super::report::Report;
use super::settings::Settings;
use crate::import::model::Model;
use crate::import::number::Num;
use crate::import::placement::{Placement, Pose};
use crate::import::xml::Element;
use std::collections::HashSet;

/// Builds links, joints and frames.
pub(super) struct Builder<'a> {
    pub(super) settings: &'a Settings,
    pub(super) defaults: &'a Defaults,
    pub(super) report: &'a mut Report,
    pub(super) model: &'a mut Model,
    /// Names of links and of joints in use, those of the file included.
    pub(super) links: HashSet<String>,
    pub(super) joints: HashSet<String>,
    /// The references of the joints with one coordinate, by name.
    pub(super) references: Vec<(String, Num)>,
    /// The bodies so far.
    pub(super) bodies: Vec<BodyAxes>,
    /// The number of bodies so far; the world is 0.
    pub(super) count: usize,
}

/// Where a body is: the link of its parent, and the parent's axes in that link.
pub(super) struct Carrier {
    pub(super) link: Option<String>,
    pub(super) place: Placement,
    /// The parent's axes in the world, in the pose of the file.
    pub(super) world: Pose,
    /// Whether a joint is between it and the world.
    pub(super) moves: bool,
}

/// The axes of a body.
#[derive(Clone)]
pub(super) struct BodyAxes {
    pub(super) name: String,
    /// The name of its link; `None` for the world.
    pub(super) link: Option<String>,
    /// Its axes in the link.
    pub(super) shift: Placement,
    /// Its axes in the world, in the pose of the file.
    pub(super) world: Pose,
}

/// A body to be joined to its parent.
pub(super) struct Mount<'e> {
    pub(super) element: &'e Element,
    pub(super) name: &'e str,
    /// The body's axes in the parent's link.
    pub(super) place: Placement,
}
