//! Rules for names: snake_case identifiers of Rust that are no keywords.

use heck::ToSnakeCase;

/// The name of the fixed base; no link or frame can have it.
pub const WORLD: &str = "world";

/// Rust's keywords, strict and reserved, of every edition.
#[rustfmt::skip]
const KEYWORDS: [&str; 52] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate",
    "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl",
    "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
    "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while", "yield", "_",
];

/// Returns whether `text` is a keyword of Rust.
pub fn is_keyword(text: &str) -> bool {
    KEYWORDS.contains(&text)
}

/// Returns whether `text` can name a mechanism, link, frame or joint: words of `a`–`z` and digits joined
/// by single `_`, a letter first, no keyword.
pub fn is_identifier(text: &str) -> bool {
    let word = |w: &str| {
        !w.is_empty()
            && w.bytes()
                .all(|b| b.is_ascii_lowercase() || b.is_ascii_digit())
    };
    text.starts_with(|c: char| c.is_ascii_lowercase())
        && text.split('_').all(word)
        && !is_keyword(text)
}

/// Returns `text` in snake_case: lower case, `_` between words and for characters that are no ASCII
/// letters or digits, `n` before a leading digit. The result may be empty, or a keyword.
pub fn snake_case(text: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let spaced: String = text.chars().map(plain).collect();
    let mut name = spaced.to_snake_case();
    if name.starts_with(|c: char| c.is_ascii_digit()) {
        name.insert(0, 'n');
    }
    name
}

/// Returns the identifier nearest to `text`: in snake_case, with `_n` after a keyword. `None` if no letter
/// or digit is left.
pub fn to_identifier(text: &str) -> Option<String> {
    let mut name = snake_case(text);
    if is_keyword(&name) {
        name += "_n";
    }
    (!name.is_empty()).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers() {
        for good in ["a", "arm", "upper_arm", "iiwa14", "link_1_2", "q2d"] {
            assert!(is_identifier(good), "{good}");
        }
        for bad in [
            "", "_", "a_", "_a", "a__b", "Arm", "1a", "a-b", "a b", "ä", "fn", "self", "gen",
        ] {
            assert!(!is_identifier(bad), "{bad}");
        }
    }

    #[test]
    fn anything_with_a_letter_becomes_an_identifier() {
        assert_eq!(to_identifier("Upper Arm").as_deref(), Some("upper_arm"));
        assert_eq!(
            to_identifier("LHipYawLink").as_deref(),
            Some("l_hip_yaw_link")
        );
        assert_eq!(to_identifier("FR_hip").as_deref(), Some("fr_hip"));
        assert_eq!(to_identifier("1-dof").as_deref(), Some("n1_dof"));
        assert_eq!(to_identifier("fn").as_deref(), Some("fn_n"));
        assert_eq!(to_identifier("__x__y").as_deref(), Some("x_y"));
        assert_eq!(to_identifier("—"), None);
        for text in [
            "Upper Arm",
            "1-dof",
            "fn",
            "__x__y",
            "Schulter (links)",
            "self",
        ] {
            assert!(
                to_identifier(text).is_some_and(|n| is_identifier(&n)),
                "{text}"
            );
        }
    }
}
