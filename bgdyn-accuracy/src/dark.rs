//! Adds a style sheet to drawings for a dark background.
//!
//! Lightness is that of Oklab (Ottosson 2020), which is perceptually uniform for every hue.

use std::collections::BTreeSet;
use std::fmt::Write;

/// Lightness of the dark background, which replaces white.
const GROUND: f64 = 0.2;
/// Lightness of the colour that replaces black.
const BRIGHT: f64 = 0.97;
/// Least chroma of a distinguishing colour, which retains its hue and stays bright.
const VIVID: f64 = 0.07;
/// Least lightness of such a colour on the dark background.
const LEGIBLE: f64 = 0.64;

/// Returns the drawing with a style sheet for viewers in dark mode.
///
/// Every colour in a `fill` or `stroke` attribute, written as `#rgb`, `#rrggbb`, `black` or `white`, gets
/// a counterpart: pale colours become dark and dark ones pale, and distinguishing colours retain their
/// hue. A drawing that has the style sheet already is returned unchanged.
pub fn with_dark_mode(svg: &str) -> String {
    let root = svg
        .find("<svg")
        .and_then(|from| Some(from + svg[from..].find('>')? + 1));
    let Some(end) = root.filter(|_| !svg.contains("prefers-color-scheme")) else {
        return svg.to_owned();
    };
    let mut rules = String::new();
    // Shapes without a colour are black.
    let _ = write!(rules, "svg:not([fill]){{fill:{}}}", dark([0.0; 3]));
    for (attribute, name) in colours(svg) {
        if let Some(rgb) = parsed(name) {
            let _ = write!(
                rules,
                "[{attribute}=\"{name}\"]{{{attribute}:{}}}",
                dark(rgb)
            );
        }
    }
    let (head, body) = svg.split_at(end);
    format!("{head}\n<style>@media (prefers-color-scheme: dark){{{rules}}}</style>{body}")
}

/// Returns attributes and their colours, in alphabetical order.
fn colours(svg: &str) -> BTreeSet<(&'static str, &str)> {
    let mut found = BTreeSet::new();
    for attribute in ["fill", "stroke"] {
        let start = format!(" {attribute}=\"");
        for (at, _) in svg.match_indices(&start) {
            let rest = &svg[at + start.len()..];
            found.extend(rest.split('"').next().map(|name| (attribute, name)));
        }
    }
    found
}

/// Parses red, green and blue, from 0 to 1.
fn parsed(name: &str) -> Option<[f64; 3]> {
    let digits = match name {
        "white" => "ffffff",
        "black" => "000000",
        name => name.strip_prefix('#')?,
    };
    let wide: String = match digits.len() {
        3 => digits.chars().flat_map(|c| [c, c]).collect(),
        6 => digits.to_owned(),
        _ => return None,
    };
    let part = |k: usize| u8::from_str_radix(wide.get(2 * k..2 * k + 2)?, 16).ok();
    let [r, g, b] = [part(0)?, part(1)?, part(2)?];
    Some([r, g, b].map(|x| f64::from(x) / 255.0))
}

/// Returns the counterpart of a colour on the dark background.
fn dark(rgb: [f64; 3]) -> String {
    let [l, a, b] = oklab(rgb);
    let light = match a.hypot(b) >= VIVID {
        true => l.max(1.12 - l).max(LEGIBLE),
        false => GROUND + (BRIGHT - GROUND) * (1.0 - l).max(0.0).powf(0.75),
    };
    // Less chroma if the screen does not have the colour.
    let with = |part: f64| of_oklab([light, part * a, part * b]);
    let inside = |rgb: &[f64; 3]| rgb.iter().all(|x| (-1e-3..=1.001).contains(x));
    let parts = (0..=20).rev().map(|k| with(f64::from(k) / 20.0));
    let rgb = parts.into_iter().find(inside).unwrap_or([light; 3]);
    let byte = |x: f64| (255.0 * x.clamp(0.0, 1.0)).round() as u8;
    let [r, g, b] = rgb.map(byte);
    format!("#{r:02x}{g:02x}{b:02x}")
}

type Matrix = [[f64; 3]; 3];

fn times(m: &Matrix, x: [f64; 3]) -> [f64; 3] {
    m.map(|row| row[0] * x[0] + row[1] * x[1] + row[2] * x[2])
}

/// Converts to Oklab: lightness, and two coordinates of hue and chroma.
fn oklab(rgb: [f64; 3]) -> [f64; 3] {
    let linear = rgb.map(|x| match x <= 0.04045 {
        true => x / 12.92,
        false => ((x + 0.055) / 1.055).powf(2.4),
    });
    let cones: Matrix = [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ];
    let lab: Matrix = [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ];
    times(&lab, times(&cones, linear).map(f64::cbrt))
}

/// Converts from Oklab.
fn of_oklab(lab: [f64; 3]) -> [f64; 3] {
    let cones: Matrix = [
        [1.0, 0.3963377774, 0.2158037573],
        [1.0, -0.1055613458, -0.0638541728],
        [1.0, -0.0894841775, -1.2914855480],
    ];
    let rgb: Matrix = [
        [4.0767416621, -3.3077115913, 0.2309699292],
        [-1.2684380046, 2.6097574011, -0.3413193965],
        [-0.0041960863, -0.7034186147, 1.7076147010],
    ];
    let linear = times(&rgb, times(&cones, lab).map(|x| x * x * x));
    linear.map(|x| match x <= 0.0031308 {
        true => 12.92 * x,
        false => 1.055 * x.powf(1.0 / 2.4) - 0.055,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the contrast of two colours as defined by WCAG 2.
    fn contrast(a: [f64; 3], b: [f64; 3]) -> f64 {
        let luminance = |rgb: [f64; 3]| {
            let linear = rgb.map(|x| match x <= 0.04045 {
                true => x / 12.92,
                false => ((x + 0.055) / 1.055_f64).powf(2.4),
            });
            0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
        };
        let (a, b) = (luminance(a) + 0.05, luminance(b) + 0.05);
        a.max(b) / a.min(b)
    }

    fn counterpart(rgb: [f64; 3]) -> [f64; 3] {
        parsed(&dark(rgb)).expect("a colour")
    }

    /// Over the whole cube of colours: a colour that is readable on white has a readable counterpart.
    #[test]
    fn what_can_be_read_stays_readable() {
        let ground = counterpart([1.0; 3]);
        assert!(contrast(ground, [0.0; 3]) < 1.4, "a dark ground");
        for k in 0..9_u32.pow(3) {
            let rgb = [k % 9, k / 9 % 9, k / 81].map(|x| f64::from(x) / 8.0);
            let on_white = contrast(rgb, [1.0; 3]);
            let on_dark = contrast(counterpart(rgb), ground);
            assert!(
                on_dark >= on_white.min(4.3),
                "{rgb:?}: {on_white:.2} on white, {on_dark:.2} on {}",
                dark(rgb)
            );
        }
    }

    #[test]
    fn colours_are_read_as_they_are_written() {
        assert_eq!(parsed("#fff"), parsed("white"));
        assert_eq!(parsed("#0072B2"), parsed("#0072b2"));
        assert_eq!(parsed("none"), None);
        assert_eq!(parsed("#ü12345"), None);
        for rgb in [[0.0; 3], [1.0; 3], [0.2, 0.5, 0.9]] {
            let there_and_back = of_oklab(oklab(rgb));
            let close = rgb
                .iter()
                .zip(there_and_back)
                .all(|(a, b)| (a - b).abs() < 1e-6);
            assert!(close, "{rgb:?} becomes {there_and_back:?}");
        }
    }

    #[test]
    fn every_colour_of_a_drawing_has_its_rule() {
        let svg =
            "<svg width=\"2\"><rect fill=\"#fff\"/><line stroke=\"#0072B2\" fill=\"none\"/></svg>";
        let both = with_dark_mode(svg);
        for rule in [
            "[fill=\"#fff\"]{fill:#",
            "[stroke=\"#0072B2\"]{stroke:#",
            "svg:not([fill])",
        ] {
            assert!(both.contains(rule), "{both}");
        }
        assert!(!both.contains("[fill=\"none\"]"));
        assert_eq!(with_dark_mode(&both), both, "once is enough");
        assert_eq!(with_dark_mode("no drawing"), "no drawing");
    }
}
