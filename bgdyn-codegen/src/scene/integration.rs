//! The settings of a scene's integration, and the table of the integrators that it can name.

/// How a scene asks to be run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integration {
    /// The integrator.
    pub method: IntegratorName,
    /// How its steps are chosen.
    pub step_control: StepControl,
    /// When it ends, s.
    pub end: f64,
}

/// How steps are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepControl {
    /// Every step is as long, s.
    Step(f64),
    /// As long as the error of a step stays below this, absolute and relative.
    Tolerance(f64),
}

/// An integrator, by the name that scenes give it. `TABLE` has its properties.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IntegratorName {
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

/// What an integrator reads of a scene beside its rates.
#[derive(Clone, Copy)]
enum RequiredFunctions {
    /// Nothing.
    Rates,
    /// The slope ∂ẏ/∂y.
    Jacobian,
    /// The canonical form: it is this integrator on momenta in place of velocities.
    Canonical(IntegratorName),
}

use IntegratorName as I;
use RequiredFunctions::{Canonical, Jacobian, Rates};

/// The integrators in the order of the enum: name, whether it can choose its steps by a tolerance, what
/// it reads. A test of the command `bgdyn` compares every line with the integrator of that name.
const TABLE: [(IntegratorName, &str, bool, RequiredFunctions); 11] = [
    (I::SemiImplicitEuler, "semi_implicit_euler", false, Rates),
    (I::Rk4, "rk4", false, Rates),
    (I::Midpoint, "midpoint", false, Jacobian),
    (I::Gauss2, "gauss2", false, Jacobian),
    (I::Gauss3, "gauss3", false, Jacobian),
    (
        I::CanonicalMidpoint,
        "canonical_midpoint",
        false,
        Canonical(I::Midpoint),
    ),
    (
        I::CanonicalGauss2,
        "canonical_gauss2",
        false,
        Canonical(I::Gauss2),
    ),
    (
        I::CanonicalGauss3,
        "canonical_gauss3",
        false,
        Canonical(I::Gauss3),
    ),
    (I::Rodas4, "rodas4", true, Jacobian),
    (I::Dopri5, "dopri5", true, Rates),
    (I::Dop853, "dop853", true, Rates),
];

impl IntegratorName {
    /// Every integrator there is.
    pub const ALL: [IntegratorName; TABLE.len()] = {
        let mut all = [I::Rk4; TABLE.len()];
        let mut i = 0;
        while i < all.len() {
            all[i] = TABLE[i].0;
            assert!(all[i] as usize == i, "in the order of the enum");
            i += 1;
        }
        all
    };

    /// Its name.
    pub fn name(self) -> &'static str {
        TABLE[self as usize].1
    }

    /// The integrator with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|i| i.name() == name)
    }

    /// Whether it can choose its steps by a tolerance.
    pub fn controls_its_error(self) -> bool {
        TABLE[self as usize].2
    }

    /// Whether it takes the slope ∂ẏ/∂y: to solve for its stages in (q, v).
    pub fn needs_jacobian(self) -> bool {
        matches!(TABLE[self as usize].3, Jacobian)
    }

    /// Whether it runs on momenta in place of velocities.
    pub fn needs_canonical(self) -> bool {
        matches!(TABLE[self as usize].3, Canonical(_))
    }

    /// The same integrator on velocities: itself, where it is not one on momenta.
    pub fn on_velocities(self) -> Self {
        match TABLE[self as usize].3 {
            Canonical(same) => same,
            Rates | Jacobian => self,
        }
    }
}
