//! Emits what a module says of joints whose motion is prescribed.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::mechanism::{Mechanism, prescribed_parameter_names};
use crate::method::Method;
use crate::model::Model;

/// Returns the constants of the prescribed joints; nothing if there are none.
pub(super) fn prescribed_constants(names: &[String]) -> TokenStream {
    if names.is_empty() {
        return TokenStream::new();
    }
    let np = Literal::usize_unsuffixed(names.len());
    quote! {
        /// Number of prescribed joints.
        pub const NP: usize = #np;
        /// Names of the prescribed joints, in the order of `drive_efforts`.
        pub const PRESCRIBED_NAMES: [&str; NP] = [#(#names),*];
    }
}

/// Describes the prescribed joints, if there are any.
pub(super) fn prescribed_docs(mechanism: &Mechanism) -> Vec<String> {
    let names = mechanism.prescribed_names();
    if names.is_empty() {
        return Vec::new();
    }
    let fields = |name: &String| {
        let fields = prescribed_parameter_names(name);
        format!(" | `{name}` | `{}` |", fields.join("`, `"))
    };
    let mut docs = vec![
        String::new(),
        " The motion of these joints is prescribed by fields of the struct. Efforts, accelerations, energies, poses,"
            .into(),
        " velocities and J̇ v are those of the whole motion; Jacobians and the mass matrix belong to v.".into(),
        String::new(),
        " | prescribed joint | fields |".into(),
        " |---|---|".into(),
    ];
    docs.extend(names.iter().map(fields));
    docs
}

/// Returns the constant with the names of the joints in a method's result.
pub(super) fn joint_list(method: Method) -> &'static str {
    match method {
        Method::DriveEfforts(_) => "PRESCRIBED_NAMES",
        _ => "JOINT_NAMES",
    }
}

/// Describes a method's result: one line of documentation.
pub(super) fn summary_of(method: Method, model: &Model) -> String {
    let usual = method.summary(&model.bond_graph.sites);
    if model.mechanism.prescribed().is_empty() {
        return usual;
    }
    match method {
        Method::Gravity => {
            "Joint efforts at which the joints in q rest while the prescribed ones move.".into()
        }
        Method::KineticEnergy => "Kinetic energy, with the motion of the prescribed joints.".into(),
        Method::CoriolisMatrix => {
            "Coriolis matrix C(q, v): bias = C v + gravity, Ṁ + ∂M/∂t − 2C skew; ∂M/∂t is along the prescribed joints.".into()
        }
        Method::Velocity(_) | Method::JacobianDotV(_) => {
            let usual = usual.replace("J̇ v of", "J̇ v and the prescribed motion of");
            format!("{} With the motion of the prescribed joints.", usual)
        }
        Method::Jacobian(_) => usual.replace(", is J v;", ", changes by J v with v;"),
        _ => usual,
    }
}
