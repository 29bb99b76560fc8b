//! Formats numbers and words for people.

/// A number as short as it can be written without loss: `0.002`, `5e-6`.
pub(crate) fn number(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 || (1e-3..1e5).contains(&size) {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}

/// A number with two or three digits: `0.18`, `3.1e-7`.
pub(crate) fn short(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        "0".into()
    } else if (1e-2..1e6).contains(&size) {
        let decimals = (2 - size.log10().floor() as i32).clamp(0, 4) as usize;
        let text = format!("{x:.decimals$}");
        match text.contains('.') {
            true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
            false => text,
        }
    } else {
        format!("{x:.1e}")
    }
}

/// A time of so many ns in the unit that suits it.
pub(crate) fn time(ns: f64) -> String {
    let (value, unit) = match ns {
        _ if ns < 1e3 => (ns, "ns"),
        _ if ns < 1e6 => (ns / 1e3, "µs"),
        _ => (ns / 1e6, "ms"),
    };
    format!("{} {unit}", short(value))
}

/// A step in the unit that suits it.
pub(crate) fn step(h: f64) -> String {
    let (value, unit) = match h {
        _ if h < 0.9e-3 => (h * 1e6, "µs"),
        _ if h < 0.9 => (h * 1e3, "ms"),
        _ => (h, "s"),
    };
    format!("{} {unit}", short(value))
}

/// Text as HTML and SVG want it.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

#[cfg(test)]
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
