//! Emits what a scene with rigid contacts has more than others.

use bgdyn_runtime::ImpactLaw;
use proc_macro2::TokenStream;
use quote::quote;

use super::super::body::vector;
use super::super::constants::size;
use crate::interface::SceneInterface;
use crate::scene::StateLayout;

/// Returns the type of the states of the contacts.
pub(super) fn states_type(layout: &StateLayout) -> TokenStream {
    let number = size(layout.rigid_contacts.len());
    quote! { [__rt::RigidContact<T>; #number] }
}

/// Returns the type of their maps.
pub(super) fn maps_type(layout: &StateLayout) -> TokenStream {
    let number = size(layout.rigid_contacts.len());
    quote! { [__rt::ContactMap<__na::SVector<T, N>>; #number] }
}

/// Returns the type of their biases.
pub(super) fn biases_type(layout: &StateLayout) -> TokenStream {
    let number = size(layout.rigid_contacts.len());
    quote! { [[T; 3]; #number] }
}

/// Returns their states from six numbers each.
pub(super) fn states(values: &[TokenStream]) -> TokenStream {
    let one = |v: &[TokenStream]| match v {
        [gap, x, y, normal, friction, restitution] => quote! {
            __rt::RigidContact {
                gap: #gap,
                velocity: [#x, #y, #normal],
                friction: #friction,
                restitution: #restitution,
            }
        },
        _ => unreachable!("six numbers a contact"),
    };
    let all = values.chunks(6).map(one);
    quote! { [#(#all),*] }
}

/// Returns their maps from three rows and three columns each, for the velocities.
pub(super) fn maps(layout: &StateLayout, values: &[TokenStream]) -> TokenStream {
    let nv = layout.nv();
    let zeros = |n: usize| (0..n).map(|_| quote! { T::from_f64(0.0) });
    let in_state = |velocities: &[TokenStream]| {
        let all = zeros(layout.nq()).chain(velocities.iter().cloned());
        vector(&all.chain(zeros(layout.nx())).collect::<Vec<_>>())
    };
    let one = |values: &[TokenStream]| {
        let mut all = values.chunks(nv.max(1)).map(in_state);
        let [rows, columns] = [(); 2].map(|()| all.by_ref().take(3).collect::<Vec<_>>());
        quote! { __rt::ContactMap { rows: [#(#rows),*], columns: [#(#columns),*] } }
    };
    let all = values.chunks((6 * nv).max(1)).map(one);
    quote! { [#(#all),*] }
}

/// Returns their biases from three numbers each.
pub(super) fn biases(values: &[TokenStream]) -> TokenStream {
    let all = values.chunks(3).map(|one| quote! { [#(#one),*] });
    quote! { [#(#all),*] }
}

/// Returns the methods of the trait, if the scene has rigid contacts.
pub(super) fn of_trait(scene: &SceneInterface) -> TokenStream {
    let names = &scene.layout.rigid_contacts;
    if names.is_empty() {
        return TokenStream::new();
    }
    let entries = names.iter().map(|name| {
        let mut entries = scene.entries.iter();
        size(entries.position(|entry| entry.name == *name).unwrap_or(0))
    });
    let law = (scene.impacts == ImpactLaw::Poisson).then(|| {
        quote! { fn impact_law(&self) -> __rt::ImpactLaw { __rt::ImpactLaw::Poisson } }
    });
    quote! {
        #law
        fn rigid_contact_names(&self) -> &'static [&'static str] { &[#(#names),*] }
        fn rigid_contact_entries(&self) -> &'static [usize] { &[#(#entries),*] }
        fn rigid_contact_states(
            &self,
            y: &__na::SVector<T, N>,
            input: &__na::SVector<T, NU>,
            t: T,
            contacts: &mut [__rt::RigidContact<T>],
        ) {
            let state = State::from_vectors(y, &State::<T>::default().modes());
            let all = self.rigid_contact_states(&state, &Input::from_vector(input), t);
            for (to, from) in contacts.iter_mut().zip(all) {
                *to = from;
            }
        }
        fn rigid_contact_maps(
            &self,
            y: &__na::SVector<T, N>,
            input: &__na::SVector<T, NU>,
            t: T,
            maps: &mut [::core::option::Option<__rt::ContactMap<__na::SVector<T, N>>>],
        ) -> ::core::result::Result<(), Self::Singular> {
            let state = State::from_vectors(y, &State::<T>::default().modes());
            let all = self.rigid_contact_maps(&state, &Input::from_vector(input), t);
            // Maps are large: each is copied once.
            for (to, from) in maps.iter_mut().zip(all.iter().flatten()) {
                *to = ::core::option::Option::Some(*from);
            }
            all.map(|_| ())
        }
        fn rigid_contact_biases(
            &self,
            y: &__na::SVector<T, N>,
            input: &__na::SVector<T, NU>,
            t: T,
            biases: &mut [[T; 3]],
        ) {
            let state = State::from_vectors(y, &State::<T>::default().modes());
            let all = self.rigid_contact_biases(&state, &Input::from_vector(input), t);
            for (to, from) in biases.iter_mut().zip(all) {
                *to = from;
            }
        }
    }
}
