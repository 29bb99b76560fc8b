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
