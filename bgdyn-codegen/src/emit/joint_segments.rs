//! The positions and velocities of the joints in q and v, and the components of joints with one position.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::tokens::number;
use crate::bond_graph::{LinkFrame, Multibody};
use crate::mechanism::Motion;

/// The positions and velocities of a joint that follow each other in q and v.
#[derive(Clone)]
pub(super) struct JointSegment {
    /// Its module of `bgdyn_runtime::manifold`; empty if q̇ = v.
    pub(super) manifold: &'static str,
    pub(super) nq: usize,
    pub(super) nv: usize,
    /// Whether its position is an angle.
    pub(super) turns: bool,
    /// Whether its quaternion may have any length.
    pub(super) any_length: bool,
    /// For a position whose rate is a sum of velocities of other joints: their indices with ratios.
    pub(super) leaders: Vec<(usize, f64)>,
}

impl JointSegment {
    /// A joint with one position and q̇ = v.
    pub(super) const PLAIN: Self = JointSegment {
        manifold: "",
        nq: 1,
        nv: 1,
        turns: true,
        any_length: false,
        leaders: Vec::new(),
    };
}

/// Returns the joints in the order of q and v.
pub(super) fn segments(graph: &Multibody) -> Vec<JointSegment> {
    let own = graph.frames.iter().filter(|f| f.degrees.own_positions());
    let moving = own.filter(|frame| frame.motion != Motion::None);
    let segment = |frame: &LinkFrame| JointSegment {
        manifold: match frame.motion {
            Motion::Compound(motion) => motion.manifold,
            _ => "",
        },
        nq: frame.motion.nq(),
        nv: match frame.degrees.own_velocities() {
            true => frame.motion.nv(),
            false => 0,
        },
        turns: frame.motion != Motion::Translation,
        any_length: frame.degrees.any_length,
        leaders: leaders(frame),
    };
    moving.map(segment).collect()
}

/// Returns the velocities that a joint's follows, with ratios; none for a joint with a velocity of its own.
fn leaders(frame: &LinkFrame) -> Vec<(usize, f64)> {
    let degrees = &frame.degrees;
    if degrees.own_velocities() {
        return vec![];
    }
    let velocities = degrees.velocities.iter().map(|j| j.0);
    let ratios = degrees.velocity_ratios().into_iter();
    velocities.zip(ratios.map(|ratio| ratio.to_f64())).collect()
}

/// Returns the position, or its rate, of a joint whose velocity is the sum of ratio · velocity over others.
pub(super) fn following(
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
pub(super) fn plain(name: &str, turns: bool, arguments: &[&Vec<Ident>], k: usize) -> TokenStream {
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
