//! Laws of mechanics, and the equality of the formulations, on random mechanisms.
//!
//! In double-double the regrouped recursion must equal the literal sum to 1e-29 of the natural
//! size of the result (see `common::natural_effort`): rounding stays digits below, so every
//! regrouping is shown to be exact. The long run:
//!
//! ```sh
//! cargo test --release -p bgdyn-codegen --test laws -- --ignored --nocapture
//! ```

mod common;

use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;
use common::random::Draft;
use common::rng::Rng;
use common::values::{Direction, Methods, dot};
use common::{Robot, State, assert_close, full, natural_effort, natural_inertia, sum_abs};
use nalgebra::{DMatrix, DVector};

const FORWARD: Method = Method::ForwardDynamics;

/// Of double-double results, relative to their natural size.
const EXACT: f64 = 1e-29;
/// Of `f64` results, relative to their natural size.
const ROUNDED: f64 = 1e-15;

/// A random mechanism with both formulations and a state.
struct Case {
    what: String,
    draft: Draft,
    robot: Robot,
    literal: Methods,
    recursion: Methods,
    /// Forward dynamics by articulated bodies, and what is generated.
    bodies: [Function; 3],
    state: State,
    /// Natural size of an effort, of an entry of M.
    effort: f64,
    inertia: f64,
}

impl Case {
    fn new(seed: u64, most: usize) -> Self {
        let mut rng = Rng::new(seed);
        let draft = Draft::random(&mut rng, most);
        let text = draft.yaml();
        let robot = Robot::read(&text, None);
        let state = State::random(&mut rng, &robot.motions());
        Case {
            what: format!("seed {seed}\n{text}{state:?}"),
            bodies: [
                robot.whole("articulated", FORWARD),
                robot.whole("articulated_base", FORWARD),
                robot.chosen(FORWARD),
            ],
            literal: Methods::new(&robot, "literal"),
            recursion: Methods::new(&robot, "recursion"),
            effort: natural_effort(&robot, &state),
            inertia: natural_inertia(&robot, &state).1,
            draft,
            robot,
            state,
        }
    }

    fn place(&self, law: &str) -> impl Fn() -> String + use<> {
        let text = format!("{law}\n{}\n{law}", self.what);
        move || text.clone()
    }

    /// How far every centre of mass may be from the world's origin, m.
    fn reach(&self) -> f64 {
        let links = self.robot.mechanism.links().iter();
        let steps = links.flat_map(|l| l.joint.origin.translation.0);
        1.0 + steps.map(|x| x.to_f64().abs()).sum::<f64>()
    }

    /// Natural size of a method's result.
    fn size(&self, method: Method) -> f64 {
        let speed = sum_abs(&self.state.v);
        match method {
            Method::MassMatrix => self.inertia,
            Method::KineticEnergy => self.inertia * speed * speed,
            Method::PotentialEnergy => self.effort * self.reach(),
            _ => self.effort,
        }
    }

    /// recursion = literal, for every method but the solved one.
    fn formulations_agree(&self) {
        for method in Method::ALL {
            if method == Method::ForwardDynamics {
                continue;
            }
            let x: Vec<Dd> = self.recursion.value(method, &self.state);
            let y: Vec<Dd> = self.literal.value(method, &self.state);
            let tolerance = EXACT * self.size(method);
            assert_close(&x, &y, tolerance, self.place(&format!("{method:?}")));
        }
    }

    /// M is symmetric (one triangle is all there is), positive semidefinite, = ∂τ/∂a, and gives T
    /// and the linear part of the inverse dynamics.
    fn mass_matrix(&self) {
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
        let tolerance = EXACT * self.size(Method::KineticEnergy);
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
        let tolerance = EXACT * self.effort;
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
            let tolerance = EXACT * self.inertia;
            assert_close(&column, &rows[k], tolerance, self.place("M = ∂τ/∂a"));
        }
    }

    /// gravity = ∂V/∂q, and v·τ = d/dt (T + V), which is Ṁ − 2C skew.
    fn energy(&self) {
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
            let tolerance = EXACT * self.size(Method::PotentialEnergy);
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
            let tolerance = EXACT * (self.effort * self.reach()) * speed;
            assert_close(&[power], &[growth], tolerance, self.place("power = dE/dt"));
        }
    }

    /// In `f64` every method is the double-double one, rounded.
    fn rounding(&self) {
        for methods in [&self.literal, &self.recursion] {
            for method in Method::ALL {
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

    /// Forward undoes inverse; a mass matrix that is singular is refused, never a wild number.
    /// Gives the regular case's error in units of the bar.
    fn forward(&self) -> Option<f64> {
        let n = self.state.q.len();
        let efforts: Vec<f64> = self.literal.value(Method::InverseDynamics, &self.state);
        let bias: Vec<f64> = self.literal.value(Method::Bias, &self.state);
        let rows: Vec<Vec<f64>> = full(&self.literal.value(Method::MassMatrix, &self.state), n);
        let mass = DMatrix::from_fn(n, n, |i, j| rows[i][j]);
        let moments = mass.symmetric_eigenvalues();
        let (least, most) = (moments.min(), moments.max());
        let state = State {
            tau: efforts,
            ..self.state.clone()
        };
        let pivot = least_pivot(self.literal.mass(&self.state));
        let mut worst = 0.0_f64;
        let a = DVector::from_row_slice(&self.state.a);
        // The literal M does not fold enough to be sure of a singular one, and an elimination may
        // miss massless links in a row; they are not generated where that may be.
        let factors = [&self.literal, &self.recursion].map(|m| m.function(FORWARD));
        let ways = factors.map(|f| (f, false)).into_iter();
        for (function, sure) in ways.chain(self.bodies.iter().map(|f| (f, true))) {
            let (found, refused) = function.evaluate(state.inputs::<f64>());
            let place = self.place(&format!("forward dynamics, {}", function.formulation));
            let finite = found.iter().all(|x| x.is_finite());
            assert!(finite, "{}: {found:?}", place());
            if pivot < 1e-25 {
                // Singular at this q, whatever the digits.
                assert!(refused.is_some() || !sure, "{}: {found:?}", place());
                continue;
            }
            if least <= 1e-13 * most {
                continue; // regular, but beyond the digits of `f64`: may be refused or solved
            }
            assert_eq!(refused, None, "{}: eigenvalues {moments}", place());
            // ‖FD(ID(a)) − a‖ ≤ 8 n eps ‖M⁻¹‖ (‖M‖‖a‖ + ‖h‖), and where terms of h cancel to less
            // than their rounding, that.
            let h = DVector::from_row_slice(&bias);
            let size = 8.0 * n as f64 * (most * a.norm() + h.norm()) + self.effort;
            let bar = f64::EPSILON * size / least;
            let off = (DVector::from_vec(found) - &a).norm();
            assert!(off <= bar, "{}: off by {off:e}, bar {bar:e}", place());
            worst = worst.max(off / bar.max(f64::MIN_POSITIVE));
            // In double-double it undoes the literal sum, for which the efforts keep their tails.
            let mut inputs = state.inputs::<Dd>();
            inputs.u = self.literal.value(Method::InverseDynamics, &self.state);
            let (found, _) = function.evaluate(inputs);
            let off = found.iter().zip(&self.state.a);
            let off = off.map(|(&x, &a)| (x - Dd::from_f64(a)).to_f64());
            let off = DVector::from_iterator(n, off).norm();
            let bar = EXACT * size / least;
            assert!(off <= bar, "{}: off by {off:e}, bar {bar:e}", place());
        }
        (least > 1e-13 * most).then_some(worst)
    }

    /// The base's place enters nothing: efforts are the same to the last bit, and so is the plan.
    fn moved_base(&self) {
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

    /// The order of the links in the file names the coordinates, and changes nothing else.
    fn other_order(&self, rng: &mut Rng) {
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
        };
        let own: Vec<Dd> = self.recursion.value(Method::InverseDynamics, s);
        let own: Vec<Dd> = order.iter().map(|&k| own[k]).collect();
        let f = other.whole("recursion", Method::InverseDynamics);
        let theirs: Vec<Dd> = state.value(&f);
        assert_close(
            &theirs,
            &own,
            EXACT * self.effort,
            self.place("another order"),
        );
    }
}

/// The least pivot of M = LᵀDL in double-double, beside the diagonal entry it came from.
fn least_pivot(mut mass: Vec<Vec<Dd>>) -> f64 {
    let diagonal: Vec<Dd> = (0..mass.len()).map(|k| mass[k][k]).collect();
    let mut least = f64::INFINITY;
    for k in (0..mass.len()).rev() {
        let pivot = mass[k][k];
        let share = (pivot / diagonal[k]).to_f64();
        if share.is_nan() || share < 1e-25 {
            return 0.0;
        }
        least = least.min(share);
        for i in 0..k {
            for j in 0..k {
                mass[i][j] = mass[i][j] - mass[k][i] / pivot * mass[k][j];
            }
        }
    }
    least
}

/// All laws on a range of seeds; gives how many mass matrices were regular.
fn check(seeds: std::ops::Range<u64>, most: usize) -> usize {
    let (mut regular, mut worst) = (0, 0.0_f64);
    for seed in seeds.clone() {
        let case = Case::new(seed, most);
        case.formulations_agree();
        case.mass_matrix();
        case.energy();
        case.rounding();
        if let Some(off) = case.forward() {
            regular += 1;
            worst = worst.max(off);
        }
        case.moved_base();
        case.other_order(&mut Rng::new(seed ^ 0xfeed));
    }
    println!("{seeds:?}: {regular} regular, forward dynamics at most {worst:.1e} of its bar");
    regular
}

#[test]
fn small_mechanisms() {
    assert!(check(0..150, 3) > 75);
}

#[test]
fn larger_mechanisms() {
    assert!(check(1000..1060, 7) > 20);
}

#[test]
#[ignore = "long: 10,000 mechanisms; run it optimised"]
fn ten_thousand_mechanisms() {
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get() as u64);
    let share = 10_000_u64.div_ceil(threads);
    let regular: usize = std::thread::scope(|scope| {
        let run =
            |t: u64| scope.spawn(move || check(10_000 + t * share..10_000 + (t + 1) * share, 7));
        let runs: Vec<_> = (0..threads).map(run).collect();
        runs.into_iter()
            .map(|run| run.join().expect("a law is broken"))
            .sum()
    });
    assert!(regular > 4_000);
}
