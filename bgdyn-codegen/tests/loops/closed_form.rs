//! Planar loops in closed form against the literal sum, in double-double at closed positions: random mechanisms on fixed
//! and moving bodies, with axes in any direction, and the specs.

use bgdyn_codegen::choice::Choice;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::formulation::{Prepared, specification};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::mechanism::closure::polygons;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::{Dd, OUT_OF_REACH};

use super::multiplier_system::solve;
use super::random_dyads::{KINDS, Surroundings, draw};
use super::references::spec;
use super::robot::{Robot, close, largest};

const METHODS: [Method; 7] = [
    Method::ForwardDynamics,
    Method::InverseDynamics,
    Method::MassMatrix,
    Method::Bias,
    Method::Gravity,
    Method::KineticEnergy,
    Method::PotentialEnergy,
];

/// Mechanisms of each kind, and states of each mechanism: more than 1000 in all.
const MECHANISMS: u64 = 6;
const STATES: u64 = 6;

fn in_closed_form(function: &Function) -> bool {
    function.formulation.contains("closed form")
}

/// A mechanism with its functions and the literal sum.
struct Compared {
    robot: Robot,
    functions: Vec<(Method, Function)>,
    literal: Vec<(Method, Function)>,
    what: String,
}

impl Compared {
    fn new(text: &str, what: String) -> Self {
        let robot = Robot::read(text);
        let choice = Choice::new(&robot.graph, None);
        let prepared = Prepared::new(&robot.graph);
        let functions = METHODS.map(|method| {
            let function = choice.function(method).expect("a function");
            (method, (*function).clone())
        });
        let wanted = METHODS.into_iter().chain([Method::VelocityMap]);
        let literal = wanted
            .filter_map(|method| Some((method, specification().function(&prepared, method)?)));
        let literal = literal.collect();
        Compared {
            functions: functions.to_vec(),
            literal,
            what,
            robot,
        }
    }

    fn literal(&self, method: Method, at: &Inputs<Dd>) -> Vec<Dd> {
        let found = self.literal.iter().find(|(known, _)| *known == method);
        let (_, function) = found.expect("a literal form");
        function.evaluate(at.clone()).0
    }

    /// Returns a closed position with random velocities, accelerations and efforts.
    fn state(&self, seed: u64) -> Inputs<Dd> {
        let closure = self.robot.mechanism.closure().expect("loops");
        let mut state = self.robot.state(seed);
        let sample = &closure.samples[seed as usize % closure.samples.len()];
        let mut q = state.q.clone();
        for p in closure.moved_positions() {
            q[p.0] = sample[p.0];
        }
        closure.walk(&closure.position_rows(), &mut q, &mut Random(900 + seed));
        self.close_to_the_last_digit(&mut q);
        state.q = q;
        let parameters = self.robot.graph.parameters.iter();
        Inputs {
            q: state.q,
            v: state.v,
            a: state.a,
            u: state.u,
            parameters: parameters.map(|p| p.default * Dd::from_f64(1.3)).collect(),
            ..Inputs::default()
        }
    }

    /// Takes another step of Newton's method: the literal sum reads dependent positions, and towards singular positions
    /// a residual of 1e-27 is a large error of theirs.
    fn close_to_the_last_digit(&self, q: &mut [Dd]) {
        let closure = self.robot.mechanism.closure().expect("loops");
        let (residuals, jacobian) = closure.values(&closure.rows, q);
        let dependents: Vec<usize> = closure.dependents().map(|j| j.0).collect();
        let square = jacobian
            .iter()
            .map(|row| dependents.iter().map(|&j| row[j]).collect());
        let step = solve(square.collect(), &residuals);
        for (j, step) in dependents.into_iter().zip(step) {
            let position = closure.positions[j].expect("a joint with one position");
            q[position.0] -= step;
        }
    }

    /// Compares all functions at a state. Towards singular positions S grows, and with it what rounding changes: the bar
    /// is 1e-25 times the size of the terms, which contain S twice and in z once more.
    fn compare(&self, seed: u64) {
        let at = self.state(seed);
        let steep = 1.0 + largest(&self.literal(Method::VelocityMap, &at));
        let fast = 1.0 + largest(&at.v);
        let size = (steep * fast).powi(2) * steep * (1.0 + largest(&at.a));
        for (method, function) in &self.functions {
            let what = format!(
                "{}, state {seed}: {method:?} by {}",
                self.what, function.formulation
            );
            let (found, refused) = function.evaluate(at.clone());
            assert_eq!(refused, None, "{what}");
            match method {
                Method::ForwardDynamics => {
                    let moved = Inputs {
                        a: found.clone(),
                        ..at.clone()
                    };
                    let efforts = self.literal(Method::InverseDynamics, &moved);
                    close(
                        &efforts,
                        &at.u,
                        1e-25,
                        size * (1.0 + largest(&found)),
                        &what,
                    );
                }
                _ => close(&found, &self.literal(*method, &at), 1e-25, size, &what),
            }
        }
    }

    /// Checks that functions in closed form do not read the dependent positions.
    fn dependents_are_not_read(&self) {
        let closure = self.robot.mechanism.closure().expect("loops");
        let at = self.state(3);
        let mut elsewhere = at.clone();
        for joint in polygons(closure)
            .expect("planar loops")
            .iter()
            .flat_map(|p| p.dependents())
        {
            elsewhere.q[joint.position.0] += Dd::from_f64(0.7);
        }
        let closed = self.functions.iter().filter(|(_, f)| in_closed_form(f));
        for (method, function) in closed {
            let values = [&at, &elsewhere].map(|at| function.evaluate(at.clone()).0);
            assert_eq!(values[0], values[1], "{}: {method:?}", self.what);
        }
    }
}

#[test]
fn random_planar_loops_equal_the_literal_sum() {
    random_planar_loops(STATES);
}

#[test]
#[ignore = "a minute of literal sums: .ci/long"]
fn random_planar_loops_equal_the_literal_sum_in_1000_states() {
    assert!(random_planar_loops(22) >= 1000);
}

/// Compares random mechanisms of each kind in this many states each; returns the number of all states.
fn random_planar_loops(count: u64) -> u64 {
    let (mut closed, mut all, mut states) = (0, 0, 0);
    let mut branches = [0, 0];
    for (k, kind) in KINDS.into_iter().enumerate() {
        for n in 0..MECHANISMS {
            let around = Surroundings {
                root: ["fixed", "continuous", "floating"][n as usize % 3],
                gravity: n != 1,
                parameters: n == 2,
                exchanged: n % 2 == 1,
            };
            let seed = 1000 * (k as u64 + 1) + n;
            let text = draw(kind, seed, &around);
            let what = format!("{kind}, seed {seed}, {}", around.root);
            let compared = Compared::new(&text, what);
            for seed in 0..count {
                compared.compare(seed);
                states += 1;
            }
            compared.dependents_are_not_read();
            let closure = compared.robot.mechanism.closure().expect("loops");
            for polygon in polygons(closure).expect("planar loops") {
                branches[usize::from(polygon.positive)] += 1;
            }
            all += compared.functions.len();
            closed += compared
                .functions
                .iter()
                .filter(|(_, f)| in_closed_form(f))
                .count();
        }
    }
    assert!(branches.iter().all(|&n| n > 4), "{branches:?}");
    // Elimination is left for potential energies and gravity that do not depend on the loop.
    assert!(10 * closed > 8 * all, "{closed} of {all}");
    states
}

#[test]
fn the_specs_equal_the_literal_sum() {
    for name in [
        "four_bar",
        "slider_crank",
        "slider_crank_near_singular",
        "five_bar",
        "six_bar",
        "excavator",
        "andrews",
    ] {
        let compared = Compared::new(&spec(name), name.to_owned());
        let (_, forward) = &compared.functions[0];
        assert!(in_closed_form(forward), "{name}: {}", forward.formulation);
        (0..STATES).for_each(|seed| compared.compare(seed));
        compared.dependents_are_not_read();
    }
}

/// The two branches of a parallelogram meet at regular positions, where its root vanishes: no closed form.
#[test]
fn parallelograms_have_no_closed_form() {
    let robot = Robot::read(&spec("parallelograms"));
    assert_eq!(polygons(robot.mechanism.closure().expect("loops")), None);
}

/// Out of reach the root's argument is negative: the loop is refused, whatever the dependent positions are; a step
/// before there is a number.
#[test]
fn out_of_reach_the_loop_is_refused() {
    let robot = Robot::read(&spec("five_bar"));
    let choice = Choice::new(&robot.graph, None);
    let forward = choice
        .function(Method::ForwardDynamics)
        .expect("a function");
    assert!(in_closed_form(&forward), "{}", forward.formulation);
    let names = |name: &str| {
        let names = robot.mechanism.position_names();
        names
            .iter()
            .position(|known| known == name)
            .expect("a joint")
    };
    // Cranks of 0.25 m, 0.3 m apart, rods of 0.35 m: symmetric, the elbows are 0.3 + 0.5 sin φ apart.
    let (first, second) = (names("proximal1_angle"), names("proximal2_angle"));
    let reach = (0.4_f64 / 0.5).asin();
    let right = std::f64::consts::FRAC_PI_2;
    for (off, out) in [(-1e-9, false), (1e-9, true), (0.1, true), (-0.1, false)] {
        let mut q = vec![f64::NAN; robot.mechanism.nq()];
        (q[first], q[second]) = (right + reach + off, right - reach - off);
        let at = Inputs {
            q,
            v: vec![0.3, -0.2],
            u: vec![0.1, 0.2],
            ..Inputs::default()
        };
        let (found, refused) = forward.evaluate(at);
        assert_eq!(refused.is_some(), out, "{off:e}: {found:?}");
        if out {
            // After the joints' pivots, that of the loop.
            assert_eq!(refused, Some(OUT_OF_REACH + robot.nv()), "{off:e}");
        } else {
            assert!(found.iter().all(|x| x.is_finite()), "{off:e}: {found:?}");
        }
    }
}

/// Returns the largest error of a function in `f64` at a state, relative to the largest entry of the exact result.
fn error(function: &Function, at: &Inputs<f64>, exact: &[Dd]) -> f64 {
    let (found, refused) = function.evaluate(at.clone());
    assert_eq!(refused, None, "{}", function.formulation);
    let off = found
        .iter()
        .zip(exact)
        .map(|(&x, &y)| (Dd::from_f64(x) - y).to_f64().abs());
    off.fold(0.0, f64::max) / largest(exact)
}

/// At positions that close exactly for independent ones in `f64`: the largest errors over the states are not above twice
/// those of elimination, which reads rounded dependent positions, and a few roundings.
#[test]
fn digits_are_not_lost_against_elimination() {
    for name in [
        "four_bar",
        "slider_crank",
        "slider_crank_near_singular",
        "five_bar",
        "six_bar",
        "andrews",
        "excavator",
    ] {
        let compared = Compared::new(&spec(name), name.to_owned());
        let robot = &compared.robot;
        let closure = robot.mechanism.closure().expect("loops");
        let eliminated = Choice::by_elimination(&robot.graph, None);
        for (method, function) in compared
            .functions
            .iter()
            .take(2)
            .filter(|(_, f)| in_closed_form(f))
        {
            let other = eliminated.function(*method).expect("a function");
            assert!(!in_closed_form(&other));
            let mut worst = [0.0_f64; 2];
            for seed in 0..150 {
                let mut at = compared.state(seed);
                let round =
                    |x: &mut Vec<Dd>| x.iter_mut().for_each(|x| *x = Dd::from_f64(x.to_f64()));
                for x in [
                    &mut at.q,
                    &mut at.v,
                    &mut at.a,
                    &mut at.u,
                    &mut at.parameters,
                ] {
                    round(x);
                }
                assert!(closure.close(&mut at.q));
                compared.close_to_the_last_digit(&mut at.q);
                let (exact, _) = other.evaluate(at.clone());
                let all = |x: &[Dd]| x.iter().map(|x| x.to_f64()).collect();
                let rounded = Inputs {
                    q: all(&at.q),
                    v: all(&at.v),
                    a: all(&at.a),
                    u: all(&at.u),
                    parameters: all(&at.parameters),
                    ..Inputs::default()
                };
                let errors = [function, &other].map(|f| error(f, &rounded, &exact));
                worst = std::array::from_fn(|k| worst[k].max(errors[k]));
            }
            println!(
                "{name} {method:?}: {:e} in closed form, {:e} by elimination",
                worst[0], worst[1]
            );
            assert!(
                worst[0] <= 2.0 * worst[1] + 1e-14,
                "{name}, {method:?}: {worst:?}"
            );
        }
    }
}
