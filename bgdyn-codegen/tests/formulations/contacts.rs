//! Tests methods of contacts: equal to their definitions by the literal sum, to differences along the motion, and to each
//! other; loops, prescribed joints and given bases; counts of operations.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::{ContactMethod, Method};
use bgdyn_runtime::Dd;

use crate::checked::{
    checked_methods, counted, every_turned_sign_is_refused, of_folder, quick_loops,
};
use crate::common::Robot;
use crate::common::rng::Rng;

/// Two branches with noisy axes: spheres against each other and against the world, a capsule and a box against a plane on
/// the other branch, a point, spheres that a joint with a mimic carries.
const BRANCHES: &str = include_str!("../../../tests/contact/branches.yaml");

/// A ball on a turntable with a given motion, and on the arm beside it.
const TURNTABLE: &str = include_str!("../../../tests/contact/turntable.yaml");

/// The contact of two branches of a robot on a vehicle.
const ON_VEHICLE: &str = "format: 1
name: on_vehicle
base: given
links:
  - name: left
    joint: { name: left_turn, type: revolute, axis: [0.1, 0.9, 0.2], origin: { xyz: [0, 0.2, 0] } }
    mass: 1
    com: [0.2, 0, 0]
    inertia: { solid: box, size: [0.4, 0.1, 0.1] }
  - name: right
    joint: { name: right_turn, type: revolute, axis: z, origin: { xyz: [0, -0.2, 0] } }
    mass: 1
    com: [0.2, 0, 0]
    inertia: { solid: box, size: [0.4, 0.1, 0.1] }
contacts:
  clap: { link: left, at: [0.4, 0, 0], radius: 50 mm, with: right, with_at: [0.4, 0, 0], with_radius: 40 mm }
";

fn methods(robot: &Robot) -> Vec<Method> {
    Method::contact_of(robot.graph).expect("contacts")
}

fn passes(text: &str, what: &str) -> Robot {
    let robot = Robot::read(text, Some(what));
    checked_methods(&robot, &methods(&robot), what);
    robot
}

fn spec(name: &str) -> Robot {
    let specs = of_folder("specs/contact");
    let found = specs.iter().find(|(other, _)| other == name);
    let (_, text) = found.expect("a spec with contacts");
    Robot::read(text, Some(name))
}

#[test]
fn contacts_equal_the_literal_sum() {
    for name in ["ball", "quadruped"] {
        let robot = spec(name);
        checked_methods(&robot, &methods(&robot), name);
    }
    passes(BRANCHES, "branches");
}

/// Also from forward dynamics, where the mass matrix is not factored.
#[test]
fn prescribed_joints_and_given_bases_equal_the_literal_sum() {
    passes(TURNTABLE, "turntable");
    passes(ON_VEHICLE, "on_vehicle");
}

/// A ball on the last link of each loop touches the world, and another one the first link.
#[test]
fn loops_equal_the_literal_sum() {
    for (name, text) in quick_loops() {
        let (mechanism, _) = bgdyn_codegen::read(&text, Some(&name));
        let mechanism = mechanism.expect("a loop");
        let links = mechanism.links();
        let shown: Vec<&str> = links.iter().map(|link| link.name.as_str()).collect();
        let (first, last) = (shown[0], shown[shown.len() - 1]);
        let contacts = format!(
            "\ncontacts:\n  ground: {{ link: {last}, at: [0.1, 0.02, 0.03], radius: 30 mm, on: tilted }}\n  \
             beside: {{ link: {last}, at: [0.2, 0.01, 0.5], radius: 20 mm, with: {first}, with_at: [0.1, 0, 0.1] }}\n\
             planes:\n  tilted: {{ normal: [0.2, 0.9, 0.3], offset: -1 }}\n"
        );
        passes(&(text + &contacts), &name);
    }
}

/// A cart on two wheels runs into a wall.
#[test]
fn wheels_equal_the_literal_sum() {
    let specs = of_folder("specs/constraints");
    let cart = specs.iter().find(|(name, _)| name == "differential_drive");
    let (name, text) = cart.expect("a cart on wheels");
    let contacts = "\ncontacts:\n  bumper: { link: cart, at: [0.3, 0.1, 0.05], radius: 60 mm, on: wall }\n\
                    planes:\n  wall: { normal: [-1, 0.2, 0.1], offset: -2 }\n";
    passes(&format!("{text}{contacts}"), name);
}

#[test]
fn turned_signs_are_refused() {
    for text in [BRANCHES, TURNTABLE] {
        let robot = Robot::read(text, Some("contacts"));
        let model = checked_methods(&robot, &methods(&robot), "contacts");
        // Some entries are zero in every posture, but no constants.
        let at = state(&robot, &mut Rng::new(83));
        every_turned_sign_is_refused(&model, |function, k| {
            let values: Vec<Dd> = function.evaluate(at.clone()).0;
            // Of the large matrices every fifth entry.
            let is_read = match function.shape().checked() {
                true => k >= robot.nv() && k % 5 == 0,
                false => true,
            };
            is_read && values[k].to_f64().abs() > 1e-9
        });
    }
}

/// A state with quaternions of length 1.
fn state(robot: &Robot, rng: &mut Rng) -> Inputs<Dd> {
    let graph = robot.graph;
    let mut some =
        |n: usize| -> Vec<Dd> { (0..n).map(|_| Dd::from_f64(rng.within(1.0))).collect() };
    let (mut q, v) = (some(graph.positions.len()), some(graph.coordinates.len()));
    graph.normalize(&mut q);
    Inputs {
        q,
        v,
        parameters: some(graph.parameters.len()),
        ..Inputs::default()
    }
}

/// Half of a step, s: differences have errors of its square.
const STEP: f64 = 1e-9;

/// Returns the rate of results along velocities: a central difference.
fn rate(robot: &Robot, at: &Inputs<Dd>, v: &[Dd], of: &dyn Fn(&Inputs<Dd>) -> Vec<Dd>) -> Vec<f64> {
    let rates = robot.graph.position_rates(&at.q, v);
    let moved = |step: f64| {
        let step = Dd::from_f64(step);
        let q = at.q.iter().zip(&rates).map(|(&q, &rate)| q + step * rate);
        of(&Inputs {
            q: q.collect(),
            ..at.clone()
        })
    };
    let (after, before) = (moved(STEP), moved(-STEP));
    let pairs = after.into_iter().zip(before);
    pairs
        .map(|(x, y)| (x - y).to_f64() / (2.0 * STEP))
        .collect()
}

fn near(found: &[Dd], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (k, (x, y)) in found.iter().zip(expected).enumerate() {
        let x = x.to_f64();
        assert!(
            (x - y).abs() < 1e-11 * y.abs().max(1.0),
            "{what} {k}: {x} {y}"
        );
    }
}

/// γ_n is the rate of the gap, columns of J are γ of unit velocities, J̇ v is the rate of γ: by differences.
#[test]
fn contacts_equal_differences() {
    let mut rng = Rng::new(71);
    for robot in [Robot::read(BRANCHES, Some("branches")), spec("quadruped")] {
        let contacts = robot.graph.contacts.len();
        let function = |of: fn(usize) -> ContactMethod| robot.chosen(Method::Contact(of(contacts)));
        let [gaps, velocity, jacobian, bias] = [
            ContactMethod::Gaps,
            ContactMethod::Velocity,
            ContactMethod::Jacobian,
            ContactMethod::Bias,
        ]
        .map(function);
        for _ in 0..3 {
            let at = state(&robot, &mut rng);
            let n = at.v.len();
            let of = |at: &Inputs<Dd>| velocity.evaluate(at.clone()).0;
            let along = of(&at);
            let normal: Vec<Dd> = along.iter().skip(2).step_by(3).copied().collect();
            let of_gaps = |at: &Inputs<Dd>| gaps.evaluate(at.clone()).0;
            near(&normal, &rate(&robot, &at, &at.v, &of_gaps), "gap rate");
            let entries: Vec<Dd> = jacobian.evaluate(at.clone()).0;
            for k in 0..n {
                let mut v = vec![Dd::ZERO; n];
                v[k] = Dd::ONE;
                let column: Vec<Dd> = entries.iter().skip(k).step_by(n).copied().collect();
                let unit = of(&Inputs { v, ..at.clone() });
                let unit: Vec<f64> = unit.iter().map(|x| x.to_f64()).collect();
                near(&column, &unit, "column");
            }
            let found: Vec<Dd> = bias.evaluate(at.clone()).0;
            near(&found, &rate(&robot, &at, &at.v, &of), "bias");
        }
    }
}

/// γ is the velocity of the point of the sphere's link at c less that of the partner's, from poses by differences; the axes
/// are orthonormal and right-handed.
#[test]
fn velocities_are_those_of_the_points_that_touch() {
    let mut rng = Rng::new(73);
    let robot = Robot::read(BRANCHES, Some("branches"));
    let graph = robot.graph;
    let contacts = graph.contacts.len();
    let velocity = robot.chosen(Method::Contact(ContactMethod::Velocity(contacts)));
    let frames = robot.chosen(Method::Contact(ContactMethod::Frames(contacts)));
    let pose = |link: usize| {
        let own = |s: &bgdyn_codegen::bond_graph::Site| s.link.is_some_and(|l| l.0 == link);
        let site = graph.sites.iter().position(own).expect("a link");
        robot.chosen(Method::Pose(bgdyn_codegen::bond_graph::SiteId(site)))
    };
    for _ in 0..4 {
        let at = state(&robot, &mut rng);
        let found: Vec<Dd> = velocity.evaluate(at.clone()).0;
        let all: Vec<Dd> = frames.evaluate(at.clone()).0;
        for (k, pair) in graph.contacts.iter().enumerate() {
            let frame = &all[12 * k..12 * (k + 1)];
            let axis = |j: usize| [frame[j], frame[3 + j], frame[6 + j]];
            let dot = |a: [Dd; 3], b: [Dd; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let point = [frame[9], frame[10], frame[11]];
            // The world point that is fixed to the link and at c now.
            let carried = |link: Option<bgdyn_codegen::mechanism::LinkId>| -> Vec<f64> {
                let Some(link) = link else {
                    return vec![0.0; 3];
                };
                let pose = pose(link.0);
                let now: Vec<Dd> = pose.evaluate(at.clone()).0;
                let lever: [Dd; 3] = std::array::from_fn(|i| point[i] - now[9 + i]);
                let local = |j: usize| dot([now[j], now[3 + j], now[6 + j]], lever);
                let local = [0, 1, 2].map(local);
                let place = |at: &Inputs<Dd>| -> Vec<Dd> {
                    let moved: Vec<Dd> = pose.evaluate(at.clone()).0;
                    let row = |i: usize| [moved[3 * i], moved[3 * i + 1], moved[3 * i + 2]];
                    (0..3).map(|i| moved[9 + i] + dot(row(i), local)).collect()
                };
                rate(&robot, &at, &at.v, &place)
            };
            let (a, b) = (carried(pair.sphere.link), carried(pair.partner.link()));
            let expected = [0, 1, 2].map(|j| {
                let axis = axis(j).map(|x| x.to_f64());
                (0..3).map(|i| axis[i] * (a[i] - b[i])).sum::<f64>()
            });
            near(&found[3 * k..3 * k + 3], &expected, &pair.name);
            let [x, y, n] = [0, 1, 2].map(axis);
            let products = [
                dot(x, x),
                dot(y, y),
                dot(n, n),
                dot(x, y),
                dot(y, n),
                dot(x, n),
            ];
            near(&products, &[1.0, 1.0, 1.0, 0.0, 0.0, 0.0], "orthonormal");
            let cross = [
                x[1] * y[2] - x[2] * y[1],
                x[2] * y[0] - x[0] * y[2],
                x[0] * y[1] - x[1] * y[0],
            ];
            near(&cross, &n.map(|x| x.to_f64()), "right-handed");
        }
    }
}

/// M (M⁻¹ Jᵀ) = Jᵀ and G = J (M⁻¹ Jᵀ), with the generated M and J.
#[test]
fn responses_solve_the_mass_matrix() {
    let mut rng = Rng::new(79);
    for robot in [
        Robot::read(BRANCHES, Some("branches")),
        spec("quadruped"),
        spec("ball"),
    ] {
        let contacts = robot.graph.contacts.len();
        let (n, rows) = (robot.nv(), 3 * contacts);
        let at = state(&robot, &mut rng);
        let value = |method| -> Vec<Dd> { robot.chosen(method).evaluate(at.clone()).0 };
        let of = |of: ContactMethod| value(Method::Contact(of));
        let mass = value(Method::MassMatrix);
        let jacobian = of(ContactMethod::Jacobian(contacts));
        let response = of(ContactMethod::Response(contacts)).split_off(n);
        let delassus = of(ContactMethod::Delassus(contacts)).split_off(n);
        let in_triangle = |i: usize, j: usize| i.max(j) * (i.max(j) + 1) / 2 + i.min(j);
        let sum = |terms: &mut dyn Iterator<Item = Dd>| terms.fold(Dd::ZERO, |sum, x| sum + x);
        for r in 0..rows {
            let column: Vec<Dd> = response.iter().skip(r).step_by(rows).copied().collect();
            let moved = |i: usize| sum(&mut (0..n).map(|j| mass[in_triangle(i, j)] * column[j]));
            let expected: Vec<f64> = jacobian[r * n..(r + 1) * n]
                .iter()
                .map(|x| x.to_f64())
                .collect();
            near(
                &(0..n).map(moved).collect::<Vec<_>>(),
                &expected,
                "M M⁻¹ Jᵀ",
            );
            let own = |s: usize| sum(&mut (0..n).map(|j| jacobian[s * n + j] * column[j]));
            let own: Vec<f64> = (0..=r).map(|s| own(s).to_f64()).collect();
            near(&delassus[in_triangle(r, 0)..=in_triangle(r, r)], &own, "G");
        }
    }
}

#[test]
fn without_contacts_there_are_no_methods_of_them() {
    let text = BRANCHES.split("contacts:").next().expect("the links");
    let robot = Robot::read(text, Some("links"));
    let why = Method::named(robot.graph, "contact_delassus").expect_err("no contacts");
    let expected = "`contact_delassus`: the mechanism has no contacts; write under `contacts`";
    assert!(why.starts_with(expected), "{why}");
}

/// Multiplications and additions, before loops and blocks, in the order of `ContactMethod::all`. Of a quadruped with 12
/// contacts the blocks of G of two feet contain the joints of the trunk alone.
const COUNTS: [(&str, [usize; 7]); 2] = [
    ("ball", [11, 6, 94, 101, 124, 386, 158]),
    ("quadruped", [122, 351, 618, 713, 1490, 10273, 11030]),
];

#[test]
fn counts_do_not_grow() {
    let found = COUNTS.map(|(name, _)| {
        let robot = spec(name);
        let all = ContactMethod::all(robot.graph.contacts.len());
        (name, counted(&robot, all.map(Method::Contact)))
    });
    assert_eq!(found, COUNTS);
}
