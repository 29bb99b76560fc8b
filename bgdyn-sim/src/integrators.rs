//! The list of integrators by name.

use bgdyn_runtime::StateVector;

use crate::dop853::Dop853;
use crate::dopri5::Dopri5;
use crate::extrapolation::Extrapolation12;
use crate::gauss::{Gauss2, Gauss3, Gauss4, Midpoint};
use crate::integrator::Integrator;
use crate::moreau::Moreau;
use crate::real::{Of, Real};
use crate::rk4::Rk4;
use crate::rodas4::Rodas4;
use crate::semi_implicit_euler::SemiImplicitEuler;

/// A function that is generic over the integrator, which is chosen by name.
pub trait WithIntegrator<Y: StateVector> {
    /// The result.
    type Output;

    /// Calls the function.
    fn with<M: Integrator<Y>>(self, integrator: M) -> Self::Output;
}

macro_rules! integrators {
    ($($name:literal => $integrator:expr,)*) => {
        /// Names of all integrators, in the order of the list.
        pub const INTEGRATORS: &[&str] = &[$($name),*];

        /// Calls a function with the integrator of this name; `None` if the name is unknown.
        pub fn with_integrator<Y: StateVector, W: WithIntegrator<Y>>(name: &str, what: W) -> Option<W::Output>
        where
            Of<Y>: Real,
        {
            match name {
                $($name => Some(what.with($integrator)),)*
                _ => None,
            }
        }
    };
}

integrators! {
    "semi_implicit_euler" => SemiImplicitEuler,
    "rk4" => Rk4,
    "midpoint" => Midpoint::<Of<Y>>::new(),
    "gauss2" => Gauss2::<Of<Y>>::new(),
    "gauss3" => Gauss3::<Of<Y>>::new(),
    "gauss4" => Gauss4::<Of<Y>>::new(),
    "rodas4" => Rodas4,
    "dopri5" => Dopri5,
    "dop853" => Dop853,
    "moreau" => Moreau::<Of<Y>>::new(),
    "extrapolation12" => Extrapolation12::default(),
}
