//! Parses the entries of `loops`: two places on links that a joint connects.

use super::walk::{At, Reader};
use super::{LoopEndSpec, LoopSpec};
use crate::unit::Dimension;

impl Reader {
    pub(super) fn closing(&mut self, at: &At<'_>) -> Option<LoopSpec> {
        let keys = [
            "name",
            "type",
            "a",
            "b",
            "axis",
            "length",
            "branch",
            "near",
            "redundant",
            "tolerance",
        ];
        let example = "`- { name: …, type: hinge, a: { link: … }, b: { link: … } }`";
        let map = self.mapping(at, ("a loop", example), &keys)?;
        Some(LoopSpec {
            name: self.needed(&map, "name", "`name: …`, the loop's name", Self::text),
            kind: self.needed(
                &map,
                "type",
                "`type: …`: `hinge`, `point`, `slider` or another type of loop",
                Self::text,
            ),
            a: self.needed(&map, "a", "`a: { link: … }`, one place", Self::loop_end),
            b: self.needed(
                &map,
                "b",
                "`b: { link: … }`, the place it is connected to",
                Self::loop_end,
            ),
            axis: self.field(&map, "axis", Self::axis),
            length: self.number_field(&map, "length", &[Dimension::Length]),
            branch: self.text_field(&map, "branch"),
            near: self.field(&map, "near", |r, at| {
                let fit = [Dimension::Angle, Dimension::Length];
                r.coefficients(at, &fit, ("positions by joint", "`{ elbow: 30 deg }`"))
            }),
            redundant: self.text_field(&map, "redundant"),
            tolerance: self.number_field(&map, "tolerance", &[Dimension::Length]),
            location: map.location,
        })
    }

    /// Parses a place: a link with an origin on it, or a frame.
    fn loop_end(&mut self, at: &At<'_>) -> Option<LoopEndSpec> {
        let what = (
            "a place",
            "`{ link: …, origin: { xyz: [x, y, z] } }` or `{ frame: … }`",
        );
        let map = self.mapping(at, what, &["link", "origin", "frame"])?;
        Some(LoopEndSpec {
            link: self.text_field(&map, "link"),
            origin: self.field(&map, "origin", Self::origin),
            frame: self.text_field(&map, "frame"),
            location: map.location,
        })
    }
}
