//! The laws of mechanics, and the equality of the formulations, for one mechanism in one state.
//!
//! In double-double the regrouped recursion must equal the literal sum to 1e-28 of the natural size of the
//! result (see [`super::natural_size`]), so every regrouping is shown to be exact. Rounding is 1e-32, but
//! folded constants are accurate to 2⁻⁹⁸ = 3e-30 of the terms of their sums.

use bgdyn_codegen::formulation::FORMULATIONS;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;
use nalgebra::DMatrix;

use super::parameters::{parametrised, values};
use super::random::Draft;
use super::rng::Rng;
use super::values::{Direction, Methods, dot};
use super::{
    Robot, State, assert_close, natural_effort, natural_inertia, natural_size, reach, sum_abs,
};

/// Tolerance of double-double results, relative to their natural size.
pub const EXACT: f64 = 1e-28;
/// The same without snapping: the generator treats a component of a direction below 1e-26 as rounding, and
/// two angles of 1e-13 have such a product.
pub const NOISY: f64 = 1e-26;
/// Tolerance of `f64` results, relative to their natural size.
pub const ROUNDED: f64 = 1e-15;

/// A random mechanism with its formulations and a state.
pub struct Case {
    pub what: String,
    pub draft: Draft,
    pub robot: Robot,
    pub literal: Methods,
    pub recursion: Methods,
    /// The functions of all other formulations of the list.
    pub others: Vec<Function>,
    /// The generated function of forward dynamics.
    pub chosen: Function,
    pub state: State,
    /// Natural size of an effort, and of an entry of M.
    pub effort: f64,
    pub inertia: f64,
}

impl Case {
    /// Returns the case of a seed, with up to `most` moving joints; with run-time parameters or without.
    pub fn of_seed(seed: u64, most: usize, parameters: bool) -> Self {
        let mut rng = Rng::new(seed);
        let mut draft = Draft::random(&mut rng, most);
        if parameters {
            draft = parametrised(&draft, &mut rng);
        }
        Case::new(&format!("seed {seed}"), draft, |robot| {
            let mut state = State::random(&mut rng, &robot.motions());
            state.parameters = values(&robot.mechanism, &mut rng);
            state
        })
    }

    /// Returns a mechanism in the chosen state.
    pub fn new(name: &str, draft: Draft, state: impl FnOnce(&Robot) -> State) -> Self {
        let text = draft.yaml();
        let robot = Robot::read(&text, None);
        let state = state(&robot);
        Case {
            what: format!("{name}\n{text}{state:?}"),
            chosen: robot.chosen(Method::ForwardDynamics),
            literal: Methods::new(&robot, "literal"),
            recursion: Methods::new(&robot, "recursion"),
            others: others(&robot),
            effort: natural_effort(&robot, &state),
            inertia: natural_inertia(&robot, &state).1,
            draft,
            robot,
            state,
        }
    }

    pub fn place(&self, law: &str) -> impl Fn() -> String + use<> {
        let text = format!("{law}\n{}\n{law}", self.what);
        move || text.clone()
    }

    /// Returns an upper bound of the distance of every centre of mass from the world's origin, m.
    pub fn reach(&self) -> f64 {
        reach(&self.robot, &self.state)
    }

    /// Natural size of a method's result.
    pub fn size(&self, method: Method) -> f64 {
        natural_size(&self.robot, &self.state, method)
    }

    /// Returns the tolerance of double-double results, relative to their natural size.
    pub(super) fn exact(&self) -> f64 {
        match self.draft.exact {
            true => NOISY,
            false => EXACT,
        }
    }

    /// Returns the functions of a method by all formulations but the literal sum.
    pub(super) fn ways(&self, method: Method) -> impl Iterator<Item = &Function> {
        let others = self.others.iter().filter(move |f| f.method == method);
        [self.recursion.function(method)].into_iter().chain(others)
    }

    /// Checks that every formulation = literal, for every method except forward dynamics. Returns the largest
    /// difference, relative to natural size.
    pub fn formulations_agree(&self) -> f64 {
        let mut worst = 0.0_f64;
        for method in Method::OF_TRAIT {
            if method == Method::ForwardDynamics {
                continue;
            }
            let y: Vec<Dd> = self.literal.value(method, &self.state);
            let tolerance = self.exact() * self.size(method);
            for way in self.ways(method) {
                let x: Vec<Dd> = self.state.value(way);
                let place = self.place(&format!("{method:?}, {}", way.formulation));
                assert_close(&x, &y, tolerance, place);
                let off = x.iter().zip(&y).map(|(x, y)| (*x - *y).abs().to_f64());
                let off = off.fold(0.0, f64::max);
                worst = worst.max(off / self.size(method).max(f64::MIN_POSITIVE));
            }
        }
        worst
    }

    /// Checks that M is symmetric (only one triangle exists), positive semidefinite, = ∂τ/∂a, and gives T
    /// and the linear part of the inverse dynamics.
    pub fn mass_matrix(&self) {
        let n = self.state.q.len();
        let rows: Vec<Vec<Dd>> = self.recursion.mass(&self.state);
        let rounded = DMatrix::from_fn(n, n, |i, j| rows[i][j].to_f64());
        let moments = rounded.symmetric_eigenvalues();
        assert!(
            moments.min() >= -ROUNDED * self.inertia,
            "{}: eigenvalues {moments}",
            self.place("positive semidefinite")()
        );
        let momenta: Vec<Dd> = rows.iter().map(|row| dot(row, &self.state.v)).collect();
        let twice = dot(&momenta, &self.state.v);
        let kinetic: Vec<Dd> = self.recursion.value(Method::KineticEnergy, &self.state);
        let half = Dd::from_f64(0.5);
        let tolerance = self.exact() * self.size(Method::KineticEnergy);
        assert_close(
            &[half * twice],
            &kinetic,
            tolerance,
            self.place("½vᵀMv = T"),
        );

        let inverse: Vec<Dd> = self.recursion.value(Method::InverseDynamics, &self.state);
        let bias: Vec<Dd> = self.recursion.value(Method::Bias, &self.state);
        let sum: Vec<Dd> = (0..n)
            .map(|j| dot(&rows[j], &self.state.a) + bias[j])
            .collect();
        let tolerance = self.exact() * self.effort;
        assert_close(
            &sum,
            &inverse,
            tolerance,
            self.place("M a + bias = inverse dynamics"),
        );

        let mut still = self.state.clone();
        still.v.fill(0.0);
        let weight: Vec<Dd> = self.recursion.value(Method::Gravity, &self.state);
        let at_rest: Vec<Dd> = self.recursion.value(Method::Bias, &still);
        assert_close(
            &weight,
            &at_rest,
            tolerance,
            self.place("bias at rest = gravity"),
        );

        for k in 0..n {
            let unit: Vec<f64> = (0..n).map(|j| f64::from(u8::from(j == k))).collect();
            let along = Direction {
                a: Some(&unit),
                ..Direction::default()
            };
            let column = self
                .recursion
                .derivative(Method::InverseDynamics, &self.state, &along);
            let tolerance = self.exact() * self.inertia;
            assert_close(&column, &rows[k], tolerance, self.place("M = ∂τ/∂a"));
        }
    }

    /// Checks gravity = ∂V/∂q, and v·τ = d/dt (T + V), which means that Ṁ − 2C is skew.
    pub fn energy(&self) {
        let n = self.state.q.len();
        for methods in [&self.literal, &self.recursion] {
            let slope = |k: usize| {
                let unit: Vec<f64> = (0..n).map(|j| f64::from(u8::from(j == k))).collect();
                let along = Direction {
                    q: Some(&unit),
                    ..Direction::default()
                };
                methods.derivative(Method::PotentialEnergy, &self.state, &along)[0]
            };
            let slopes: Vec<Dd> = (0..n).map(slope).collect();
            let gravity: Vec<Dd> = methods.value(Method::Gravity, &self.state);
            let tolerance = self.exact() * self.size(Method::PotentialEnergy);
            assert_close(&gravity, &slopes, tolerance, self.place("gravity = ∂V/∂q"));

            let along = Direction {
                q: Some(&self.state.v),
                v: Some(&self.state.a),
                a: None,
            };
            let rate = |m| methods.derivative(m, &self.state, &along)[0];
            let growth = rate(Method::KineticEnergy) + rate(Method::PotentialEnergy);
            let efforts: Vec<Dd> = methods.value(Method::InverseDynamics, &self.state);
            let power = dot(&efforts, &self.state.v);
            let speed = 1.0 + sum_abs(&self.state.v);
            let tolerance = self.exact() * (self.effort * self.reach()) * speed;
            assert_close(&[power], &[growth], tolerance, self.place("power = dE/dt"));
        }
    }

    /// Checks that in `f64` every method is the double-double one, rounded.
    pub fn rounding(&self) {
        for methods in [&self.literal, &self.recursion] {
            for method in Method::OF_TRAIT {
                if method == Method::ForwardDynamics {
                    continue;
                }
                let x: Vec<f64> = methods.value(method, &self.state);
                let y: Vec<Dd> = methods.value(method, &self.state);
                let x: Vec<Dd> = x.into_iter().map(Dd::from_f64).collect();
                let tolerance = ROUNDED * self.size(method);
                assert_close(&x, &y, tolerance, self.place(&format!("{method:?}, f64")));
            }
        }
    }

    /// Checks that the base's position has no influence: efforts are the same to the last bit, and so is
    /// the plan.
    pub fn moved_base(&self) {
        let moved = self.draft.moved([1e6, -1e9, 3.0]);
        let moved = Robot::read(&moved.yaml(), None);
        for method in [Method::InverseDynamics, Method::ForwardDynamics] {
            let (here, there) = (
                self.recursion.function(method),
                moved.whole("recursion", method),
            );
            assert_eq!(here.formulation, there.formulation, "{}", self.what);
            let (x, _) = here.evaluate(self.state.inputs::<f64>());
            let (y, _) = there.evaluate(self.state.inputs::<f64>());
            let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&x), bits(&y), "{}", self.place("moved base")());
        }
    }

    /// Checks that the order of the links in the file affects only the order of the coordinates.
    pub fn other_order(&self, rng: &mut Rng) {
        let other = Robot::read(&self.draft.shuffled(rng).yaml(), None);
        let (joints, theirs) = (self.robot.joints(), other.joints());
        let place = |j: &String| joints.iter().position(|k| k == j).expect("the same joints");
        let order: Vec<usize> = theirs.iter().map(place).collect();
        let reordered = |x: &[f64]| order.iter().map(|&k| x[k]).collect::<Vec<f64>>();
        let s = &self.state;
        let state = State {
            q: reordered(&s.q),
            v: reordered(&s.v),
            a: reordered(&s.a),
            tau: reordered(&s.tau),
            parameters: of_names(&other, |name| s.parameters[place_of(&self.robot, name)]),
        };
        let own: Vec<Dd> = self.recursion.value(Method::InverseDynamics, s);
        let own: Vec<Dd> = order.iter().map(|&k| own[k]).collect();
        let f = other.whole("recursion", Method::InverseDynamics);
        let theirs: Vec<Dd> = state.value(&f);
        assert_close(
            &theirs,
            &own,
            self.exact() * self.effort,
            self.place("another order"),
        );
    }
}

/// Returns the functions of all formulations of the list except the literal sum and the recursion, for the methods
/// that they know.
fn others(robot: &Robot) -> Vec<Function> {
    let ways = FORMULATIONS.into_iter();
    let ways = ways.filter(|way| !super::FORMULATIONS.contains(&way.name()));
    ways.flat_map(|way| {
        let known = Method::OF_TRAIT.into_iter().filter(|&m| way.knows(m));
        let made: Vec<Function> = known.filter_map(|m| robot.made(way, m)).collect();
        assert!(!made.is_empty(), "{} makes no method", way.name());
        made
    })
    .collect()
}

/// Returns the index of the run-time parameter of this name.
fn place_of(robot: &Robot, name: &str) -> usize {
    let mut names = robot.mechanism.parameters().iter().map(|p| p.name.as_str());
    names.position(|n| n == name).expect("the same parameters")
}

/// Returns a number for each run-time parameter, by its name.
fn of_names(robot: &Robot, number: impl Fn(&str) -> f64) -> Vec<f64> {
    let parameters = robot.mechanism.parameters().iter();
    parameters.map(|p| number(&p.name)).collect()
}

/// Checks all laws; returns the results of [`Case::formulations_agree`] and [`Case::forward`].
pub fn all(case: &Case, rng: &mut Rng) -> (f64, Option<f64>) {
    let worst = case.formulations_agree();
    case.mass_matrix();
    case.energy();
    case.rounding();
    let solved = case.forward();
    case.moved_base();
    case.other_order(rng);
    (worst, solved)
}
