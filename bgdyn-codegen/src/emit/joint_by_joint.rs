//! Emits vectors that are computed joint by joint, from the positions and velocities of the joints in q and v.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::tokens::{ident, number};
use crate::bond_graph::JointSegment;

/// The number of components of a quaternion, the last positions of a joint that has one.
const QUATERNION: usize = 4;

/// Returns the position, or its rate, of a joint whose velocity is the sum of ratio · velocity over others.
fn following(
    name: &str,
    leaders: &[(usize, f64)],
    own: &[&Vec<Ident>],
    velocities: Option<&[Ident]>,
) -> TokenStream {
    let position = own.first().and_then(|array| array.first());
    let moved = velocities.map(|all| {
        let terms = leaders.iter().map(|&(j, ratio)| {
            let (v, ratio) = (&all[j], number(ratio));
            quote! { T::from_f64(#ratio) * #v }
        });
        quote! { #(#terms)+* }
    });
    match (name, position, moved) {
        ("integrate", Some(q), Some(moved)) => quote! { #q + (#moved) },
        ("position_rates", _, Some(moved)) => moved,
        ("normalize", Some(q), _) => quote! { #q },
        _ => quote! { T::from_f64(0.0) },
    }
}

/// Returns component k of a joint with q̇ = v.
fn plain(name: &str, turns: bool, arguments: &[&Vec<Ident>], k: usize) -> TokenStream {
    let first: Vec<&Ident> = arguments.iter().filter_map(|array| array.get(k)).collect();
    match (name, first.as_slice()) {
        ("integrate", [x, y]) => quote! { #x + #y },
        ("difference", [x, y]) => quote! { #x - #y },
        ("position_rates", [_, v]) => quote! { #v },
        ("normalize", [q]) => quote! { #q },
        // From 0 … 1 to −π … π, or to −1 … 1.
        ("sample", [u]) => {
            let half = match turns {
                true => number(std::f64::consts::PI),
                false => number(1.0),
            };
            quote! { (#u + #u - T::from_f64(1.0)) * T::from_f64(#half) }
        }
        _ => quote! { T::from_f64(0.0) },
    }
}

/// Returns a vector computed joint by joint. The arguments have a name, a type, and whether they are positions; so
/// has the result.
pub(super) fn joint_by_joint(
    joints: &[JointSegment],
    name: &str,
    arguments: &[(&str, &TokenStream, bool)],
    positions: bool,
) -> TokenStream {
    let size = |s: &JointSegment, positions: bool| if positions { s.nq } else { s.nv };
    // The components of each argument, joint by joint.
    let components = |k: usize, of: bool| -> Vec<Vec<Ident>> {
        let mut next = 0;
        let own = |s: &JointSegment| {
            let from = next;
            next += size(s, of);
            (from..next)
                .map(|i| format_ident!("{}{i}", ["x", "y"][k]))
                .collect()
        };
        joints.iter().map(own).collect()
    };
    let arrays: Vec<Vec<Vec<Ident>>> = arguments
        .iter()
        .enumerate()
        .map(|(k, (_, _, of))| components(k, *of))
        .collect();
    let opened = arguments.iter().zip(&arrays).map(|((name, ..), array)| {
        let (name, all) = (ident(name), array.iter().flatten());
        quote! { let [[#(#all),*]] = #name.data.0; }
    });
    let (mut statements, mut results) = (TokenStream::new(), Vec::new());
    for (j, segment) in joints.iter().enumerate() {
        let own: Vec<&Vec<Ident>> = arrays.iter().map(|array| &array[j]).collect();
        if !segment.leaders.is_empty() {
            let velocities: Option<Vec<Ident>> = (arguments.iter().zip(&arrays))
                .find(|((.., of), _)| !of)
                .map(|(_, array)| array.iter().flatten().cloned().collect());
            let result = following(name, &segment.leaders, &own, velocities.as_deref());
            results.extend(positions.then_some(result));
            continue;
        }
        if segment.manifold.is_empty() {
            let own_components = 0..size(segment, positions);
            results.extend(own_components.map(|k| plain(name, segment.turns, &own, k)));
            continue;
        }
        let (module, function) = (ident(segment.manifold), ident(name));
        let found = |letter: &str| -> Vec<Ident> {
            let all = 0..size(segment, positions);
            all.map(|i| format_ident!("{letter}{j}_{i}")).collect()
        };
        let call = |normal: bool| {
            let given = own.iter().zip(arguments).map(|(array, (.., of))| {
                let array = quote! { [#(#array),*] };
                match normal && *of {
                    true => quote! { __rt::manifold::#module::normalize(#array) },
                    false => array,
                }
            });
            quote! { __rt::manifold::#module::#function(#(#given),*) }
        };
        // A quaternion of any length is scaled first. Its own rates are proportional to its length.
        let (normal, rates) = (segment.any_length, name == "position_rates");
        let (first, call_first) = (found("r"), call(normal));
        statements.extend(quote! { let [#(#first),*] = #call_first; });
        if normal && rates {
            let (second, call_second) = (found("s"), call(false));
            statements.extend(quote! { let [#(#second),*] = #call_second; });
            let shifts = first.len() - QUATERNION;
            let both = first[..shifts].iter().chain(&second[shifts..]);
            results.extend(both.map(|r| quote! { #r }));
        } else {
            results.extend(first.iter().map(|r| quote! { #r }));
        }
    }
    quote! {
        #(#opened)*
        #statements
        __rt::vector([#(#results),*])
    }
}
