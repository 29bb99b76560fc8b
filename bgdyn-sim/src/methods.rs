//! The list of integrators that a scene or a command can name.

use crate::dop853::Dop853;
use crate::dopri5::Dopri5;
use crate::extrapolation::Extrapolation12;
use crate::gauss::{Gauss2, Gauss3, Gauss4, Midpoint};
use crate::method::Method;
use crate::rk4::Rk4;
use crate::rodas4::Rodas4;
use crate::semi_implicit_euler::SemiImplicitEuler;
use crate::space::{Of, Real, Space};

/// What is to be done with a method that is chosen by name.
pub trait WithMethod<Y: Space> {
    /// What comes of it.
    type Output;

    /// Does it.
    fn with<M: Method<Y>>(self, method: M) -> Self::Output;
}

macro_rules! methods {
    ($($name:literal => $method:expr,)*) => {
        /// Names of all methods, in the order of the list.
        pub const METHODS: &[&str] = &[$($name),*];

        /// Does something with the method of this name; `None` where there is none.
        pub fn with_method<Y: Space, W: WithMethod<Y>>(name: &str, what: W) -> Option<W::Output>
        where
            Of<Y>: Real,
        {
            match name {
                $($name => Some(what.with($method)),)*
                _ => None,
            }
        }
    };
}

methods! {
    "semi_implicit_euler" => SemiImplicitEuler,
    "rk4" => Rk4,
    "midpoint" => Midpoint::<Of<Y>>::new(),
    "gauss2" => Gauss2::<Of<Y>>::new(),
    "gauss3" => Gauss3::<Of<Y>>::new(),
    "gauss4" => Gauss4::<Of<Y>>::new(),
    "rodas4" => Rodas4,
    "dopri5" => Dopri5,
    "dop853" => Dop853,
    "extrapolation12" => Extrapolation12::default(),
}
