//! Emits the access to the positions of joints with several velocities.
//!
//! It consists of their ranges in q and v, and their pose or rotation as types of nalgebra.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::tokens::ident;
use crate::mechanism::joint::CompoundMotion;
use crate::mechanism::{Link, Mechanism, Motion};

/// The constants of the module, and the functions of the struct.
pub(super) struct JointAccess {
    /// `FREE_Q`, `FREE_V`
    pub(super) constants: TokenStream,
    /// `free_pose`, `set_free_pose`; `ball_rotation`, `set_ball_rotation`
    pub(super) functions: TokenStream,
}

/// Returns the access to all joints with several velocities.
pub(super) fn joint_access(mechanism: &Mechanism) -> JointAccess {
    let (mut constants, mut functions) = (TokenStream::new(), TokenStream::new());
    for link in mechanism.links() {
        let Motion::Compound(motion) = link.joint.kind.motion else {
            continue;
        };
        if motion.manifold.is_empty() || !link.joint.degrees.own_velocities() {
            continue;
        }
        constants.extend(ranges(link, motion));
        if let (Some(first), Some(names)) =
            (motion.quaternion(), motion.access_names(&link.joint.name))
        {
            functions.extend(pose_functions(link, motion, first, &names));
        }
    }
    JointAccess {
        constants,
        functions,
    }
}

/// Returns the ranges of a joint in q and v.
fn ranges(link: &Link, motion: &CompoundMotion) -> TokenStream {
    let joint = &link.joint;
    let upper = joint.name.to_uppercase();
    let (q, v) = (first_position(link), joint.degrees.velocities[0].0);
    let (q_end, v_end) = (q + motion.positions.len(), v + motion.velocities.len());
    let list = |names: Vec<&str>| names.join(", ");
    let positions = list(motion.positions.iter().map(|p| p.suffix).collect());
    let velocities = list(motion.velocities.iter().map(|v| v.suffix).collect());
    let doc = |what: &str, of: &str| format!(" {what} of the joint `{}`: {of}.", joint.name);
    let [q_doc, v_doc] = [doc("Positions", &positions), doc("Velocities", &velocities)];
    let [q_name, v_name] = ["Q", "V"].map(|part| format_ident!("{upper}_{part}"));
    // Velocities that follow from others leave gaps.
    let in_v = (!joint.degrees.partly_dependent()).then(|| {
        quote! {
            #[doc = #v_doc]
            pub const #v_name: ::core::ops::Range<usize> = #v..#v_end;
        }
    });
    quote! {
        #[doc = #q_doc]
        pub const #q_name: ::core::ops::Range<usize> = #q..#q_end;
        #in_v
    }
}

fn first_position(link: &Link) -> usize {
    link.joint.degrees.positions[0].0
}

/// Returns the functions that read and write a joint with a quaternion, its position `first` and those
/// after it.
fn pose_functions(
    link: &Link,
    motion: &CompoundMotion,
    first: usize,
    names: &[String; 2],
) -> TokenStream {
    let joint = &link.joint.name;
    let at = first_position(link);
    let quaternion = at + first;
    // The positions before the quaternion are a displacement.
    let place: Vec<usize> = (at..quaternion).collect();
    let components: Vec<usize> = (quaternion..quaternion + 4).collect();
    let read = match link.joint.degrees.any_length {
        true => quote! { __rt::manifold::spherical::normalize([#(q[#components]),*]) },
        false => quote! { [#(q[#components]),*] },
    };
    let rotation = quote! {
        __na::Unit::new_unchecked(__na::Quaternion { coords: __rt::vector(#read) })
    };
    let write = |of: TokenStream| {
        let each = components.iter().enumerate();
        let each = each.map(|(k, p)| quote! { q[#p] = #of.coords[#k]; });
        quote! { #(#each)* }
    };
    let kind = motion.access_kind();
    let [get, set] = names.each_ref().map(|name| ident(name));
    let (value, body, written) = if place.is_empty() {
        let value = quote! { __na::UnitQuaternion<T> };
        (value, rotation, write(quote! { rotation }))
    } else {
        let quaternion = write(quote! { pose.rotation });
        let value = quote! { __na::Isometry3<T> };
        let body = quote! {
            __na::Isometry {
                rotation: #rotation,
                translation: __na::Translation { vector: __rt::vector([#(q[#place]),*]) },
            }
        };
        let each = place.iter().enumerate();
        let each = each.map(|(k, p)| quote! { q[#p] = pose.translation.vector[#k]; });
        (value, body, quote! { #(#each)* #quaternion })
    };
    let argument = ident(kind);
    functions(
        (joint, kind),
        (&get, &set),
        &value,
        (&argument, body, written),
    )
}

/// Returns the two functions of a joint.
fn functions(
    (joint, kind): (&str, &str),
    (get, set): (&Ident, &Ident),
    value: &TokenStream,
    (argument, body, written): (&Ident, TokenStream, TokenStream),
) -> TokenStream {
    let get_doc = format!(
        " Returns the {kind} of the joint `{joint}`: from the axes of its link to those of its origin."
    );
    let set_doc = format!(" Sets the {kind} of the joint `{joint}` in `q`.");
    quote! {
        #[doc = #get_doc]
        pub fn #get(q: &__na::SVector<T, NQ>) -> #value {
            #body
        }
        #[doc = #set_doc]
        pub fn #set(q: &mut __na::SVector<T, NQ>, #argument: &#value) {
            #written
        }
    }
}
