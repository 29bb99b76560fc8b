//! The task: the origin of the Panda's last joint to a point 0.41 m away within a second, and to rest there.

use bgdyn::nalgebra::{SMatrix, SVector, Vector3};
use bgdyn::runtime::step::{SemiImplicit, State};
use bgdyn_sim::ilqr::{Cost, Part, Problem, Quadratic};

use crate::panda7::Panda7;

/// Number of joints.
pub const JOINTS: usize = 7;
/// Number of steps.
pub const NODES: usize = 50;
/// Length of a step, s.
pub const STEP: f64 = 0.02;
/// Positions at the start, rad; the arm is at rest there.
#[expect(
    clippy::approx_constant,
    reason = "the numbers of the recorded task, as they are"
)]
pub const START: [f64; JOINTS] = [
    0.0,
    -0.785398163,
    0.0,
    -2.35619449,
    0.0,
    1.57079632679,
    0.785398163,
];
/// From the place at the start to the target, m.
pub const WAY: [f64; 3] = [-0.2, 0.3, 0.2];

/// Positions, velocities or efforts of all joints.
pub type Joints = SVector<f64, JOINTS>;
/// Positions and velocities.
pub type ArmState = State<f64, JOINTS, JOINTS>;
/// The problem to be solved.
pub type Reaching<'a> = Problem<'a, Panda7<f64>, Reach, f64, JOINTS>;

/// The cost: h (w_v |v|²/2 + w_u |u − u₀|²/2 + w_p |p − p*|²/2) at each node and w_v |v|²/2 + w_p |p − p*|²/2 at the end,
/// with the place p(q).
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    /// p*, m.
    pub target: Vector3<f64>,
    /// u₀: efforts that hold the arm at the start, N·m.
    pub holding: Joints,
    /// At each node: of velocities, efforts, and the distance.
    pub node: [f64; 3],
    /// At the end: of velocities, and the distance.
    pub end: [f64; 2],
}

impl Reach {
    /// Returns the cost for an arm.
    pub fn new(arm: &Panda7<f64>) -> Self {
        let start = Joints::from(START);
        Reach {
            target: place(arm, &start) + Vector3::from(WAY),
            holding: arm.gravity(&start),
            node: [0.1, 1e-3, 1.0],
            end: [10.0, 1e3],
        }
    }

    /// Returns p − p*.
    pub fn miss(&self, arm: &Panda7<f64>, q: &Joints) -> Vector3<f64> {
        place(arm, q) - self.target
    }

    /// Adds the derivatives of weights[0] |v|²/2 + weights[1] |p − p*|²/2.
    fn add_state(
        &self,
        arm: &Panda7<f64>,
        state: &ArmState,
        weights: [f64; 2],
        sum: &mut Quadratic<f64, JOINTS>,
    ) {
        sum.add_square(Part::V, weights[0], &state.v);
        let jacobian = arm.jacobian_world_l_panda_joint7(&state.q);
        let by_q: SMatrix<f64, 3, JOINTS> = jacobian.fixed_rows::<3>(3).into_owned();
        sum.add_residual(weights[1], &self.miss(arm, &state.q), &by_q);
    }
}

/// Returns the place of the last joint's origin, m.
pub fn place(arm: &Panda7<f64>, q: &Joints) -> Vector3<f64> {
    arm.pose_l_panda_joint7(q).translation
}

/// Returns the state at the start.
pub fn start() -> ArmState {
    State {
        q: Joints::from(START),
        v: Joints::zeros(),
    }
}

/// Returns the problem, without limits of the efforts.
pub fn problem<'a>(model: &'a Panda7<f64>, cost: &'a Reach) -> Reaching<'a> {
    Problem {
        model,
        cost,
        step: SemiImplicit { step: STEP },
        limits: None,
    }
}

impl Cost<Panda7<f64>, f64, JOINTS, JOINTS> for Reach {
    fn node(&self, arm: &Panda7<f64>, _: usize, state: &ArmState, tau: &Joints) -> f64 {
        let [v, u, p] = self.node;
        let squares = v * state.v.norm_squared()
            + u * (tau - self.holding).norm_squared()
            + p * self.miss(arm, &state.q).norm_squared();
        0.5 * STEP * squares
    }

    fn end(&self, arm: &Panda7<f64>, state: &ArmState) -> f64 {
        let [v, p] = self.end;
        0.5 * (v * state.v.norm_squared() + p * self.miss(arm, &state.q).norm_squared())
    }

    fn add_node(
        &self,
        arm: &Panda7<f64>,
        _: usize,
        state: &ArmState,
        tau: &Joints,
        sum: &mut Quadratic<f64, JOINTS>,
    ) {
        let [v, u, p] = self.node.map(|weight| STEP * weight);
        sum.add_square(Part::U, u, &(tau - self.holding));
        self.add_state(arm, state, [v, p], sum);
    }

    fn add_end(&self, arm: &Panda7<f64>, state: &ArmState, sum: &mut Quadratic<f64, JOINTS>) {
        self.add_state(arm, state, self.end, sum);
    }
}
