//! The solver on a tree with a floating base and ball joints, whose positions are no vectors.

use bgdyn::Dynamics;
use bgdyn::nalgebra::SVector;
use bgdyn::runtime::step::{SemiImplicit, State};
use bgdyn_codegen::random::Random;
use bgdyn_sim::ilqr::{Cost, Ending, Ilqr, Iteration, Part, Problem, Quadratic};

bgdyn::bgdyn!("tests/steps/random_tree.yaml", derivatives = true);
use random_tree::{NQ, NV, RandomTree};

const NODES: usize = 8;
type Tree = RandomTree<f64>;
type V = SVector<f64, NV>;
type S = State<f64, NQ, NV>;

/// Little velocity and effort on the way, and a given velocity in the end.
struct Swing(V);

impl Cost<Tree, f64, NQ, NV> for Swing {
    fn node(&self, _: &Tree, _: usize, state: &S, tau: &V) -> f64 {
        0.5e-2 * tau.norm_squared() + 0.05 * state.v.norm_squared()
    }
    fn end(&self, _: &Tree, state: &S) -> f64 {
        2.0 * (state.v - self.0).norm_squared()
    }
    fn add_node(&self, _: &Tree, _: usize, state: &S, tau: &V, sum: &mut Quadratic<f64, NV>) {
        sum.add_square(Part::U, 1e-2, tau);
        sum.add_square(Part::V, 0.1, &state.v);
    }
    fn add_end(&self, _: &Tree, state: &S, sum: &mut Quadratic<f64, NV>) {
        sum.add_square(Part::V, 4.0, &(state.v - self.0));
    }
}

/// Returns random numbers.
fn random(random: &mut Random, size: f64) -> V {
    V::from_fn(|_, _| size * random.signed())
}

#[test]
fn joints_of_every_type_take_part() {
    let tree = Tree::default();
    let mut numbers = Random(5);
    let rest = Swing(random(&mut numbers, 0.3));
    let q = tree.sample(&random(&mut numbers, 0.5).map(|u| u + 0.5));
    let first = State {
        q: tree.normalize(&q),
        v: random(&mut numbers, 0.5),
    };
    let efforts: V = random(&mut numbers, 0.2);
    let mut problem = Problem {
        model: &tree,
        cost: &rest,
        step: SemiImplicit { step: 0.01 },
        limits: Some([efforts; 2]),
    };
    let mut ilqr = Ilqr::<f64, NQ, NV, NODES>::new(&problem, &first, &[efforts; NODES])
        .expect("a regular mass matrix");
    let gradient = ilqr.gradient(&problem).expect("derivatives");
    let largest = gradient.iter().map(V::amax).fold(0.0, f64::max);
    let held = ilqr.iterate(&problem, 0.0).expect("an iteration");
    assert_eq!(held, Iteration::Ended(Ending::Converged));
    for (k, by_adjoint) in gradient.iter().enumerate() {
        let off = (ilqr.slope(k) - by_adjoint).amax();
        assert!(off < 1e-12 * largest, "node {k} is off by {off:e}");
    }

    problem.limits = None;
    let outcome = ilqr.solve(&problem, 1e-13, 100).expect("an optimum");
    assert_eq!(outcome.end, Ending::Converged);
    let left = ilqr.gradient(&problem).expect("derivatives");
    let left = left.iter().map(V::amax).fold(0.0, f64::max);
    println!("{outcome:?}, gradient {largest:e}, then {left:e}");
    assert!(
        left < 1e-5 * largest,
        "a slope of {left:e} is left of {largest:e}"
    );
}
