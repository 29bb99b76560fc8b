//! The tree of bodies: each becomes a link, with a link without inertia for each further joint.

use super::defaults::Defaults;
use super::inertial;
use super::joints::{self, BodyJoint};
use super::pose::{between, placement};
use super::report::Report;
use super::settings::{FromGeoms, Settings};
use super::solids::{self, Part};
use crate::import::joint_type::JointType;
use crate::import::model::{Frame, Inertial, Joint, Link, Model};
use crate::import::naming::{free_name, shown};
use crate::import::number::{Num, all_zero};
use crate::import::placement::Placement;
use crate::import::xml::{Element, fault};
use anyhow::Result;
use std::collections::HashSet;

/// Elements that make bodies or joints which are not written in the file.
const GENERATORS: &[&str] = &["composite", "flexcomp", "attach", "replicate"];

const POSE: &[&str] = &["pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"];

const GEOM: &[&str] = &[
    "name",
    "class",
    "type",
    "size",
    "fromto",
    "pos",
    "quat",
    "axisangle",
    "xyaxes",
    "zaxis",
    "euler",
    "mass",
    "density",
    "group",
    "shellinertia",
    "mesh",
];

const SITE: &[&str] = &[
    "name",
    "class",
    "pos",
    "quat",
    "axisangle",
    "xyaxes",
    "zaxis",
    "euler",
    "fromto",
];

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
    /// The number of bodies so far; the world is 0.
    pub(super) count: usize,
}

/// Where a body is: the link of its parent, and the parent's axes in that link.
struct Carrier {
    link: Option<String>,
    place: Placement,
    /// Whether a joint is between it and the world.
    moves: bool,
}

/// A body to be joined to its parent.
struct Mount<'e> {
    element: &'e Element,
    name: &'e str,
    /// The body's axes in the parent's link.
    place: Placement,
}

/// An element of a body with the pose of its `<frame>` and its class.
struct Item<'e> {
    element: &'e Element,
    frame: Placement,
    class: Option<&'e str>,
}

/// The elements of a body by kind.
#[derive(Default)]
struct Content<'e> {
    inertials: Vec<Item<'e>>,
    joints: Vec<Item<'e>>,
    geoms: Vec<Item<'e>>,
    sites: Vec<Item<'e>>,
    bodies: Vec<Item<'e>>,
}

impl<'a> Builder<'a> {
    /// Builds everything in `<worldbody>`.
    pub(super) fn world(&mut self, element: &Element) -> Result<()> {
        let mut content = Content::default();
        let class = element.get("childclass");
        self.collect(element, &Placement::identity(), class, &mut content)?;
        for wrong in content.joints.iter().chain(&content.inertials) {
            let name = &wrong.element.name;
            let message = format!("`<{name}>` in `<worldbody>`: the world does not move");
            return Err(fault(wrong.element.at, message));
        }
        // They neither move nor weigh.
        for item in &content.geoms {
            self.report.attributes(item.element, GEOM);
            self.report.geom(false);
        }
        let carrier = Carrier {
            link: None,
            place: Placement::identity(),
            moves: false,
        };
        self.sites(&content.sites, &carrier)?;
        self.bodies(&content.bodies, &carrier)
    }

    /// Sorts the elements inside a body or frame.
    fn collect<'e>(
        &mut self,
        element: &'e Element,
        frame: &Placement,
        class: Option<&'e str>,
        content: &mut Content<'e>,
    ) -> Result<()> {
        for child in &element.children {
            let list = match child.name.as_str() {
                "inertial" => &mut content.inertials,
                "joint" | "freejoint" => &mut content.joints,
                "geom" => &mut content.geoms,
                "site" => &mut content.sites,
                "body" => &mut content.bodies,
                "frame" => {
                    let known = [POSE, &["name", "childclass"]].concat();
                    self.report.attributes(child, &known);
                    let inner = frame.then(&placement(child, self.settings)?);
                    let class = child.get("childclass").or(class);
                    self.collect(child, &inner, class, content)?;
                    continue;
                }
                name if GENERATORS.contains(&name) => {
                    let what = format!(
                        "`<{name}>` of line {} makes bodies that are not in the file: import what MuJoCo saves \
                         (`mj_saveLastXML`)",
                        child.at.0
                    );
                    self.report.refuse(child.at, what);
                    continue;
                }
                _ => {
                    self.report.element(child, &element.name);
                    continue;
                }
            };
            list.push(Item {
                element: child,
                frame: frame.clone(),
                class,
            });
        }
        Ok(())
    }

    fn bodies(&mut self, items: &[Item<'_>], carrier: &Carrier) -> Result<()> {
        for item in items {
            self.body(item, carrier)?;
        }
        Ok(())
    }

    /// Builds a body and those on it.
    fn body(&mut self, item: &Item<'_>, carrier: &Carrier) -> Result<()> {
        let element = item.element;
        self.count += 1;
        let known = [POSE, &["name", "childclass", "mocap", "gravcomp"]].concat();
        self.report.attributes(element, &known);
        let name = self.body_name(element);
        self.note(element, &name);
        let class = element.get("childclass").or(item.class);
        let mut content = Content::default();
        self.collect(element, &Placement::identity(), class, &mut content)?;
        let mut joints = Vec::new();
        for joint in &content.joints {
            joints.push(self.joint(joint)?);
        }
        let moves = carrier.moves || !joints.is_empty();
        let inertial = self.inertial(&name, &content, moves)?;
        let place = item.frame.then(&placement(element, self.settings)?);
        let mount = Mount {
            element,
            name: &name,
            place: carrier.place.then(&place),
        };
        let (shift, place) = self.mount(&mount, joints, carrier)?;
        self.model.links.push(Link {
            name: name.clone(),
            at: element.at,
            inertial: inertial.map(|inertial| shifted(inertial, &shift)),
            place,
        });
        let own = Carrier {
            link: Some(name),
            place: shift,
            moves,
        };
        self.sites(&content.sites, &own)?;
        self.bodies(&content.bodies, &own)
    }

    fn body_name(&mut self, element: &Element) -> String {
        if let Some(name) = element.get("name") {
            return name.to_owned();
        }
        let name = free_name(&format!("body_{}", self.count), &self.links);
        self.links.insert(name.clone());
        name
    }

    /// Reports what a body has and a link does not.
    fn note(&mut self, element: &Element, name: &str) {
        let name = shown(name);
        if element.get("mocap") == Some("true") {
            let kind = "bodies whose pose is an input (mocap), fixed here";
            self.report.groups.add(kind, format!("`{name}`"));
        }
        let compensation = element.get("gravcomp").map(str::trim);
        let zero = |text: &str| text.parse() == Ok(0.0);
        if let Some(value) = compensation.filter(|text| !zero(text)) {
            let item = format!("`{name}` ({})", shown(value));
            let kind = "compensation of gravity (gravcomp), not taken over";
            self.report.groups.add(kind, item);
        }
    }

    fn joint(&mut self, item: &Item<'_>) -> Result<BodyJoint> {
        joints::count(item.element, self.report);
        let element = match item.element.name.as_str() {
            "freejoint" => item.element.clone(),
            _ => self.defaults.apply(item.element, item.class)?,
        };
        joints::read(&element, &item.frame, self.settings, self.report)
    }

    /// Returns the inertia of a body, in its own axes.
    fn inertial(
        &mut self,
        name: &str,
        content: &Content<'_>,
        moves: bool,
    ) -> Result<Option<Inertial>> {
        if let [_, second, ..] = content.inertials.as_slice() {
            let message = format!("a second `<inertial>` in body `{}`", shown(name));
            return Err(fault(second.element.at, message));
        }
        let given = content.inertials.first();
        let from_geoms = match self.settings.inertia_from_geoms {
            FromGeoms::Never => false,
            FromGeoms::Always => true,
            FromGeoms::Missing => given.is_none(),
        };
        let (mut solids, mut unknown) = (Vec::new(), Vec::new());
        for item in &content.geoms {
            self.report.attributes(item.element, GEOM);
            let geom = self.defaults.apply(item.element, item.class)?;
            let part = match from_geoms {
                true => solids::part(&geom, self.settings)?,
                false => Part::Nothing,
            };
            self.report.geom(matches!(part, Part::Solid(_)));
            match part {
                Part::Nothing => {}
                Part::Unknown(what) => unknown.push(what),
                Part::Solid(mut solid) => {
                    solid.pose = item.frame.pose().then(&solid.pose);
                    solids.push(solid);
                }
            }
        }
        let label = shown(name);
        if !unknown.is_empty() && (moves || self.settings.total_mass.is_some()) {
            let all = unknown.join(", ");
            let at = content.geoms.first().map_or((1, 1), |item| item.element.at);
            self.report.refuse(
                at,
                format!(
                    "body `{label}` has its inertia from {all}, which is not computed here: give it an `<inertial>` \
                     (MuJoCo writes them with `saveinertial`)"
                ),
            );
        } else if !unknown.is_empty() {
            let kind = "bodies that do not move, without the inertia of their meshes";
            self.report.groups.add(kind, format!("`{label}`"));
        }
        let mut inertial = solids::sum(&solids);
        if let (Some(given), None) = (given, &inertial) {
            inertial = Some(inertial::read(given.element, self.settings, self.report)?);
        }
        if let Some(changed) = inertial::adjust(&mut inertial, self.settings) {
            self.report.groups.add(changed, format!("`{label}`"));
        }
        Ok(inertial)
    }

    /// Writes the joints of a body and the links between them; returns the body's axes in its link, and the
    /// pose of a body that is fixed to the world.
    fn mount(
        &mut self,
        mount: &Mount<'_>,
        joints: Vec<BodyJoint>,
        carrier: &Carrier,
    ) -> Result<(Placement, Option<Placement>)> {
        let Mount { element, name, .. } = *mount;
        let parent = carrier.link.as_deref();
        if joints.is_empty() {
            let Some(parent) = parent else {
                return Ok((Placement::identity(), Some(mount.place.clone())));
            };
            let joint_name = self.joint_name(&format!("{name}_mount"));
            self.model.joints.push(Joint {
                origin: mount.place.clone(),
                ..Joint::fixed(&joint_name, element.at, Some(parent), name)
            });
            return Ok((Placement::identity(), None));
        }
        if let Some(free) = joints.iter().find(|it| it.kind == JointType::Floating) {
            if joints.len() > 1 || parent.is_some() {
                let message = format!(
                    "the free joint of body `{}` must be its only one, and the body on the world",
                    shown(name)
                );
                return Err(fault(free.at, message));
            }
            self.float(free, mount);
            return Ok((Placement::identity(), None));
        }
        Ok((self.chain(mount, &joints, parent), None))
    }

    /// Writes a floating joint; its coordinates are the pose of the body in the world, as in MuJoCo.
    fn float(&mut self, free: &BodyJoint, mount: &Mount<'_>) {
        let name = self.name_of(free, mount.name);
        let text = |numbers: &[Num; 3]| numbers.each_ref().map(|it| it.text.as_str()).join(" ");
        let Placement { xyz, rpy } = &mount.place;
        if !all_zero(xyz) || !all_zero(rpy) {
            let item = format!("`{}` at {}, rpy {}", shown(&name), text(xyz), text(rpy));
            let kind = "poses at the start, not a part of a mechanism";
            self.report.groups.add(kind, item);
        }
        self.model.joints.push(Joint {
            kind: JointType::Floating,
            ..Joint::fixed(&name, free.at, None, mount.name)
        });
    }

    /// Writes a joint for each of a body's, with links without inertia between them; returns the body's axes
    /// in its link.
    fn chain(
        &mut self,
        mount: &Mount<'_>,
        joints: &[BodyJoint],
        parent: Option<&str>,
    ) -> Placement {
        let mut parent = parent.map(str::to_owned);
        let mut at = mount.place.clone();
        for (index, joint) in joints.iter().enumerate() {
            let name = self.name_of(joint, mount.name);
            let anchored = at.then(&moved(&joint.anchor));
            let child = match index + 1 == joints.len() {
                true => mount.name.to_owned(),
                false => {
                    let child = free_name(&format!("{}_{name}", mount.name), &self.links);
                    self.links.insert(child.clone());
                    self.model.links.push(Link {
                        name: child.clone(),
                        at: joint.at,
                        inertial: None,
                        place: None,
                    });
                    child
                }
            };
            if joint.kind.is_scalar() {
                let reference = joint.reference.clone();
                self.references.push((name.clone(), reference));
            }
            self.model.joints.push(Joint {
                kind: joint.kind,
                origin: anchored.then(&joint.at_zero()),
                axis: joint.axis.clone(),
                limits: joint.limits.clone(),
                effects: joint.effects.clone(),
                ..Joint::fixed(&name, joint.at, parent.as_deref(), &child)
            });
            at = moved(&joint.anchor.each_ref().map(negated));
            parent = Some(child);
        }
        at
    }

    /// Returns the joint's name, or one made of that of its body and its kind.
    fn name_of(&mut self, joint: &BodyJoint, body: &str) -> String {
        match joint.name.as_str() {
            "" => {
                let word = match joint.kind {
                    JointType::Floating => "free",
                    JointType::Spherical => "ball",
                    JointType::Prismatic => "slide",
                    _ => "hinge",
                };
                self.joint_name(&format!("{body}_{word}"))
            }
            name => name.to_owned(),
        }
    }

    fn joint_name(&mut self, wanted: &str) -> String {
        let name = free_name(wanted, &self.joints);
        self.joints.insert(name.clone());
        name
    }

    /// Writes the sites with names as frames.
    fn sites(&mut self, items: &[Item<'_>], carrier: &Carrier) -> Result<()> {
        for item in items {
            self.report.attributes(item.element, SITE);
            let site = self.defaults.apply(item.element, item.class)?;
            let Some(name) = site.get("name") else {
                self.report.groups.add(
                    "sites without a name, not taken over",
                    format!("line {}", site.at.0),
                );
                continue;
            };
            let place = match between(&site)? {
                Some((pose, _)) => pose.placement(),
                None => placement(&site, self.settings)?,
            };
            self.model.frames.push(Frame {
                name: name.to_owned(),
                link: carrier.link.clone(),
                place: carrier.place.then(&item.frame.then(&place)),
            });
        }
        Ok(())
    }
}

/// A displacement without a rotation.
fn moved(xyz: &[Num; 3]) -> Placement {
    Placement {
        xyz: xyz.clone(),
        rpy: Num::zeros(),
    }
}

fn negated(number: &Num) -> Num {
    match number.is_zero() {
        true => Num::zero(),
        false => Num::computed(-number.value),
    }
}

/// Returns an inertia of the body's axes in those of its link.
fn shifted(inertial: Inertial, shift: &Placement) -> Inertial {
    let own = Placement {
        xyz: inertial.com,
        rpy: inertial.rpy,
    };
    let Placement { xyz: com, rpy } = shift.then(&own);
    Inertial {
        com,
        rpy,
        ..inertial
    }
}
