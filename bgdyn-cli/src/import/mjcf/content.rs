//! The elements of a body, sorted by kind; those of a `<frame>` belong to the body.

use super::builder::Builder;
use super::pose::placement;
use crate::import::placement::Placement;
use crate::import::xml::Element;
use anyhow::Result;

/// Elements that make bodies or joints which are not written in the file.
const GENERATORS: &[&str] = &["composite", "flexcomp", "attach", "replicate"];

/// An element of a body with the pose of its `<frame>` and its class.
pub(super) struct Item<'e> {
    pub(super) element: &'e Element,
    pub(super) frame: Placement,
    pub(super) class: Option<&'e str>,
}

/// The elements of a body by kind.
#[derive(Default)]
pub(super) struct Content<'e> {
    pub(super) inertials: Vec<Item<'e>>,
    pub(super) joints: Vec<Item<'e>>,
    pub(super) geoms: Vec<Item<'e>>,
    pub(super) sites: Vec<Item<'e>>,
    pub(super) bodies: Vec<Item<'e>>,
}

impl Builder<'_> {
    /// Sorts the elements inside a body or frame.
    pub(super) fn collect<'e>(
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
                    self.report.known(child);
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
}
