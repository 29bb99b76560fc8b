//! The methods a generated model has: names, arguments, shapes, units. One list, read by the
//! formulations, the emitter and the command line.

/// An argument of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Argument {
    /// Positions q: rad, m.
    Q,
    /// Velocities v: rad/s, m/s.
    V,
    /// Accelerations a: rad/s², m/s².
    A,
    /// Joint efforts tau: N·m, N.
    Tau,
}

impl Argument {
    /// Its name in signatures and in files of states.
    pub fn name(self) -> &'static str {
        match self {
            Argument::Q => "q",
            Argument::V => "v",
            Argument::A => "a",
            Argument::Tau => "tau",
        }
    }
}

/// What a method returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One number.
    Scalar,
    /// NV numbers.
    Vector,
    /// NV numbers, or the error that names a joint.
    CheckedVector,
    /// A symmetric NV × NV matrix; the expressions are its lower triangle, row by row.
    Symmetric,
}

impl Shape {
    /// How many expressions make the result.
    pub fn len(self, nv: usize) -> usize {
        match self {
            Shape::Scalar => 1,
            Shape::Vector | Shape::CheckedVector => nv,
            Shape::Symmetric => nv * (nv + 1) / 2,
        }
    }
}

/// A method of a generated model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// P_j of equation (6).
    InverseDynamics,
    /// M(q).
    MassMatrix,
    /// P − M a.
    Bias,
    /// P at rest.
    Gravity,
    /// Accelerations under given efforts.
    ForwardDynamics,
    /// T(q, v).
    KineticEnergy,
    /// V(q).
    PotentialEnergy,
}

impl Method {
    /// Every method, in the order of the output.
    pub const ALL: [Method; 7] = [
        Method::InverseDynamics,
        Method::MassMatrix,
        Method::Bias,
        Method::Gravity,
        Method::ForwardDynamics,
        Method::KineticEnergy,
        Method::PotentialEnergy,
    ];

    /// The method with this name.
    pub fn by_name(name: &str) -> Option<Method> {
        Method::ALL.into_iter().find(|m| m.name() == name)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Method::InverseDynamics => "inverse_dynamics",
            Method::MassMatrix => "mass_matrix",
            Method::Bias => "bias",
            Method::Gravity => "gravity",
            Method::ForwardDynamics => "forward_dynamics",
            Method::KineticEnergy => "kinetic_energy",
            Method::PotentialEnergy => "potential_energy",
        }
    }

    /// Its arguments.
    pub fn arguments(self) -> &'static [Argument] {
        use Argument::{A, Q, Tau, V};
        match self {
            Method::InverseDynamics => &[Q, V, A],
            Method::MassMatrix | Method::Gravity | Method::PotentialEnergy => &[Q],
            Method::Bias | Method::KineticEnergy => &[Q, V],
            Method::ForwardDynamics => &[Q, V, Tau],
        }
    }

    /// Its result.
    pub fn shape(self) -> Shape {
        match self {
            Method::InverseDynamics | Method::Bias | Method::Gravity => Shape::Vector,
            Method::ForwardDynamics => Shape::CheckedVector,
            Method::MassMatrix => Shape::Symmetric,
            Method::KineticEnergy | Method::PotentialEnergy => Shape::Scalar,
        }
    }

    /// What the result is: one line of documentation.
    pub fn summary(self) -> &'static str {
        match self {
            Method::InverseDynamics => {
                "Joint efforts that produce the accelerations `a` (Kuzmin 2007, eq. 6)."
            }
            Method::MassMatrix => "Mass matrix M(q), exactly symmetric.",
            Method::Bias => "Bias force: everything in the joint efforts but M(q)·a.",
            Method::Gravity => "Joint efforts that hold the mechanism at rest.",
            Method::ForwardDynamics => {
                "Accelerations under the joint efforts `tau`: M⁻¹(tau − bias)."
            }
            Method::KineticEnergy => "Kinetic energy ½ vᵀ M(q) v.",
            Method::PotentialEnergy => {
                "Potential energy of gravity; zero with every centre of mass at the world's origin."
            }
        }
    }

    /// Units of the result.
    pub fn units(self) -> &'static str {
        match self {
            Method::InverseDynamics | Method::Bias | Method::Gravity => {
                "N·m for a rotation, N for a translation"
            }
            Method::MassMatrix => "kg·m² between rotations, kg·m mixed, kg between translations",
            Method::ForwardDynamics => "rad/s² for a rotation, m/s² for a translation",
            Method::KineticEnergy | Method::PotentialEnergy => "J",
        }
    }
}
