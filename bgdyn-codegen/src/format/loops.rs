//! Parses the entries of `loops`: two places on links that a joint connects.

use super::walk::{At, Reader};
use super::{LoopEndSpec, LoopSpec};
use crate::fault::wording::expected;
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
        let map = self.mapping(at, expected::LOOP, &keys)?;
        Some(LoopSpec {
            name: self.needed(&map, "name", expected::LOOP_NAME_KEY, Self::text),
            kind: self.needed(&map, "type", expected::LOOP_TYPE_KEY, Self::text),
            a: self.needed(&map, "a", expected::LOOP_A_KEY, Self::loop_end),
            b: self.needed(&map, "b", expected::LOOP_B_KEY, Self::loop_end),
            axis: self.field(&map, "axis", Self::axis),
            length: self.number_field(&map, "length", &[Dimension::Length]),
            branch: self.text_field(&map, "branch"),
            near: self.field(&map, "near", |r, at| {
                let fit = [Dimension::Angle, Dimension::Length];
                r.coefficients(at, &fit, expected::NEAR)
            }),
            redundant: self.text_field(&map, "redundant"),
            tolerance: self.number_field(&map, "tolerance", &[Dimension::Length]),
            location: map.location,
        })
    }

    /// Parses a place: a link with an origin on it, or a frame.
    fn loop_end(&mut self, at: &At<'_>) -> Option<LoopEndSpec> {
        let what = expected::LOOP_END;
        let map = self.mapping(at, what, &["link", "origin", "frame"])?;
        Some(LoopEndSpec {
            link: self.text_field(&map, "link"),
            origin: self.field(&map, "origin", Self::origin),
            frame: self.text_field(&map, "frame"),
            location: map.location,
        })
    }
}
