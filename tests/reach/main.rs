//! iLQR on the Panda of the example `reach`, compared with an optimum of Crocoddyl, and its parts with each other.

mod limits;
mod tree;

#[path = "../../examples/controllers/reach/task.rs"]
mod task;

bgdyn::bgdyn!(
    "tests/golden/specs/panda7.yaml",
    derivatives = true,
    frames = [l_panda_joint7],
);

use bgdyn::nalgebra::{SVector, Vector3};
use bgdyn_codegen::random::Random;
use bgdyn_sim::ilqr::{Ending, Ilqr, Iteration};
use panda7::Panda7;
use serde_json::Value;
use task::{JOINTS, Joints, NODES, Reach, Reaching, problem, start};

type Solver = Ilqr<f64, JOINTS, JOINTS, NODES>;

/// Returns the recorded problem and optimum.
fn recorded() -> Value {
    let text = include_str!("../golden/mpc/reach_panda7.json");
    serde_json::from_str(text).expect("JSON")
}

/// Returns a list of numbers.
fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list");
    list.iter().map(|x| x.as_f64().expect("a number")).collect()
}

/// Returns the motion that stays at the start.
fn at_rest(problem: &Reaching<'_>) -> Solver {
    let efforts = [problem.cost.holding; NODES];
    Ilqr::new(problem, &start(), &efforts).expect("a regular mass matrix")
}

/// Returns a motion under random efforts.
fn shaken(problem: &Reaching<'_>, seed: u64) -> Solver {
    let mut random = Random(seed);
    let efforts =
        std::array::from_fn(|_| problem.cost.holding + Joints::from_fn(|_, _| random.signed()));
    Ilqr::new(problem, &start(), &efforts).expect("a regular mass matrix")
}

#[test]
fn the_task_is_the_recorded_one() {
    let recorded = recorded();
    let arm = Panda7::default();
    let cost = Reach::new(&arm);
    let target = Vector3::from_vec(numbers(&recorded["target"]));
    assert!((cost.target - target).amax() < 1e-14);
    let holding = Joints::from_vec(numbers(&recorded["gravity_efforts"]));
    assert!((cost.holding - holding).amax() < 1e-9);
    let first = numbers(&recorded["x0"]);
    assert_eq!([start().q.as_slice(), start().v.as_slice()].concat(), first);
    assert_eq!(recorded["nodes"], NODES);
    assert_eq!(recorded["step"], task::STEP);
    let weight = |name: &str| recorded["weights"][name].as_f64().expect("a number");
    assert_eq!(cost.node, ["v", "u", "p"].map(weight));
    assert_eq!(cost.end, ["last_v", "last_p"].map(weight));
    let at_start = recorded["cost_at_start"].as_f64().expect("a number");
    assert!((at_rest(&problem(&arm, &cost)).cost() - at_start).abs() < 1e-11);
}

/// The recorded gains are those of Crocoddyl without its regularisation: with the usual 1e-9 on the diagonal of Q_uu, which
/// is 2e-5 in some directions here, they differ by 3e-4.
#[test]
fn optimum_and_first_gain_are_the_recorded_ones() {
    let recorded = recorded();
    let arm = Panda7::default();
    let cost = Reach::new(&arm);
    let problem = problem(&arm, &cost);
    let mut ilqr = at_rest(&problem);
    let outcome = ilqr.solve(&problem, 1e-15, 100).expect("an optimum");
    assert_eq!(outcome.end, Ending::Converged);
    let optimum = recorded["cost"].as_f64().expect("a number");
    let off = (outcome.cost - optimum).abs();
    assert!(off < 1e-9, "the cost {} is off by {off:e}", outcome.cost);
    let rows = recorded["feedback_first"].as_array().expect("rows");
    let [by_q, by_v] = ilqr.gain(0);
    let mut most = 0f64;
    for (i, row) in rows.iter().enumerate() {
        for (j, x) in numbers(row).into_iter().enumerate() {
            let gain = if j < JOINTS {
                by_q[(i, j)]
            } else {
                by_v[(i, j - JOINTS)]
            };
            most = most.max((gain - x).abs());
        }
    }
    println!("cost {:e} off, gains {most:e} off", off);
    assert!(most < 1e-6, "a gain is off by {most:e}");
}

#[test]
fn cost_falls_monotonically() {
    let arm = Panda7::default();
    let cost = Reach::new(&arm);
    let problem = problem(&arm, &cost);
    for mut ilqr in [at_rest(&problem), shaken(&problem, 1), shaken(&problem, 2)] {
        let mut before = ilqr.cost();
        let mut moves = 0;
        while let Iteration::Moved { cost, share } =
            ilqr.iterate(&problem, 1e-12).expect("an iteration")
        {
            assert!(cost < before, "{cost} after {before}");
            assert!(share > 0.0 && share <= 1.0);
            assert_eq!(cost, ilqr.cost());
            (before, moves) = (cost, moves + 1);
            assert!(moves < 60, "no optimum");
        }
        assert!(moves > 3);
        assert!(
            (before - 0.0993193390).abs() < 1e-9,
            "another optimum: {before}"
        );
    }
}

/// With limits equal to the efforts no node reacts: the sweep is then the chain of adjoints.
#[test]
fn gradient_by_adjoint_is_that_by_sweep() {
    let arm = Panda7::default();
    let cost = Reach::new(&arm);
    let mut problem = problem(&arm, &cost);
    let efforts: Joints = cost.holding + SVector::repeat(0.1);
    problem.limits = Some([efforts; 2]);
    let mut ilqr = at_rest(&problem);
    let gradient = ilqr.gradient(&problem).expect("derivatives");
    let largest = gradient.iter().map(SVector::amax).fold(0.0, f64::max);
    assert!(largest > 0.1);
    assert_eq!(
        ilqr.iterate(&problem, 0.0),
        Ok(Iteration::Ended(Ending::Converged))
    );
    for (k, by_adjoint) in gradient.iter().enumerate() {
        let off = (ilqr.slope(k) - by_adjoint).amax();
        assert!(off < 1e-12 * largest, "node {k} is off by {off:e}");
    }
}

#[test]
fn gradient_is_the_slope_of_the_cost() {
    let arm = Panda7::default();
    let cost = Reach::new(&arm);
    let problem = problem(&arm, &cost);
    let ilqr = shaken(&problem, 3);
    let gradient = ilqr.gradient(&problem).expect("derivatives");
    let mut random = Random(4);
    let way: [Joints; NODES] = std::array::from_fn(|_| Joints::from_fn(|_, _| random.signed()));
    let efforts: Vec<Joints> = ilqr.efforts().copied().collect();
    let cost_at = |share: f64| {
        let moved = std::array::from_fn(|k| efforts[k] + way[k] * share);
        Solver::new(&problem, &start(), &moved)
            .expect("a motion")
            .cost()
    };
    // Central differences of order 4.
    let h = 1e-4;
    let difference = |h: f64| (cost_at(h) - cost_at(-h)) / (2.0 * h);
    let slope = (4.0 * difference(h) - difference(2.0 * h)) / 3.0;
    let by_adjoint: f64 = gradient.iter().zip(&way).map(|(g, w)| g.dot(w)).sum();
    let off = (slope - by_adjoint).abs() / by_adjoint.abs();
    assert!(
        off < 1e-7,
        "{slope} by differences, {by_adjoint} by adjoints"
    );
}
