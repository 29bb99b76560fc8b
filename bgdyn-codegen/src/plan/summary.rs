//! Describes a method's result in the module of a mechanism: one line of documentation.

use crate::method::Method;
use crate::model::Model;

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
pub fn summary_of(method: Method, model: &Model) -> String {
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
