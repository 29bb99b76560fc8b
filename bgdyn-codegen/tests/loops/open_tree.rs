//! Methods with velocities of the open tree, against its equations with multipliers, in double-double.

use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::frame_rows::{FrameMotion, minus, rows};
use super::multiplier_system::with_rows;
use super::random_loops::Text;
use super::robot::{Robot, State, Way, close, dot, full, largest, times};

const WAYS: [Way; 2] = [None, Some("subspaces")];

/// The equations of the open tree at one state.
pub struct TreeEquations {
    /// With velocities at which the rows hold, and efforts on all joints.
    pub state: State<Dd>,
    pub mass: Vec<Vec<Dd>>,
    pub bias: Vec<Dd>,
    /// Rows of B, and γ.
    pub rows: Vec<(Vec<Dd>, Dd)>,
}

impl TreeEquations {
    pub fn new(text: &Text, robot: &Robot, seed: u64) -> Self {
        let tree = Robot::read(&text.open());
        let closure = robot.mechanism.closure().expect("loops");
        let mut random = Random(70 + seed);
        let mut own = robot.state(seed);
        for p in closure.positions.iter().flatten() {
            own.q[p.0] = closure.samples[5 * seed as usize + 1][p.0];
        }
        let rates: Vec<Dd> = own.value(&robot.function(None, Method::TreeVelocity));
        let mut some = || -> Vec<Dd> {
            let all = rates.iter();
            all.map(|_| Dd::from_f64(20.0 * random.signed())).collect()
        };
        let state = State {
            q: own.q,
            v: rates.clone(),
            a: some(),
            u: some(),
        };
        let all = text.all.iter().enumerate();
        let rows = all.flat_map(|(l, one)| {
            let [a, b] =
                ["a", "b"].map(|end| FrameMotion::new(&tree, &format!("{end}{l}"), &state));
            rows(one, &a, &b)
        });
        let rows = rows.collect();
        let at_rest = State {
            a: vec![Dd::ZERO; tree.nv()],
            ..state.clone()
        };
        let mass: Vec<Dd> = state.value(&tree.function(None, Method::MassMatrix));
        TreeEquations {
            mass: full(&mass, tree.nv()),
            bias: at_rest.value(&tree.function(None, Method::Bias)),
            rows,
            state,
        }
    }

    /// Returns the solution of M x − Bᵀ λ = f, B x = r, and λ.
    pub fn solved(&self, f: &[Dd], r: &[Dd]) -> (Vec<Dd>, Vec<Dd>) {
        let mut solution = with_rows(&self.mass, &self.rows, [f, r]);
        let lambda = solution.split_off(f.len());
        (solution, lambda)
    }

    /// Returns Bᵀ λ.
    pub fn of_rows(&self, lambda: &[Dd]) -> Vec<Dd> {
        let column = |j: usize| self.rows.iter().map(|row| row.0[j]).collect::<Vec<Dd>>();
        (0..self.mass.len())
            .map(|j| dot(&column(j), lambda))
            .collect()
    }
}

/// Returns the parts of `all` for vectors of the tree and of the rows.
fn parts(all: &[Dd], n: usize) -> (Vec<Dd>, Vec<Dd>) {
    let (tree, rows) = all.split_at(n);
    (tree.to_vec(), rows.to_vec())
}

fn compare(text: &Text, what: &str) {
    let robot = Robot::read(&text.closed());
    let n = robot
        .graph
        .closed
        .as_deref()
        .expect("loops")
        .tree
        .coordinates
        .len();
    for seed in 0..3 {
        let tree = TreeEquations::new(text, &robot, seed);
        let gamma: Vec<Dd> = tree.rows.iter().map(|row| row.1).collect();
        let (accelerations, lambda) = tree.solved(&minus(&tree.state.u, &tree.bias), &gamma);
        let wanted_efforts = tree.of_rows(&lambda);
        let size = largest(&accelerations);
        let force = largest(&wanted_efforts).max(largest(&tree.bias));
        let still = vec![Dd::ZERO; tree.rows.len()];
        let (projected, _) = tree.solved(&times(&tree.mass, &tree.state.a), &still);
        for way in WAYS {
            let what = format!("{what}, state {seed}, {way:?}");
            let value = |state: &State<Dd>, method| -> Vec<Dd> {
                state.value(&robot.function(way, method))
            };
            let found = value(&tree.state, Method::ConstrainedDynamics);
            let (found, own) = parts(&found, n);
            close(&found, &accelerations, 1e-22, size, &what);
            let jacobian = value(&tree.state, Method::ConstraintJacobian);
            let own_rows: Vec<&[Dd]> = jacobian.chunks(n).collect();
            let column = |j: usize| own_rows.iter().map(|row| row[j]).collect::<Vec<Dd>>();
            let efforts: Vec<Dd> = (0..n).map(|j| dot(&column(j), &own)).collect();
            close(
                &efforts,
                &wanted_efforts,
                1e-21,
                force,
                &format!("{what}: efforts"),
            );
            // B q̈ + Ḃ q̇ = 0
            let bias = value(&tree.state, Method::ConstraintBias);
            let rates: Vec<Dd> = own_rows
                .iter()
                .map(|row| -dot(row, &accelerations))
                .collect();
            close(&bias, &rates, 1e-22, size, &format!("{what}: bias"));
            // The power of the rows: λᵀ B q̇ = 0.
            let power: Vec<Dd> = own_rows.iter().map(|row| dot(row, &tree.state.v)).collect();
            let power = dot(&own, &power).to_f64().abs();
            let fast = largest(&tree.state.v);
            assert!(
                power <= 1e-24 * largest(&own).max(1.0) * fast.max(1.0),
                "{what}: {power:e}"
            );
            let other = State {
                v: tree.state.a.clone(),
                ..tree.state.clone()
            };
            let found = value(&other, Method::ProjectVelocity);
            close(
                &found,
                &projected,
                1e-22,
                largest(&other.v),
                &format!("{what}: projection"),
            );
            // What holds already stays.
            let again = State {
                v: found.clone(),
                ..other
            };
            let kept = value(&again, Method::ProjectVelocity);
            close(
                &kept,
                &found,
                1e-22,
                largest(&found),
                &format!("{what}: projected twice"),
            );
        }
    }
}

#[test]
fn spatial_loops_accelerate_and_are_projected_as_with_multipliers() {
    for (seed, root) in ["fixed", "floating", "spherical"].into_iter().enumerate() {
        let mut random = Random(500 + seed as u64);
        let text = Text::point_and_rod(&mut random, root);
        compare(&text, &format!("point and rod, {root}"));
    }
}

#[test]
fn loops_of_other_types_accelerate_and_are_projected_as_with_multipliers() {
    for (seed, kind) in ["hinge", "slider", "weld", "universal"]
        .into_iter()
        .enumerate()
    {
        let mut random = Random(600 + seed as u64);
        let text = Text::of_type(&mut random, "spherical", kind);
        compare(&text, kind);
    }
}
