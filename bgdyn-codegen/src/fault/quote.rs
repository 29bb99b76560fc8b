//! A user's text inside a message: quoted, shortened, on one line.

/// How many characters of a user's text a message repeats.
const QUOTE_WIDTH: usize = 60;

/// A user's text between backticks, on one line and not too long.
pub(crate) fn quote(text: &str) -> String {
    let mut shown: String = text.chars().take(QUOTE_WIDTH).flat_map(escape).collect();
    if text.chars().nth(QUOTE_WIDTH).is_some() {
        shown.push('…');
    }
    format!("`{shown}`")
}

/// A message that may hold a user's text: what would break its line is escaped.
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
