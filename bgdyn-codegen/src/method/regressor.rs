//! Regressors: the methods that are linear in the parameters of the bodies.
//!
//! A body is a moving link with everything fixed to it. It has ten parameters π: m, the first moments mx, my, mz, and
//! the tensor Ixx, Ixy, Iyy, Ixz, Iyz, Izz about the origin of the link, in link axes (the order of Pinocchio). The
//! base parameters π_b = K π are the combinations that efforts depend on.

use super::{Argument, ParameterSet, Shape};

/// Number of parameters of a body.
pub const PARAMETERS_PER_BODY: usize = 10;

/// Names of the parameters of a body, in order.
pub const PARAMETER_NAMES: [&str; PARAMETERS_PER_BODY] = [
    "m", "mx", "my", "mz", "Ixx", "Ixy", "Iyy", "Ixz", "Iyz", "Izz",
];

/// A method that is linear in the parameters of the bodies, or one of their vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Regressor {
    /// Y(q, v, a): τ = Y π.
    Full,
    /// Y_b(q, v, a): τ = Y_b π_b.
    Base,
    /// Y(q, 0, 0).
    Gravity,
    /// Y_b(q, 0, 0).
    BaseGravity,
    /// Y_b of two velocities: M a_r + C(q, v) v_r + g = Y_b π_b (Slotine and Li 1987).
    Adaptive,
    /// Y_bᵀ s of two velocities.
    AdaptiveStep,
    /// Y_b(q, v, a)ᵀ s.
    TransposedTimes,
    /// M v = Y_p π.
    Momentum,
    /// M v = Y_p π_b.
    BaseMomentum,
    /// T = Y_T π.
    KineticEnergy,
    /// V = Y_V π.
    PotentialEnergy,
    /// π.
    Parameters,
    /// K π for any π.
    BaseParameters,
}

impl Regressor {
    /// All of them.
    pub const ALL: [Regressor; 13] = [
        Regressor::Full,
        Regressor::Base,
        Regressor::Gravity,
        Regressor::BaseGravity,
        Regressor::Adaptive,
        Regressor::AdaptiveStep,
        Regressor::TransposedTimes,
        Regressor::Momentum,
        Regressor::BaseMomentum,
        Regressor::KineticEnergy,
        Regressor::PotentialEnergy,
        Regressor::Parameters,
        Regressor::BaseParameters,
    ];

    /// Returns its name.
    pub fn name(self) -> &'static str {
        match self {
            Regressor::Full => "regressor",
            Regressor::Base => "base_regressor",
            Regressor::Gravity => "gravity_regressor",
            Regressor::BaseGravity => "base_gravity_regressor",
            Regressor::Adaptive => "adaptive_regressor",
            Regressor::AdaptiveStep => "adaptive_step",
            Regressor::TransposedTimes => "base_regressor_transposed_times",
            Regressor::Momentum => "momentum_regressor",
            Regressor::BaseMomentum => "base_momentum_regressor",
            Regressor::KineticEnergy => "kinetic_energy_regressor",
            Regressor::PotentialEnergy => "potential_energy_regressor",
            Regressor::Parameters => "parameters",
            Regressor::BaseParameters => "base_parameters",
        }
    }

    /// Returns its arguments.
    pub fn arguments(self) -> &'static [Argument] {
        use Argument::{A, BodyParameters, Direction, Q, ReferenceA, ReferenceV, V};
        match self {
            Regressor::Full | Regressor::Base => &[Q, V, A],
            Regressor::Gravity | Regressor::BaseGravity | Regressor::PotentialEnergy => &[Q],
            Regressor::Adaptive => &[Q, V, ReferenceV, ReferenceA],
            Regressor::AdaptiveStep => &[Q, V, ReferenceV, ReferenceA, Direction],
            Regressor::TransposedTimes => &[Q, V, A, Direction],
            Regressor::Momentum | Regressor::BaseMomentum => &[Q, V],
            Regressor::KineticEnergy => &[Q, V],
            Regressor::Parameters => &[],
            Regressor::BaseParameters => &[BodyParameters],
        }
    }

    /// Returns what its columns, or the elements of its result, belong to.
    pub fn set(self) -> ParameterSet {
        match self {
            Regressor::Full | Regressor::Gravity | Regressor::Parameters => ParameterSet::Bodies,
            Regressor::Momentum => ParameterSet::Bodies,
            Regressor::KineticEnergy | Regressor::PotentialEnergy => ParameterSet::Bodies,
            _ => ParameterSet::Base,
        }
    }

    /// Returns whether it depends on the motion of a base that is given.
    pub fn moves_with_base(self) -> bool {
        !matches!(
            self,
            Regressor::Momentum
                | Regressor::BaseMomentum
                | Regressor::KineticEnergy
                | Regressor::PotentialEnergy
        )
    }

    /// Returns the shape of its result.
    pub fn shape(self) -> Shape {
        match self {
            Regressor::Full
            | Regressor::Base
            | Regressor::Gravity
            | Regressor::BaseGravity
            | Regressor::Adaptive
            | Regressor::Momentum
            | Regressor::BaseMomentum => Shape::ParameterColumns(self.set()),
            _ => Shape::ParameterVector(self.set()),
        }
    }

    /// Describes the result: one line of documentation.
    pub fn summary(self) -> &'static str {
        match self {
            Regressor::Full => {
                "Regressor Y: the joint efforts are Y π, with the parameters π of the bodies as in [`BODY_NAMES`], beside those of the rotors."
            }
            Regressor::Base => {
                "Regressor Y_b of the base parameters: the joint efforts are Y_b π_b, as in [`BASE_PARAMETERS`], beside those of the rotors."
            }
            Regressor::Gravity => "Regressor of the joint efforts at rest: gravity is Y π.",
            Regressor::BaseGravity => {
                "Regressor of the joint efforts at rest by base parameters: gravity is Y_b π_b."
            }
            Regressor::Adaptive => {
                "Regressor of two velocities (Slotine and Li 1987): M(q) a_r + C(q, v) v_r + gravity = Y_b π_b, with Christoffel's C."
            }
            Regressor::AdaptiveStep => {
                "Y_bᵀ s with the regressor Y_b of two velocities: the direction of an adaptation law."
            }
            Regressor::TransposedTimes => "Y_bᵀ s with the regressor Y_b of the base parameters.",
            Regressor::Momentum => {
                "Regressor of the momenta: M(q) v = Y_p π, beside those of the rotors."
            }
            Regressor::BaseMomentum => {
                "Regressor of the momenta by base parameters: M(q) v = Y_p π_b, beside those of the rotors."
            }
            Regressor::KineticEnergy => {
                "Kinetic energy by the parameters of the bodies: the products with π sum to T, beside the energy of the rotors."
            }
            Regressor::PotentialEnergy => {
                "Potential energy of gravity by the parameters of the bodies: the products with π sum to V, beside that of links fixed to the world."
            }
            Regressor::Parameters => {
                "Parameters π of the bodies, ten for each as in [`BODY_NAMES`]: m, mx, my, mz, Ixx, Ixy, Iyy, Ixz, Iyz, Izz about the origin of the link, in its axes."
            }
            Regressor::BaseParameters => {
                "Base parameters π_b = K π, as in [`BASE_PARAMETERS`], of any parameters `pi` of the bodies."
            }
        }
    }

    /// Returns the units of the result.
    pub fn units(self) -> &'static str {
        match self {
            Regressor::Parameters | Regressor::BaseParameters => "kg, kg·m, kg·m²",
            Regressor::AdaptiveStep | Regressor::TransposedTimes => {
                "units of s times efforts, per kg, kg·m, kg·m²"
            }
            Regressor::KineticEnergy | Regressor::PotentialEnergy => "J per kg, kg·m, kg·m²",
            Regressor::Momentum | Regressor::BaseMomentum => "momenta per kg, kg·m, kg·m²",
            _ => "N·m for a rotation, N for a translation, per kg, kg·m, kg·m²",
        }
    }
}
