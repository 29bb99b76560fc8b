//! What an MJCF has and the mechanism does not: counted by name, and written once.

use super::known::known;
use crate::import::groups::Groups;
use crate::import::naming::shown;
use crate::import::tally::{Tally, plural};
use crate::import::xml::{At, Element, fault};
use anyhow::Result;

/// So many bodies of meshes are named.
const SHOWN: usize = 5;

/// Messages of an import.
#[derive(Default)]
pub(super) struct Report {
    /// Warnings of one kind with their names.
    pub(super) groups: Groups,
    elements: Tally,
    /// Elements with the attributes that are not read and their counts.
    attributes: Vec<(String, Vec<(String, usize)>)>,
    refused: Vec<(At, String)>,
    /// Bodies that need their inertia and have it from shapes whose inertia is not computed here.
    pub(super) shapes: Vec<(At, String)>,
    geoms: usize,
    solid_geoms: usize,
}

impl Report {
    /// Counts the attributes of an element that are not read anywhere.
    pub(super) fn known(&mut self, element: &Element) {
        self.attributes(element, &known(&element.name));
    }

    /// Counts the attributes of an element that are not in the list.
    pub(super) fn attributes(&mut self, element: &Element, read: &[&str]) {
        for (attribute, _) in &element.attributes {
            if read.contains(&attribute.as_str()) {
                continue;
            }
            let of = self.attributes.iter_mut();
            let mut of = of.filter(|(name, _)| *name == element.name);
            let known = match of.next() {
                Some((_, known)) => known,
                None => {
                    let new = (element.name.clone(), Vec::new());
                    self.attributes.push(new);
                    match self.attributes.last_mut() {
                        Some((_, known)) => known,
                        None => continue,
                    }
                }
            };
            match known.iter_mut().find(|(name, _)| name == attribute) {
                Some((_, count)) => *count += 1,
                None => known.push((attribute.clone(), 1)),
            }
        }
    }

    /// Counts the elements directly inside one that are not in the list.
    pub(super) fn children(&mut self, element: &Element, read: &[&str]) {
        for child in &element.children {
            if !read.contains(&child.name.as_str()) {
                self.element(child, &element.name);
            }
        }
    }

    /// Counts an element that is not imported.
    pub(super) fn element(&mut self, element: &Element, inside: &str) {
        let what = format!("`<{}>` in `<{}>`", shown(&element.name), shown(inside));
        self.elements.count(what, 0);
    }

    /// Counts a geom.
    pub(super) fn geom(&mut self, gives_inertia: bool) {
        self.geoms += 1;
        self.solid_geoms += usize::from(gives_inertia);
    }

    /// Notes something without which the mechanism would be wrong.
    pub(super) fn refuse(&mut self, at: At, what: String) {
        self.refused.push((at, what));
    }

    /// Returns one error for everything that was refused.
    pub(super) fn check(&mut self) -> Result<()> {
        let mut refused = std::mem::take(&mut self.refused);
        refused.extend(self.bodies_of_shapes());
        let Some((at, _)) = refused.first() else {
            return Ok(());
        };
        let all: Vec<&str> = refused.iter().map(|(_, what)| what.as_str()).collect();
        Err(fault(*at, all.join("; ")))
    }

    /// Returns the refusal of bodies whose inertia is that of meshes.
    fn bodies_of_shapes(&self) -> Option<(At, String)> {
        let (at, _) = self.shapes.first()?;
        let names = self.shapes.iter().take(SHOWN);
        let names: Vec<&str> = names.map(|(_, name)| name.as_str()).collect();
        let more = match self.shapes.len().saturating_sub(SHOWN) {
            0 => String::new(),
            more => format!(", and {more} more"),
        };
        let bodies = match self.shapes.len() {
            1 => "a body".to_owned(),
            count => format!("{count} bodies"),
        };
        Some((
            *at,
            format!(
                "the inertia of {bodies} is that of meshes or shells, which is not computed here: {}{more}; give each an \
                 `<inertial>` (MuJoCo writes them into the file it saves with `saveinertial`)",
                names.join(", ")
            ),
        ))
    }

    /// Returns the warnings.
    pub(super) fn lines(self) -> Vec<String> {
        let mut lines: Vec<String> = self.groups.lines().collect();
        if self.geoms > 0 {
            lines.push(format!(
                "not imported: the shapes of {}, for contacts and drawing; {} of them gave bodies their inertia",
                plural(self.geoms, "geom"),
                self.solid_geoms
            ));
        }
        lines.extend(self.elements.lines());
        for (element, attributes) in self.attributes {
            let attributes = attributes.iter();
            let attributes: Vec<String> = attributes
                .map(|(name, count)| format!("{} ({count})", shown(name)))
                .collect();
            lines.push(format!(
                "not imported: attributes of `<{}>`: {}",
                shown(&element),
                attributes.join(", ")
            ));
        }
        lines
    }
}
