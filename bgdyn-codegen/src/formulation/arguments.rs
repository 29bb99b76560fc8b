//! The arguments of a method, and the numbers of the spec, as expressions.

use crate::bond_graph::{Multibody, Rotor};
use crate::expr::{Builder, Expr, Leaf};
use crate::math::Vec3;
use crate::mechanism::{BaseMotion, ParameterId, Value};
use crate::method::{Argument, Method, Regressor};

/// The motion of a base that is given at run time, in base axes.
#[derive(Clone, Copy)]
pub(super) struct BaseState<'g> {
    /// ω, rad/s.
    pub omega: Vec3<Expr<'g>>,
    /// ω̇, rad/s².
    pub omega_dot: Vec3<Expr<'g>>,
    /// Acceleration of the base's origin less gravity, m/s².
    pub acceleration: Vec3<Expr<'g>>,
}

/// The arguments of a method as expressions; quantities that are no arguments are zero.
pub(super) struct Arguments<'g> {
    /// Positions.
    pub q: Vec<Expr<'g>>,
    /// Velocities.
    pub v: Vec<Expr<'g>>,
    /// Accelerations.
    pub a: Vec<Expr<'g>>,
    /// Joint efforts.
    pub tau: Vec<Expr<'g>>,
    /// Velocities of a reference.
    pub reference_v: Vec<Expr<'g>>,
    /// A number for each velocity.
    pub direction: Vec<Expr<'g>>,
    /// Whether the active efforts are included.
    pub active: bool,
    /// The motion of the base, for methods that depend on it.
    pub base: Option<BaseState<'g>>,
}

impl<'g> Arguments<'g> {
    /// Returns the arguments of a method; of one with the velocities of the open tree if the graph is that tree's.
    pub fn new(b: &'g Builder, graph: &Multibody, method: Method) -> Self {
        let read_all = |n: usize, on: bool, leaf: fn(usize) -> Leaf| -> Vec<Expr<'g>> {
            (0..n)
                .map(|j| if on { b.leaf(leaf(j)) } else { b.zero() })
                .collect()
        };
        let read = |on, leaf| read_all(graph.coordinates.len(), on, leaf);
        let takes = |argument| method.arguments().contains(&argument);
        // Kinetic energy and velocities of frames always use the true velocities, also without velocity
        // products.
        let kinematic = method.placed_site().is_some()
            || matches!(
                method,
                Method::KineticEnergy
                    | Method::ProjectVelocity
                    | Method::Centroidal(_)
                    | Method::Contact(_)
                    | Method::MassMatrixRate
                    | Method::Regressor(
                        Regressor::Momentum | Regressor::BaseMomentum | Regressor::KineticEnergy
                    )
            );
        let turning = graph.velocity_products || kinematic;
        let efforts = match method {
            Method::ActuatedForward(number)
            | Method::ActuatedReactions(number)
            | Method::ActuatedJointReactions(number) => read_all(number, true, Leaf::Input),
            _ => read(
                takes(Argument::Tau) || takes(Argument::TreeTau),
                Leaf::Input,
            ),
        };
        Arguments {
            q: read_all(graph.positions.len(), true, Leaf::Position),
            v: read(
                (takes(Argument::V) || takes(Argument::TreeV)) && turning,
                Leaf::Velocity,
            ),
            a: read(
                takes(Argument::A) || takes(Argument::ReferenceA),
                Leaf::Acceleration,
            ),
            tau: efforts,
            reference_v: read(takes(Argument::ReferenceV) && turning, Leaf::State),
            direction: read(takes(Argument::Direction), Leaf::Input),
            active: !matches!(method, Method::Centroidal(_)),
            base: graph
                .base
                .filter(|_| moves_with_base(method))
                .map(|motion| base_state(b, &motion)),
        }
    }
}

/// Returns whether a method depends on the motion of the base: efforts and accelerations do; poses,
/// velocities and energies are relative to the base.
fn moves_with_base(method: Method) -> bool {
    matches!(
        method,
        Method::InverseDynamics
            | Method::Bias
            | Method::Gravity
            | Method::ForwardDynamics
            | Method::CoriolisMatrix
            | Method::InverseDynamicsDerivatives
            | Method::ForwardDynamicsDerivatives
            | Method::InverseDerivativesByTree
            | Method::ForwardDerivativesByTree
            | Method::JointReactions
            | Method::ActuatedJointReactions(_)
            | Method::Payload(_)
    ) || matches!(method, Method::Regressor(regressor) if regressor.moves_with_base())
}

fn base_state<'g>(b: &'g Builder, motion: &BaseMotion) -> BaseState<'g> {
    let read = |v: Vec3<ParameterId>| v.map(|p| value(b, Value::Parameter(p)));
    BaseState {
        omega: read(motion.angular_velocity),
        omega_dot: read(motion.angular_acceleration),
        acceleration: read(motion.specific_force),
    }
}

/// Returns the inertia that a rotor adds to a joint: N² J.
pub(super) fn reflected<'g>(b: &'g Builder, rotor: &Rotor) -> Expr<'g> {
    spin(b, rotor) * value(b, rotor.ratio)
}

/// Returns the momentum of a rotor about its axis per unit rate of the joint: N J.
pub(super) fn spin<'g>(b: &'g Builder, rotor: &Rotor) -> Expr<'g> {
    value(b, rotor.inertia) * value(b, rotor.ratio)
}

/// Returns a number of the spec as an expression.
pub(super) fn value<'g>(b: &'g Builder, value: Value) -> Expr<'g> {
    match value {
        Value::Fixed(x) => b.constant(x),
        Value::Parameter(ParameterId(p)) => b.leaf(Leaf::Parameter(p)),
    }
}
