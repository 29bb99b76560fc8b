//! Groups warnings by kind.

/// Warnings of one kind, reported in one line with the names they are about.
#[derive(Default)]
pub(super) struct Groups(Vec<(&'static str, Vec<String>)>);

impl Groups {
    /// Adds a name to a kind of warning.
    pub(super) fn add(&mut self, kind: &'static str, item: String) {
        match self.0.iter_mut().find(|(known, _)| *known == kind) {
            Some((_, items)) => items.push(item),
            None => self.0.push((kind, vec![item])),
        }
    }

    /// Returns one line for each kind.
    pub(super) fn lines(self) -> impl Iterator<Item = String> {
        self.0
            .into_iter()
            .map(|(kind, items)| format!("{kind}: {}", items.join("; ")))
    }
}
