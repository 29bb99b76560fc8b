//! Writes SVG text of the few shapes in a drawing. Colours have the notation of CSS (`#282828`).

use std::fmt::Write;

use bgdyn_accuracy::dark::with_dark_mode;
use bgdyn_accuracy::escaped;

/// Colour of bonds and texts.
pub(super) const INK: &str = "#282828";
/// Colour of less important parts.
pub(super) const FAINT: &str = "#777777";
/// Colour of what is wrong.
pub(super) const ALARM: &str = "#c2410c";
/// Colour of thin lines.
pub(super) const GRID: &str = "#e3e3e3";

/// The alignment of a text relative to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    /// The text begins at the point.
    Start,
    /// The text is centred at the point.
    Middle,
}

/// A drawing in progress. Units are pixels, y points down.
#[derive(Debug)]
pub(super) struct Drawing {
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
    pub fn line(&mut self, (x1, y1): (f64, f64), (x2, y2): (f64, f64), colour: &str) {
        writeln!(
            self.body,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{colour}\"/>"
        )
        .expect("text");
    }

    /// Draws a line of this width through points.
    pub fn stroke(&mut self, points: &[(f64, f64)], colour: &str, width: f64) {
        let all = points.iter().map(|(x, y)| format!("{x:.1},{y:.1}"));
        let path = all.collect::<Vec<_>>().join(" ");
        writeln!(
            self.body,
            "<polyline points=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"/>"
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
        };
        let text = escaped(text);
        writeln!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\"{weight} fill=\"{colour}\" text-anchor=\"{anchor}\">{text}</text>"
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
