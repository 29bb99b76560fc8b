//! Splits Rust text into words and signs.

/// Returns the words and signs of a file, without comments, strings and code under `#[cfg(test)]`.
pub fn code(text: &str) -> Vec<String> {
    without_tests(words(text))
}

/// Returns words and signs: `::` is one sign; comments and strings are omitted.
fn words(text: &str) -> Vec<String> {
    let c: Vec<char> = text.chars().collect();
    let at = |i: usize| c.get(i).copied().unwrap_or('\0');
    let (mut words, mut i) = (Vec::new(), 0);
    while i < c.len() {
        let raw =
            c[i] == 'r' && (at(i + 1) == '"' || (at(i + 1) == '#' && "#\"".contains(at(i + 2))));
        if c[i] == '/' && at(i + 1) == '/' {
            while i < c.len() && c[i] != '\n' {
                i += 1;
            }
        } else if c[i] == '/' && at(i + 1) == '*' {
            i += 2;
            while i < c.len() && !(c[i] == '*' && at(i + 1) == '/') {
                i += 1;
            }
            i += 2;
        } else if raw {
            let hashes = (i + 1..).take_while(|&k| at(k) == '#').count();
            i += hashes + 2;
            let ends = |i: usize| at(i) == '"' && (1..=hashes).all(|k| at(i + k) == '#');
            while i < c.len() && !ends(i) {
                i += 1;
            }
            i += hashes + 1;
        } else if c[i] == '"' {
            i += 1;
            while i < c.len() && c[i] != '"' {
                i += if c[i] == '\\' { 2 } else { 1 };
            }
            i += 1;
        } else if c[i] == '\'' && (at(i + 1) == '\\' || at(i + 2) == '\'') {
            // A character literal; else a lifetime.
            i += if at(i + 1) == '\\' { 3 } else { 2 };
            while i < c.len() && c[i] != '\'' {
                i += 1;
            }
            i += 1;
        } else if c[i].is_alphanumeric() || c[i] == '_' {
            let start = i;
            while i < c.len() && (c[i].is_alphanumeric() || c[i] == '_') {
                i += 1;
            }
            words.push(c[start..i].iter().collect());
        } else if c[i] == ':' && at(i + 1) == ':' {
            words.push("::".into());
            i += 2;
        } else {
            if !c[i].is_whitespace() {
                words.push(c[i].to_string());
            }
            i += 1;
        }
    }
    words
}

/// Removes each item after `#[cfg(test)]`: up to its `;` or its last brace.
fn without_tests(words: Vec<String>) -> Vec<String> {
    let mark = ["#", "[", "cfg", "(", "test", ")", "]"];
    let (mut left, mut i) = (Vec::new(), 0);
    while i < words.len() {
        if !words[i..].iter().take(mark.len()).eq(mark.iter()) {
            left.push(words[i].clone());
            i += 1;
            continue;
        }
        let mut depth = 0;
        while i < words.len() {
            match words[i].as_str() {
                "{" => depth += 1,
                "}" => depth -= 1,
                _ => {}
            }
            let ends = words[i] == "}" || words[i] == ";";
            i += 1;
            if ends && depth == 0 {
                break;
            }
        }
    }
    left
}
