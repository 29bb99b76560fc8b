//! The models, random states, and every result of a model in one list.

use bgdyn::nalgebra::SVector;
use bgdyn::{Dynamics, Scalar};
use bgdyn_codegen::random::Random;

bgdyn::bgdyn!("../golden/specs/puma560.yaml");
bgdyn::bgdyn!("../golden/specs/scara4.yaml");
bgdyn::bgdyn!("specs/lifter.yaml");
bgdyn::bgdyn!("specs/massless_tip.yaml");
bgdyn::bgdyn!("specs/spherical_pendulum.yaml");

/// A vector of numbers in (−size, size).
pub(crate) fn vector<const N: usize>(random: &mut Random, size: f64) -> SVector<f64, N> {
    SVector::from_fn(|_, _| size * random.signed())
}

/// Positions, velocities, and accelerations or efforts.
pub(crate) type State<T, const N: usize> = [SVector<T, N>; 3];

/// Converts a state to another scalar.
pub(crate) fn widen<T: Scalar, const N: usize>(state: &State<f64, N>) -> State<T, N> {
    state.map(|x| x.map(T::from_f64))
}

/// Returns everything a model computes except accelerations, with the name of the method.
pub(crate) fn results<T: Scalar, M: Dynamics<T, N, N>, const N: usize>(
    model: &M,
    [q, v, a]: &State<T, N>,
) -> Vec<(&'static str, Vec<T>)> {
    let list = |x: SVector<T, N>| x.as_slice().to_vec();
    let mass = model.mass_matrix(q);
    vec![
        ("inverse_dynamics", list(model.inverse_dynamics(q, v, a))),
        ("mass_matrix", mass.as_slice().to_vec()),
        ("bias", list(model.bias(q, v))),
        ("gravity", list(model.gravity(q))),
        ("kinetic_energy", vec![model.kinetic_energy(q, v)]),
        ("potential_energy", vec![model.potential_energy(q)]),
        ("integrate", list(model.integrate(q, v))),
        ("difference", list(model.difference(q, v))),
    ]
}
