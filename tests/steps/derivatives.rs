//! Derivatives of steps against dual numbers, and adjoints against derivatives.

use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::runtime::num_dual::Dual64;
use bgdyn::runtime::step::{Linearizable, Rk4, SemiImplicit, State, Step, StepBlocks, Tangent};
use bgdyn_codegen::random::Random;

use crate::coupled::Coupled;
use crate::five_bar::FiveBar;
use crate::puma560::Puma560;
use crate::random_tree::RandomTree;
use crate::{numbers, state, widen};

/// Length of the steps, s: long, so that terms of every order in it count.
const LONG: f64 = 0.1;
/// Length of steps that do not lead a linkage out of its reach, s.
const SHORT: f64 = 0.01;

/// The arguments of a step.
#[derive(Clone, Copy)]
struct Arguments<const NQ: usize, const NV: usize> {
    state: State<f64, NQ, NV>,
    tau: SVector<f64, NV>,
}

/// Returns ∂q⁺ and ∂v⁺ along component `k` of argument `part` (q, v, u): the step in dual numbers.
fn along<M, S, const NQ: usize, const NV: usize>(
    model: &M,
    step: &S,
    at: &Arguments<NQ, NV>,
    (part, k): (usize, usize),
) -> [SVector<f64, NV>; 2]
where
    M: Linearizable<Dual64, NQ, NV>,
    S: Step<M, Dual64, NQ, NV>,
{
    let mut changes = [SVector::<Dual64, NV>::repeat(0.0.into()); 3];
    changes[part][k].eps = 1.0;
    let from = State {
        q: model.integrate(&widen(&at.state.q), &changes[0]),
        v: widen::<Dual64, NV>(&at.state.v) + changes[1],
    };
    let tau = widen::<Dual64, NV>(&at.tau) + changes[2];
    let next = step.next(model, &from, &tau).expect("regular");
    let here = next.q.map(|x| Dual64::from(x.re));
    let moved = model.difference(&next.q, &here);
    [moved.map(|x| x.eps), next.v.map(|x| x.eps)]
}

/// Checks the blocks of a step against dual numbers, and `forward` and `adjoint` against the blocks.
fn check<M, D, S, E, const NQ: usize, const NV: usize>(
    what: &str,
    (model, dual): (&M, &D),
    (step, dual_step): (&S, &E),
    loops: bool,
) where
    M: Linearizable<f64, NQ, NV>,
    D: Linearizable<Dual64, NQ, NV>,
    S: Step<M, f64, NQ, NV>,
    E: Step<D, Dual64, NQ, NV>,
{
    let mut random = Random(8);
    for _ in 0..10 {
        let at = Arguments {
            state: state(model, &mut random, loops),
            tau: numbers(&mut random, 5.0),
        };
        let blocks = step.linear(model, &at.state, &at.tau).expect("regular");
        let dense = blocks.dense();
        for part in 0..3 {
            let columns: Vec<_> = (0..NV)
                .map(|k| along(dual, dual_step, &at, (part, k)))
                .collect();
            for (row, name) in ["q", "v"].into_iter().enumerate() {
                let wanted = SMatrix::<f64, NV, NV>::from_fn(|i, k| columns[k][row][i]);
                let found = dense[row][part];
                let (error, size) = ((found - wanted).amax(), wanted.amax().max(1.0));
                assert!(
                    error < 1e-11 * size,
                    "{what}: d{name} by argument {part} is off by {error:e} of {size:e}"
                );
            }
        }

        let change = Tangent {
            q: numbers(&mut random, 1.0),
            v: numbers(&mut random, 1.0),
        };
        let efforts: SVector<f64, NV> = numbers(&mut random, 1.0);
        let moved = blocks.forward(&change, &efforts);
        let parts = [change.q, change.v, efforts];
        for (row, moved) in [moved.q, moved.v].into_iter().enumerate() {
            let wanted = (0..3).fold(SVector::zeros(), |sum, j| sum + dense[row][j] * parts[j]);
            let size = wanted.amax().max(1.0);
            assert!((moved - wanted).amax() < 1e-13 * size, "{what}: forward");
        }
        let dual_of_next = Tangent {
            q: numbers(&mut random, 1.0),
            v: numbers(&mut random, 1.0),
        };
        let (by_state, by_tau) = blocks.adjoint(&dual_of_next);
        for (j, found) in [by_state.q, by_state.v, by_tau].into_iter().enumerate() {
            let wanted = dense[0][j].tr_mul(&dual_of_next.q) + dense[1][j].tr_mul(&dual_of_next.v);
            let size = wanted.amax().max(1.0);
            assert!((found - wanted).amax() < 1e-13 * size, "{what}: adjoint");
        }
    }
}

macro_rules! both_steps {
    ($what:literal, $model:ident, $step:ident, $loops:literal) => {
        let models = (&$model::<f64>::default(), &$model::<Dual64>::default());
        let (h, dual_h) = ($step, Dual64::from($step));
        let steps = (&SemiImplicit { step: h }, &SemiImplicit { step: dual_h });
        check(concat!($what, ", semi-implicit"), models, steps, $loops);
        let steps = (&Rk4 { step: h }, &Rk4 { step: dual_h });
        check(concat!($what, ", Runge-Kutta"), models, steps, $loops);
    };
}

#[test]
fn plain_joints() {
    both_steps!("PUMA 560", Puma560, LONG, false);
}

#[test]
fn floating_base_ball_joints_and_a_plane() {
    both_steps!("random tree", RandomTree, LONG, false);
}

#[test]
fn joints_that_follow_others() {
    both_steps!("coupled joints", Coupled, LONG, false);
}

#[test]
fn loops() {
    both_steps!("five-bar linkage", FiveBar, SHORT, true);
}
