//! Errors of steps against their length.

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::step::{Linearizable, Rk4, SemiImplicit, State, Step};
use bgdyn_codegen::random::Random;
use bgdyn_sim::rk4_step;

use crate::puma560::{self, Puma560};
use crate::random_tree::{self, RandomTree};
use crate::{numbers, state};

/// Time of a run, s.
const TIME: f64 = 0.25;

/// Returns the state after `count` steps.
fn run<M, S, const NQ: usize, const NV: usize>(
    model: &M,
    from: &State<f64, NQ, NV>,
    tau: &SVector<f64, NV>,
    count: usize,
    step: impl Fn(f64) -> S,
) -> State<f64, NQ, NV>
where
    M: Linearizable<f64, NQ, NV>,
    S: Step<M, f64, NQ, NV>,
{
    let step = step(TIME / count as f64);
    let next = |state, _| step.next(model, &state, tau).expect("regular");
    (0..count).fold(*from, next)
}

/// Returns the distance of two states.
fn distance<M: Linearizable<f64, NQ, NV>, const NQ: usize, const NV: usize>(
    model: &M,
    a: &State<f64, NQ, NV>,
    b: &State<f64, NQ, NV>,
) -> f64 {
    let q = model.difference(&a.q, &b.q).amax();
    q.max((a.v - b.v).amax())
}

#[test]
fn errors_fall_with_the_order_on_joints_of_every_type() {
    let model = RandomTree::<f64>::default();
    let mut random = Random(5);
    let from = state::<_, { random_tree::NQ }, { random_tree::NV }>(&model, &mut random, false);
    let tau = numbers(&mut random, 3.0);
    let exact = run(&model, &from, &tau, 4096, |step| Rk4 { step });

    let fourth = [64, 128].map(|n| {
        let end = run(&model, &from, &tau, n, |step| Rk4 { step });
        distance(&model, &end, &exact)
    });
    let order = (fourth[0] / fourth[1]).log2();
    assert!((3.7..4.4).contains(&order), "{order} of {fourth:?}");

    let first = [1024, 2048].map(|n| {
        let end = run(&model, &from, &tau, n, |step| SemiImplicit { step });
        distance(&model, &end, &exact)
    });
    let order = (first[0] / first[1]).log2();
    assert!((0.9..1.1).contains(&order), "{order} of {first:?}");
}

#[test]
fn runge_kutta_of_plain_joints_is_that_of_the_simulation() {
    let model = Puma560::<f64>::default();
    let mut random = Random(6);
    let from = state::<_, { puma560::NQ }, { puma560::NV }>(&model, &mut random, false);
    let tau = numbers(&mut random, 3.0);
    let other = rk4_step(&model, 0.0, &from, 0.01, |_, _| tau).expect("regular");
    let next = Rk4 { step: 0.01 };
    let next = next.next(&model, &from, &tau).expect("regular");
    assert!(distance(&model, &next, &other) < 1e-13);
}
