//! Loops of an MJCF: `connect` becomes a point that two links share, `weld` a place at which they are one.

use super::builder::{BodyAxes, Builder};
use super::pose::exact;
use super::settings::one_of;
use crate::import::attributes::numbers;
use crate::import::joint_type::JointType;
use crate::import::loops::joints_between;
use crate::import::model::{Loop, LoopPlace};
use crate::import::naming::{free_name, shown};
use crate::import::number::Num;
use crate::import::placement::{Placement, Pose, displaced, turned_by_quaternion};
use crate::import::xml::{Element, fault};
use anyhow::Result;
use std::collections::HashSet;

const READ: [&str; 15] = [
    "name",
    "class",
    "active",
    "body1",
    "body2",
    "anchor",
    "relpose",
    "site1",
    "site2",
    "torquescale",
    // How soft the constraint is.
    "solref",
    "solimp",
    "mass",
    "inertia",
    "group",
];
const EXACT: &str = "loops, exact here, while MuJoCo holds them by a soft constraint";
const INACTIVE: &str = "equality constraints that are not active, not imported";
const ON_ONE_LINK: &str =
    "equality constraints between bodies that no joint moves against each other, not imported";
const FREE: &str = "equality constraints across a free joint, not imported: write them as `loops` into the mechanism";

impl Builder<'_> {
    /// Reads the elements `<connect>` and `<weld>` of all `<equality>` elements.
    pub(super) fn loops(&mut self, root: &Element) -> Result<()> {
        let mut names: HashSet<String> = HashSet::new();
        for section in root.all("equality") {
            for element in &section.children {
                let kind = match element.name.as_str() {
                    "connect" => "point",
                    "weld" => "weld",
                    _ => continue,
                };
                self.close(element, kind, &mut names)?;
            }
        }
        Ok(())
    }

    fn close(
        &mut self,
        element: &Element,
        kind: &'static str,
        names: &mut HashSet<String>,
    ) -> Result<()> {
        self.report.attributes(element, &READ);
        let element = &self.defaults.apply_kind(element, "equality", None)?;
        let given = element.get("name").map_or_else(
            || free_name(&format!("{}_{}", element.name, names.len() + 1), names),
            str::to_owned,
        );
        names.insert(given.clone());
        let label = format!("`{}` (line {})", shown(&given), element.at.0);
        if element.get("active").is_some()
            && !one_of(element, "active", &[("true", true), ("false", false)])?
        {
            self.report.groups.add(INACTIVE, label);
            return Ok(());
        }
        let [a, b] = match element.get("site1").is_some() || element.get("site2").is_some() {
            true => self.between_sites(element)?,
            false => self.between_bodies(element, kind)?,
        };
        let way = joints_between(self.model, &a.link, &b.link);
        if way.is_empty() {
            self.report.groups.add(ON_ONE_LINK, label);
        } else if way.iter().any(|joint| joint.kind == JointType::Floating) {
            self.report.groups.add(FREE, label);
        } else {
            self.report.groups.add(EXACT, label);
            self.model.loops.push(Loop {
                name: given,
                kind,
                axis: None,
                a,
                b,
            });
        }
        Ok(())
    }

    fn between_sites(&self, element: &Element) -> Result<[LoopPlace; 2]> {
        let place = |attribute: &str| -> Result<LoopPlace> {
            let name = element.get(attribute).unwrap_or_default();
            let mut frames = self.model.frames.iter();
            let found = frames.find(|frame| frame.name == name);
            let missing = || {
                let message = format!("`{attribute}`: there is no site `{}`", shown(name));
                fault(element.at, message)
            };
            let frame = found.ok_or_else(missing)?;
            Ok(LoopPlace {
                link: frame.link.clone(),
                place: frame.place.clone(),
            })
        };
        Ok([place("site1")?, place("site2")?])
    }

    /// The place on the first body is given; that on the second one is where it is in the pose of the file.
    fn between_bodies(&self, element: &Element, kind: &str) -> Result<[LoopPlace; 2]> {
        let (first, second) = (self.axes(element, "body1")?, self.axes(element, "body2")?);
        let at_file = second.world.inverse().then(&first.world);
        let (a, b) = match kind {
            "point" => {
                let anchor = displaced(exact(&numbers::<3>(element, "anchor")?).0);
                (anchor, at_file.then(&anchor))
            }
            _ => match relative(element)? {
                Some(pose) => (pose, displaced([Num::zero().exact(); 3])),
                None => {
                    let own = displaced([Num::zero().exact(); 3]);
                    (own, at_file)
                }
            },
        };
        let [mut a, mut b] = [first.place(&a), second.place(&b)];
        if kind == "point" {
            // Points have no axes.
            (a.place.rpy, b.place.rpy) = (Num::zeros(), Num::zeros());
        }
        Ok([a, b])
    }

    fn axes(&self, element: &Element, attribute: &str) -> Result<BodyAxes> {
        let Some(name) = element.get(attribute) else {
            if attribute == "body2" {
                return Ok(BodyAxes::world());
            }
            let message = format!("this `<{}>` has no `body1`", element.name);
            return Err(fault(element.at, message));
        };
        if name == "world" {
            return Ok(BodyAxes::world());
        }
        let found = self.bodies.iter().find(|body| body.name == name);
        found.cloned().ok_or_else(|| {
            let message = format!("`{attribute}`: there is no body `{}`", shown(name));
            fault(element.at, message)
        })
    }
}

impl BodyAxes {
    /// A pose in the axes of the body as a place on its link.
    fn place(&self, inner: &Pose) -> LoopPlace {
        LoopPlace {
            link: self.link.clone(),
            place: self.shift.then(&inner.placement()),
        }
    }

    fn world() -> Self {
        BodyAxes {
            name: "world".into(),
            link: None,
            shift: Placement::identity(),
            world: displaced([Num::zero().exact(); 3]),
        }
    }
}

/// Returns `relpose`, the pose of the second body in the first one; `None` if it is that of the file: without the
/// attribute, or with the quaternion 0.
fn relative(element: &Element) -> Result<Option<Pose>> {
    if element.get("relpose").is_none() {
        return Ok(None);
    }
    let [x, y, z, quaternion @ ..] = numbers::<7>(element, "relpose")?;
    if quaternion.iter().all(Num::is_zero) {
        return Ok(None);
    }
    let [w, i, j, k] = quaternion.each_ref().map(Num::exact);
    Ok(Some(Pose {
        translation: exact(&[x, y, z]),
        ..turned_by_quaternion([i, j, k, w])
    }))
}
