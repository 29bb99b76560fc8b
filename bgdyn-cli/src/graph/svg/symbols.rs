//! Draws SVG symbols of junctions and bonds.

use super::drawing::{Anchor, Drawing, INK};

/// x to the right, y down.
pub(super) type Point = (f64, f64);

/// A bond: a line with a half arrow at its end.
pub(super) struct Bond {
    path: Vec<Point>,
    /// Whether it has three components.
    pub triple: bool,
    /// The end with the causal stroke.
    pub stroke: Option<Point>,
}

impl Bond {
    /// Returns a bond of one component.
    pub fn single(path: &[Point]) -> Self {
        Bond {
            path: path.to_vec(),
            triple: false,
            stroke: None,
        }
    }

    /// Returns a bond of three components.
    pub fn triple(path: &[Point]) -> Self {
        Bond {
            triple: true,
            ..Bond::single(path)
        }
    }

    /// Returns a bond of three components, or of one.
    pub fn of(path: &[Point], triple: bool) -> Self {
        Bond {
            triple,
            ..Bond::single(path)
        }
    }

    /// Puts the causal stroke at the start.
    pub fn stroke_at_start(mut self) -> Self {
        self.stroke = self.path.first().copied();
        self
    }
}

/// Half the distance of the two lines of a bond of three components.
const APART: f64 = 1.5;

/// Draws a bond.
pub(super) fn bond(d: &mut Drawing, bond: &Bond) {
    let [.., before, end] = bond.path[..] else {
        return;
    };
    let lines: &[f64] = if bond.triple {
        &[-APART, APART]
    } else {
        &[0.0]
    };
    for &aside in lines {
        d.stroke(&shifted(&bond.path, aside), INK, 1.1);
    }
    let along = direction(before, end);
    // The half arrow is below a horizontal bond, and right of a vertical one.
    let aside = (along.1.abs(), along.0.abs());
    let start = if bond.triple { APART } else { 0.0 };
    let tip = (end.0 + start * aside.0, end.1 + start * aside.1);
    let barb = (
        tip.0 - 9.0 * along.0 + 5.0 * aside.0,
        tip.1 - 9.0 * along.1 + 5.0 * aside.1,
    );
    d.stroke(&[tip, barb], INK, 1.4);
    if let Some(at) = bond.stroke {
        let along = match at == end {
            true => along,
            false => direction(bond.path[0], bond.path[1]),
        };
        let (dx, dy) = (5.5 * along.1, 5.5 * along.0);
        d.stroke(&[(at.0 - dx, at.1 - dy), (at.0 + dx, at.1 + dy)], INK, 1.8);
    }
}

/// Returns the unit vector from a to b.
fn direction(a: Point, b: Point) -> Point {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let length = dx.hypot(dy).max(f64::MIN_POSITIVE);
    (dx / length, dy / length)
}

/// Returns a path of horizontal and vertical lines, displaced to its right.
fn shifted(path: &[Point], by: f64) -> Vec<Point> {
    let last = path.len() - 1;
    let shift = |(k, &(x, y)): (usize, &Point)| {
        let before = direction(path[k.max(1) - 1], path[k.max(1)]);
        let after = direction(path[k.min(last - 1)], path[k.min(last - 1) + 1]);
        let corner = k > 0 && k < last;
        let (nx, ny) = match corner {
            true => (-before.1 - after.1, before.0 + after.0),
            false => (-after.1, after.0),
        };
        (x + by * nx, y + by * ny)
    };
    path.iter().enumerate().map(shift).collect()
}

/// Draws a junction, extended from one point to another.
pub(super) fn bar(d: &mut Drawing, from: Point, to: Point, colour: &str) {
    d.stroke(&[from, to], colour, 5.0);
}

/// Clears the background of a bar.
pub(super) fn clearing(d: &mut Drawing, from: Point, to: Point, colour: &str) {
    d.stroke(&[from, to], colour, 11.0);
}

/// Draws the symbol of a junction.
pub(super) fn junction(d: &mut Drawing, (x, y): Point, sign: &str, colour: &str) {
    d.rectangle((x - 7.0, y - 9.0), (14.0, 18.0), "#ffffff");
    let corners = [
        (x - 7.0, y - 9.0),
        (x + 7.0, y - 9.0),
        (x + 7.0, y + 9.0),
        (x - 7.0, y + 9.0),
        (x - 7.0, y - 9.0),
    ];
    d.stroke(&corners, colour, 1.0);
    d.bold((x, y + 5.0), 14, colour, Anchor::Middle, sign);
}
