//! Suggestions for misspelt names: the nearest known word.

use strsim::osa_distance;

/// Returns the word of `known` nearest to `word`, if it is near enough: by insertions, deletions,
/// replacements and swaps of neighbours, up to a third of the longer word's letters.
pub(super) fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_lowercase();
    let length = word.chars().count();
    if length > 64 {
        return None;
    }
    let near = known
        .into_iter()
        .map(|k| (osa_distance(&word, k), k))
        .min_by_key(|(d, _)| *d)?;
    let limit = (length.max(near.1.chars().count()) / 3).max(1);
    (near.0 <= limit && near.0 < length.max(1)).then_some(near.1)
}

/// Returns the message that no `what` has the name `name`, with the nearest of `known`, or `all` of them.
pub(crate) fn unknown_name(what: &str, name: &str, known: &[&str], all: &str) -> String {
    match nearest(name, known.iter().copied()) {
        Some(near) => format!("no {what} is called `{name}`: did you mean `{near}`?"),
        None => format!("no {what} is called `{name}`; there are {all}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_words_are_found_and_far_ones_are_not() {
        let known = ["upper_arm", "forearm", "hand"];
        assert_eq!(nearest("uper_arm", known), Some("upper_arm"));
        assert_eq!(nearest("Forearm", known), Some("forearm"));
        assert_eq!(nearest("hnad", known), Some("hand"));
        assert_eq!(nearest("gripper", known), None);
        assert_eq!(nearest("ixx", ["xx", "yy", "rpy"]), Some("xx"));
        assert_eq!(nearest("", known), None);
        assert_eq!(nearest("q", ["x", "y"]), None);
    }
}
