//! Writes SVG text of the few shapes in figures.
//!
//! Colours have the notation of CSS (`#282828`); dashes that of `stroke-dasharray`, empty for a solid
//! line.

use std::fmt::Write;

use crate::dark::with_dark_mode;
use crate::format::escaped;

/// Colour of axes and texts.
pub const INK: &str = "#282828";
/// Colour of less important parts.
pub const FAINT: &str = "#777777";
/// Colour of failures.
pub const ALARM: &str = "#c2410c";
/// Colour of grid lines.
pub const GRID: &str = "#e3e3e3";

/// The alignment of a text relative to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// The text begins at the point.
    Start,
    /// The text is centred at the point.
    Middle,
    /// The text ends at the point.
    End,
}

/// The shape of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// A disc.
    Circle,
    /// A filled square.
    Square,
    /// A filled triangle that points up.
    Triangle,
    /// Two strokes.
    Cross,
}

/// A drawing in progress. Units are pixels, y points down.
#[derive(Debug)]
pub struct Drawing {
    width: f64,
    height: f64,
    body: String,
}

impl Drawing {
    /// Returns an empty drawing of this size.
    pub fn new(width: f64, height: f64) -> Self {
        Drawing {
            width,
            height,
            body: String::new(),
        }
    }

    /// Returns its width.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Draws a straight line, one pixel wide.
    pub fn line(&mut self, from: (f64, f64), to: (f64, f64), colour: &str, dashes: &str) {
        let dashes = match dashes {
            "" => String::new(),
            dashes => format!(" stroke-dasharray=\"{dashes}\""),
        };
        let ((x1, y1), (x2, y2)) = (from, to);
        writeln!(
            self.body,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{colour}\"{dashes}/>"
        )
        .expect("text");
    }

    /// Draws a line through points.
    pub fn curve(&mut self, points: &[(f64, f64)], colour: &str, dashes: &str) {
        self.polyline(points, colour, 1.8, dashes);
    }

    /// Draws a line of this width through points.
    pub fn stroke(&mut self, points: &[(f64, f64)], colour: &str, width: f64) {
        self.polyline(points, colour, width, "");
    }

    fn polyline(&mut self, points: &[(f64, f64)], colour: &str, width: f64, dashes: &str) {
        let path = polyline(points);
        let dashes = match dashes {
            "" => String::new(),
            dashes => format!(" stroke-dasharray=\"{dashes}\""),
        };
        writeln!(
            self.body,
            "<polyline points=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"{dashes}/>"
        )
        .expect("text");
    }

    /// Draws a filled rectangle from its upper left corner.
    pub fn rectangle(&mut self, (x, y): (f64, f64), (w, h): (f64, f64), colour: &str) {
        writeln!(
            self.body,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"{colour}\"/>"
        )
        .expect("text");
    }

    /// Draws a filled polygon.
    pub fn area(&mut self, points: &[(f64, f64)], colour: &str) {
        let corners = polyline(points);
        writeln!(
            self.body,
            "<polygon points=\"{corners}\" fill=\"{colour}\"/>"
        )
        .expect("text");
    }

    /// Draws a disc of this radius.
    pub fn disc(&mut self, (x, y): (f64, f64), radius: f64, colour: &str) {
        writeln!(
            self.body,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{colour}\"/>"
        )
        .expect("text");
    }

    /// Draws a marker.
    pub fn marker(&mut self, (x, y): (f64, f64), marker: Marker, colour: &str) {
        let r = 4.0;
        let path = |points: &[(f64, f64)]| {
            let all = points
                .iter()
                .map(|(dx, dy)| format!("{:.1},{:.1}", x + dx, y + dy));
            all.collect::<Vec<_>>().join(" ")
        };
        let shape = match marker {
            Marker::Circle => {
                format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r}\" fill=\"{colour}\"/>")
            }
            Marker::Square => format!(
                "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"7.4\" height=\"7.4\" fill=\"{colour}\"/>",
                x - 3.7,
                y - 3.7
            ),
            Marker::Triangle => {
                let corners = path(&[(0.0, -5.0), (4.8, 3.8), (-4.8, 3.8)]);
                format!("<polygon points=\"{corners}\" fill=\"{colour}\"/>")
            }
            Marker::Cross => {
                let (a, b) = (path(&[(-r, -r), (r, r)]), path(&[(-r, r), (r, -r)]));
                let style = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"");
                format!("<polyline points=\"{a}\" {style}/><polyline points=\"{b}\" {style}/>")
            }
        };
        writeln!(self.body, "{shape}").expect("text");
    }

    /// Writes a line of text; the point is on its baseline.
    pub fn text(&mut self, at: (f64, f64), size: u32, colour: &str, anchor: Anchor, text: &str) {
        self.words(at, size, "", (colour, anchor, text));
    }

    /// Writes the same in bold.
    pub fn bold(&mut self, at: (f64, f64), size: u32, colour: &str, anchor: Anchor, text: &str) {
        self.words(at, size, " font-weight=\"bold\"", (colour, anchor, text));
    }

    fn words(
        &mut self,
        (x, y): (f64, f64),
        size: u32,
        weight: &str,
        (colour, anchor, text): (&str, Anchor, &str),
    ) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let text = escaped(text);
        writeln!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\"{weight} fill=\"{colour}\" text-anchor=\"{anchor}\">{text}</text>"
        )
        .expect("text");
    }

    /// Writes a vertical text, upwards and centred.
    pub fn upright(&mut self, (x, y): (f64, f64), size: u32, text: &str) {
        let text = escaped(text);
        writeln!(
            self.body,
            "<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" font-size=\"{size}\" fill=\"{INK}\" text-anchor=\"middle\">{text}</text>"
        )
        .expect("text");
    }

    /// Begins a group of shapes; viewers show the title as a tooltip of its shapes.
    pub fn group(&mut self, title: &str) {
        writeln!(self.body, "<g><title>{}</title>", escaped(title)).expect("text");
    }

    /// Ends the group.
    pub fn end_group(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// Returns the drawing as a file's text, for light and dark pages.
    pub fn finish(self) -> String {
        let Drawing {
            width,
            height,
            body,
        } = self;
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{body}</svg>\n"
        );
        with_dark_mode(&svg)
    }
}

/// Returns points in the notation of SVG, in tenths of a pixel.
fn polyline(points: &[(f64, f64)]) -> String {
    let all = points.iter().map(|(x, y)| format!("{x:.1},{y:.1}"));
    all.collect::<Vec<_>>().join(" ")
}
