//! The frames of a model: its own, those of links and joints, and named ones, each with its pose relative to another.

use super::values::pose;
use crate::import::attributes::name;
use crate::import::naming::shown;
use crate::import::placement::Placement;
use crate::import::xml::{At, Element, fault};
use anyhow::Result;
use std::collections::HashMap;

/// The name of the frame of the model.
pub(super) const MODEL: &str = "__model__";

/// The frame of the model.
pub(super) const OWN: usize = 0;

/// The frames of a model: that of the model first.
pub(super) struct Frames {
    all: Vec<PlacedFrame>,
    index: HashMap<String, usize>,
}

struct PlacedFrame {
    at: At,
    /// Its pose in the axes of `base`.
    place: Placement,
    /// The frame that its pose is relative to; that of the model is relative to nothing.
    base: usize,
    /// The frame that it moves with; a link moves with itself.
    attached: usize,
}

/// A frame whose references are names.
struct Named<'e> {
    name: &'e str,
    element: &'e Element,
    /// What its pose is relative to, and what it moves with.
    base: &'e str,
    attached: Option<&'e str>,
}

impl Frames {
    /// Reads the frames of a model. Before version 1.7 poses name the frame that they are relative to by `frame`, and a
    /// joint or a frame may have the name of a link.
    pub(super) fn read(model: &Element, version: (u32, u32)) -> Result<Self> {
        let old = version < (1, 7);
        let mut named = Vec::new();
        for element in &model.children {
            let (base, attached) = match element.name.as_str() {
                "link" => (MODEL, None),
                "joint" => {
                    let child = element
                        .child("child")
                        .map_or("", |child| child.text.as_str());
                    (child, Some(child))
                }
                "frame" => {
                    let attached = element.get("attached_to").unwrap_or_default();
                    let attached = if attached.is_empty() { MODEL } else { attached };
                    (attached, Some(attached))
                }
                _ => continue,
            };
            let own = name(element)?;
            let stated = element.child("pose").and_then(|pose| {
                let older = pose.get("frame").filter(|_| old);
                pose.get("relative_to").or(older)
            });
            named.push(Named {
                name: own,
                element,
                base: stated.filter(|base| !base.is_empty()).unwrap_or(base),
                attached,
            });
        }
        let mut frames = Frames {
            all: vec![PlacedFrame {
                at: model.at,
                place: Placement::identity(),
                base: OWN,
                attached: OWN,
            }],
            index: HashMap::from([(MODEL.to_owned(), OWN)]),
        };
        for (k, one) in named.iter().enumerate() {
            let (at, own) = (one.element.at, one.name);
            let alike = |other: &&Named<'_>| {
                other.name == own && (!old || other.element.name == one.element.name)
            };
            if own == MODEL || named[..k].iter().any(|other| alike(&other)) {
                let message = format!(
                    "there is a second link, joint or frame called `{}` in this model",
                    shown(own)
                );
                return Err(fault(at, message));
            }
            let is_link = one.element.name == "link";
            if is_link || !frames.index.contains_key(own) {
                frames.index.insert(own.to_owned(), k + 1);
            }
        }
        let canonical = canonical(model, &frames)?;
        frames.all[OWN].attached = canonical;
        for (k, one) in named.iter().enumerate() {
            let place = one.element.child("pose").map(pose).transpose()?;
            let frame = PlacedFrame {
                at: one.element.at,
                place: place.unwrap_or_else(Placement::identity),
                base: frames.named(one.base, one.element, "the pose")?,
                attached: match one.attached {
                    None => k + 1,
                    Some(other) => frames.named(other, one.element, "the frame")?,
                },
            };
            frames.all.push(frame);
        }
        frames.refuse_circles(&named)?;
        Ok(frames)
    }

    /// Returns the index of the frame of a link, a joint or a frame of this model.
    pub(super) fn own(&self, element: &Element) -> usize {
        let own = self.all.iter().position(|frame| frame.at == element.at);
        own.unwrap_or(OWN)
    }

    /// Returns the index of a frame by its name.
    ///
    /// # Errors
    /// If there is none of this name; `what` of the element refers to it.
    pub(super) fn named(&self, name: &str, element: &Element, what: &str) -> Result<usize> {
        self.index.get(name).copied().ok_or_else(|| {
            let nested = match name.contains("::") {
                true => ": nested models are not imported",
                false => "",
            };
            let message = format!(
                "{what} of `{}` refers to `{}`, and there is no such link, joint or frame in the model{nested}",
                shown(element.get("name").unwrap_or_default()),
                shown(name)
            );
            fault(element.at, message)
        })
    }

    /// Returns the frame of the link that a frame moves with.
    pub(super) fn link_of(&self, frame: usize) -> usize {
        let mut at = frame;
        for _ in 0..self.all.len() {
            at = self.all[at].attached;
        }
        at
    }

    /// Returns the index of the link with this frame.
    pub(super) fn position(&self, frame: usize, links: &[&Element]) -> Option<usize> {
        links.iter().position(|link| self.own(link) == frame)
    }

    /// Returns the pose of a frame in the axes of another one, at the positions of the file. The text of numbers stays
    /// where one of them is given relative to the other.
    pub(super) fn relative(&self, to: usize, from: usize) -> Placement {
        let (up, way) = (self.way(from), self.way(to));
        let common = up.iter().find(|frame| way.contains(frame));
        let common = common.copied().unwrap_or(OWN);
        let below = |way: &[usize]| {
            let inner = way.iter().take_while(|frame| **frame != common);
            inner.fold(Placement::identity(), |inner, &frame| {
                self.all[frame].place.then(&inner)
            })
        };
        let (own, other) = (below(&up), below(&way));
        match own.is_identity() {
            true => other,
            false => own.pose().inverse().then(&other.pose()).placement(),
        }
    }

    /// Returns the frame and those that its pose is relative to, up to that of the model.
    fn way(&self, frame: usize) -> Vec<usize> {
        let mut way = vec![frame];
        while let Some(&last) = way.last().filter(|last| **last != OWN) {
            way.push(self.all[last].base);
        }
        way
    }

    /// Refuses poses that are relative to each other, and frames that are attached to each other.
    fn refuse_circles(&self, named: &[Named<'_>]) -> Result<()> {
        for (k, one) in named.iter().enumerate() {
            let follow = |next: fn(&PlacedFrame) -> usize, ends: &dyn Fn(usize) -> bool| {
                let mut at = k + 1;
                (0..self.all.len()).any(|_| {
                    let ended = ends(at);
                    at = next(&self.all[at]);
                    ended
                })
            };
            let placed = follow(|frame| frame.base, &|frame| frame == OWN);
            let attached = follow(|frame| frame.attached, &|frame| {
                self.all[frame].attached == frame
            });
            let what = match (placed, attached) {
                (true, true) => continue,
                (false, _) => "relative to themselves",
                (_, false) => "attached to themselves",
            };
            let message = format!("poses or frames are {what}: see `{}`", shown(one.name));
            return Err(fault(self.all[k + 1].at, message));
        }
        Ok(())
    }
}

/// Returns the frame of the link that the model's frame moves with: the first one by default.
fn canonical(model: &Element, frames: &Frames) -> Result<usize> {
    let stated = model.get("canonical_link").filter(|name| !name.is_empty());
    let first = model.all("link").next();
    let Some(name) = stated.or(first.and_then(|link| link.get("name"))) else {
        return Err(fault(model.at, "this model has no link"));
    };
    let is_link = model.all("link").any(|link| link.get("name") == Some(name));
    if !is_link {
        let message = format!("`canonical_link`: there is no link `{}`", shown(name));
        return Err(fault(model.at, message));
    }
    frames.named(name, model, "`canonical_link`")
}
