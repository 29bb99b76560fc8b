//! "Did you mean …?": the known word nearest to the one written.

/// The nearest of `known` to `word`, if it is near enough to be meant.
pub(super) fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_lowercase();
    let length = word.chars().count();
    if length > 64 {
        return None;
    }
    let near = known
        .into_iter()
        .map(|k| (distance(&word, k), k))
        .min_by_key(|(d, _)| *d)?;
    let limit = (length.max(near.1.chars().count()) / 3).max(1);
    (near.0 <= limit && near.0 < length.max(1)).then_some(near.1)
}

/// No `what` is called `name`: the nearest of `known`, or `all` of them.
pub(crate) fn unknown_name(what: &str, name: &str, known: &[&str], all: &str) -> String {
    match nearest(name, known.iter().copied()) {
        Some(near) => format!("no {what} is called `{name}`: did you mean `{near}`?"),
        None => format!("no {what} is called `{name}`; there are {all}"),
    }
}

/// Insertions, deletions, replacements and swaps of neighbours that lead from `a` to `b`.
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let replaced = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut best = replaced.min(rows[i - 1][j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(rows[i - 2][j - 2] + 1);
            }
            row.push(best);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
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
