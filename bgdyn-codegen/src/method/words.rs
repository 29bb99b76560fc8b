//! What the documentation says of a method's result.

use super::Method;
use crate::bond_graph::{Site, SiteId};

impl Method {
    /// Describes the result: one line of documentation.
    pub fn summary(self, sites: &[Site]) -> String {
        let of = |site: SiteId| format!("`{}`", sites[site.0].name);
        match self {
            Method::InverseDynamics => {
                "Joint efforts that produce the accelerations `a` (Kuzmin 2007, eq. 6).".into()
            }
            Method::MassMatrix => "Mass matrix M(q), exactly symmetric.".into(),
            Method::Bias => "Bias force: everything in the joint efforts but M(q)·a.".into(),
            Method::Gravity => "Joint efforts that hold the mechanism at rest.".into(),
            Method::ForwardDynamics => {
                "Accelerations under the joint efforts `tau`: M⁻¹(tau − bias).".into()
            }
            Method::KineticEnergy => "Kinetic energy ½ vᵀ M(q) v.".into(),
            Method::PotentialEnergy => {
                "Potential energy of gravity; zero with every centre of mass at the world's origin."
                    .into()
            }
            Method::CoriolisMatrix => {
                "Coriolis matrix C(q, v) of Christoffel's symbols: bias = C v + gravity, Ṁ − 2C skew."
                    .into()
            }
            Method::InverseDynamicsDerivatives => {
                "Derivatives of the joint efforts: (∂τ/∂q, ∂τ/∂v); ∂τ/∂a is the mass matrix.".into()
            }
            Method::ForwardDynamicsDerivatives => {
                "Derivatives of the accelerations: (∂q̈/∂q, ∂q̈/∂v, ∂q̈/∂τ); the last is M⁻¹.".into()
            }
            Method::InverseDerivativesByTree => {
                "Derivatives of the joint efforts: (∂τ/∂q, ∂τ/∂v); ∂τ/∂a is the mass matrix. ∂τ/∂q has a column for each velocity of the open tree: the position moves along it, and closes.".into()
            }
            Method::ForwardDerivativesByTree => {
                "Derivatives of the accelerations: (∂q̈/∂q, ∂q̈/∂v, ∂q̈/∂τ); the last is M⁻¹. ∂q̈/∂q has a column for each velocity of the open tree: the position moves along it, and closes.".into()
            }
            Method::DriveEfforts(_) => {
                "Efforts of the drives that give the prescribed joints their motion, at the accelerations `a`.".into()
            }
            Method::Pose(s) => format!("Pose of {} in the world.", of(s)),
            Method::Velocity(s) => format!(
                "Velocity of {}, angular part first: ω, and the velocity of its origin; world axes.",
                of(s)
            ),
            Method::Jacobian(s) => format!(
                "Jacobian of {}: its velocity, angular part first, is J v; world axes, at its origin.",
                of(s)
            ),
            Method::JacobianDotV(s) => format!(
                "J̇ v of {}: its acceleration, angular part first, where the joints' is zero; world axes.",
                of(s)
            ),
            Method::VelocityMap => {
                "Velocity map S(q): the velocities of the open tree are S v.".into()
            }
            Method::TreeVelocity => "Velocities of the open tree: S v.".into(),
            Method::TreeAcceleration => "Accelerations of the open tree: S a + Ṡ v.".into(),
            Method::ConstraintResidual => {
                "By how much the loops are open, as in [`CONSTRAINT_NAMES`]; zero at closed positions.".into()
            }
            Method::ConstraintJacobian => {
                "Rates of the loops' conditions for the velocities of the open tree: B S = 0.".into()
            }
            Method::Multipliers => {
                "Efforts of the loops on place b, in the axes of place a, for the accelerations `a`, if all other efforts are those of the independent joints."
                    .into()
            }
            Method::ClosingStep => {
                "Step of Newton's method: the change of the dependent positions that closes the loops, with the opposite sign; `close` repeats it."
                    .into()
            }
            Method::ConstraintBias => {
                "Ḃ q̇ at the velocities `qd` of the open tree, at which B q̇ = 0: the rows demand B q̈ = −Ḃ q̇.".into()
            }
            Method::ConstrainedDynamics => {
                "Accelerations of the open tree and multipliers at its velocities `qd`, at which B q̇ = 0, under efforts `tau` on all its joints: M q̈ + h = tau + Bᵀ λ, B q̈ = −Ḃ q̇."
                    .into()
            }
            Method::ProjectVelocity => {
                "The velocities with B q̇ = 0 that are nearest to the velocities `qd` of the open tree: their difference has the least kinetic energy."
                    .into()
            }
            Method::Reactions => {
                "Forces and moments at the places where loops close and wheels touch, under the joint efforts `tau`, as in [`REACTION_NAMES`]."
                    .into()
            }
            Method::JointReactions => {
                "Force and moment on each link from its parent through its joint, about the link's origin, in link axes, at the accelerations `a`; links as in [`LINK_NAMES`]."
                    .into()
            }
            Method::ActuatedInverse(_) => {
                "Efforts of the actuated joints that produce the accelerations `a`, as in [`ACTUATED`]: A P = Sᵀ (6)."
                    .into()
            }
            Method::ActuatedForward(_) => {
                "Accelerations under the efforts `tau` of the actuated joints, as in [`ACTUATED`]: (Sᵀ M S)⁻¹ (A tau − bias)."
                    .into()
            }
            Method::ActuatedReactions(_) => {
                "Forces and moments at the places where loops close and wheels touch, under the efforts `tau` of the actuated joints, as in [`REACTION_NAMES`]."
                    .into()
            }
            Method::ActuatedJointReactions(_) => {
                "Force and moment on each link from its parent through its joint, about the link's origin, in link axes, at the accelerations `a` and under the efforts `tau` of the actuated joints, as in [`ACTUATED`]; links as in [`LINK_NAMES`]."
                    .into()
            }
            Method::Regressor(regressor) => regressor.summary().into(),
            Method::Payload(of) => of.summary(sites),
            Method::Operational(of) => of.summary(sites),
            Method::Directional(of) => of.summary().into(),
            Method::ParameterDerivatives(of) => of.summary().into(),
            Method::Centroidal(of) => of.summary().into(),
            Method::Contact(of) => of.summary().into(),
            Method::MassMatrixRate => {
                "Rate Ṁ(q, v) of the mass matrix along the velocities `v`, exactly symmetric.".into()
            }
            Method::Scene(role) => role.summary().into(),
            Method::Bundle { .. } => "The results of several methods, which share their computations.".into(),
        }
    }

    /// Returns the units of the result.
    pub fn units(self) -> &'static str {
        match self {
            Method::InverseDynamics
            | Method::ActuatedInverse(_)
            | Method::Bias
            | Method::Gravity
            | Method::DriveEfforts(_) => "N·m for a rotation, N for a translation",
            Method::MassMatrix => "kg·m² between rotations, kg·m mixed, kg between translations",
            Method::ForwardDynamics | Method::ActuatedForward(_) => {
                "rad/s² for a rotation, m/s² for a translation"
            }
            Method::KineticEnergy | Method::PotentialEnergy => "J",
            Method::CoriolisMatrix => "efforts per rad/s or m/s",
            Method::InverseDynamicsDerivatives | Method::InverseDerivativesByTree => {
                "efforts per rad or m, and per rad/s or m/s"
            }
            Method::ForwardDynamicsDerivatives | Method::ForwardDerivativesByTree => {
                "accelerations per rad or m, per rad/s or m/s, per N·m or N"
            }
            Method::Pose(_) => "m; columns of the rotation are the frame's axes in the world's",
            Method::Velocity(_) => "rad/s, m/s",
            Method::Jacobian(_) => "rad and m per unit of each joint",
            Method::JacobianDotV(_) => "rad/s², m/s²",
            Method::VelocityMap => "rad and m per unit of each independent joint",
            Method::TreeVelocity => "rad/s, m/s",
            Method::TreeAcceleration => "rad/s², m/s²",
            Method::ConstraintResidual => "m, rad",
            Method::ConstraintJacobian => "m and rad per unit of each joint",
            Method::Multipliers => "N, N·m",
            Method::ClosingStep => "rad, m",
            Method::ConstraintBias => "m/s², rad/s²",
            Method::ConstrainedDynamics => "rad/s², m/s²; N, N·m",
            Method::ProjectVelocity => "rad/s, m/s",
            Method::Reactions
            | Method::ActuatedReactions(_)
            | Method::JointReactions
            | Method::ActuatedJointReactions(_) => "N, N·m",
            Method::Regressor(regressor) => regressor.units(),
            Method::Payload(of) => of.units(),
            Method::Operational(of) => of.units(),
            Method::Directional(of) => of.units(),
            Method::ParameterDerivatives(of) => of.units(),
            Method::Centroidal(of) => of.units(),
            Method::Contact(of) => of.units(),
            Method::MassMatrixRate => "units of the mass matrix per second",
            Method::Scene(_) | Method::Bundle { .. } => "as its parts say",
        }
    }
}
