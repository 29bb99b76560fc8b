//! Steps with derivatives: the derivatives are those of the discrete step, by dual numbers along the tangent; the adjoint
//! is the transpose; Runge–Kutta has order 4 on joints of every type.

mod derivatives;
mod order;

bgdyn::bgdyn!("specs/puma560.yaml", derivatives = true);
bgdyn::bgdyn!("specs/loops/five_bar.yaml", derivatives = true);
bgdyn::bgdyn!("tests/free_joints/coupled.yaml", derivatives = true);
bgdyn::bgdyn!("tests/steps/random_tree.yaml", derivatives = true);

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::step::State;
use bgdyn::{Dynamics, Scalar};
use bgdyn_codegen::random::Random;

/// Returns numbers in −size … size.
fn numbers<const N: usize>(random: &mut Random, size: f64) -> SVector<f64, N> {
    SVector::from_fn(|_, _| random.signed() * size)
}

/// Returns a random state, near the neutral position of mechanisms with loops.
fn state<M: Dynamics<f64, NQ, NV>, const NQ: usize, const NV: usize>(
    model: &M,
    random: &mut Random,
    loops: bool,
) -> State<f64, NQ, NV> {
    let q = match loops {
        true => model.integrate(&model.neutral(), &numbers(random, 0.2)),
        false => model.sample(&numbers::<NV>(random, 0.5).map(|u| u + 0.5)),
    };
    State {
        q: model.normalize(&q),
        v: numbers(random, 2.0),
    }
}

/// Returns the numbers in another scalar.
fn widen<T: Scalar, const N: usize>(x: &SVector<f64, N>) -> SVector<T, N> {
    x.map(T::from_f64)
}
