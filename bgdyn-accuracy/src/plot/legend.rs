//! Legends, and names beside the ends of curves.

use plotters::prelude::{Color, Rectangle};

use super::{
    Area, Chart, Drawn, INK, Marker, RGBColor, Stroke, at, curve, mark, place_in, text, write,
};

/// The sign of a series in the legend of a plot.
#[derive(Clone, Copy, Debug)]
pub enum Sign {
    /// A curve.
    Line(Stroke),
    /// Points.
    Points(Marker, RGBColor),
    /// A curve through points, in the curve's colour.
    Curve(Stroke, Marker),
    /// A shaded part.
    Shade(RGBColor),
}

/// Width of a sign, px, and its distance from the text.
const WIDTH: f64 = 34.0;
const GAP: f64 = 8.0;

/// Draws a sign of 34 pixels from its left end at half its height, px.
pub fn sign(area: &Area<'_>, (x, y): (f64, f64), sign: Sign) -> Drawn {
    let (ends, middle) = ([at(x, y), at(x + WIDTH, y)], at(x + 0.5 * WIDTH, y));
    match sign {
        Sign::Line(stroke) => curve(area, ends, stroke),
        Sign::Points(marker, colour) => mark(area, middle, marker, colour),
        Sign::Curve(stroke, marker) => {
            curve(area, ends, stroke)?;
            mark(area, middle, marker, stroke.colour)
        }
        Sign::Shade(colour) => {
            let corners = [at(x, y - 8.0), at(x + WIDTH, y + 8.0)];
            area.draw(&Rectangle::new(corners, colour.filled()))
        }
    }
}

/// Draws signs with their texts in a row from a point, px.
pub fn legend(area: &Area<'_>, (mut x, y): (f64, f64), entries: &[(Sign, &str)]) -> Drawn {
    for (what, words) in entries {
        // Points need less width than lines.
        let less = match what {
            Sign::Points(..) => 12.0,
            _ => 0.0,
        };
        sign(area, (x - less, y), *what)?;
        x += WIDTH + GAP - 2.0 * less;
        write(area, (x, y), words, text(13, INK))?;
        x += 7.0 * words.chars().count() as f64 + 24.0;
    }
    Ok(())
}

/// Height of a name beside a curve, px.
const LINE: f64 = 16.0;

/// Writes names right of the ends of curves, in their colours, each on a line of its own.
pub fn name_ends(
    area: &Area<'_>,
    chart: &Chart<'_>,
    ends: impl IntoIterator<Item = ((f64, f64), String, RGBColor)>,
) -> Drawn {
    let place = |(end, name, colour)| (place_in(area, chart, end), name, colour);
    let mut names: Vec<_> = ends.into_iter().map(place).collect();
    names.sort_by_key(|((_, y), ..)| *y);
    let (gap, line) = at(GAP, LINE);
    let mut free = i32::MIN;
    for ((x, y), name, colour) in names {
        let y = y.max(free);
        free = y + line;
        area.draw_text(&name, &text(13, colour), (x + gap, y))?;
    }
    Ok(())
}
