//! The rigid contacts in a step of an integrator that solves for their impulses.

use bgdyn_runtime::MOST_CONTACTS;

/// The rigid contacts in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactStep<T> {
    /// p, N·s along (x, y, normal) of each contact; 0 for those that are open. p/h is the mean force in the step.
    pub impulses: [[T; 3]; MOST_CONTACTS],
    /// The energy that each contact takes, J: −p·(γ⁻ + γ⁺)/2.
    pub losses: [T; MOST_CONTACTS],
    /// The residual of the impulses, N·s, as [`crate::cone::ContactOutcome::residual`].
    pub residual: T,
    /// Whether it meets the tolerance.
    pub solved: bool,
    /// The deepest overlap of a contact at the end of the step, m; 0 without overlap.
    pub depth: T,
}
