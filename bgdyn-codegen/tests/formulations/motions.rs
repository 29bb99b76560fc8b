//! Tests poses, velocities and Jacobians of sites, the Coriolis matrix and first derivatives: against each
//! other and against differences in double-double, on random mechanisms and golden robots.

use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::values::{Direction, Methods};
use crate::common::{Robot, State, assert_close, full, golden, natural_effort};
use bgdyn_codegen::bond_graph::SiteId;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

/// Of double-double results that follow from each other without a difference quotient.
const EXACT: f64 = 1e-27;
/// Step of a central difference in double-double: its error is about the square of it.
const STEP: f64 = 1e-9;
/// Of central differences, relative to natural size.
const DIFFERENCE: f64 = 1e-15;

struct Case {
    what: String,
    robot: Robot,
    state: State,
}

fn cases() -> impl Iterator<Item = Case> {
    (0..24).map(|seed| {
        let mut rng = Rng::new(9000 + seed);
        let text = Draft::random(&mut rng, 6).yaml();
        let robot = Robot::read(&text, None);
        let state = State::random(&mut rng, &robot.motions());
        let what = format!("seed {seed}\n{text}{state:?}");
        Case { what, robot, state }
    })
}

impl Case {
    fn value(&self, formulation: &str, method: Method) -> Vec<Dd> {
        self.at(formulation, method, 0.0)
    }

    /// The value at q + `step` · v.
    fn at(&self, formulation: &str, method: Method, step: f64) -> Vec<Dd> {
        let mut inputs = self.state.inputs::<Dd>();
        for (q, v) in inputs.q.iter_mut().zip(&self.state.v) {
            *q += Dd::from_f64(step) * Dd::from_f64(*v);
        }
        self.robot.function(formulation, method).evaluate(inputs).0
    }

    /// d/dt along v, by a central difference.
    fn rate(&self, method: Method) -> Vec<Dd> {
        let (after, before) = (
            self.at("literal", method, STEP),
            self.at("literal", method, -STEP),
        );
        let quotient = |(x, y): (&Dd, &Dd)| (*x - *y) / Dd::from_f64(2.0 * STEP);
        after.iter().zip(&before).map(quotient).collect()
    }

    fn close(&self, law: &str, x: &[Dd], y: &[Dd], tolerance: f64) {
        assert_close(x, y, tolerance, || format!("{law}\n{}", self.what));
    }

    /// Size of lengths and rates in these mechanisms: some metres, some rad/s.
    fn size(&self) -> f64 {
        let speed = crate::common::sum_abs(&self.state.v);
        let reach = 10.0 + crate::common::sum_abs(&self.state.q);
        reach * (1.0 + speed) * (1.0 + speed)
    }
}

fn product(matrix: &[Dd], columns: usize, v: &[f64]) -> Vec<Dd> {
    matrix
        .chunks(columns)
        .map(|row| crate::common::values::dot(row, v))
        .collect()
}

#[test]
fn sites_move_as_their_poses_do() {
    let mut sites = 0;
    for case in cases() {
        let n = case.state.q.len();
        for site in (0..case.robot.graph.sites.len()).map(SiteId) {
            sites += 1;
            for method in Method::of_site(site) {
                let (x, y) = (
                    case.value("recursion", method),
                    case.value("literal", method),
                );
                case.close("recursion = literal", &x, &y, EXACT * case.size());
            }
            let velocity = case.value("recursion", Method::Velocity(site));
            let jacobian = case.value("recursion", Method::Jacobian(site));
            let product = product(&jacobian, n, &case.state.v);
            case.close("J v = velocity", &product, &velocity, EXACT * case.size());
            let bias = case.value("recursion", Method::JacobianDotV(site));
            let rate = case.rate(Method::Velocity(site));
            case.close("J̇ v = rate of J v", &bias, &rate, DIFFERENCE * case.size());
            moves_as_pose(&case, site, &velocity);
        }
    }
    assert!(sites > 100, "{sites}");
}

/// The velocity's linear part is the rate of the origin, its angular part ω with Ṙ Rᵀ = [ω]×.
fn moves_as_pose(case: &Case, site: SiteId, velocity: &[Dd]) {
    let pose = case.value("recursion", Method::Pose(site));
    let rate = case.rate(Method::Pose(site));
    case.close(
        "linear",
        &velocity[3..],
        &rate[9..],
        DIFFERENCE * case.size(),
    );
    let spin = |i: usize, j: usize| {
        (0..3).fold(Dd::ZERO, |sum, k| sum + rate[3 * i + k] * pose[3 * j + k])
    };
    let omega = [spin(2, 1), spin(0, 2), spin(1, 0)];
    case.close("angular", &velocity[..3], &omega, DIFFERENCE * case.size());
}

#[test]
fn coriolis_matrix_holds_christoffels_symbols() {
    for case in cases() {
        let n = case.state.q.len();
        let effort = natural_effort(&case.robot, &case.state);
        for formulation in ["literal", "recursion"] {
            let c = case.value(formulation, Method::CoriolisMatrix);
            let gravity = case.value(formulation, Method::Gravity);
            let bias = case.value(formulation, Method::Bias);
            let sum: Vec<Dd> = product(&c, n, &case.state.v)
                .into_iter()
                .zip(gravity)
                .map(|(x, g)| x + g)
                .collect();
            case.close("C v + gravity = bias", &sum, &bias, EXACT * effort);
            // Ṁ − 2C is skew.
            let methods = Methods::new(&case.robot, formulation);
            let along = Direction {
                q: Some(&case.state.v),
                ..Direction::default()
            };
            let rate = full(
                &methods.derivative(Method::MassMatrix, &case.state, &along),
                n,
            );
            let two = Dd::from_f64(2.0);
            let skew = |i: usize, j: usize| rate[i][j] - two * c[n * i + j];
            for i in 0..n {
                for j in 0..=i {
                    case.close(
                        "Ṁ − 2C is skew",
                        &[skew(i, j)],
                        &[-skew(j, i)],
                        EXACT * effort,
                    );
                }
            }
        }
    }
}

#[test]
fn derivatives_of_inverse_dynamics_are_its_slopes() {
    for case in cases() {
        let n = case.state.q.len();
        let effort = natural_effort(&case.robot, &case.state) * (1.0 + case.size());
        let inverse = case.robot.function("recursion", Method::InverseDynamics);
        let made = case.value("recursion", Method::InverseDynamicsDerivatives);
        let other = case.value("literal", Method::InverseDynamicsDerivatives);
        case.close("recursion = literal", &made, &other, EXACT * effort);
        for j in 0..n {
            let slope = |of_q: bool| -> Vec<Dd> {
                let moved = |step: f64| {
                    let mut inputs = case.state.inputs::<Dd>();
                    let x = if of_q {
                        &mut inputs.q[j]
                    } else {
                        &mut inputs.v[j]
                    };
                    *x += Dd::from_f64(step);
                    inverse.evaluate(inputs).0
                };
                let quotient = |(x, y): (Dd, Dd)| (x - y) / Dd::from_f64(2.0 * STEP);
                moved(STEP)
                    .into_iter()
                    .zip(moved(-STEP))
                    .map(quotient)
                    .collect()
            };
            let column =
                |square: &[Dd]| -> Vec<Dd> { square.iter().skip(j).step_by(n).copied().collect() };
            let (dq, dv) = made.split_at(n * n);
            case.close("∂τ/∂q", &column(dq), &slope(true), DIFFERENCE * effort);
            case.close("∂τ/∂v", &column(dv), &slope(false), DIFFERENCE * effort);
        }
    }
}

/// Golden derivatives exist for the first states of some robots.
#[test]
fn derivatives_equal_golden_values() {
    let mut compared = 0;
    for (name, robot) in golden::robots_up_to(8) {
        let file = golden::values(&name);
        let joints: Vec<&str> = file["joints"]
            .as_array()
            .unwrap()
            .iter()
            .map(|j| j.as_str().unwrap())
            .collect();
        let names = robot.joints();
        let place: Vec<usize> = names
            .iter()
            .map(|n| joints.iter().position(|j| j == n).expect("the joint"))
            .collect();
        let n = names.len();
        let inverse = robot.function("recursion", Method::InverseDynamicsDerivatives);
        let forward = ["recursion", "articulated", "articulated_base"]
            .map(|way| robot.function(way, Method::ForwardDynamicsDerivatives));
        for state in file["states"].as_array().unwrap() {
            let vector = |key: &str| -> Vec<f64> {
                place
                    .iter()
                    .map(|&p| state[key][p].as_f64().unwrap())
                    .collect()
            };
            let matrix = |key: &str| -> Option<Vec<f64>> {
                state[key].is_array().then(|| {
                    let entry = |k: usize| state[key][place[k / n]][place[k % n]].as_f64().unwrap();
                    (0..n * n).map(entry).collect()
                })
            };
            let given = State {
                q: vector("q"),
                v: vector("v"),
                a: vector("a"),
                tau: vector("tau_in"),
                parameters: vec![],
            };
            let found: Vec<f64> = given.value(&inverse);
            let solved = forward.each_ref().map(|way| given.value::<f64>(way));
            let mut pieces = vec![
                ("dtau_dq", &found[..n * n], 1e-12),
                ("dtau_dv", &found[n * n..], 1e-12),
            ];
            for solved in &solved {
                pieces.push(("dqdd_dq", &solved[n..n + n * n], 1e-10));
                pieces.push(("dqdd_dv", &solved[n + n * n..n + 2 * n * n], 1e-10));
            }
            for (key, found, relative) in pieces {
                let Some(wanted) = matrix(key) else { continue };
                compared += 1;
                let tolerance = relative * crate::common::largest(&wanted).max(1e-3);
                assert_close(found, &wanted, tolerance, || format!("{name} {key}"));
            }
        }
    }
    assert!(compared >= 560, "{compared}");
}
