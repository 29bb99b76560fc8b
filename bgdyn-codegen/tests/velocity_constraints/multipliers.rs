//! Random wheels, balls and knife edges against the open tree with multipliers: M q̈ + h = P + Bᵀ λ, B q̈ = γ, solved
//! here in double-double. B and γ come from the Jacobians and accelerations of frames of the open tree.

use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::multiplier_system::with_rows;
use super::random_mechanisms::{Text, Touch};
use super::robot::{Robot, State, Way, close, dot, full, largest, times};
use super::slip_rows::rows;

const WAYS: [Way; 2] = [None, Some("subspaces")];

/// A row of B, and γ.
pub type Row = (Vec<Dd>, Dd);

/// Returns the rows of the open tree in a state.
type RowsOfTree<'a> = &'a dyn Fn(&State<Dd>) -> Vec<Row>;

/// Compares in three states.
fn compare(text: &Text, what: &str) {
    let (tree, robot) = (Robot::read(&text.open()), Robot::read(&text.constrained()));
    let closure = robot.mechanism.closure().expect("constraints").clone();
    assert_eq!(robot.nv() + closure.rows.len(), tree.nv(), "{what}");
    for k in 0..3 {
        let mut state = robot.state(k as u64);
        state.q.clone_from(&closure.samples[4 * k + 1]);
        let all = || text.all.iter().enumerate();
        let of_tree = |state: &State<Dd>| -> Vec<Row> {
            all()
                .flat_map(|one| rows(&tree, one, text.normal, state))
                .collect()
        };
        let same_directions = text.all.iter().all(|one| !one.touch.without_axle());
        let what = format!("{what}, state {k}");
        compare_at((&tree, &robot), (&of_tree, same_directions), state, &what);
    }
}

/// Compares at one state; `rows` are B and γ of the open tree, in the directions of the generated rows or in others.
pub fn compare_at(
    (tree, robot): (&Robot, &Robot),
    (rows, same_directions): (RowsOfTree<'_>, bool),
    mut state: State<Dd>,
    what: &str,
) {
    let closure = robot.mechanism.closure().expect("constraints");
    let value = |method| -> Vec<Dd> { state.value(&robot.function(None, method)) };
    let rates = value(Method::TreeVelocity);
    let mut efforts = vec![Dd::ZERO; tree.nv()];
    for (j, &p) in closure.independents.iter().zip(&state.u) {
        efforts[j.0] = p;
    }
    let of_tree = State {
        q: state.q.clone(),
        v: rates.clone(),
        a: vec![Dd::ZERO; tree.nv()],
        u: efforts.clone(),
    };
    let rows = rows(&of_tree);
    for (row, _) in &rows {
        let off = dot(row, &rates).to_f64().abs();
        assert!(
            off < 1e-24 * largest(&rates).max(1.0),
            "{what}: slips at {off:e} m/s"
        );
    }
    let n = tree.nv();
    let mass = full(&of_tree.value(&tree.function(None, Method::MassMatrix)), n);
    let bias: Vec<Dd> = of_tree.value(&tree.function(None, Method::Bias));
    let drive: Vec<Dd> = efforts.iter().zip(&bias).map(|(&p, &h)| p - h).collect();
    let gamma: Vec<Dd> = rows.iter().map(|(_, gamma)| *gamma).collect();
    let solution = with_rows(&mass, &rows, [&drive, &gamma]);
    let (accelerations, lambda) = solution.split_at(n);
    let independents = closure.independents.iter();
    state.a = independents.map(|j| accelerations[j.0]).collect();
    let size = largest(accelerations);
    let forces = largest(lambda).max(largest(&bias));
    for way in WAYS {
        let value = |method| -> Vec<Dd> { state.value(&robot.function(way, method)) };
        let what = format!("{what}, {way:?}");
        close(
            &value(Method::ForwardDynamics),
            &state.a,
            1e-22,
            size,
            &what,
        );
        close(
            &value(Method::InverseDynamics),
            &state.u,
            1e-22,
            forces,
            &what,
        );
        close(
            &value(Method::TreeAcceleration),
            accelerations,
            1e-22,
            size,
            &what,
        );
        // Bᵀ λ, whatever the directions of the rows.
        let jacobian = value(Method::ConstraintJacobian);
        let own: Vec<&[Dd]> = jacobian.chunks(n).collect();
        let own_forces = value(Method::Multipliers);
        let theirs: Vec<&[Dd]> = rows.iter().map(|(row, _)| row.as_slice()).collect();
        let on_joints = |rows: &[&[Dd]], of: &[Dd]| -> Vec<Dd> {
            let column = |j: usize| rows.iter().map(|row| row[j]).collect::<Vec<Dd>>();
            (0..n).map(|j| dot(&column(j), of)).collect()
        };
        let (found, wanted) = (on_joints(&own, &own_forces), on_joints(&theirs, lambda));
        close(&found, &wanted, 1e-21, forces, &what);
        // Rows of wheels and edges have the same directions as here; those of balls and ellipsoids are along the plane's axes.
        if same_directions {
            close(&own_forces, lambda, 1e-21, forces, &what);
        }
    }
    // M_u = Sᵀ M S
    let map: Vec<Dd> = state.value(&robot.function(None, Method::VelocityMap));
    let column = |k: usize| map.iter().skip(k).step_by(robot.nv()).copied().collect();
    let columns: Vec<Vec<Dd>> = (0..robot.nv()).map(column).collect();
    let found = state.value(&robot.function(None, Method::MassMatrix));
    for (row, column) in full(&found, robot.nv()).iter().zip(&columns) {
        let moved = times(&mass, column);
        let wanted: Vec<Dd> = columns.iter().map(|other| dot(other, &moved)).collect();
        close(
            row,
            &wanted,
            1e-23,
            largest(&wanted),
            &format!("{what}: mass matrix"),
        );
    }
}

#[test]
fn knife_edges_move_as_with_multipliers() {
    for (seed, root) in [
        "type: planar",
        "type: floating",
        "type: spherical",
        "type: continuous, axis: [1, 2, 3]",
    ]
    .into_iter()
    .enumerate()
    {
        let mut random = Random(500 + seed as u64);
        let mut text = Text::new(&mut random, root, 4);
        text.touch(&mut random, 2, Touch::Edge);
        text.touch(&mut random, 4, Touch::Edge);
        compare(&text, &format!("knife edges, {root}"));
    }
}

/// Wheels whose joint is about their axle, on chains of joints of one degree.
#[test]
fn wheels_on_axles_move_as_with_multipliers() {
    for (seed, touch) in [
        Touch::Wheel,
        Touch::Longitudinal,
        Touch::Lateral,
        Touch::Tyre,
        Touch::LongitudinalTyre,
        Touch::LateralTyre,
    ]
    .into_iter()
    .enumerate()
    {
        let mut random = Random(600 + seed as u64);
        let mut text = Text::new(&mut random, "type: prismatic, axis: [1, -2, 3]", 5);
        text.wheel(&mut random, 5, touch);
        compare(&text, &format!("{touch:?}"));
    }
}

/// Wheels and balls that are fixed to a body in general position.
#[test]
fn rims_and_balls_move_as_with_multipliers() {
    for (seed, touch) in [
        Touch::Wheel,
        Touch::Longitudinal,
        Touch::Ball,
        Touch::LateralTyre,
        Touch::Ellipsoid,
    ]
    .into_iter()
    .enumerate()
    {
        let mut random = Random(700 + seed as u64);
        let mut text = Text::new(&mut random, "type: prismatic, axis: [1, -2, 3]", 5);
        text.touch(&mut random, 4, touch);
        compare(&text, &format!("{touch:?} on a body"));
    }
}

#[test]
fn bodies_that_float_roll_as_with_multipliers() {
    for (seed, touch) in [
        Touch::Wheel,
        Touch::Lateral,
        Touch::Ball,
        Touch::Tyre,
        Touch::Ellipsoid,
    ]
    .into_iter()
    .enumerate()
    {
        let mut random = Random(800 + seed as u64);
        let mut text = Text::new(&mut random, "type: floating", 2);
        text.touch(&mut random, 0, touch);
        text.wheel(&mut random, 2, Touch::Wheel);
        compare(&text, &format!("{touch:?}, floating"));
    }
}
