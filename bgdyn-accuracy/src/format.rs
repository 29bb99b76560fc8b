//! Formats numbers and words for people.

use bgdyn_runtime::Digits;

/// Prints a number in the shortest form without loss: `0.002`, `5e-6`.
pub(crate) fn number(x: f64) -> String {
    Digits::shortest(x).plain(-3..5).to_string()
}

/// Prints a number with two or three digits: `0.18`, `3.1e-7`.
pub(crate) fn short(x: f64) -> String {
    match x == 0.0 || (1e-2..1e6).contains(&x.abs()) {
        true => Digits::new(x, 3).plain(-2..7).to_string(),
        false => Digits::new(x, 2).plain(0..0).with_zeros().to_string(),
    }
}

/// Prints a time given in ns, in a suitable unit.
#[cfg(feature = "plot")]
pub(crate) fn time(ns: f64) -> String {
    let (value, unit) = match ns {
        _ if ns < 1e3 => (ns, "ns"),
        _ if ns < 1e6 => (ns / 1e3, "µs"),
        _ => (ns / 1e6, "ms"),
    };
    format!("{} {unit}", short(value))
}

/// Prints a step in a suitable unit.
#[cfg(feature = "plot")]
pub(crate) fn step(h: f64) -> String {
    let (value, unit) = match h {
        _ if h < 0.9e-3 => (h * 1e6, "µs"),
        _ if h < 0.9 => (h * 1e3, "ms"),
        _ => (h, "s"),
    };
    format!("{} {unit}", short(value))
}

/// Escapes text for HTML and SVG.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

#[cfg(all(test, feature = "plot"))]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_exact() {
        assert_eq!(number(0.002), "0.002");
        assert_eq!(number(5e-6), "5e-6");
        assert_eq!(short(0.1234), "0.123");
        assert_eq!(short(20.0), "20");
        assert_eq!(short(640.0), "640");
        assert_eq!(time(812.3), "812 ns");
        assert_eq!(time(81230.0), "81.2 µs");
        assert_eq!(step(0.05 / 4.0), "12.5 ms");
    }
}
