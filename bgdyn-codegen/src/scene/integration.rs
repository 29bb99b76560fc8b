//! The settings of a scene's integration: method, step or tolerance, end.

/// How a scene asks to be run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integration {
    /// The method.
    pub method: Integrator,
    /// What its steps go by.
    pub pace: Pace,
    /// When it ends, s.
    pub end: f64,
}

/// What steps go by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// Every step is as long, s.
    Step(f64),
    /// As long as the error of a step stays below this, absolute and relative.
    Tolerance(f64),
}

/// A method of integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integrator {
    /// Semi-implicit Euler: velocities first, positions with the new ones.
    SemiImplicitEuler,
    /// The classical Runge–Kutta method of order 4.
    Rk4,
    /// Implicit midpoint, order 2.
    Midpoint,
    /// Gauss–Legendre with 2 stages, order 4.
    Gauss2,
    /// Gauss–Legendre with 3 stages, order 6.
    Gauss3,
    /// Implicit midpoint on the canonical form.
    CanonicalMidpoint,
    /// Gauss–Legendre with 2 stages on the canonical form.
    CanonicalGauss2,
    /// Gauss–Legendre with 3 stages on the canonical form.
    CanonicalGauss3,
    /// Rosenbrock's method RODAS of order 4, L-stable, with error control.
    Rodas4,
    /// Dormand and Prince's pair of order 5, with error control.
    Dopri5,
    /// Dormand and Prince's method of order 8, with error control.
    Dop853,
}

impl Integrator {
    /// Every method there is.
    pub const ALL: [Integrator; 11] = [
        Integrator::SemiImplicitEuler,
        Integrator::Rk4,
        Integrator::Midpoint,
        Integrator::Gauss2,
        Integrator::Gauss3,
        Integrator::CanonicalMidpoint,
        Integrator::CanonicalGauss2,
        Integrator::CanonicalGauss3,
        Integrator::Rodas4,
        Integrator::Dopri5,
        Integrator::Dop853,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Integrator::SemiImplicitEuler => "semi_implicit_euler",
            Integrator::Rk4 => "rk4",
            Integrator::Midpoint => "midpoint",
            Integrator::Gauss2 => "gauss2",
            Integrator::Gauss3 => "gauss3",
            Integrator::CanonicalMidpoint => "canonical_midpoint",
            Integrator::CanonicalGauss2 => "canonical_gauss2",
            Integrator::CanonicalGauss3 => "canonical_gauss3",
            Integrator::Rodas4 => "rodas4",
            Integrator::Dopri5 => "dopri5",
            Integrator::Dop853 => "dop853",
        }
    }

    /// The method with this name.
    pub fn named(name: &str) -> Option<Self> {
        Integrator::ALL.into_iter().find(|m| m.name() == name)
    }

    /// Whether it can choose its steps by a tolerance.
    pub fn controls_its_error(self) -> bool {
        use Integrator::{Dop853, Dopri5, Rodas4};
        matches!(self, Rodas4 | Dopri5 | Dop853)
    }

    /// Whether it takes the slope ∂ẏ/∂y: to solve for its stages in (q, v).
    pub fn needs_jacobian(self) -> bool {
        use Integrator::{Gauss2, Gauss3, Midpoint, Rodas4};
        matches!(self, Midpoint | Gauss2 | Gauss3 | Rodas4)
    }

    /// Whether it runs on momenta in place of velocities.
    pub fn needs_canonical(self) -> bool {
        use Integrator::{CanonicalGauss2, CanonicalGauss3, CanonicalMidpoint};
        matches!(self, CanonicalMidpoint | CanonicalGauss2 | CanonicalGauss3)
    }
}
