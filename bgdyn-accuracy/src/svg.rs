//! Drawings as SVG text: the few shapes that figures are made of.

use std::fmt::Write;

use crate::text::escaped;

/// Colour of axes and words.
pub(crate) const INK: &str = "#282828";
/// Colour of what stands back.
pub(crate) const FAINT: &str = "#777777";
/// Colour of failures.
pub(crate) const ALARM: &str = "#c2410c";
/// Colour of grid lines.
pub(crate) const GRID: &str = "#e3e3e3";

/// Where a text stands from its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// The shape of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Marker {
    Circle,
    Square,
    Triangle,
    Cross,
}

/// A drawing under way. Units are pixels, y points down.
#[derive(Debug)]
pub(crate) struct Drawing {
    width: f64,
    height: f64,
    body: String,
}

impl Drawing {
    pub fn new(width: f64, height: f64) -> Self {
        Drawing {
            width,
            height,
            body: String::new(),
        }
    }

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

    pub fn curve(&mut self, points: &[(f64, f64)], colour: &str, dashes: &str) {
        let path: Vec<String> = points
            .iter()
            .map(|(x, y)| format!("{x:.1},{y:.1}"))
            .collect();
        let dashes = match dashes {
            "" => String::new(),
            dashes => format!(" stroke-dasharray=\"{dashes}\""),
        };
        writeln!(
            self.body,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.8\"{dashes}/>",
            path.join(" ")
        )
        .expect("text");
    }

    pub fn rectangle(&mut self, (x, y): (f64, f64), (w, h): (f64, f64), colour: &str) {
        writeln!(
            self.body,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"{colour}\"/>"
        )
        .expect("text");
    }

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

    pub fn text(
        &mut self,
        (x, y): (f64, f64),
        size: u32,
        colour: &str,
        anchor: Anchor,
        text: &str,
    ) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let text = escaped(text);
        writeln!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" fill=\"{colour}\" text-anchor=\"{anchor}\">{text}</text>"
        )
        .expect("text");
    }

    /// A text that reads upwards, centred.
    pub fn upright(&mut self, (x, y): (f64, f64), size: u32, text: &str) {
        let text = escaped(text);
        writeln!(
            self.body,
            "<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" font-size=\"{size}\" fill=\"{INK}\" text-anchor=\"middle\">{text}</text>"
        )
        .expect("text");
    }

    /// The drawing as a file's text.
    pub fn finish(self) -> String {
        let Drawing {
            width,
            height,
            body,
        } = self;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{body}</svg>\n"
        )
    }
}
