//! Colours, texts, lines and markers.

use plotters::coord::CoordTranslate;
use plotters::element::DashedPathElement;
use plotters::prelude::{
    Circle, Color, Cross, DrawingArea, EmptyElement, FontDesc, FontFamily, FontStyle, PathElement,
    RGBColor, Rectangle, SVGBackend, TextStyle, TriangleMarker,
};
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{Area, Drawn, at, px};

/// Colour of texts.
pub const INK: RGBColor = RGBColor(40, 40, 40);
/// Colour of axes and of less important parts.
pub const FAINT: RGBColor = RGBColor(119, 119, 119);
/// Colour of failures.
pub const ALARM: RGBColor = RGBColor(194, 65, 12);
/// Colour of grid lines.
pub const GRID: RGBColor = RGBColor(227, 227, 227);
// The palette of Okabe and Ito (2008), which is distinguishable for colour-blind readers.
/// Blue of the palette of Okabe and Ito.
pub const BLUE: RGBColor = RGBColor(0, 114, 178);
/// Vermilion of this palette.
pub const VERMILION: RGBColor = RGBColor(213, 94, 0);
/// Bluish green of this palette.
pub const GREEN: RGBColor = RGBColor(0, 158, 115);
/// Reddish purple of this palette.
pub const PURPLE: RGBColor = RGBColor(204, 121, 167);
/// Sky blue of this palette.
pub const SKY: RGBColor = RGBColor(86, 180, 233);
/// Orange of this palette.
pub const ORANGE: RGBColor = RGBColor(230, 159, 0);

/// Returns the style of a text of this size in pixels; its point is at half its height, at its left end.
pub fn text(size: u32, colour: RGBColor) -> TextStyle<'static> {
    // The backend divides by this number.
    let size = 1.24 * f64::from(px(size));
    TextStyle {
        font: FontDesc::new(FontFamily::SansSerif, size, FontStyle::Normal),
        color: colour.to_backend_color(),
        pos: Pos::new(HPos::Left, VPos::Center),
    }
}

/// Returns the style of the same text in bold.
pub fn bold(size: u32, colour: RGBColor) -> TextStyle<'static> {
    let style = text(size, colour);
    TextStyle {
        font: style.font.style(FontStyle::Bold),
        ..style
    }
}

/// Returns the style of a text that ends at its point.
pub fn right_aligned(style: TextStyle<'_>) -> TextStyle<'_> {
    style.pos(Pos::new(HPos::Right, VPos::Center))
}

/// Returns the style of a text whose middle is at its point.
pub fn centred(style: TextStyle<'_>) -> TextStyle<'_> {
    style.pos(Pos::new(HPos::Center, VPos::Center))
}

/// Writes a line of text at a position in pixels.
pub fn write(area: &Area<'_>, (x, y): (f64, f64), words: &str, style: TextStyle<'_>) -> Drawn {
    area.draw_text(words, &style, at(x, y))
}

/// A kind of line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub colour: RGBColor,
    /// Its width, px.
    pub width: f64,
    /// Lengths of dashes and of gaps, px; none for a solid line.
    pub dashes: Option<(f64, f64)>,
}

impl From<RGBColor> for Stroke {
    /// A solid line of the usual width of curves.
    fn from(colour: RGBColor) -> Self {
        Stroke::new(colour, 1.8)
    }
}

impl Stroke {
    /// Returns a solid line of this width in pixels.
    pub const fn new(colour: RGBColor, width: f64) -> Self {
        Stroke {
            colour,
            width,
            dashes: None,
        }
    }

    /// Returns the same line with dashes and gaps of these lengths in pixels.
    pub const fn dashed(self, dash: f64, gap: f64) -> Self {
        Stroke {
            dashes: Some((dash, gap)),
            ..self
        }
    }
}

/// Draws a line through points, in the coordinates of the area.
pub fn curve<C: CoordTranslate<From: Clone>>(
    area: &DrawingArea<SVGBackend<'_>, C>,
    points: impl IntoIterator<Item = C::From>,
    stroke: Stroke,
) -> Drawn {
    let points: Vec<C::From> = points.into_iter().collect();
    let (width, _) = at(stroke.width, 0.0);
    let style = stroke.colour.stroke_width(width as u32);
    match stroke.dashes {
        None => area.draw(&PathElement::new(points, style)),
        Some((dash, gap)) => {
            let (dash, gap) = at(dash, gap);
            area.draw(&DashedPathElement::new(points, dash, gap, style))
        }
    }
}

/// The shape of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// A disc.
    Disc,
    /// A small disc, one of very many.
    Dot,
    /// A circle with the ground of the page inside.
    Hollow,
    /// A filled square.
    Square,
    /// A filled triangle that points up.
    Triangle,
    /// Two strokes.
    Cross,
}

/// Draws a marker at a point, in the coordinates of the area.
pub fn mark<C: CoordTranslate<From: Clone>>(
    area: &DrawingArea<SVGBackend<'_>, C>,
    place: C::From,
    marker: Marker,
    colour: RGBColor,
) -> Drawn {
    let size = |pixels: f64| at(pixels, 0.0).0;
    let (filled, stroke) = (colour.filled(), |w| colour.stroke_width(size(w) as u32));
    let white = plotters::style::WHITE.filled();
    match marker {
        Marker::Disc => area.draw(&Circle::new(place, size(4.0), filled)),
        Marker::Dot => area.draw(&Circle::new(place, size(1.5), filled)),
        Marker::Hollow => {
            area.draw(&Circle::new(place.clone(), size(3.5), white))?;
            area.draw(&Circle::new(place, size(3.5), stroke(1.5)))
        }
        Marker::Square => {
            let corners = [at(-3.7, -3.7), at(3.7, 3.7)];
            area.draw(&(EmptyElement::at(place) + Rectangle::new(corners, filled)))
        }
        Marker::Triangle => area.draw(&TriangleMarker::new(place, size(5.2), filled)),
        Marker::Cross => area.draw(&Cross::new(place, size(4.0), stroke(2.0))),
    }
}
