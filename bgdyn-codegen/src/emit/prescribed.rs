//! Emits what a module says of joints whose motion is prescribed.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::mechanism::{Mechanism, prescribed_parameter_names};
use crate::method::Method;

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
        Method::ActuatedInverse(_) => "ACTUATED",
        method if method.of_tree() => "TREE_JOINT_NAMES",
        _ => "JOINT_NAMES",
    }
}
