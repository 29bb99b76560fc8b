//! Motions of free bodies and balls: what must be constant is, to the order of the integrator.

use bgdyn::Dynamics;
use bgdyn::nalgebra::SVector;

use crate::satellite_arm6::{NV, SatelliteArm6};
use crate::spherical_chain3::{self, SphericalChain3};

/// A position and a velocity.
type State<const NQ: usize, const NV: usize> = (SVector<f64, NQ>, SVector<f64, NV>);

/// One step of the classical Runge–Kutta method on the components of q, with one normalisation at the end.
fn step<M: Dynamics<f64, NQ, NV>, const NQ: usize, const NV: usize>(
    model: &M,
    (q, v): &State<NQ, NV>,
    tau: &SVector<f64, NV>,
    h: f64,
) -> State<NQ, NV> {
    let rates = |(q, v): &State<NQ, NV>| -> State<NQ, NV> {
        let a = model.forward_dynamics(q, v, tau);
        (
            model.position_rates(q, v),
            a.unwrap_or_else(|_| panic!("it has inertia")),
        )
    };
    let along = |k: &State<NQ, NV>, h: f64| (q + k.0 * h, v + k.1 * h);
    let first = rates(&(*q, *v));
    let second = rates(&along(&first, h / 2.0));
    let third = rates(&along(&second, h / 2.0));
    let fourth = rates(&along(&third, h));
    let q = q + (first.0 + (second.0 + third.0) * 2.0 + fourth.0) * (h / 6.0);
    let v = v + (first.1 + (second.1 + third.1) * 2.0 + fourth.1) * (h / 6.0);
    (model.normalize(&q), v)
}

/// A satellite at rest turns itself by the torques of its arm: its momentum stays zero, to the fourth power
/// of the step. The first six rows of M v are its linear and angular momentum.
#[test]
fn a_satellite_turned_by_its_arm_keeps_zero_momentum() {
    let model = SatelliteArm6::<f64>::default();
    let q = model.neutral();
    let tau = [4.0, -3.0, 2.0, 0.6, -0.4, 0.2];
    let tau = SVector::<f64, NV>::from_fn(|j, _| if j < 6 { 0.0 } else { tau[j - 6] });
    // The largest momentum, relative to that of the bus alone, and the final position.
    let run = |steps: usize| {
        let mut state = (q, SVector::<f64, NV>::zeros());
        let (mut most, mut size) = (0.0_f64, 0.0_f64);
        for _ in 0..steps {
            state = step(&model, &state, &tau, 1.0 / steps as f64);
            let mass = model.mass_matrix(&state.0);
            most = most.max((mass * state.1).rows(0, 6).amax());
            let own = (0..6).map(|i| mass[(i, i)] * state.1[i].abs());
            size = own.fold(size, f64::max);
        }
        (most / size, state.0)
    };
    let ((coarse, _), (fine, end)) = (run(500), run(1000));
    let order = (coarse / fine).log2();
    assert!(fine < 1e-9, "{fine:e}");
    assert!(order > 3.5, "{coarse:e}, {fine:e}: order {order}");
    let turned = model.difference(&end, &q);
    assert!(turned.rows(3, 3).norm() > 0.01, "it turned by {turned}");
}

/// Three rods on balls swing: the error of the energy falls with the fourth power of the step.
#[test]
fn three_rods_on_balls_keep_their_energy() {
    const NV: usize = spherical_chain3::NV;
    let model = SphericalChain3::<f64>::default();
    let start = SVector::<f64, NV>::from_fn(|j, _| 0.3 + 0.05 * j as f64);
    let begin = (
        model.sample(&start),
        SVector::<f64, NV>::from_fn(|j, _| 1.0 - 0.2 * j as f64),
    );
    let energy = |(q, v): &State<{ spherical_chain3::NQ }, NV>| {
        model.kinetic_energy(q, v) + model.potential_energy(q)
    };
    let drift = |steps: usize| {
        let mut state = begin;
        for _ in 0..steps {
            state = step(&model, &state, &SVector::zeros(), 1.0 / steps as f64);
        }
        (energy(&state) - energy(&begin)).abs()
    };
    let [coarse, fine] = [500, 1000].map(drift);
    // Energy errors fall with the fifth power here at most, with the fourth at least.
    let order = (coarse / fine).log2();
    assert!(coarse < 1e-3, "{coarse:e}");
    assert!(order > 3.7, "{coarse:e}, {fine:e}: order {order}");
}
