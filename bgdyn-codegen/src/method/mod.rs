//! The methods of a generated model: names, arguments, shapes, units.
//!
//! The formulations, the emitter and the command line use them.

mod actuated;
mod argument;
mod bundled;
mod centroidal;
mod contact;
mod derivatives;
mod directional;
mod loads;
mod operational;
mod parameter_derivatives;
mod payload;
mod possible;
mod regressor;
mod scene_function;
mod shape;
mod words;

use crate::bond_graph::{ClosedTree, Site, SiteId};
pub use argument::Argument;
pub use centroidal::Centroidal;
pub use contact::{CONTACT_DIRECTIONS, ContactMethod};
pub use directional::Directional;
pub use operational::{Operational, TASK_DIRECTIONS};
pub use parameter_derivatives::ParameterDerivatives;
pub use payload::PayloadRegressor;
pub use regressor::{PARAMETER_NAMES, PARAMETERS_PER_BODY, Regressor};
pub use scene_function::SceneFunction;
pub use shape::{Entries, ParameterSet, Shape};

/// A method of a generated model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// P_j of equation (6).
    InverseDynamics,
    /// M(q).
    MassMatrix,
    /// P − M a.
    Bias,
    /// P at rest.
    Gravity,
    /// Accelerations under given efforts.
    ForwardDynamics,
    /// T(q, v).
    KineticEnergy,
    /// V(q).
    PotentialEnergy,
    /// C(q, v).
    CoriolisMatrix,
    /// ∂τ/∂q, ∂τ/∂v.
    InverseDynamicsDerivatives,
    /// ∂q̈/∂q, ∂q̈/∂v, ∂q̈/∂τ.
    ForwardDynamicsDerivatives,
    /// P_j of equation (6) at the prescribed joints; their number.
    DriveEfforts(usize),
    /// [`Method::InverseDynamicsDerivatives`] where conditions on velocities alone leave more ways to move than velocities:
    /// ∂/∂q has a column for each velocity of the open tree.
    InverseDerivativesByTree,
    /// [`Method::ForwardDynamicsDerivatives`] likewise.
    ForwardDerivativesByTree,
    /// Pose of a site.
    Pose(SiteId),
    /// Velocity of a site.
    Velocity(SiteId),
    /// Jacobian of a site.
    Jacobian(SiteId),
    /// Acceleration of a site at zero joint accelerations.
    JacobianDotV(SiteId),
    /// S(q), of a mechanism with loops.
    VelocityMap,
    /// q̇ of the open tree: S v.
    TreeVelocity,
    /// q̈ of the open tree: S a + z.
    TreeAcceleration,
    /// c(q): by how much the loops are open.
    ConstraintResidual,
    /// B(q): the rates of c for the velocities of the open tree.
    ConstraintJacobian,
    /// λ: the efforts of the rows.
    Multipliers,
    /// The step of Newton's method for the dependent positions.
    ClosingStep,
    /// Ḃ q̇ for velocities of the open tree.
    ConstraintBias,
    /// q̈ of the open tree and λ under efforts on all its joints.
    ConstrainedDynamics,
    /// The nearest velocities of the open tree that the rows allow.
    ProjectVelocity,
    /// Forces and moments at the closing places and contacts.
    Reactions,
    /// Forces and moments at the joints of the tree of links.
    JointReactions,
    /// The efforts of the actuated joints that produce accelerations, where these are not the independent joints;
    /// their number.
    ActuatedInverse(usize),
    /// Accelerations under efforts of the actuated joints.
    ActuatedForward(usize),
    /// Forces and moments at the closing places and contacts under efforts of the actuated joints.
    ActuatedReactions(usize),
    /// Forces and moments at the joints of the tree of links, with drives at the actuated joints.
    ActuatedJointReactions(usize),
    /// A method that is linear in the parameters of the bodies, or one of their vectors.
    Regressor(Regressor),
    /// A method for the parameters of a payload.
    Payload(PayloadRegressor),
    /// A method of operational space.
    Operational(Operational),
    /// A derivative along a direction, or an adjoint.
    Directional(Directional),
    /// A derivative of the accelerations by parameters.
    ParameterDerivatives(ParameterDerivatives),
    /// The centre of mass, or the momentum about it.
    Centroidal(Centroidal),
    /// A method of the contacts.
    Contact(ContactMethod),
    /// Ṁ(q, v).
    MassMatrixRate,
    /// A function of a scene.
    Scene(SceneFunction),
    /// Several methods in one call.
    Bundle {
        /// What any of them reads.
        arguments: &'static [Argument],
        /// Whether one of them may have no result.
        checked: bool,
    },
}

/// Returns the names of all methods that a generated struct may have, for any names of sites.
pub fn names() -> Vec<String> {
    let all = Method::possible(&[]).into_iter();
    all.chain(Method::OF_LOOPS)
        .chain(Method::ON_REQUEST)
        .chain([Method::DriveEfforts(0)])
        .chain(Method::on_request())
        .map(|method| method.name(&[]))
        .chain(Method::reduced_names())
        .collect()
}

impl Method {
    /// The methods of [`bgdyn_runtime::Dynamics`], which every model has.
    pub const OF_TRAIT: [Method; 7] = [
        Method::InverseDynamics,
        Method::MassMatrix,
        Method::Bias,
        Method::Gravity,
        Method::ForwardDynamics,
        Method::KineticEnergy,
        Method::PotentialEnergy,
    ];

    /// Returns the methods, without those of sites, that a mechanism of any kind may have, and that are generated if they are
    /// asked for.
    pub fn on_request() -> impl Iterator<Item = Method> {
        let regressors = Regressor::ALL.map(Method::Regressor).into_iter();
        regressors
            .chain([Method::Operational(Operational::InverseMassMatrix)])
            .chain(Directional::ALL.map(Method::Directional))
            .chain(Centroidal::ALL.map(Method::Centroidal))
            .chain([Method::MassMatrixRate])
            .chain(ContactMethod::all(0).map(Method::Contact))
            .chain(ParameterDerivatives::all(0).map(Method::ParameterDerivatives))
    }

    /// The methods of mechanisms with loops.
    pub const OF_LOOPS: [Method; 7] = [
        Method::VelocityMap,
        Method::TreeVelocity,
        Method::TreeAcceleration,
        Method::ConstraintResidual,
        Method::ConstraintJacobian,
        Method::Multipliers,
        Method::ClosingStep,
    ];

    /// The methods of mechanisms with loops that are generated if they are asked for by name.
    pub const ON_REQUEST: [Method; 4] = [
        Method::ConstraintBias,
        Method::ConstrainedDynamics,
        Method::ProjectVelocity,
        Method::Reactions,
    ];

    /// Returns the methods of a mechanism with loops or contacts that all get: without those of closing if nothing closes.
    pub fn of_closed(closed: &ClosedTree) -> Vec<Method> {
        let closes = closed
            .closure
            .rows
            .iter()
            .any(|row| row.kind.has_positions());
        let closing = |m: &Method| matches!(m, Method::ConstraintResidual | Method::ClosingStep);
        let all = Method::OF_LOOPS.into_iter();
        all.filter(|method| closes || !closing(method)).collect()
    }

    /// Returns the four methods of a site.
    pub fn of_site(site: SiteId) -> [Method; 4] {
        [
            Method::Pose(site),
            Method::Velocity(site),
            Method::Jacobian(site),
            Method::JacobianDotV(site),
        ]
    }

    /// Returns whether the trait `Dynamics` has it.
    pub fn of_trait(self) -> bool {
        Method::OF_TRAIT.contains(&self)
    }

    /// Returns the site in its name.
    pub fn site(self) -> Option<SiteId> {
        match self {
            Method::Operational(of) => of.site(),
            Method::Payload(of) => Some(of.site()),
            other => other.placed_site(),
        }
    }

    /// Returns the site whose pose or motion the method computes.
    pub fn placed_site(self) -> Option<SiteId> {
        match self {
            Method::Pose(site)
            | Method::Velocity(site)
            | Method::Jacobian(site)
            | Method::JacobianDotV(site) => Some(site),
            _ => None,
        }
    }

    /// Returns whether its formulations do not compute it from the bond graph, but from functions of other methods or from
    /// parts of them.
    pub fn is_derived(self) -> bool {
        matches!(
            self,
            Method::Regressor(_)
                | Method::Payload(_)
                | Method::Operational(_)
                | Method::Contact(_)
                | Method::Directional(_)
                | Method::ParameterDerivatives(_)
        )
    }

    /// Returns its name.
    pub fn name(self, sites: &[Site]) -> String {
        let site = |prefix: &str, site: SiteId| format!("{prefix}_{}", sites[site.0].name);
        match self {
            Method::InverseDynamics | Method::ActuatedInverse(_) => "inverse_dynamics".into(),
            Method::MassMatrix => "mass_matrix".into(),
            Method::Bias => "bias".into(),
            Method::Gravity => "gravity".into(),
            Method::ForwardDynamics | Method::ActuatedForward(_) => "forward_dynamics".into(),
            Method::KineticEnergy => "kinetic_energy".into(),
            Method::PotentialEnergy => "potential_energy".into(),
            Method::CoriolisMatrix => "coriolis_matrix".into(),
            Method::InverseDynamicsDerivatives => "inverse_dynamics_derivatives".into(),
            Method::ForwardDynamicsDerivatives => "forward_dynamics_derivatives".into(),
            Method::InverseDerivativesByTree => "inverse_dynamics_derivatives".into(),
            Method::ForwardDerivativesByTree => "forward_dynamics_derivatives".into(),
            Method::DriveEfforts(_) => "drive_efforts".into(),
            Method::Pose(s) => site("pose", s),
            Method::Velocity(s) => site("velocity", s),
            Method::Jacobian(s) => site("jacobian_world", s),
            Method::JacobianDotV(s) => site("jacobian_dot_v_world", s),
            Method::VelocityMap => "velocity_map".into(),
            Method::TreeVelocity => "tree_velocity".into(),
            Method::TreeAcceleration => "tree_acceleration".into(),
            Method::ConstraintResidual => "constraint_residual".into(),
            Method::ConstraintJacobian => "constraint_jacobian".into(),
            Method::Multipliers => "multipliers".into(),
            Method::ClosingStep => "closing_step".into(),
            Method::ConstraintBias => "constraint_bias".into(),
            Method::ConstrainedDynamics => "constrained_dynamics".into(),
            Method::ProjectVelocity => "project_velocity".into(),
            Method::Reactions | Method::ActuatedReactions(_) => "reactions".into(),
            Method::JointReactions | Method::ActuatedJointReactions(_) => "joint_reactions".into(),
            Method::Regressor(regressor) => regressor.name().into(),
            Method::Payload(of) => site(of.prefix(), of.site()),
            Method::Operational(of) => match of.site() {
                Some(s) => site(of.prefix(), s),
                None => of.prefix().into(),
            },
            Method::Directional(of) => of.name().into(),
            Method::ParameterDerivatives(of) => of.name().into(),
            Method::Centroidal(of) => of.name().into(),
            Method::Contact(of) => of.name().into(),
            Method::MassMatrixRate => "mass_matrix_rate".into(),
            Method::Scene(role) => role.name().into(),
            Method::Bundle { .. } => "bundle".into(),
        }
    }

    /// Returns its arguments.
    pub fn arguments(self) -> &'static [Argument] {
        use Argument::{A, ActuatedTau, Q, Tau, TreeTau, TreeV, V};
        match self {
            Method::InverseDynamics
            | Method::InverseDynamicsDerivatives
            | Method::InverseDerivativesByTree
            | Method::ActuatedInverse(_)
            | Method::DriveEfforts(_) => &[Q, V, A],
            Method::MassMatrix | Method::Gravity | Method::PotentialEnergy => &[Q],
            Method::Pose(_) | Method::Jacobian(_) => &[Q],
            Method::Bias | Method::KineticEnergy | Method::CoriolisMatrix => &[Q, V],
            Method::Velocity(_) | Method::JacobianDotV(_) => &[Q, V],
            Method::VelocityMap | Method::ConstraintResidual => &[Q],
            Method::ConstraintJacobian | Method::ClosingStep => &[Q],
            Method::TreeVelocity => &[Q, V],
            Method::TreeAcceleration | Method::Multipliers | Method::JointReactions => &[Q, V, A],
            Method::ForwardDynamics
            | Method::ForwardDynamicsDerivatives
            | Method::ForwardDerivativesByTree => &[Q, V, Tau],
            Method::Reactions => &[Q, V, Tau],
            Method::ActuatedForward(_) | Method::ActuatedReactions(_) => &[Q, V, ActuatedTau],
            Method::ActuatedJointReactions(_) => &[Q, V, A, ActuatedTau],
            Method::ConstraintBias | Method::ProjectVelocity => &[Q, TreeV],
            Method::ConstrainedDynamics => &[Q, TreeV, TreeTau],
            Method::Regressor(regressor) => regressor.arguments(),
            Method::Payload(of) => of.arguments(),
            Method::Operational(of) => of.arguments(),
            Method::Directional(of) => of.arguments(),
            Method::ParameterDerivatives(of) => of.arguments(),
            Method::Centroidal(of) => of.arguments(),
            Method::Contact(of) => of.arguments(),
            Method::MassMatrixRate => &[Q, V],
            Method::Scene(SceneFunction::Inverse) => &[
                Argument::State,
                Argument::Accelerations,
                Argument::Input,
                Argument::Time,
            ],
            Method::Scene(
                SceneFunction::ToCanonical
                | SceneFunction::PositionRates
                | SceneFunction::ClosingStep,
            ) => &[Argument::State],
            Method::Scene(SceneFunction::FromCanonical) => &[Argument::Canonical],
            Method::Scene(SceneFunction::CanonicalRates) => &[
                Argument::Canonical,
                Argument::Modes,
                Argument::Input,
                Argument::Time,
            ],
            Method::Scene(_) => &[Argument::State, Argument::Input, Argument::Time],
            Method::Bundle { arguments, .. } => arguments,
        }
    }

    /// Returns whether its arguments are velocities of the open tree.
    pub fn of_tree(self) -> bool {
        self.arguments().contains(&Argument::TreeV)
    }

    /// Returns the shape of its result.
    pub fn shape(self) -> Shape {
        match self {
            Method::InverseDynamics | Method::Bias | Method::Gravity => Shape::Vector,
            Method::ForwardDynamics | Method::ActuatedForward(_) => Shape::CheckedVector,
            Method::ActuatedInverse(number) => Shape::CheckedActuated(number),
            Method::MassMatrix => Shape::Symmetric,
            Method::KineticEnergy | Method::PotentialEnergy => Shape::Scalar,
            Method::CoriolisMatrix => Shape::Square,
            Method::InverseDynamicsDerivatives => Shape::SquarePair,
            Method::ForwardDynamicsDerivatives => Shape::CheckedSquares,
            Method::InverseDerivativesByTree => Shape::SlopesByTree,
            Method::ForwardDerivativesByTree => Shape::CheckedSlopesByTree,
            Method::DriveEfforts(np) => Shape::Drives(np),
            Method::Pose(_) => Shape::Pose,
            Method::Velocity(_) | Method::JacobianDotV(_) => Shape::Spatial,
            Method::Jacobian(_) => Shape::Jacobian,
            Method::VelocityMap => Shape::TreeMatrix,
            Method::TreeVelocity | Method::TreeAcceleration => Shape::TreeVector,
            Method::ClosingStep => Shape::TreeVector,
            Method::ConstraintResidual | Method::Multipliers => Shape::RowVector,
            Method::ConstraintBias => Shape::RowVector,
            Method::ConstraintJacobian => Shape::RowMatrix,
            Method::ConstrainedDynamics => Shape::CheckedTreeAndRows,
            Method::ProjectVelocity => Shape::CheckedTree,
            Method::Reactions | Method::ActuatedReactions(_) => Shape::CheckedWrenches,
            Method::JointReactions | Method::ActuatedJointReactions(_) => Shape::LinkWrenches,
            Method::Regressor(regressor) => regressor.shape(),
            Method::Payload(of) => of.shape(),
            Method::Operational(of) => of.shape(),
            Method::Directional(of) => of.shape(),
            Method::ParameterDerivatives(of) => of.shape(),
            Method::Centroidal(of) => of.shape(),
            Method::Contact(of) => of.shape(),
            Method::MassMatrixRate => Shape::Symmetric,
            Method::Scene(
                SceneFunction::Energy
                | SceneFunction::RigidContactStates
                | SceneFunction::RigidContactBiases
                | SceneFunction::Inverse
                | SceneFunction::Inputs
                | SceneFunction::Outputs
                | SceneFunction::ToCanonical
                | SceneFunction::PositionRates
                | SceneFunction::ClosingStep,
            ) => Shape::Parts,
            Method::Scene(_) => Shape::CheckedParts,
            Method::Bundle { checked: false, .. } => Shape::Bundle,
            Method::Bundle { checked: true, .. } => Shape::CheckedBundle,
        }
    }
}
