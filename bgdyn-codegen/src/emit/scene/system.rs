//! The traits of scenes, implemented by a scene's methods.

use bgdyn_runtime::SampledControl;
use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::super::constants::size;
use super::super::tokens::{ident, number};
use super::parts::{mode_parts, names_of, of_named};
use super::rigid_contacts;
use crate::interface::SceneInterface;
use crate::scene::StateLayout;

/// The implementation of the trait by the named functions.
pub(super) fn system_trait(scene: &SceneInterface, name: &Ident) -> TokenStream {
    let layout = &scene.layout;
    let mode_fields = names_of(&mode_parts(layout));
    let entries = names_of(&of_named(&scene.entries));
    let input = if layout.inputs.is_empty() {
        quote! { *given }
    } else {
        quote! {
            self.input(&State::from_vectors(y, modes), &Input::from_vector(given), t).vector()
        }
    };
    let events = if layout.events.is_empty() {
        quote! { ::core::result::Result::Ok(__rt::vector([])) }
    } else {
        quote! { self.events(&State::from_vectors(y, modes), &Input::from_vector(input), t) }
    };
    let contacts = if layout.modes.is_empty() {
        quote! { ::core::result::Result::Ok([]) }
    } else {
        quote! {
            let all = self.contacts(&State::from_vectors(y, modes), &Input::from_vector(input), t)?;
            ::core::result::Result::Ok([#(all.#mode_fields),*])
        }
    };
    let output = if scene.outputs.is_empty() {
        quote! { __rt::vector([]) }
    } else {
        quote! {
            self.output(&State::from_vectors(y, modes), &Input::from_vector(input), t).vector()
        }
    };
    let count = size(entries.len());
    let velocities = &scene.mode_coordinates;
    let corners = corners(&scene.corners);
    let control = scene.control.as_ref().map(|own| control(own.sampled()));
    let quasi_joints = quasi_joints(layout);
    let constrained = constrained_positions(layout);
    let rigid_contacts = rigid_contacts::of_trait(scene);
    let mode_velocities = velocities.iter().map(|&j| size(layout.nq() + j));
    quote! {
        impl<T: __Scalar> __rt::HybridSystem<T> for #name<T> {
            type State = __na::SVector<T, N>;
            type Modes = __na::SVector<T, NM>;
            type Inputs = __na::SVector<T, NU>;
            type Events = __na::SVector<T, NE>;
            type Outputs = __na::SVector<T, NY>;
            type Entries = __na::SVector<T, #count>;
            type Singular = T::Singular<{ NV + NX }>;
            fn state_names(&self) -> &'static [&'static str; N] { &STATE_NAMES }
            fn positions(&self) -> usize { NQ }
            #quasi_joints
            #constrained
            fn mode_names(&self) -> &'static [&'static str; NM] { &MODE_NAMES }
            fn input_names(&self) -> &'static [&'static str; NU] { &INPUT_NAMES }
            fn event_names(&self) -> &'static [&'static str; NE] { &EVENT_NAMES }
            fn event_modes(&self) -> &'static [::core::option::Option<usize>; NE] { &EVENT_MODES }
            fn mode_velocities(&self) -> &'static [usize; NM] { &[#(#mode_velocities),*] }
            #corners
            #control
            #rigid_contacts
            fn output_names(&self) -> &'static [&'static str; NY] { &OUTPUT_NAMES }
            fn entry_names(&self) -> &'static [&'static str; #count] { &ENTRY_NAMES }
            fn start(&self) -> (__na::SVector<T, N>, __na::SVector<T, NM>) {
                let start = State::<T>::default();
                (start.vector(), start.modes())
            }
            fn derivative(
                &self,
                y: &__na::SVector<T, N>,
                modes: &__na::SVector<T, NM>,
                input: &__na::SVector<T, NU>,
                t: T,
            ) -> ::core::result::Result<__na::SVector<T, N>, Self::Singular> {
                let (state, input) = (State::from_vectors(y, modes), Input::from_vector(input));
                ::core::result::Result::Ok(self.derivative(&state, &input, t)?.vector())
            }
            fn input(
                &self,
                y: &__na::SVector<T, N>,
                modes: &__na::SVector<T, NM>,
                given: &__na::SVector<T, NU>,
                t: T,
            ) -> __na::SVector<T, NU> { #input }
            fn events(
                &self,
                y: &__na::SVector<T, N>,
                modes: &__na::SVector<T, NM>,
                input: &__na::SVector<T, NU>,
                t: T,
            ) -> ::core::result::Result<__na::SVector<T, NE>, Self::Singular> { #events }
            fn contacts(
                &self,
                y: &__na::SVector<T, N>,
                modes: &__na::SVector<T, NM>,
                input: &__na::SVector<T, NU>,
                t: T,
            ) -> ::core::result::Result<[__rt::Contact<T>; NM], Self::Singular> { #contacts }
            fn output(
                &self,
                y: &__na::SVector<T, N>,
                modes: &__na::SVector<T, NM>,
                input: &__na::SVector<T, NU>,
                t: T,
            ) -> __na::SVector<T, NY> { #output }
            fn energy(
                &self,
                y: &__na::SVector<T, N>,
                modes: &__na::SVector<T, NM>,
                input: &__na::SVector<T, NU>,
                t: T,
            ) -> [T; #count] {
                let (state, input) = (State::from_vectors(y, modes), Input::from_vector(input));
                let all = self.energy(&state, &input, t);
                [#(all.#entries),*]
            }
            fn power(
                &self,
                y: &__na::SVector<T, N>,
                modes: &__na::SVector<T, NM>,
                input: &__na::SVector<T, NU>,
                t: T,
            ) -> ::core::result::Result<[__rt::Balance<T>; #count], Self::Singular> {
                let (state, input) = (State::from_vectors(y, modes), Input::from_vector(input));
                let all = self.power(&state, &input, t)?;
                ::core::result::Result::Ok([#(all.#entries),*])
            }
        }
    }
}

/// The instants at which an input bends, where there are any.
fn corners(corners: &[f64]) -> TokenStream {
    if corners.is_empty() {
        return TokenStream::new();
    }
    let instants = corners.iter().map(|&t| {
        let (sign, size) = ((t < 0.0).then(|| quote! { - }), number(t.abs()));
        quote! { #sign #size }
    });
    quote! { fn corners(&self) -> &'static [f64] { &[#(#instants),*] } }
}

/// Returns the method for sampled controllers.
fn control(control: SampledControl<'_>) -> TokenStream {
    let numbers = |all: &[f64]| {
        let all = all.iter().map(|&x| number(x));
        quote! { &[#(#all),*] }
    };
    let SampledControl {
        controlled, seed, ..
    } = control;
    let (period, delay) = (number(control.period), number(control.delay));
    let (resolution, noise) = (numbers(control.resolution), numbers(control.noise));
    let controlled = controlled.iter().map(|&i| size(i));
    let input_resolution = numbers(control.input_resolution);
    let seed = proc_macro2::Literal::u64_unsuffixed(seed);
    quote! {
        fn control(&self) -> ::core::option::Option<__rt::SampledControl<'static>> {
            ::core::option::Option::Some(__rt::SampledControl {
                period: #period,
                delay: #delay,
                resolution: #resolution,
                noise: #noise,
                controlled: &[#(#controlled),*],
                input_resolution: #input_resolution,
                seed: #seed,
            })
        }
    }
}

/// Returns the method for the joints with quasi-velocities, if the scene has some.
fn quasi_joints(layout: &StateLayout) -> TokenStream {
    if layout.quasi_joints.is_empty() {
        return TokenStream::new();
    }
    let joints = layout.quasi_joints.iter().map(|joint| {
        let joint = joint.in_state(layout);
        let kind = ident(&format!("{:?}", joint.kind));
        let (position, velocity) = (size(joint.position), size(joint.velocity));
        quote! {
            __rt::QuasiJoint {
                kind: __rt::QuasiJointKind::#kind, position: #position, velocity: #velocity
            }
        }
    });
    quote! { fn quasi_joints(&self) -> &'static [__rt::QuasiJoint] { &[#(#joints),*] } }
}

/// Returns the methods for positions whose rates follow from several velocities.
fn constrained_positions(layout: &StateLayout) -> TokenStream {
    if !layout.needs_position_rates() {
        return TokenStream::new();
    }
    let close = (!layout.closing.is_empty()).then(|| {
        quote! {
            fn closes(&self) -> bool { true }
            fn close(
                &self,
                y: &mut __na::SVector<T, N>,
            ) -> ::core::result::Result<bool, Self::Singular> {
                let modes = State::<T>::default().modes();
                let step = |y: &__na::SVector<T, N>| {
                    self.closing_step(&State::from_vectors(y, &modes))
                };
                __rt::closure::close_state::<T, N, NQ, { NV + NX }>(y, &DEPENDENTS, &PIVOT_NAMES, step)?;
                ::core::result::Result::Ok(true)
            }
        }
    });
    quote! {
        fn position_rates(&self, y: &__na::SVector<T, N>, rates: &mut __na::SVector<T, N>) -> bool {
            let modes = State::<T>::default().modes();
            let own = self.position_rates(&State::from_vectors(y, &modes));
            for (rate, &own) in rates.iter_mut().zip(own.iter()) {
                *rate = own;
            }
            true
        }
        #close
    }
}

/// The implementation of the trait `Slope`.
pub(super) fn slope_trait(name: &Ident) -> TokenStream {
    quote! {
        impl<T: __Scalar> __rt::Slope<T> for #name<T> {
            fn slope(
                &self,
                y: &__na::SVector<T, N>,
                modes: &__na::SVector<T, NM>,
                given: &__na::SVector<T, NU>,
                t: T,
            ) -> ::core::result::Result<
                (__na::SMatrix<T, N, N>, __na::SVector<T, N>),
                T::Singular<{ NV + NX }>,
            > {
                self.jacobian(&State::from_vectors(y, modes), &Input::from_vector(given), t)
            }
        }
    }
}

/// The implementation of the trait `InputSlope`.
pub(super) fn input_slope_trait(name: &Ident) -> TokenStream {
    quote! {
        impl<T: __Scalar> __rt::InputSlope<T> for #name<T> {
            type InputMatrix = __na::SMatrix<T, N, NU>;
            fn input_slope(
                &self,
                y: &__na::SVector<T, N>,
                modes: &__na::SVector<T, NM>,
                input: &__na::SVector<T, NU>,
                t: T,
            ) -> ::core::result::Result<Self::InputMatrix, T::Singular<{ NV + NX }>> {
                self.input_jacobian(&State::from_vectors(y, modes), &Input::from_vector(input), t)
            }
        }
    }
}

/// The implementation of the trait `Canonical`.
pub(super) fn canonical_trait(name: &Ident) -> TokenStream {
    let checked = quote! {
        ::core::result::Result<__na::SVector<T, N>, T::Singular<{ NV + NX }>>
    };
    quote! {
        impl<T: __Scalar> __rt::Canonical<T> for #name<T> {
            fn to_canonical(
                &self,
                y: &__na::SVector<T, N>,
                modes: &__na::SVector<T, NM>,
                _given: &__na::SVector<T, NU>,
                _t: T,
            ) -> __na::SVector<T, N> {
                self.to_canonical(&State::from_vectors(y, modes))
            }
            fn from_canonical(
                &self,
                z: &__na::SVector<T, N>,
                _modes: &__na::SVector<T, NM>,
                _given: &__na::SVector<T, NU>,
                _t: T,
            ) -> #checked {
                self.from_canonical(z)
            }
            fn canonical_rates(
                &self,
                z: &__na::SVector<T, N>,
                modes: &__na::SVector<T, NM>,
                given: &__na::SVector<T, NU>,
                t: T,
            ) -> #checked {
                self.canonical_rates(z, modes, &Input::from_vector(given), t)
            }
        }
    }
}
