//! The tree of bodies: each becomes a link, with a link without inertia for each further joint.

use super::builder::{BodyAxes, Builder, Carrier, Mount};
use super::content::{Content, Item};
use super::inertial;
use super::joints::{self, MjcfJoint};
use super::pose::{between, placement};
use super::settings::{FromGeoms, one_of};
use super::solids::{self, Part};
use crate::import::model::{Frame, Inertial, Link};
use crate::import::naming::{free_name, shown};
use crate::import::placement::Placement;
use crate::import::xml::{Element, fault};
use anyhow::Result;

impl Builder<'_> {
    /// Builds everything in `<worldbody>`.
    pub(super) fn world(&mut self, element: &Element) -> Result<()> {
        let mut content = Content::default();
        let class = element.get("childclass");
        self.collect(element, &Placement::identity(), class, &mut content)?;
        let mut wrong = content.joints.iter().chain(&content.inertials);
        if let Some(wrong) = wrong.next() {
            let name = &wrong.element.name;
            let message = format!("`<{name}>` in `<worldbody>`: the world does not move");
            return Err(fault(wrong.element.at, message));
        }
        // They neither move nor weigh.
        for item in &content.geoms {
            self.report.known(item.element);
            self.report.geom(false);
        }
        let carrier = Carrier {
            link: None,
            place: Placement::identity(),
            world: Placement::identity().pose(),
            moves: false,
        };
        self.sites(&content.sites, &carrier)?;
        self.all(&content.bodies, &carrier)
    }

    fn all(&mut self, items: &[Item<'_>], carrier: &Carrier) -> Result<()> {
        for item in items {
            self.body(item, carrier)?;
        }
        Ok(())
    }

    /// Builds a body and those on it.
    fn body(&mut self, item: &Item<'_>, carrier: &Carrier) -> Result<()> {
        let element = item.element;
        self.count += 1;
        self.report.known(element);
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
        let (shift, fixed) = self.mount(&mount, joints, carrier)?;
        self.model.links.push(Link {
            name: name.clone(),
            at: element.at,
            inertial: inertial.map(|inertial| inertial.shifted(&shift)),
            place: fixed,
        });
        let axes = BodyAxes {
            name: name.clone(),
            link: Some(name.clone()),
            shift: shift.clone(),
            world: carrier.world.then(&place.pose()),
        };
        let own = Carrier {
            link: Some(name),
            place: shift,
            world: axes.world,
            moves,
        };
        self.bodies.push(axes);
        self.sites(&content.sites, &own)?;
        self.all(&content.bodies, &own)
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
            let kind = "compensation of gravity (gravcomp), not imported";
            self.report.groups.add(kind, item);
        }
    }

    fn joint(&mut self, item: &Item<'_>) -> Result<MjcfJoint> {
        self.report.known(item.element);
        let element = match item.element.name.as_str() {
            "freejoint" => {
                self.note_alignment(item.element)?;
                item.element.clone()
            }
            _ => self.defaults.apply(item.element, item.class)?,
        };
        joints::read(&element, &item.frame, self.settings, self.report)
    }

    /// Reports a free joint for which MuJoCo moves the body's frame.
    fn note_alignment(&mut self, element: &Element) -> Result<()> {
        let aligned = match element.get("align") {
            None | Some("auto") => self.settings.align_free,
            Some(_) => one_of(element, "align", &[("true", true), ("false", false)])?,
        };
        if aligned {
            let kind = "free joints that MuJoCo aligns with the inertia of their body (`align`): here q is the \
                        pose of the body's own frame, and v and M are about its origin";
            let name = element.get("name").map_or_else(
                || format!("line {}", element.at.0),
                |name| format!("`{}`", shown(name)),
            );
            self.report.groups.add(kind, name);
        }
        Ok(())
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
            self.report.known(item.element);
            let geom = self.defaults.apply(item.element, item.class)?;
            let part = match from_geoms {
                true => solids::part(&geom, self.settings)?,
                false => Part::Nothing,
            };
            self.report.geom(matches!(part, Part::Solid(_)));
            match part {
                Part::Nothing => {}
                Part::Unknown(what) => unknown.push((item.element.at, what)),
                Part::Solid(solid) => {
                    let mut solid = *solid;
                    solid.pose = item.frame.pose().then(&solid.pose);
                    solids.push(solid);
                }
            }
        }
        let label = shown(name);
        if let Some((at, _)) = unknown.first()
            && (moves || self.settings.total_mass.is_some())
        {
            let what: Vec<&str> = unknown.iter().map(|(_, what)| what.as_str()).collect();
            let item = format!("`{label}` ({})", what.join(", "));
            self.report.shapes.push((*at, item));
        } else if !unknown.is_empty() {
            self.model.incomplete.push(name.to_owned());
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

    /// Writes the sites with names as frames.
    fn sites(&mut self, items: &[Item<'_>], carrier: &Carrier) -> Result<()> {
        for item in items {
            self.report.known(item.element);
            let site = self.defaults.apply(item.element, item.class)?;
            let Some(name) = site.get("name") else {
                self.report.groups.add(
                    "sites without a name, not imported",
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
