//! Default classes: the attributes that elements of a class have without giving them.

use super::known::ORIENTATION;
use super::report::Report;
use crate::import::naming::shown;
use crate::import::xml::{Element, fault};
use anyhow::Result;
use std::collections::HashMap;

/// The elements whose defaults are read.
const KINDS: [&str; 4] = ["joint", "geom", "site", "equality"];

/// The class of elements without one.
const MAIN: &str = "main";

type ClassAttributes = Vec<(String, String)>;

/// All classes with their attributes, those of outer classes included.
pub(super) struct Defaults {
    /// By class: an element for each of [`KINDS`].
    classes: HashMap<String, [ClassAttributes; 4]>,
    main: String,
}

impl Defaults {
    /// Reads all `<default>` elements.
    pub(super) fn read(root: &Element, report: &mut Report) -> Result<Self> {
        let mut defaults = Defaults {
            classes: HashMap::from([(MAIN.to_owned(), Default::default())]),
            main: MAIN.to_owned(),
        };
        for (number, element) in root.all("default").enumerate() {
            let name = element.get("class").unwrap_or(MAIN);
            if number == 0 && name != MAIN {
                // The first class may have a name of its own.
                defaults.main = name.to_owned();
                defaults.classes.insert(name.to_owned(), Default::default());
            }
            let outer = defaults.classes[&defaults.main].clone();
            defaults.add(name, element, outer, report)?;
        }
        Ok(defaults)
    }

    fn add(
        &mut self,
        name: &str,
        element: &Element,
        outer: [ClassAttributes; 4],
        report: &mut Report,
    ) -> Result<()> {
        let mut own = outer;
        for (kind, attributes) in KINDS.iter().zip(&mut own) {
            for child in element.all(kind) {
                report.known(child);
                overlay(attributes, &child.attributes);
            }
        }
        report.children(element, &["default", "joint", "geom", "site", "equality"]);
        self.classes.insert(name.to_owned(), own.clone());
        for nested in element.all("default") {
            let Some(class) = nested.get("class") else {
                let message = "this nested `<default>` names no class: `class=…` is missing";
                return Err(fault(nested.at, message));
            };
            if self.classes.contains_key(class) {
                let message = format!("a second default class `{}`", shown(class));
                return Err(fault(nested.at, message));
            }
            self.add(class, nested, own.clone(), report)?;
        }
        Ok(())
    }

    /// Returns an element with the attributes of its class: its own, else that of the nearest `childclass`,
    /// else the outermost one.
    pub(super) fn apply(&self, element: &Element, childclass: Option<&str>) -> Result<Element> {
        self.apply_kind(element, &element.name, childclass)
    }

    /// Returns an element with the attributes of its class for elements of this kind.
    pub(super) fn apply_kind(
        &self,
        element: &Element,
        kind: &str,
        childclass: Option<&str>,
    ) -> Result<Element> {
        let class = element.get("class").or(childclass).unwrap_or(&self.main);
        let Some(attributes) = self.classes.get(class) else {
            let message = format!("there is no default class `{}`", shown(class));
            return Err(fault(element.at, message));
        };
        let kind = KINDS.iter().position(|known| *known == kind);
        let mut merged = kind.map_or(Vec::new(), |kind| attributes[kind].clone());
        overlay(&mut merged, &element.attributes);
        Ok(Element {
            attributes: merged,
            ..element.clone()
        })
    }
}

/// Replaces attributes by those given. Of `size` only the given numbers are replaced.
fn overlay(attributes: &mut ClassAttributes, given: &ClassAttributes) {
    let orients = |name: &str| ORIENTATION.contains(&name);
    if given.iter().any(|(name, _)| orients(name)) {
        attributes.retain(|(name, _)| !orients(name));
    }
    for (name, value) in given {
        let old = attributes.iter_mut().find(|(known, _)| known == name);
        match old {
            Some((_, old)) if name == "size" => *old = with_rest(value, old),
            Some((_, old)) => old.clone_from(value),
            None => attributes.push((name.clone(), value.clone())),
        }
    }
}

/// Returns the numbers of the first list, and those of the second beyond its length.
fn with_rest(first: &str, second: &str) -> String {
    let given: Vec<&str> = first.split_whitespace().collect();
    let rest = second.split_whitespace().skip(given.len());
    let all: Vec<&str> = given.iter().copied().chain(rest).collect();
    all.join(" ")
}
