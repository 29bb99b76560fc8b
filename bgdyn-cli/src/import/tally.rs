//! Counts what a file has and a mechanism does not.

/// The omitted things, in the order of first occurrence: name, count, number of mesh files.
#[derive(Default)]
pub(super) struct Tally(Vec<(String, usize, usize)>);

impl Tally {
    /// Counts one thing, with the number of mesh files in it.
    pub(super) fn count(&mut self, what: String, meshes: usize) {
        match self.0.iter_mut().find(|(known, ..)| *known == what) {
            Some((_, times, all)) => {
                *times += 1;
                *all += meshes;
            }
            None => self.0.push((what, 1, meshes)),
        }
    }

    /// Returns one line for each kind of thing.
    pub(super) fn lines(self) -> impl Iterator<Item = String> {
        self.0.into_iter().map(|(what, times, meshes)| {
            let times = plural(times, "time");
            match meshes {
                0 => format!("not imported: {what} ({times})"),
                _ => format!(
                    "not imported: {what} ({times}, with {})",
                    plural(meshes, "mesh file")
                ),
            }
        })
    }
}

/// Returns `1 time`, `3 times`.
pub(super) fn plural(count: usize, word: &str) -> String {
    match count {
        1 => format!("1 {word}"),
        _ => format!("{count} {word}s"),
    }
}
