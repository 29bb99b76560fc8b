//! The joints and links of a model: which joints carry links, and which frames become those of the links.

use super::frames::{Frames, OWN};
use super::joints::{self, Motion};
use super::report::SdfReport;
use super::values;
use crate::import::attributes::name;
use crate::import::model::Frame;
use crate::import::naming::shown;
use crate::import::placement::Placement;
use crate::import::xml::{Element, fault};
use anyhow::Result;

/// The name of the world in joints.
const WORLD: &str = "world";

/// A joint of the file.
pub(super) struct ReadJoint<'e> {
    pub(super) element: &'e Element,
    pub(super) name: &'e str,
    pub(super) frame: usize,
    pub(super) motion: Motion,
    /// The indices of its links; `None` for the world.
    pub(super) parent: Option<usize>,
    pub(super) child: usize,
    /// Whether parent and child are those of the file in exchange.
    pub(super) reversed: bool,
}

impl ReadJoint<'_> {
    /// Exchanges parent and child: the same motion with opposite axes, in the opposite order. A joint on the world
    /// stays as it is.
    pub(super) fn reverse(&mut self) {
        if let Some(parent) = self.parent.replace(self.child) {
            self.child = parent;
            self.motion.reverse();
            self.reversed = !self.reversed;
        } else {
            self.parent = None;
        }
    }
}

/// The frames with the links and their joints.
pub(super) struct ModelLayout<'e> {
    pub(super) frames: Frames,
    pub(super) links: Vec<&'e Element>,
    /// The joint that carries each link, by index.
    pub(super) carrier: Vec<Option<usize>>,
    /// The frame that becomes that of each link.
    pub(super) own: Vec<usize>,
    /// The model's frame in the world.
    pub(super) world: Placement,
}

/// Reads a joint; `None` for one that the report refuses.
pub(super) fn read_joint<'e>(
    element: &'e Element,
    (frames, links): (&Frames, &[&Element]),
    version: (u32, u32),
    report: &mut SdfReport,
) -> Result<Option<ReadJoint<'e>>> {
    let name = name(element)?;
    report.children(
        element,
        &[
            "parent",
            "child",
            "pose",
            "axis",
            "axis2",
            "thread_pitch",
            "screw_thread_pitch",
        ],
    );
    let end = |part: &str| {
        let text = element.child(part).map(|part| part.text.as_str());
        text.filter(|text| !text.is_empty()).ok_or_else(|| {
            let message = format!(
                "joint `{}` names no {part}: `<{part}>…</{part}>` is missing",
                shown(name)
            );
            fault(element.at, message)
        })
    };
    let (parent, child) = (end("parent")?, end("child")?);
    if child == WORLD {
        let message = format!(
            "the child of joint `{}` is the world: exchange it with the parent",
            shown(name)
        );
        return Err(fault(element.at, message));
    }
    let link = |name: &str| -> Result<usize> {
        let frame = frames.named(name, element, "the joint")?;
        let link = frames.link_of(frame);
        let found = frames.position(link, links);
        found.ok_or_else(|| fault(element.at, "a joint connects two links"))
    };
    let frame = frames.own(element);
    let Some(motion) = joints::motion(element, (frames, frame), version, report)? else {
        return Ok(None);
    };
    let parent = match parent {
        WORLD => None,
        name => Some(link(name)?),
    };
    let child = link(child)?;
    if parent == Some(child) {
        let what = format!("joint `{}` connects a link with itself", shown(name));
        report.refuse(element.at, what);
        return Ok(None);
    }
    Ok(Some(ReadJoint {
        element,
        name,
        frame,
        motion,
        parent,
        child,
        reversed: false,
    }))
}

impl<'e> ModelLayout<'e> {
    /// Decides where the frames of links are; `carrier` is the joint that carries each.
    pub(super) fn new(
        (model, frames, links): (&Element, Frames, Vec<&'e Element>),
        joints: &[ReadJoint<'_>],
        carrier: Vec<Option<usize>>,
    ) -> Result<Self> {
        let mut own = Vec::new();
        for (link, carrier) in links.iter().zip(&carrier) {
            let moving = carrier.map(|j| &joints[j]);
            let moving = moving.filter(|joint| !matches!(joint.motion, Motion::Fixed));
            own.push(match moving {
                Some(joint) => joint.frame,
                None => frames.own(link),
            });
        }
        let given = model.child("pose").map(values::pose).transpose()?;
        let given = given.unwrap_or_else(Placement::identity);
        let world = match model.get("placement_frame").filter(|name| !name.is_empty()) {
            None => given,
            Some(name) => {
                let frame = frames.named(name, model, "`placement_frame`")?;
                given.then(&frames.relative(OWN, frame))
            }
        };
        Ok(ModelLayout {
            frames,
            links,
            carrier,
            own,
            world,
        })
    }

    /// Returns the pose of a frame in the axes of a link of the mechanism, or of the world.
    pub(super) fn place(&self, frame: usize, on: Option<usize>) -> Placement {
        match on {
            None => self.world.then(&self.frames.relative(frame, OWN)),
            Some(link) => self.frames.relative(frame, self.own[link]),
        }
    }

    pub(super) fn name(&self, link: usize) -> &'e str {
        self.links[link].get("name").unwrap_or_default()
    }

    /// Returns a named frame of the file.
    pub(super) fn named(&self, element: &Element) -> Result<Frame> {
        let name = name(element)?;
        let frame = self.frames.own(element);
        let link = self
            .frames
            .position(self.frames.link_of(frame), &self.links);
        Ok(Frame {
            name: name.to_owned(),
            link: link.map(|link| self.name(link).to_owned()),
            place: self.place(frame, link),
        })
    }
}
