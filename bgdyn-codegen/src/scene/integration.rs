//! The settings of a scene's integration, and the table of the integrators that it can name.

use bgdyn_runtime::ImpactLaw;

/// The settings of a scene's integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integration {
    /// The integrator.
    pub method: IntegratorName,
    /// The choice of its steps.
    pub step_control: StepControl,
    /// End of the run, s.
    pub end: f64,
    /// The law of restitution at impacts, where the integrator goes from event to event.
    pub impacts: ImpactLaw,
}

/// The choice of steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepControl {
    /// Fixed steps of this length, s.
    Step(f64),
    /// Steps with an error below this tolerance, absolute and relative.
    Tolerance(f64),
}

/// An integrator, by its name in scenes. `TABLE` has its properties.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IntegratorName {
    /// Semi-implicit Euler: first the velocities, then the positions with the new velocities.
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
    /// Time stepping of Moreau and Jean for rigid contacts.
    Moreau,
}

/// Functions of a scene that an integrator reads besides its rates.
#[derive(Clone, Copy)]
enum RequiredFunctions {
    /// Nothing.
    Rates,
    /// The slope ∂ẏ/∂y.
    Jacobian,
    /// The slope ∂ẏ/∂y, and rigid contacts, for whose impulses it solves.
    Contacts,
    /// The canonical form: the other integrator is the same one in velocities.
    Canonical(IntegratorName),
}

use IntegratorName as I;
use RequiredFunctions::{Canonical, Contacts, Jacobian, Rates};

/// The integrators in the order of the enum: name, whether it has step control, functions that it reads. A
/// test of the command `bgdyn` compares every line with the integrator of that name.
const TABLE: [(IntegratorName, &str, bool, RequiredFunctions); 12] = [
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
    (I::Moreau, "moreau", false, Contacts),
];

impl IntegratorName {
    /// All integrators.
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

    /// Returns its name.
    pub fn name(self) -> &'static str {
        TABLE[self as usize].1
    }

    /// Returns the integrator with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|i| i.name() == name)
    }

    /// Returns whether it can choose its steps by a tolerance.
    pub fn controls_its_error(self) -> bool {
        TABLE[self as usize].2
    }

    /// Returns whether it needs the slope ∂ẏ/∂y, to solve for its stages in (q, v).
    pub fn needs_jacobian(self) -> bool {
        matches!(TABLE[self as usize].3, Jacobian | Contacts)
    }

    /// Returns whether it solves for the impulses of rigid contacts.
    pub fn solves_contacts(self) -> bool {
        matches!(TABLE[self as usize].3, Contacts)
    }

    /// Returns whether it integrates the canonical form.
    pub fn needs_canonical(self) -> bool {
        matches!(TABLE[self as usize].3, Canonical(_))
    }

    /// Returns the same integrator in velocities; itself if it does not integrate the canonical form.
    pub fn on_velocities(self) -> Self {
        match TABLE[self as usize].3 {
            Canonical(same) => same,
            Rates | Jacobian | Contacts => self,
        }
    }
}
