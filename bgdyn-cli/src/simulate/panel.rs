//! A panel of a plot: its frame, numbers and labels, and the conversion of values to positions.

use bgdyn_accuracy::svg::{Anchor, Drawing, FAINT, GRID, INK};

use super::axis::Axis;

/// Blue and orange of Okabe and Ito's palette.
pub(super) const BLUE: &str = "#0072b2";
pub(super) const ORANGE: &str = "#d55e00";

/// Margin left of the frame for the numbers, above it for the title.
const LEFT: f64 = 82.0;
const TOP: f64 = 28.0;
const RIGHT: f64 = 20.0;

/// A panel with its axes.
pub(super) struct Panel<'a> {
    /// Its upper left corner and its size, px.
    pub at: (f64, f64),
    pub size: (f64, f64),
    /// The texts above it, below it, and beside it.
    pub title: String,
    pub below: String,
    pub beside: String,
    pub x: &'a Axis,
    pub y: &'a Axis,
}

impl Panel<'_> {
    /// Returns left, top, right and bottom of the frame.
    fn frame(&self) -> [f64; 4] {
        let ((x, y), (width, height)) = (self.at, self.size);
        let bottom = if self.below.is_empty() { 24.0 } else { 42.0 };
        [x + LEFT, y + TOP, x + width - RIGHT, y + height - bottom]
    }

    /// Returns the position of values, px.
    pub fn place(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let [left, top, right, bottom] = self.frame();
        let part = |axis: &Axis, v: f64| (axis.of(v) - axis.low) / (axis.high - axis.low);
        (
            left + part(self.x, x) * (right - left),
            bottom - part(self.y, y) * (bottom - top),
        )
    }

    /// Draws a line from the lower to the upper edge, at x.
    pub fn upright(&self, d: &mut Drawing, x: f64, colour: &str) {
        let [_, top, _, bottom] = self.frame();
        let (x, _) = self.place((x, 0.0));
        d.line((x, top), (x, bottom), colour, "");
    }

    /// Returns the position of the lower edge, px.
    pub fn floor(&self) -> f64 {
        self.frame()[3]
    }

    /// Draws everything except the curves.
    pub fn draw(&self, d: &mut Drawing) {
        let [left, top, right, bottom] = self.frame();
        let middle = 0.5 * (left + right);
        d.text((middle, top - 9.0), 14, INK, Anchor::Middle, &self.title);
        for (value, text) in self.y.ticks(5) {
            let part = (value - self.y.low) / (self.y.high - self.y.low);
            let y = bottom - part * (bottom - top);
            d.line((left, y), (right, y), GRID, "");
            d.text((left - 7.0, y + 4.0), 12, INK, Anchor::End, &text);
        }
        for (value, text) in self.x.ticks(8) {
            let part = (value - self.x.low) / (self.x.high - self.x.low);
            let x = left + part * (right - left);
            d.line((x, bottom), (x, bottom + 4.0), FAINT, "");
            d.text((x, bottom + 17.0), 12, INK, Anchor::Middle, &text);
        }
        d.line((left, bottom), (right, bottom), FAINT, "");
        d.line((left, top), (left, bottom), FAINT, "");
        if !self.below.is_empty() {
            d.text(
                (middle, bottom + 34.0),
                13,
                INK,
                Anchor::Middle,
                &self.below,
            );
        }
        d.upright((self.at.0 + 18.0, 0.5 * (top + bottom)), 13, &self.beside);
    }
}
