//! The methods of a generated model: names, arguments, shapes, units.
//!
//! The formulations, the emitter and the command line use them.

mod argument;
mod scene_function;
mod shape;

use crate::bond_graph::{BondGraph, ClosedTree, Site, SiteId};
use crate::fault::unknown_name;
pub use argument::Argument;
pub use scene_function::SceneFunction;
pub use shape::Shape;

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
    /// A function of a scene.
    Scene(SceneFunction),
}

/// Returns the names of all methods that a generated struct may have, for any names of sites.
pub fn names() -> Vec<String> {
    let all = Method::possible(&[]).into_iter();
    all.chain(Method::OF_LOOPS)
        .chain([Method::DriveEfforts(0)])
        .map(|method| method.name(&[]))
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

    /// Returns the methods of a mechanism with loops or contacts: without those of closing if nothing closes.
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

    /// Returns every method that this mechanism can have.
    pub fn possible_of(graph: &BondGraph) -> Vec<Method> {
        let drives = graph.released.iter().map(|r| r.prescribed.len());
        let drives = drives.map(Method::DriveEfforts);
        let (own, of_sites): (Vec<_>, Vec<_>) = Method::possible(&graph.sites)
            .into_iter()
            .partition(|method| method.site().is_none());
        let mut all: Vec<Method> = own.into_iter().chain(drives).chain(of_sites).collect();
        // Positions change in more directions than v has entries.
        let slips = graph
            .closed
            .iter()
            .any(|closed| closed.closure.nonholonomic());
        if slips {
            let derivatives = [
                Method::InverseDynamicsDerivatives,
                Method::ForwardDynamicsDerivatives,
            ];
            all.retain(|method| !derivatives.contains(method));
        }
        all.extend(
            graph
                .closed
                .iter()
                .flat_map(|closed| Method::of_closed(closed)),
        );
        all
    }

    /// Returns every method that a mechanism without loops and prescribed joints can have.
    pub fn possible(sites: &[Site]) -> Vec<Method> {
        let own = [
            Method::CoriolisMatrix,
            Method::InverseDynamicsDerivatives,
            Method::ForwardDynamicsDerivatives,
        ];
        let of_sites = (0..sites.len()).flat_map(|i| Method::of_site(SiteId(i)));
        Method::OF_TRAIT
            .into_iter()
            .chain(own)
            .chain(of_sites)
            .collect()
    }

    /// Returns the method with this name, if the mechanism can have it.
    ///
    /// # Errors
    /// A sentence with the nearest name, or with all names.
    pub fn named(graph: &BondGraph, name: &str) -> Result<Method, String> {
        let (possible, sites) = (Method::possible_of(graph), &graph.sites);
        let found = possible.iter().find(|m| m.name(sites) == name);
        found.copied().ok_or_else(|| {
            let known: Vec<String> = possible.iter().map(|m| m.name(sites)).collect();
            let known: Vec<&str> = known.iter().map(String::as_str).collect();
            let own = &known[..possible.iter().filter(|m| m.site().is_none()).count()];
            let places: Vec<&str> = sites.iter().map(|s| s.name.as_str()).collect();
            let all = format!(
                "{}; and pose_X, velocity_X, jacobian_world_X, jacobian_dot_v_world_X for X = {}",
                own.join(", "),
                places.join(", ")
            );
            unknown_name("method", name, &known, &all)
        })
    }

    /// Returns whether the trait `Dynamics` has it.
    pub fn of_trait(self) -> bool {
        Method::OF_TRAIT.contains(&self)
    }

    /// Returns the site of the method.
    pub fn site(self) -> Option<SiteId> {
        match self {
            Method::Pose(site)
            | Method::Velocity(site)
            | Method::Jacobian(site)
            | Method::JacobianDotV(site) => Some(site),
            _ => None,
        }
    }

    /// Returns its name.
    pub fn name(self, sites: &[Site]) -> String {
        let site = |prefix: &str, site: SiteId| format!("{prefix}_{}", sites[site.0].name);
        match self {
            Method::InverseDynamics => "inverse_dynamics".into(),
            Method::MassMatrix => "mass_matrix".into(),
            Method::Bias => "bias".into(),
            Method::Gravity => "gravity".into(),
            Method::ForwardDynamics => "forward_dynamics".into(),
            Method::KineticEnergy => "kinetic_energy".into(),
            Method::PotentialEnergy => "potential_energy".into(),
            Method::CoriolisMatrix => "coriolis_matrix".into(),
            Method::InverseDynamicsDerivatives => "inverse_dynamics_derivatives".into(),
            Method::ForwardDynamicsDerivatives => "forward_dynamics_derivatives".into(),
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
            Method::Scene(role) => role.name().into(),
        }
    }

    /// Returns its arguments.
    pub fn arguments(self) -> &'static [Argument] {
        use Argument::{A, Q, Tau, V};
        match self {
            Method::InverseDynamics
            | Method::InverseDynamicsDerivatives
            | Method::DriveEfforts(_) => &[Q, V, A],
            Method::MassMatrix | Method::Gravity | Method::PotentialEnergy => &[Q],
            Method::Pose(_) | Method::Jacobian(_) => &[Q],
            Method::Bias | Method::KineticEnergy | Method::CoriolisMatrix => &[Q, V],
            Method::Velocity(_) | Method::JacobianDotV(_) => &[Q, V],
            Method::VelocityMap | Method::ConstraintResidual => &[Q],
            Method::ConstraintJacobian | Method::ClosingStep => &[Q],
            Method::TreeVelocity => &[Q, V],
            Method::TreeAcceleration | Method::Multipliers => &[Q, V, A],
            Method::ForwardDynamics | Method::ForwardDynamicsDerivatives => &[Q, V, Tau],
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
        }
    }

    /// Returns the shape of its result.
    pub fn shape(self) -> Shape {
        match self {
            Method::InverseDynamics | Method::Bias | Method::Gravity => Shape::Vector,
            Method::ForwardDynamics => Shape::CheckedVector,
            Method::MassMatrix => Shape::Symmetric,
            Method::KineticEnergy | Method::PotentialEnergy => Shape::Scalar,
            Method::CoriolisMatrix => Shape::Square,
            Method::InverseDynamicsDerivatives => Shape::SquarePair,
            Method::ForwardDynamicsDerivatives => Shape::CheckedSquares,
            Method::DriveEfforts(np) => Shape::Drives(np),
            Method::Pose(_) => Shape::Pose,
            Method::Velocity(_) | Method::JacobianDotV(_) => Shape::Spatial,
            Method::Jacobian(_) => Shape::Jacobian,
            Method::VelocityMap => Shape::TreeMatrix,
            Method::TreeVelocity | Method::TreeAcceleration => Shape::TreeVector,
            Method::ClosingStep => Shape::TreeVector,
            Method::ConstraintResidual | Method::Multipliers => Shape::RowVector,
            Method::ConstraintJacobian => Shape::RowMatrix,
            Method::Scene(
                SceneFunction::Energy
                | SceneFunction::Inverse
                | SceneFunction::Inputs
                | SceneFunction::Outputs
                | SceneFunction::ToCanonical
                | SceneFunction::PositionRates
                | SceneFunction::ClosingStep,
            ) => Shape::Parts,
            Method::Scene(_) => Shape::CheckedParts,
        }
    }

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
            Method::Scene(role) => role.summary().into(),
        }
    }

    /// Returns the units of the result.
    pub fn units(self) -> &'static str {
        match self {
            Method::InverseDynamics | Method::Bias | Method::Gravity | Method::DriveEfforts(_) => {
                "N·m for a rotation, N for a translation"
            }
            Method::MassMatrix => "kg·m² between rotations, kg·m mixed, kg between translations",
            Method::ForwardDynamics => "rad/s² for a rotation, m/s² for a translation",
            Method::KineticEnergy | Method::PotentialEnergy => "J",
            Method::CoriolisMatrix => "efforts per rad/s or m/s",
            Method::InverseDynamicsDerivatives => "efforts per rad or m, and per rad/s or m/s",
            Method::ForwardDynamicsDerivatives => {
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
            Method::Scene(_) => "as its parts say",
        }
    }
}
