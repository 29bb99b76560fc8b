//! The laws between positions, velocities and the methods.

use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::runtime::wide::f64x4;
use bgdyn::runtime::{Coriolis, Dd};
use bgdyn::{Dynamics, Scalar};
use bgdyn_codegen::random::Random;

use crate::delta_robot::DeltaRobot;
use crate::excavator_bucket::{self as bucket, ExcavatorBucket};
use crate::five_bar::{self, FiveBar};
use crate::slider_crank::SliderCrank;

/// The constants of the code are `f64` numbers, rounded one by one.
const ROUNDED: f64 = 1e-14;

/// Returns numbers in −size … size.
pub fn numbers<T: Scalar, const N: usize>(random: &mut Random, size: f64) -> SVector<T, N> {
    SVector::from_fn(|_, _| T::from_f64(random.signed() * size))
}

/// Returns a closed position not far from the start.
pub fn position<T: Scalar, M: Dynamics<T, NQ, NV>, const NQ: usize, const NV: usize>(
    model: &M,
    random: &mut Random,
) -> SVector<T, NQ> {
    let step: SVector<T, NV> = numbers(random, 0.15);
    model.normalize(&model.integrate(&model.neutral(), &step))
}

fn product<const R: usize, const C: usize>(
    m: &SMatrix<Dd, R, C>,
    x: &SVector<Dd, C>,
) -> SVector<Dd, R> {
    SVector::from_fn(|i, _| (0..C).fold(Dd::from_f64(0.0), |sum, j| sum + m[(i, j)] * x[j]))
}

fn worst<const N: usize>(a: &SVector<Dd, N>, b: &SVector<Dd, N>) -> f64 {
    let off = a.iter().zip(b.iter()).map(|(&x, &y)| (x - y).abs());
    off.fold(0.0, |most: f64, x| most.max(x.to_f64()))
}

/// `difference` undoes `integrate`, and the rates of positions are the derivative of `integrate`.
fn positions_and_velocities<M: Dynamics<Dd, NQ, NV>, const NQ: usize, const NV: usize>(model: &M) {
    let mut random = Random(3);
    for _ in 0..5 {
        let q = position(model, &mut random);
        let d: SVector<Dd, NV> = numbers(&mut random, 0.1);
        let back = model.difference(&model.integrate(&q, &d), &q);
        assert!(worst(&back, &d) < 1e-27, "{:e}", worst(&back, &d));
        let h = Dd::from_f64(1e-8);
        let [ahead, behind] = [h, -h].map(|h| model.integrate(&q, &d.map(|x| x * h)));
        let slope = SVector::from_fn(|i, _| (ahead[i] - behind[i]) / (h + h));
        let rates = model.position_rates(&q, &d);
        assert!(worst(&slope, &rates) < 1e-12, "{:e}", worst(&slope, &rates));
    }
}

#[test]
fn positions_and_velocities_fit_each_other() {
    positions_and_velocities(&FiveBar::<Dd>::default());
    positions_and_velocities(&SliderCrank::<Dd>::default());
    positions_and_velocities(&DeltaRobot::<Dd>::default());
    positions_and_velocities(&ExcavatorBucket::<Dd>::default());
}

/// Inverse dynamics is M a + bias, undone by forward dynamics; T = ½ vᵀ M v; bias = C v + gravity.
fn dynamics<M, const NQ: usize, const NV: usize>(model: &M)
where
    M: Dynamics<Dd, NQ, NV> + Coriolis<Dd, NQ, NV>,
{
    let mut random = Random(5);
    for _ in 0..3 {
        let q = position(model, &mut random);
        let [v, a] = [2.0, 3.0].map(|size| numbers::<Dd, NV>(&mut random, size));
        let tau = model.inverse_dynamics(&q, &v, &a);
        let mass = model.mass_matrix(&q);
        let sum = product(&mass, &a) + model.bias(&q, &v);
        let size = tau
            .iter()
            .fold(1.0, |most: f64, x| most.max(x.to_f64().abs()));
        assert!(
            worst(&tau, &sum) < ROUNDED * size,
            "{:e}",
            worst(&tau, &sum)
        );
        let Ok(back) = model.forward_dynamics(&q, &v, &tau) else {
            panic!("a regular position is refused");
        };
        assert!(worst(&back, &a) < ROUNDED * size, "{:e}", worst(&back, &a));
        let half = Dd::from_f64(0.5);
        let energy = product(&mass, &v)
            .iter()
            .zip(v.iter())
            .fold(Dd::from_f64(0.0), |sum, (x, y)| sum + *x * *y)
            * half;
        let off = (energy - model.kinetic_energy(&q, &v)).to_f64().abs();
        assert!(off < ROUNDED * size, "{off:e}");
        let turned = product(&model.coriolis_matrix(&q, &v), &v) + model.gravity(&q);
        let bias = model.bias(&q, &v);
        assert!(
            worst(&turned, &bias) < ROUNDED * size,
            "{:e}",
            worst(&turned, &bias)
        );
        // Gravity is the slope of the potential energy along the tangent.
        let h = Dd::from_f64(1e-9);
        for j in 0..NV {
            let step = |h: Dd| SVector::from_fn(|i, _| if i == j { h } else { Dd::from_f64(0.0) });
            let [ahead, behind] =
                [h, -h].map(|h| model.potential_energy(&model.integrate(&q, &step(h))));
            let off = ((ahead - behind) / (h + h) - model.gravity(&q)[j])
                .to_f64()
                .abs();
            assert!(off < 1e-12 * size, "{off:e}");
        }
    }
}

#[test]
fn the_methods_fit_each_other() {
    dynamics(&FiveBar::<Dd>::default());
    dynamics(&SliderCrank::<Dd>::default());
    dynamics(&DeltaRobot::<Dd>::default());
    dynamics(&ExcavatorBucket::<Dd>::default());
}

/// Derivatives along the tangent against differences in double-double.
#[test]
fn derivatives_are_those_along_the_tangent() {
    let (model, mut random) = (FiveBar::<Dd>::default(), Random(7));
    let h = Dd::from_f64(1e-9);
    for _ in 0..3 {
        let q = position(&model, &mut random);
        let [v, a, tau] = [1.0, 2.0, 5.0].map(|size| numbers::<Dd, 2>(&mut random, size));
        let [by_q, by_v] = model.inverse_dynamics_derivatives(&q, &v, &a);
        let Ok([q_by_q, q_by_v, q_by_tau]) = model.forward_dynamics_derivatives(&q, &v, &tau)
        else {
            panic!("a regular position is refused");
        };
        for j in 0..2 {
            let step = |h: Dd| SVector::from_fn(|i, _| if i == j { h } else { Dd::from_f64(0.0) });
            let slope = |f: &dyn Fn(Dd) -> SVector<Dd, 2>| {
                let [ahead, behind] = [h, -h].map(f);
                (ahead - behind).map(|x| x / (h + h))
            };
            let moved = |h: Dd| model.integrate(&q, &step(h));
            let forward = |q: &SVector<Dd, 4>, v: &SVector<Dd, 2>, tau: &SVector<Dd, 2>| {
                model
                    .forward_dynamics(q, v, tau)
                    .unwrap_or_else(|_| panic!("refused"))
            };
            let columns = [
                (slope(&|h| model.inverse_dynamics(&moved(h), &v, &a)), by_q),
                (
                    slope(&|h| model.inverse_dynamics(&q, &(v + step(h)), &a)),
                    by_v,
                ),
                (slope(&|h| forward(&moved(h), &v, &tau)), q_by_q),
                (slope(&|h| forward(&q, &(v + step(h)), &tau)), q_by_v),
                (slope(&|h| forward(&q, &v, &(tau + step(h)))), q_by_tau),
            ];
            for (k, (found, matrix)) in columns.into_iter().enumerate() {
                let expected: SVector<Dd, 2> = matrix.column(j).into_owned();
                let size = expected
                    .iter()
                    .fold(1.0, |most: f64, x| most.max(x.to_f64().abs()));
                assert!(
                    worst(&found, &expected) < 1e-12 * size,
                    "{k}: {:e}",
                    worst(&found, &expected)
                );
            }
        }
    }
}

/// B S = 0, and the accelerations of the tree are the rates of its velocities.
#[test]
fn the_rows_hold_for_velocities_and_accelerations() {
    let (model, mut random) = (ExcavatorBucket::<Dd>::default(), Random(9));
    let q = position(&model, &mut random);
    let [v, a] = [2.0, 3.0].map(|size| numbers::<Dd, { bucket::NV }>(&mut random, size));
    let jacobian = model.constraint_jacobian(&q);
    let rate = product(&jacobian, &model.tree_velocity(&q, &v));
    assert!(worst(&rate, &SVector::from_element(Dd::from_f64(0.0))) < ROUNDED);
    let residual = model.constraint_residual(&q);
    assert!(worst(&residual, &SVector::from_element(Dd::from_f64(0.0))) < ROUNDED);
    // d/dt (B q̇) along the motion.
    let h = Dd::from_f64(1e-9);
    let at = |h: Dd| {
        let q = model.integrate(&q, &v.map(|x| x * h));
        let v = v + a.map(|x| x * h);
        model.tree_velocity(&q, &v)
    };
    let slope = (at(h) - at(-h)).map(|x| x / (h + h));
    let found = model.tree_acceleration(&q, &v, &a);
    assert!(worst(&slope, &found) < 1e-11, "{:e}", worst(&slope, &found));
}

/// Lanes and `f32` compute what `f64` does.
#[test]
fn every_scalar_computes_the_same() {
    let mut random = Random(11);
    let (model, lanes, single) = (
        FiveBar::<f64>::default(),
        FiveBar::<f64x4>::default(),
        FiveBar::<f32>::default(),
    );
    for _ in 0..10 {
        let q = position(&model, &mut random);
        let [v, tau] = [1.0, 3.0].map(|size| numbers::<f64, { five_bar::NV }>(&mut random, size));
        let found = model.forward_dynamics(&q, &v, &tau).expect("regular");
        let splat = |x: f64| f64x4::splat(x);
        let in_lanes = lanes
            .forward_dynamics(&q.map(splat), &v.map(splat), &tau.map(splat))
            .expect("regular");
        let in_single = single
            .forward_dynamics(
                &q.map(|x| x as f32),
                &v.map(|x| x as f32),
                &tau.map(|x| x as f32),
            )
            .expect("regular");
        let size = found.amax();
        for k in 0..five_bar::NV {
            for x in in_lanes[k].to_array() {
                assert!((x - found[k]).abs() < 1e-12 * size);
            }
            assert!((f64::from(in_single[k]) - found[k]).abs() < 1e-3 * size);
        }
    }
}

/// Samples are closed positions, also where no position closes at the sampled ones.
#[test]
fn samples_are_closed() {
    let (model, mut random) = (SliderCrank::<f64>::default(), Random(13));
    let five = FiveBar::<f64>::default();
    for _ in 0..50 {
        let q = model.sample(&SVector::from_fn(|_, _| random.unit()));
        assert!(model.constraint_residual(&q).amax() < 1e-15);
        let q = five.sample(&SVector::from_fn(|_, _| random.unit()));
        assert!(five.constraint_residual(&q).amax() < 1e-15);
    }
}
