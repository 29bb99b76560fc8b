//! Methods that are computed in one call.

use super::{Argument, Method, Shape};

use Argument::{A, ActuatedTau, AlongA, AlongQ, AlongTau, AlongV, Cotangent, Q, Tau, V};

/// The lists of arguments that a bundle may have, the shortest first. A direction and factors of results are the same
/// leaves of the graph, as are the third direction of inverse dynamics and τ, and that of forward dynamics and a: no list
/// has both.
const ARGUMENTS: [&[Argument]; 12] = [
    &[Q],
    &[Q, V],
    &[Q, V, A],
    &[Q, V, Tau],
    &[Q, V, ActuatedTau],
    &[Q, V, A, Cotangent],
    &[Q, V, Tau, Cotangent],
    &[Q, V, A, Tau],
    &[Q, V, A, ActuatedTau],
    &[Q, V, A, Tau, Cotangent],
    &[Q, V, A, AlongQ, AlongV, AlongA],
    &[Q, V, Tau, AlongQ, AlongV, AlongTau],
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
        let names_a_joint = matches!(
            shape,
            Shape::CheckedVector
                | Shape::CheckedSquares
                | Shape::CheckedSlopesByTree
                | Shape::CheckedWrenches
                | Shape::Checked(_)
        );
        Method::bundle(&[self]).is_some()
            && (!shape.checked() || names_a_joint)
            && !matches!(self, Method::Scene(_) | Method::Bundle { .. })
    }
}
