//! A size and a constant array of a pair of files.

/// A size: the end of its macro's name, its meaning, its value.
pub(super) type Size = (&'static str, &'static str, usize);

/// A constant array.
pub(super) struct Table {
    /// What it has, in one sentence.
    pub(super) about: &'static str,
    /// Type of its elements, its name and its size.
    pub(super) declaration: String,
    /// Its elements in C.
    pub(super) elements: Vec<String>,
}
