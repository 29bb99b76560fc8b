//! Methods that are computed in one call.

use super::{Argument, Method, Shape};

use Argument::{A, ActuatedTau, Q, Tau, V};

/// The lists of arguments that a bundle may have, the shortest first.
const ARGUMENTS: [&[Argument]; 7] = [
    &[Q],
    &[Q, V],
    &[Q, V, A],
    &[Q, V, Tau],
    &[Q, V, ActuatedTau],
    &[Q, V, A, Tau],
    &[Q, V, A, ActuatedTau],
];

impl Method {
    /// Returns the method that computes all of these in one call; `None` if there is no list of arguments for them.
    pub fn bundle(parts: &[Method]) -> Option<Method> {
        let reads = parts.iter().flat_map(|part| part.arguments());
        let reads: Vec<&Argument> = reads.collect();
        let fits = |list: &&&[Argument]| reads.iter().all(|argument| list.contains(argument));
        let arguments = ARGUMENTS.iter().find(fits)?;
        let checked = parts.iter().any(|part| part.shape().checked());
        Some(Method::Bundle { arguments, checked })
    }

    /// Returns whether it can be a part of a bundle: a result for positions that fit together, or without one an error
    /// that names a joint among those of the accelerations.
    pub fn may_be_bundled(self) -> bool {
        let shape = self.shape();
        let arguments = self.arguments().iter();
        let known = |argument: &&Argument| matches!(argument, Q | V | A | Tau | ActuatedTau);
        let names_a_joint = matches!(
            shape,
            Shape::CheckedVector
                | Shape::CheckedSquares
                | Shape::CheckedSlopesByTree
                | Shape::CheckedWrenches
                | Shape::Checked(_)
        );
        arguments.clone().count() == arguments.filter(known).count()
            && (!shape.checked() || names_a_joint)
            && !matches!(self, Method::Scene(_) | Method::Bundle { .. })
    }
}
