//! Loops of every type beside wheels, balls and knife edges: random vehicles against the open tree with multipliers, the
//! generator's own check, the energy of a run.

use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::selection::model;
use bgdyn_codegen::verify::{check_model, explain};
use bgdyn_runtime::Dd;

use super::multipliers::{Row, compare_at};
use super::planar_references::ROBOT;
use super::random_mechanisms::Touch;
use super::robot::{Robot, State, dot, largest};
use super::{frame_rows, random_loops, random_mechanisms, slip_rows};

const TYPES: [&str; 6] = ["hinge", "point", "slider", "weld", "universal", "distance"];

/// A random mechanism with loops, whose links touch.
struct Vehicle {
    loops: random_loops::Text,
    touches: random_mechanisms::Text,
}

impl Vehicle {
    fn new(random: &mut Random, loops: random_loops::Text) -> Self {
        let touches = random_mechanisms::Text::new(random, "type: fixed", 0);
        Vehicle { loops, touches }
    }

    /// Two branches with noisy axes on a body whose ends a loop of this type connects.
    fn spatial(random: &mut Random, root: &str, kind: &'static str) -> Self {
        let loops = match kind {
            "distance" => {
                let mut text = random_loops::Text::new(random, root, 2, random_loops::noisy);
                let apart = ([0, 0, 1000], [30, 40, 120]);
                text.connect(random, kind, [2, 4], apart);
                text
            }
            _ => random_loops::Text::of_type(random, root, kind),
        };
        Vehicle::new(random, loops)
    }

    /// Links in the plane of a body's joint, closed by a hinge.
    fn planar(random: &mut Random, root: &str) -> Self {
        let mut loops = random_loops::Text::planar(random, root, 3);
        loops.connect(random, "hinge", [3, 6], ([0, 0, 1000], [0; 3]));
        Vehicle::new(random, loops)
    }

    fn tree(&self) -> String {
        let wheels = self.touches.links.find("  - name: wheel_");
        let wheels = wheels.map_or("", |from| &self.touches.links[from..]);
        format!(
            "{}links:\n{}{wheels}frames:\n{}{}",
            self.touches.head, self.loops.links, self.loops.frames, self.touches.frames
        )
    }

    fn closed(&self) -> String {
        format!(
            "{}loops:\n{}constraints:\n{}",
            self.tree(),
            self.loops.loops,
            self.touches.constraints
        )
    }

    /// Returns the rows of the loops, and then those of the contacts.
    fn rows(&self, tree: &Robot, state: &State<Dd>) -> Vec<Row> {
        let mut all: Vec<Row> = Vec::new();
        for (l, one) in self.loops.all.iter().enumerate() {
            let of = |end| frame_rows::FrameMotion::new(tree, &format!("{end}{l}"), state);
            all.extend(frame_rows::rows(one, &of("a"), &of("b")));
        }
        let touches = self.touches.all.iter().enumerate();
        all.extend(touches.flat_map(|one| slip_rows::rows(tree, one, self.touches.normal, state)));
        all
    }

    /// Compares at two closed positions.
    fn compare(&self, what: &str) {
        let text = self.closed();
        let (tree, robot) = (Robot::read(&self.tree()), Robot::read(&text));
        let closure = robot.mechanism.closure().expect("constraints").clone();
        assert!(closure.nonholonomic(), "{what}");
        assert_eq!(robot.nv() + closure.rows.len(), tree.nv(), "{what}");
        for k in 0..2 {
            let mut state = robot.state(k as u64);
            state.q.clone_from(&closure.samples[4 * k + 1]);
            let what = format!("{what}, state {k}");
            assert_map_keeps_the_rows(&robot, &state, &what);
            let rows = |state: &State<Dd>| self.rows(&tree, state);
            compare_at((&tree, &robot), (&rows, false), state, &what);
        }
    }
}

/// B S = 0, with B of the generated Jacobian.
fn assert_map_keeps_the_rows(robot: &Robot, state: &State<Dd>, what: &str) {
    let map: Vec<Dd> = state.value(&robot.function(None, Method::VelocityMap));
    let jacobian: Vec<Dd> = state.value(&robot.function(None, Method::ConstraintJacobian));
    let nv = robot.nv();
    for row in jacobian.chunks(map.len() / nv) {
        for k in 0..nv {
            let column: Vec<Dd> = map.iter().skip(k).step_by(nv).copied().collect();
            let off = dot(row, &column).to_f64().abs();
            let allowed = 1e-24 * largest(&column).max(1.0);
            assert!(off <= allowed, "{what}: B S = {off:e} in column {k}");
        }
    }
}

fn accepted(text: &str) {
    let model = model(Robot::read(text).mechanism, &Options::default()).expect("a model");
    let found = check_model(&model);
    assert!(found.is_empty(), "{}\n{text}", explain(&found));
}

#[test]
fn knife_edges_beside_loops_of_every_type_move_as_with_multipliers() {
    for (seed, kind) in TYPES.into_iter().enumerate() {
        let mut random = Random(3000 + seed as u64);
        let mut vehicle = Vehicle::spatial(&mut random, "floating", kind);
        vehicle.touches.touch(&mut random, 0, Touch::Edge);
        vehicle.compare(&format!("edge and {kind}"));
    }
}

#[test]
fn wheels_and_balls_beside_loops_move_as_with_multipliers() {
    let cases = [
        (Touch::Wheel, "hinge"),
        (Touch::Longitudinal, "point"),
        (Touch::Lateral, "slider"),
        (Touch::Ball, "hinge"),
        (Touch::Tyre, "weld"),
        (Touch::Ellipsoid, "distance"),
    ];
    for (seed, (touch, kind)) in cases.into_iter().enumerate() {
        let mut random = Random(3100 + seed as u64);
        let mut vehicle = Vehicle::spatial(&mut random, "floating", kind);
        match touch.without_axle() {
            true => vehicle.touches.touch(&mut random, 0, touch),
            false => vehicle.touches.wheel(&mut random, 0, touch),
        }
        vehicle.compare(&format!("{touch:?} and {kind}"));
    }
}

/// What touches is a link of the loop.
#[test]
fn links_of_loops_touch_as_with_multipliers() {
    for (seed, touch) in [Touch::Edge, Touch::Wheel, Touch::Ball]
        .into_iter()
        .enumerate()
    {
        let mut random = Random(3200 + seed as u64);
        let mut vehicle = Vehicle::spatial(&mut random, "floating", "hinge");
        vehicle.touches.touch(&mut random, 3, touch);
        vehicle.compare(&format!("{touch:?} in a loop"));
    }
}

/// Loops in the plane of a cart, in closed form without its edge, and on a body that floats.
#[test]
fn planar_loops_beside_knife_edges_move_as_with_multipliers() {
    for (seed, root) in ["planar", "floating"].into_iter().enumerate() {
        let mut random = Random(3300 + seed as u64);
        let mut vehicle = Vehicle::planar(&mut random, root);
        vehicle.touches.touch(&mut random, 0, Touch::Edge);
        vehicle.compare(&format!("planar loop, {root}"));
    }
}

/// A cart with an edge, and a slider-crank or a four-bar on it or beside it.
fn cart(crank_on: &str, last_joint: &str, pin: &str) -> String {
    let on = |parent: &str| match parent {
        "" => String::new(),
        _ => format!("    parent: {parent}\n"),
    };
    let body =
        "    mass: 1\n    com: [0.1, 0, 0]\n    inertia: { xx: 0.001, yy: 0.01, zz: 0.01 }\n";
    let crank_on = on(crank_on);
    format!(
        "format: 1
name: cart_with_loop
links:
  - name: cart
    joint: {{ name: base, type: planar }}
    mass: 1
    inertia: {{ xx: 0.1, yy: 0.1, zz: 0.1 }}
  - name: crank
{crank_on}    joint: {{ name: crank_angle, type: continuous, axis: z, origin: {{ xyz: [0, 0, 0.1] }} }}
{body}  - name: rod
    parent: crank
    joint: {{ name: rod_angle, type: continuous, axis: z, origin: {{ xyz: [0.12, 0, 0] }} }}
{body}  - name: last
{crank_on}    joint: {{ name: last_joint, {last_joint} }}
{body}constraints:
  edge: {{ type: knife_edge, at: cart, direction: y }}
loops:
  - {{ name: pin, type: hinge, axis: z, a: {{ link: rod, origin: {{ xyz: [0.4, 0, 0] }} }}, b: {{ link: last, {pin} }} }}
"
    )
}

const SLIDE: &str = "type: prismatic, axis: x, origin: { xyz: [0, 0, 0.1] }";
const ROCKER: &str = "type: continuous, axis: z, origin: { xyz: [0.35, 0, 0.1] }";

fn carts() -> [String; 4] {
    let rocker_end = "origin: { xyz: [0.3, 0, 0] }";
    let [at, end] = ["origin: { xyz: [0, 0, 0] }", rocker_end];
    [
        cart("cart", SLIDE, at),
        cart("cart", ROCKER, end),
        cart("", SLIDE, at),
        cart("", ROCKER, end),
    ]
}

/// The robot with a slider-crank that a wheel drives.
fn robot_with_slider() -> String {
    let links = "  - name: rod
    parent: right_wheel
    joint: { name: rod_angle, type: continuous, axis: y, origin: { xyz: [0.05, 0, 0] } }
    mass: 0.2
    inertia: { xx: 0.001, yy: 0.001, zz: 0.001 }
  - name: piston
    parent: cart
    joint: { name: stroke, type: prismatic, axis: x, origin: { xyz: [0, -0.25, 0] } }
    mass: 0.3
constraints:";
    let pin = "loops:
  - { name: pin, type: hinge, axis: y, a: { link: rod, origin: { xyz: [0.2, 0, 0] } }, b: { link: piston } }
independent: [right, left]
";
    ROBOT
        .replace("constraints:", links)
        .replace("independent: [right, left]\n", pin)
}

#[test]
fn loops_beside_wheels_and_edges_are_accepted() {
    for text in carts().into_iter().chain([robot_with_slider()]) {
        accepted(&text);
    }
    let mut random = Random(3400);
    let mut vehicle = Vehicle::spatial(&mut random, "floating", "hinge");
    vehicle.touches.wheel(&mut random, 0, Touch::Wheel);
    vehicle.touches.touch(&mut random, 2, Touch::Edge);
    accepted(&vehicle.closed());
}

/// Returns the state after a step of the classical method of Runge and Kutta.
fn step([tree, robot]: [&Robot; 2], state: &State<Dd>, h: Dd) -> State<Dd> {
    let rates = |q: &[Dd], v: &[Dd]| {
        let at = State {
            q: q.to_vec(),
            v: v.to_vec(),
            ..state.clone()
        };
        let of_tree: Vec<Dd> = at.value(&robot.function(None, Method::TreeVelocity));
        let a: Vec<Dd> = at.value(&robot.function(None, Method::ForwardDynamics));
        (tree.rates(q, &of_tree), a)
    };
    let moved = |x: &[Dd], rate: &[Dd], h: Dd| -> Vec<Dd> {
        x.iter().zip(rate).map(|(&x, &rate)| x + h * rate).collect()
    };
    let half = h * Dd::from_f64(0.5);
    let mut sums = rates(&state.q, &state.v);
    let mut last = sums.clone();
    for (part, weight) in [(half, 2.0), (half, 2.0), (h, 1.0)] {
        last = rates(
            &moved(&state.q, &last.0, part),
            &moved(&state.v, &last.1, part),
        );
        let weight = Dd::from_f64(weight);
        sums = (
            moved(&sums.0, &last.0, weight),
            moved(&sums.1, &last.1, weight),
        );
    }
    let sixth = h / Dd::from_f64(6.0);
    State {
        q: moved(&state.q, &sums.0, sixth),
        v: moved(&state.v, &sums.1, sixth),
        ..state.clone()
    }
}

/// Without efforts, on the level. The error of a step is of the fifth order: with steps of 1 ms the energy of 0.2 s is
/// kept to nine digits.
#[test]
fn free_runs_of_carts_with_loops_keep_their_energy() {
    for (k, text) in carts().into_iter().enumerate() {
        let robot = Robot::read(&text);
        let (open, _) = text.split_once("constraints:").expect("an edge");
        let tree = Robot::read(open);
        let closure = robot.mechanism.closure().expect("a loop").clone();
        let mut state = robot.state(7);
        state.q.clone_from(&closure.samples[1]);
        state.u.fill(Dd::ZERO);
        let energy = |state: &State<Dd>| -> f64 {
            state.value(&robot.function(None, Method::KineticEnergy))[0].to_f64()
        };
        let start = energy(&state);
        for _ in 0..200 {
            state = step([&tree, &robot], &state, Dd::from_f64(1e-3));
        }
        let drift = (energy(&state) - start).abs();
        assert!(
            drift < 1e-9 * start,
            "cart {k}: {start} J, drift {drift:e} J"
        );
    }
}
