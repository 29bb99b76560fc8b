//! What a backend sets for the plans of its functions.

/// What a backend sets.
#[derive(Clone, Copy, Debug)]
pub struct PlanLimits {
    /// Largest number of angles whose sines are computed together; at least 1.
    pub sines: usize,
    /// Smallest number of entries of a result that is stored entry by entry, as soon as each is known. A smaller
    /// result is built at the end.
    pub store_from: usize,
}
