//! Derivatives of the dynamics along one direction, and their adjoints.

use super::{Argument, Entries, Shape};

/// A derivative along a direction, or an adjoint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Directional {
    /// ∂τ/∂q dq + ∂τ/∂v dv + M da.
    InverseAlong,
    /// ∂q̈/∂q dq + ∂q̈/∂v dv + M⁻¹ dτ.
    ForwardAlong,
    /// (∂τ/∂q)ᵀ l, (∂τ/∂v)ᵀ l, M l.
    InverseAdjoint,
    /// (∂q̈/∂q)ᵀ l, (∂q̈/∂v)ᵀ l, M⁻¹ l.
    ForwardAdjoint,
    /// Second derivatives of l·τ.
    InverseCurvature,
    /// Second derivatives of all efforts.
    InverseSecond,
}

impl Directional {
    /// All of them.
    pub const ALL: [Directional; 6] = [
        Directional::InverseAlong,
        Directional::ForwardAlong,
        Directional::InverseAdjoint,
        Directional::ForwardAdjoint,
        Directional::InverseCurvature,
        Directional::InverseSecond,
    ];

    /// Returns its name.
    pub fn name(self) -> &'static str {
        match self {
            Directional::InverseAlong => "inverse_dynamics_along",
            Directional::ForwardAlong => "forward_dynamics_along",
            Directional::InverseAdjoint => "inverse_dynamics_adjoint",
            Directional::ForwardAdjoint => "forward_dynamics_adjoint",
            Directional::InverseCurvature => "inverse_dynamics_curvature",
            Directional::InverseSecond => "inverse_dynamics_second",
        }
    }

    /// Returns whether it is one of forward dynamics.
    pub fn is_forward(self) -> bool {
        matches!(
            self,
            Directional::ForwardAlong | Directional::ForwardAdjoint
        )
    }

    /// Returns whether it consists of second derivatives.
    pub fn is_second(self) -> bool {
        matches!(
            self,
            Directional::InverseCurvature | Directional::InverseSecond
        )
    }

    pub(super) fn arguments(self) -> &'static [Argument] {
        use Argument::{A, AlongA, AlongQ, AlongTau, AlongV, Cotangent, Q, Tau, V};
        match self {
            Directional::InverseAlong => &[Q, V, A, AlongQ, AlongV, AlongA],
            Directional::ForwardAlong => &[Q, V, Tau, AlongQ, AlongV, AlongTau],
            Directional::InverseAdjoint | Directional::InverseCurvature => &[Q, V, A, Cotangent],
            Directional::ForwardAdjoint => &[Q, V, Tau, Cotangent],
            Directional::InverseSecond => &[Q, V, A],
        }
    }

    pub(super) fn shape(self) -> Shape {
        match self {
            Directional::InverseAlong => Shape::Vector,
            Directional::ForwardAlong => Shape::CheckedVector,
            Directional::InverseAdjoint => Shape::VectorTriple,
            Directional::ForwardAdjoint => Shape::Checked(Entries::VectorTriple),
            Directional::InverseCurvature => Shape::FourSquares,
            Directional::InverseSecond => Shape::FourCubes,
        }
    }

    pub(super) fn summary(self) -> &'static str {
        match self {
            Directional::InverseAlong => {
                "Derivative of the joint efforts along a direction: ∂τ/∂q dq + ∂τ/∂v dv + M da."
            }
            Directional::ForwardAlong => {
                "Derivative of the accelerations along a direction: ∂q̈/∂q dq + ∂q̈/∂v dv + M⁻¹ dtau."
            }
            Directional::InverseAdjoint => {
                "Derivatives of the number l·τ: (∂τ/∂q)ᵀ l, (∂τ/∂v)ᵀ l, M l."
            }
            Directional::ForwardAdjoint => {
                "Derivatives of the number l·q̈: (∂q̈/∂q)ᵀ l, (∂q̈/∂v)ᵀ l, M⁻¹ l."
            }
            Directional::InverseCurvature => {
                "Second derivatives of the number l·τ: by q and q, by q and v, by v and v, by a and q; the first one gives the row. Row i, column j of the first is the derivative along v_j of that along v_i."
            }
            Directional::InverseSecond => {
                "Second derivatives of the joint efforts: by q and q, by q and v, by v and v, by a and q, for each effort a matrix; the first one gives the row. Row i, column j of the first is the derivative along v_j of that along v_i; by a and q means ∂M/∂q."
            }
        }
    }

    pub(super) fn units(self) -> &'static str {
        match self {
            Directional::InverseAlong => "N·m for a rotation, N for a translation",
            Directional::ForwardAlong => "rad/s² for a rotation, m/s² for a translation",
            Directional::InverseAdjoint | Directional::ForwardAdjoint => {
                "that of l·τ or l·q̈, per rad or m, per rad/s or m/s, per unit of the third argument"
            }
            Directional::InverseCurvature => {
                "that of l·τ, per product of rad or m, rad/s or m/s, rad/s² or m/s²"
            }
            Directional::InverseSecond => {
                "N·m for a rotation, N for a translation, per product of rad or m, rad/s or m/s, rad/s² or m/s²"
            }
        }
    }
}
