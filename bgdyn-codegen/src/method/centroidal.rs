//! Centroidal methods: the centre of mass, and the momentum about it.
//!
//! They belong to all bodies that can move: links fixed to the world do not count. Spatial vectors have the angular part
//! first; axes are those of the world. The point is the centre of mass c, so that the linear part of the momentum is
//! m ċ.

use super::{Argument, Shape};

/// A method of the centre of mass, or of the momentum about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Centroidal {
    /// c(q).
    Centre,
    /// J_c(q): ċ = J_c v.
    Jacobian,
    /// A_g(q).
    Map,
    /// A_g v.
    Momentum,
    /// Ȧ_g v.
    Bias,
}

impl Centroidal {
    /// All of them.
    pub const ALL: [Centroidal; 5] = [
        Centroidal::Centre,
        Centroidal::Jacobian,
        Centroidal::Map,
        Centroidal::Momentum,
        Centroidal::Bias,
    ];

    /// Returns its name.
    pub fn name(self) -> &'static str {
        match self {
            Centroidal::Centre => "centre_of_mass",
            Centroidal::Jacobian => "com_jacobian",
            Centroidal::Map => "centroidal_map",
            Centroidal::Momentum => "centroidal_momentum",
            Centroidal::Bias => "centroidal_bias",
        }
    }

    /// Returns its arguments.
    pub fn arguments(self) -> &'static [Argument] {
        use Argument::{Q, V};
        match self {
            Centroidal::Centre | Centroidal::Jacobian | Centroidal::Map => &[Q],
            Centroidal::Momentum | Centroidal::Bias => &[Q, V],
        }
    }

    /// Returns the shape of its result.
    pub fn shape(self) -> Shape {
        match self {
            Centroidal::Centre => Shape::Point,
            Centroidal::Jacobian => Shape::PointJacobian,
            Centroidal::Map => Shape::Jacobian,
            Centroidal::Momentum | Centroidal::Bias => Shape::Spatial,
        }
    }

    /// Describes the result: one line of documentation.
    pub fn summary(self) -> &'static str {
        match self {
            Centroidal::Centre => "Centre of mass of all bodies that can move, in the world.",
            Centroidal::Jacobian => {
                "Jacobian of the centre of mass: its velocity is J v; world axes."
            }
            Centroidal::Map => {
                "Centroidal map A_g: the momentum about the centre of mass, angular part first, is A_g v; world axes."
            }
            Centroidal::Momentum => {
                "Momentum about the centre of mass, angular part first: A_g v; world axes."
            }
            Centroidal::Bias => {
                "Ȧ_g v: the rate of the momentum about the centre of mass, angular part first, where the joints' accelerations are zero; world axes."
            }
        }
    }

    /// Returns the units of the result.
    pub fn units(self) -> &'static str {
        match self {
            Centroidal::Centre => "m",
            Centroidal::Jacobian => "m per unit of each joint",
            Centroidal::Map => "kg·m²/s and kg·m/s per unit of each velocity",
            Centroidal::Momentum => "kg·m²/s, kg·m/s",
            Centroidal::Bias => "N·m, N",
        }
    }
}
