//! Quotes a user's text in a message: shortened, on one line.

/// Largest number of characters of a user's text in a message.
const QUOTE_WIDTH: usize = 60;

/// Returns a user's text between backticks, on one line and shortened.
pub(crate) fn quote(text: &str) -> String {
    let mut shown: String = text.chars().take(QUOTE_WIDTH).flat_map(escape).collect();
    if text.chars().nth(QUOTE_WIDTH).is_some() {
        shown.push('…');
    }
    format!("`{shown}`")
}

/// Escapes line breaks in a message with a user's text.
pub(crate) fn one_line(message: String) -> String {
    match message.contains(char::is_control) {
        true => message.chars().flat_map(escape).collect(),
        false => message,
    }
}

pub(super) fn escape(c: char) -> Vec<char> {
    if c.is_control() {
        c.escape_default().collect()
    } else {
        vec![c]
    }
}
