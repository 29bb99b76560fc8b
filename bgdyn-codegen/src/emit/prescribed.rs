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
        Method::ActuatedInverse(_) => "ACTUATED",
        method if method.of_tree() => "TREE_JOINT_NAMES",
        _ => "JOINT_NAMES",
    }
}

/// Describes a method's result where wheels or knife edges are among the constraints.
fn summary_with_contacts(method: Method, usual: String) -> String {
    match method {
        Method::ConstraintResidual => {
            "By how much wheels are above their planes and loops are open, as in [`CONSTRAINT_NAMES`]; zero for rows on velocities.".into()
        }
        Method::ConstraintJacobian => {
            "Rates of the rows of the constraints for the velocities of the open tree: B S = 0.".into()
        }
        Method::Multipliers => {
            "Forces on the wheels and edges along the directions of the rows, and of loops on place b, for the accelerations `a`, if all other efforts are those of the independent joints."
                .into()
        }
        Method::ClosingStep => {
            "Step of Newton's method: the change of the positions that makes wheels touch and loops close, with the opposite sign; `close` repeats it."
                .into()
        }
        _ => usual,
    }
}

/// Describes the result of a method whose efforts are along the independent velocities, while other joints are
/// actuated: one line of documentation.
fn reduced_summary(method: Method) -> Option<String> {
    let text = match method {
        Method::InverseDynamics => {
            "Efforts Sᵀ P along the independent velocities that produce the accelerations `a` (Kuzmin 2007, eq. 6)."
        }
        Method::ForwardDynamics => {
            "Accelerations under the efforts `tau` along the independent velocities: M⁻¹(tau − bias)."
        }
        Method::Gravity => {
            "Efforts along the independent velocities that hold the mechanism at rest."
        }
        Method::Bias => {
            "Bias force: everything in the efforts along the independent velocities but M(q)·a."
        }
        method if method.differentiates_inverse() => {
            "Derivatives of the efforts along the independent velocities: (∂τ/∂q, ∂τ/∂v); ∂τ/∂a is the mass matrix."
        }
        _ => return None,
    };
    Some(text.into())
}

/// Describes a method's result: one line of documentation.
pub(super) fn summary_of(method: Method, model: &Model) -> String {
    let usual = method.summary(&model.bond_graph.sites);
    let closed = model.bond_graph.closed.as_deref();
    let drives = closed.and_then(|closed| closed.closure.drives());
    if let Some(reduced) = drives.and_then(|_| reduced_summary(method)) {
        return reduced;
    }
    if closed.is_some_and(|closed| closed.closure.nonholonomic()) {
        return summary_with_contacts(method, usual);
    }
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
