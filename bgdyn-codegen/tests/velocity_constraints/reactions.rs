//! Forces of contacts and loads through joints: each link is a free body, whose motion follows from poses alone; rows and
//! their multipliers against those of the open tree.

use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::free_bodies::{Load, Placed, V3, assert_free_bodies, plus, scaled, three};
use super::motion_of_tree::motion_of_tree;
use super::random_mechanisms::{Constraint, Text, Touch};
use super::robot::{Robot, State, Way, close, cross, dot, full, largest};
use super::slip_rows::rows;

const WAYS: [Way; 2] = [None, Some("subspaces")];

fn normalized(v: V3) -> V3 {
    scaled(v, Dd::ONE / dot(&v, &v).sqrt())
}

/// Returns the force `of` a contact as a load on its link; `plane` are the axes of the plane.
fn load(place: Placed, one: &Constraint, plane: [V3; 3], of: &[Dd]) -> Load {
    let normal = plane[2];
    let none = [Dd::ZERO; 3];
    assert_eq!(largest(&of[3..6]), 0.0, "a contact has no moment");
    let sum = |axes: [V3; 3]| {
        let parts = axes.iter().zip(of).map(|(axis, &x)| scaled(*axis, x));
        parts.fold(none, plus)
    };
    let below = |e: V3| {
        let middle = plus(place.origin, scaled(e, -one.radius));
        plus(middle, scaled(normal, -one.crown))
    };
    match one.touch {
        Touch::Edge => Load::at(place.origin, place.turned(three(|i| of[i])), none),
        Touch::Ball => Load::at(below(normal), sum(plane), none),
        Touch::Ellipsoid => {
            // −Σ a_k² (x_k · z) x_k / h, with the directions x_k of the half-axes.
            let axes =
                [0, 1, 2].map(|k| place.turned(three(|i| if i == k { Dd::ONE } else { Dd::ZERO })));
            let lengths = three(|k| one.half_axes[k] * dot(&axes[k], &normal));
            let height = dot(&lengths, &lengths).sqrt();
            let steps = three(|k| -(one.half_axes[k] * lengths[k] / height));
            let parts = axes.iter().zip(steps);
            let lowest = parts.fold(place.origin, |at, (axis, step)| {
                plus(at, scaled(*axis, step))
            });
            Load::at(lowest, sum(plane), none)
        }
        _ => {
            let axle = place.turned(one.axis);
            let ahead = normalized(cross(&axle, &normal));
            let force = sum([ahead, cross(&normal, &ahead), normal]);
            Load::at(below(cross(&ahead, &axle)), force, none)
        }
    }
}

fn compare(text: &Text, links: &[&str], what: &str) {
    let (tree, robot) = (Robot::read(&text.open()), Robot::read(&text.constrained()));
    let closure = robot.mechanism.closure().expect("constraints");
    for seed in 0..2 {
        let mut state = robot.state(seed);
        state.q.clone_from(&closure.samples[4 * seed as usize + 1]);
        for way in WAYS {
            let what = format!("{what}, state {seed}, {way:?}");
            let (motion, reactions) = motion_of_tree(&robot, way, &state);
            let mut given = Vec::new();
            for (k, one) in text.all.iter().enumerate() {
                let place = Placed::frame(&tree, &format!("f{k}"), &motion);
                let index = tree.mechanism.links().iter();
                let index = index.map(|link| &link.name);
                let on = index.clone().position(|name| name == links[k]);
                let of = &reactions[6 * k..6 * k + 6];
                let axes = closure.loops[k].chain.end.rotation;
                let plane = [0, 1, 2].map(|c| axes.column(c).0);
                if one.touch != Touch::Edge {
                    close(&plane[2], &text.normal, 1e-28, 1.0, "the plane's normal");
                }
                given.push((on.expect("a link"), load(place, one, plane, of)));
            }
            let mut efforts = vec![Dd::ZERO; motion.v.len()];
            for (j, &p) in closure.independents.iter().zip(&motion.u) {
                efforts[j.0] = p;
            }
            let joints = state.value(&robot.function(way, Method::JointReactions));
            let all = (&joints[..], &given[..], &efforts[..]);
            assert_free_bodies(&tree, &motion, all, 1e-17, &what);
        }
    }
}

const SLIDE: &str = "type: prismatic, axis: [1, -2, 3]";

#[test]
fn links_with_knife_edges_are_free_bodies() {
    let mut random = Random(1500);
    let mut text = Text::new(&mut random, "type: continuous, axis: [1, 2, 3]", 4);
    text.touch(&mut random, 2, Touch::Edge);
    text.touch(&mut random, 4, Touch::Edge);
    compare(&text, &["body_2", "body_4"], "knife edges");
}

/// Wheels with a joint about their axle, and wheels that are fixed to a body.
#[test]
fn links_with_wheels_and_balls_are_free_bodies() {
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
        let mut random = Random(1600 + seed as u64);
        let mut text = Text::new(&mut random, SLIDE, 5);
        text.wheel(&mut random, 5, touch);
        compare(&text, &["wheel_0"], &format!("{touch:?}"));
        let mut text = Text::new(&mut random, SLIDE, 5);
        text.touch(&mut random, 4, touch);
        compare(&text, &["body_4"], &format!("{touch:?} on a body"));
    }
    for touch in [Touch::Ball, Touch::Ellipsoid] {
        let mut random = Random(1650);
        let mut text = Text::new(&mut random, SLIDE, 5);
        text.touch(&mut random, 4, touch);
        compare(&text, &["body_4"], &format!("{touch:?}"));
    }
}

/// The open tree with multipliers, on floating bodies.
#[test]
fn contacts_accelerate_and_are_projected_as_with_multipliers() {
    for (seed, touch) in [
        Touch::Wheel,
        Touch::Lateral,
        Touch::Ball,
        Touch::Edge,
        Touch::Ellipsoid,
        Touch::LateralTyre,
    ]
    .into_iter()
    .enumerate()
    {
        let mut random = Random(1700 + seed as u64);
        let mut text = Text::new(&mut random, "type: floating", 2);
        text.touch(&mut random, 0, touch);
        text.wheel(&mut random, 2, Touch::Wheel);
        let (tree, robot) = (Robot::read(&text.open()), Robot::read(&text.constrained()));
        let closure = robot.mechanism.closure().expect("constraints");
        let n = tree.nv();
        let mut own = robot.state(seed as u64);
        own.q.clone_from(&closure.samples[3]);
        let mut some = || -> Vec<Dd> {
            let number = |_| Dd::from_f64(20.0 * random.signed());
            (0..n).map(number).collect()
        };
        let state = State {
            q: own.q.clone(),
            v: own.value(&robot.function(None, Method::TreeVelocity)),
            a: some(),
            u: some(),
        };
        let all = text.all.iter().enumerate();
        let b: Vec<(Vec<Dd>, Dd)> = all
            .flat_map(|one| rows(&tree, one, text.normal, &state))
            .collect();
        let of_tree = |method| -> Vec<Dd> { state.value(&tree.function(None, method)) };
        let (mass, bias) = (full(&of_tree(Method::MassMatrix), n), of_tree(Method::Bias));
        for way in WAYS {
            let what = format!("{touch:?}, {way:?}");
            let value = |state: &State<Dd>, method| -> Vec<Dd> {
                state.value(&robot.function(way, method))
            };
            let found = value(&state, Method::ConstrainedDynamics);
            let (accelerations, lambda) = found.split_at(n);
            let jacobian = value(&state, Method::ConstraintJacobian);
            let column = |j: usize| jacobian.chunks(n).map(|row| row[j]).collect::<Vec<Dd>>();
            // M q̈ + h = τ + Bᵀ λ, and B q̈ = γ of other rows.
            let needed: Vec<Dd> = (0..n)
                .map(|i| dot(&mass[i], accelerations) + bias[i])
                .collect();
            let given: Vec<Dd> = (0..n)
                .map(|j| state.u[j] + dot(&column(j), lambda))
                .collect();
            close(&needed, &given, 1e-21, largest(lambda), &what);
            let gamma: Vec<Dd> = b.iter().map(|row| row.1).collect();
            let rates = |of: &[Dd]| b.iter().map(|row| dot(&row.0, of)).collect::<Vec<Dd>>();
            close(
                &rates(accelerations),
                &gamma,
                1e-21,
                largest(accelerations),
                &what,
            );
            let own_bias: Vec<Dd> = jacobian
                .chunks(n)
                .map(|row| -dot(row, accelerations))
                .collect();
            let found = value(&state, Method::ConstraintBias);
            close(&found, &own_bias, 1e-21, largest(accelerations), &what);
            // B q̇ = 0, and M (q̇ − q̇₀) is a sum of rows: no power along S.
            let other = State {
                v: state.a.clone(),
                ..state.clone()
            };
            let found = value(&other, Method::ProjectVelocity);
            let zero = vec![Dd::ZERO; b.len()];
            close(&rates(&found), &zero, 1e-21, largest(&other.v), &what);
            let moved: Vec<Dd> = found.iter().zip(&other.v).map(|(&x, &y)| x - y).collect();
            let momentum: Vec<Dd> = (0..n).map(|i| dot(&mass[i], &moved)).collect();
            let map = value(&other, Method::VelocityMap);
            let along = |k: usize| {
                let column: Vec<Dd> = map.iter().skip(k).step_by(robot.nv()).copied().collect();
                dot(&column, &momentum)
            };
            let along: Vec<Dd> = (0..robot.nv()).map(along).collect();
            let none = vec![Dd::ZERO; robot.nv()];
            close(&along, &none, 1e-20, largest(&momentum), &what);
        }
    }
}
