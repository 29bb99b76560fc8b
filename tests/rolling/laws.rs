//! The laws between positions, velocities and the methods.

use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::runtime::wide::f64x4;
use bgdyn::runtime::{Cause, Coriolis, Dd};
use bgdyn::{Dynamics, Scalar};
use bgdyn_codegen::random::Random;

use crate::chaplygin_sleigh::ChaplyginSleigh;
use crate::differential_drive::DifferentialDrive;
use crate::snakeboard::{self, Snakeboard};
use crate::whipple_bicycle::WhippleBicycle;

/// The constants of the code are `f64` numbers, rounded one by one.
const ROUNDED: f64 = 1e-14;

/// Returns numbers in −size … size.
pub fn numbers<T: Scalar, const N: usize>(random: &mut Random, size: f64) -> SVector<T, N> {
    SVector::from_fn(|_, _| T::from_f64(random.signed() * size))
}

/// Returns any position: there is no condition on it.
fn anywhere<const NQ: usize>(random: &mut Random) -> SVector<Dd, NQ> {
    numbers(random, 1.0)
}

fn product<const R: usize, const C: usize>(
    m: &SMatrix<Dd, R, C>,
    x: &SVector<Dd, C>,
) -> SVector<Dd, R> {
    SVector::from_fn(|i, _| (0..C).fold(Dd::from_f64(0.0), |sum, j| sum + m[(i, j)] * x[j]))
}

fn largest<const N: usize>(a: &SVector<Dd, N>) -> f64 {
    a.iter()
        .fold(0.0, |most: f64, x| most.max(x.abs().to_f64()))
}

/// The rates of positions are the derivative of `integrate`, `difference` undoes it to second order, and two ways of
/// half the length are one of the whole length to fourth order.
pub fn positions_and_velocities<M: Dynamics<Dd, NQ, NV>, const NQ: usize, const NV: usize>(
    model: &M,
    position: impl Fn(&mut Random) -> SVector<Dd, NQ>,
) {
    let mut random = Random(3);
    for _ in 0..5 {
        let q = position(&mut random);
        let d: SVector<Dd, NV> = numbers(&mut random, 0.5);
        let h = Dd::from_f64(1e-8);
        let [ahead, behind] = [h, -h].map(|h| model.integrate(&q, &d.map(|x| x * h)));
        let slope = (ahead - behind).map(|x| x / (h + h));
        let off = largest(&(slope - model.position_rates(&q, &d)));
        assert!(off < 1e-14, "{off:e}");
        let error = |h: f64| {
            let d = d.map(|x| x * Dd::from_f64(h));
            largest(&(model.difference(&model.integrate(&q, &d), &q) - d))
        };
        assert!(error(0.1) < 1e-3 && error(0.01) <= 1.1e-3 * error(0.1) + 1e-30);
        let error = |h: f64| {
            let [half, whole] = [0.5 * h, h].map(|h| d.map(|x| x * Dd::from_f64(h)));
            let twice = model.integrate(&model.integrate(&q, &half), &half);
            largest(&(twice - model.integrate(&q, &whole)))
        };
        let [coarse, fine] = [error(0.1), error(0.01)];
        assert!(fine <= 1.2e-5 * coarse + 1e-29, "{coarse:e} {fine:e}");
    }
}

#[test]
fn positions_and_velocities_fit_each_other() {
    positions_and_velocities(&ChaplyginSleigh::<Dd>::default(), anywhere);
    positions_and_velocities(&DifferentialDrive::<Dd>::default(), anywhere);
    positions_and_velocities(&Snakeboard::<Dd>::default(), anywhere);
}

/// Inverse dynamics is M a + bias, undone by forward dynamics; T = ½ vᵀ M v; bias = C v + gravity; the power of the
/// efforts is the rate of the energy, so that the constraints have none.
pub fn dynamics<M, const NQ: usize, const NV: usize>(
    model: &M,
    position: impl Fn(&mut Random) -> SVector<Dd, NQ>,
) where
    M: Dynamics<Dd, NQ, NV> + Coriolis<Dd, NQ, NV>,
{
    let mut random = Random(5);
    for _ in 0..3 {
        let q = position(&mut random);
        let [v, a] = [2.0, 3.0].map(|size| numbers::<Dd, NV>(&mut random, size));
        let tau = model.inverse_dynamics(&q, &v, &a);
        let size = largest(&tau).max(1.0);
        let near = |x: SVector<Dd, NV>, y: SVector<Dd, NV>| {
            let off = largest(&(x - y));
            assert!(off < ROUNDED * size, "{off:e}");
        };
        let mass = model.mass_matrix(&q);
        near(product(&mass, &a) + model.bias(&q, &v), tau);
        let Ok(back) = model.forward_dynamics(&q, &v, &tau) else {
            panic!("a regular position is refused");
        };
        near(back, a);
        let turned = product(&model.coriolis_matrix(&q, &v), &v) + model.gravity(&q);
        near(turned, model.bias(&q, &v));
        let dot = |x: &SVector<Dd, NV>, y: &SVector<Dd, NV>| {
            let terms = x.iter().zip(y.iter());
            terms.fold(Dd::from_f64(0.0), |sum, (x, y)| sum + *x * *y)
        };
        let energy = dot(&product(&mass, &v), &v) * Dd::from_f64(0.5);
        let off = (energy - model.kinetic_energy(&q, &v)).to_f64().abs();
        assert!(off < ROUNDED * size, "{off:e}");
        let h = Dd::from_f64(1e-8);
        let [ahead, behind] = [h, -h].map(|h| {
            let q = model.integrate(&q, &(v.map(|x| x * h)));
            model.kinetic_energy(&q, &(v + a.map(|x| x * h))) + model.potential_energy(&q)
        });
        let off = ((ahead - behind) / (h + h) - dot(&tau, &v)).to_f64().abs();
        assert!(off < 1e-12 * size, "{off:e}");
    }
}

#[test]
fn the_methods_fit_each_other() {
    dynamics(&ChaplyginSleigh::<Dd>::default(), anywhere);
    dynamics(&DifferentialDrive::<Dd>::default(), anywhere);
    dynamics(&Snakeboard::<Dd>::default(), anywhere);
}

/// B S = 0, and the accelerations of the tree are the rates of its velocities.
#[test]
fn the_rows_hold_for_velocities_and_accelerations() {
    let (model, mut random) = (Snakeboard::<Dd>::default(), Random(9));
    let q: SVector<Dd, { snakeboard::NQ }> = numbers(&mut random, 1.0);
    let [v, a] = [2.0, 3.0].map(|size| numbers::<Dd, { snakeboard::NV }>(&mut random, size));
    let rate = product(&model.constraint_jacobian(&q), &model.tree_velocity(&q, &v));
    assert!(largest(&rate) < ROUNDED);
    let h = Dd::from_f64(1e-8);
    let at = |h: Dd| {
        let q = model.integrate(&q, &v.map(|x| x * h));
        model.tree_velocity(&q, &(v + a.map(|x| x * h)))
    };
    let slope = (at(h) - at(-h)).map(|x| x / (h + h));
    let off = largest(&(slope - model.tree_acceleration(&q, &v, &a)));
    assert!(off < 1e-12, "{off:e}");
}

/// Lanes and `f32` compute what `f64` does.
#[test]
fn every_scalar_computes_the_same() {
    let mut random = Random(11);
    let (model, lanes, single) = (
        Snakeboard::<f64>::default(),
        Snakeboard::<f64x4>::default(),
        Snakeboard::<f32>::default(),
    );
    for _ in 0..10 {
        let q: SVector<f64, { snakeboard::NQ }> = numbers(&mut random, 1.0);
        let [v, tau] = [1.0, 3.0].map(|size| numbers::<f64, { snakeboard::NV }>(&mut random, size));
        let found = model.forward_dynamics(&q, &v, &tau).expect("regular");
        let splat = |x: f64| f64x4::splat(x);
        let in_lanes = lanes.forward_dynamics(&q.map(splat), &v.map(splat), &tau.map(splat));
        let in_lanes = in_lanes.expect("regular");
        let near = |x: f64| x as f32;
        let in_single = single.forward_dynamics(&q.map(near), &v.map(near), &tau.map(near));
        let in_single = in_single.expect("regular");
        let size = found.amax();
        for k in 0..snakeboard::NV {
            for x in in_lanes[k].to_array() {
                assert!((x - found[k]).abs() < 1e-12 * size);
            }
            assert!((f64::from(in_single[k]) - found[k]).abs() < 1e-3 * size);
        }
    }
}

/// Both axles across the board: they hold it the same way, and the board may turn on the spot.
#[test]
fn a_singular_position_names_a_constraint() {
    let model = Snakeboard::<f64>::default();
    let mut q = model.neutral();
    q[4] = std::f64::consts::FRAC_PI_2;
    let still = SVector::from_element(0.0);
    let error = model.forward_dynamics(&q, &still, &still);
    let error = error.expect_err("a singular position");
    assert_eq!((error.joint(), error.name()), (snakeboard::NV + 1, "rear"));
    assert_eq!(error.cause(), Cause::Loop);
    assert_eq!(snakeboard::PIVOT_NAMES[snakeboard::NV..], ["front", "rear"]);
}

#[test]
fn samples_are_spread_over_the_independent_velocities() {
    let model = Snakeboard::<f64>::default();
    let q = model.sample(&SVector::from([0.75, 0.0, 1.0]));
    let pi = std::f64::consts::PI;
    assert_eq!(q.data.0[0], [0.5, 0.0, 0.0, -pi, pi]);
}

/// Where the sampled lean and steering leave a wheel above the ground, or below it, the last closed positions before are
/// returned.
#[test]
fn samples_of_the_bicycle_touch_the_ground() {
    let model = WhippleBicycle::<f64>::default();
    let mut random = Random(20_261_128);
    let mut spread = 0.0_f64;
    for _ in 0..1000 {
        let q = model.sample(&SVector::from_fn(|_, _| random.unit()));
        let open = model.constraint_residual(&q).amax();
        assert!(open < 1e-12, "{open:e} at {q:?}");
        spread = spread.max((q - model.neutral()).amax());
    }
    assert!(spread > 1.0);
}
