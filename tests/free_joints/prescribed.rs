//! Prescribed joints in compiled code: a carousel with an arm, against the same carousel with all joints free.

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::wide::f64x4;
use bgdyn::runtime::{Dd, Dynamics, Scalar};

use crate::carousel::{self, Carousel};
use crate::carousel_free::{self, CarouselFree};

/// The places of the prescribed joints in v of the free carousel, and in its q.
const DRIVEN: [usize; 2] = [0, 3];

type Own<T> = SVector<T, { carousel::NV }>;
type All<T> = SVector<T, { carousel_free::NV }>;

fn number(seed: f64, k: usize) -> f64 {
    2.0 * (seed + 0.618_034 * (k as f64 + 1.0)).fract() - 1.0
}

/// A state of the free carousel: positions, velocities, accelerations.
fn state<T: Scalar>(seed: f64) -> (SVector<T, { carousel_free::NQ }>, All<T>, All<T>) {
    let half = T::from_f64(0.5);
    let robot = CarouselFree::<T>::default();
    let u = All::from_fn(|k, _| T::from_f64(number(seed, k)) * half + half);
    let v = All::from_fn(|k, _| T::from_f64(2.0 * number(seed, k + 20)));
    let a = All::from_fn(|k, _| T::from_f64(3.0 * number(seed, k + 40)));
    (robot.sample(&u), v, a)
}

/// Returns the components that are not those of prescribed joints.
fn own<T: Scalar, const N: usize, const M: usize>(x: &SVector<T, N>) -> SVector<T, M> {
    let kept = (0..N).filter(|k| !DRIVEN.contains(k));
    SVector::from_iterator(kept.map(|k| x[k]))
}

/// Returns the carousel with the motion of the prescribed joints in this state.
fn driven<T: Scalar>(q: &SVector<T, { carousel_free::NQ }>, v: &All<T>, a: &All<T>) -> Carousel<T> {
    let [table, reach] = DRIVEN;
    Carousel {
        turntable_position: q[table],
        turntable_velocity: v[table],
        turntable_acceleration: a[table],
        reach_position: q[reach],
        reach_velocity: v[reach],
        reach_acceleration: a[reach],
    }
}

#[test]
fn sizes_and_names() {
    assert_eq!(carousel::PRESCRIBED_NAMES, ["turntable", "reach"]);
    assert_eq!(carousel::JOINT_NAMES[..2], ["swing", "tilt"]);
    assert_eq!((carousel::NP, carousel::NV, carousel::NQ), (2, 5, 6));
    let still = Carousel::<f64>::default();
    assert_eq!((still.turntable_velocity, still.reach_position), (0.0, 0.0));
}

#[test]
fn efforts_and_accelerations_are_those_with_free_joints() {
    let free = CarouselFree::<f64>::default();
    for seed in [0.11, 0.42, 0.77] {
        let (q, v, a) = state(seed);
        let carousel = driven(&q, &v, &a);
        let (own_q, own_v, own_a) = (own(&q), own(&v), own(&a));
        let all = free.inverse_dynamics(&q, &v, &a);
        let efforts: Own<f64> = own(&all);
        let found = carousel.inverse_dynamics(&own_q, &own_v, &own_a);
        assert!(
            (found - efforts).norm() < 1e-12 * all.norm(),
            "{found} {efforts}"
        );
        let drives = carousel.drive_efforts(&own_q, &own_v, &own_a);
        for (k, &j) in DRIVEN.iter().enumerate() {
            assert!(
                (drives[k] - all[j]).abs() < 1e-12 * all.norm(),
                "{drives} {all}"
            );
        }
        let back = carousel.forward_dynamics(&own_q, &own_v, &efforts);
        let back = back.expect("it has inertia");
        assert!((back - own_a).norm() < 1e-10, "{back} {own_a}");
        let (tip, expected) = (
            carousel.velocity_tip(&own_q, &own_v),
            free.velocity_tip(&q, &v),
        );
        assert!((tip - expected).norm() < 1e-13 * expected.norm());
        // The acceleration of the tip is J a and the rest.
        let jacobian = carousel.jacobian_world_tip(&own_q);
        let tip = jacobian * own_a + carousel.jacobian_dot_v_world_tip(&own_q, &own_v);
        let expected = free.jacobian_world_tip(&q) * a + free.jacobian_dot_v_world_tip(&q, &v);
        assert!(
            (tip - expected).norm() < 1e-12 * expected.norm(),
            "{tip} {expected}"
        );
    }
}

/// The power of all efforts, those of the drives included, is the rate of the energy.
#[test]
fn the_drives_supply_the_power_that_the_joints_do_not() {
    let energy = |q: &SVector<Dd, { carousel_free::NQ }>, v: &All<Dd>, a: &All<Dd>| {
        let carousel = driven(q, v, a);
        let (q, v) = (own(q), own(v));
        carousel.kinetic_energy(&q, &v) + carousel.potential_energy(&q)
    };
    let free = CarouselFree::<Dd>::default();
    let h = Dd::from_f64(1e-8);
    let (q, v, a) = state::<Dd>(0.3);
    let at = |h: Dd| {
        let half = Dd::from_f64(0.5);
        let moved = v.zip_map(&a, |v, a| h * (v + half * h * a));
        energy(
            &free.integrate(&q, &moved),
            &v.zip_map(&a, |v, a| v + h * a),
            &a,
        )
    };
    let rate = (at(h) - at(-h)) / (h + h);
    let carousel = driven(&q, &v, &a);
    let (own_q, own_v, own_a) = (own(&q), own(&v), own(&a));
    let efforts: Own<Dd> = carousel.inverse_dynamics(&own_q, &own_v, &own_a);
    let drives = carousel.drive_efforts(&own_q, &own_v, &own_a);
    let zero = Dd::from_f64(0.0);
    let joints = (0..carousel::NV).fold(zero, |sum, j| sum + efforts[j] * own_v[j]);
    let whole = (0..carousel::NP).fold(joints, |sum, k| sum + drives[k] * v[DRIVEN[k]]);
    let off = (whole - rate).to_f64().abs();
    assert!(off < 1e-13 * whole.to_f64().abs(), "{off:e}");
    assert!((joints - rate).to_f64().abs() > 1.0);
}

/// Lanes, `f32` and double-double compute the same.
#[test]
fn every_scalar_has_prescribed_joints() {
    fn drives<T: Scalar>(number: impl Fn(f64) -> T) -> (Own<T>, SVector<T, { carousel::NP }>) {
        let (q, v, a) = state::<f64>(0.6);
        let (q, v, a) = (q.map(&number), v.map(&number), a.map(&number));
        let carousel = driven(&q, &v, &a);
        let (q, v, a) = (own(&q), own(&v), own(&a));
        (
            carousel.inverse_dynamics(&q, &v, &a),
            carousel.drive_efforts(&q, &v, &a),
        )
    }
    let exact = drives(Dd::from_f64);
    let double = drives(|x| x);
    let single = drives(|x| x as f32);
    let wide = drives(f64x4::splat);
    let size = exact
        .1
        .map(Dd::to_f64)
        .amax()
        .max(exact.0.map(Dd::to_f64).amax());
    for k in 0..carousel::NP {
        let expected = exact.1[k].to_f64();
        assert!((double.1[k] - expected).abs() < 1e-14 * size, "{k}");
        assert!(
            (f64::from(single.1[k]) - expected).abs() < 1e-5 * size,
            "{k}"
        );
        assert_eq!(wide.1[k].to_array(), [double.1[k]; 4], "{k}");
    }
    for j in 0..carousel::NV {
        assert!(
            (double.0[j] - exact.0[j].to_f64()).abs() < 1e-14 * size,
            "{j}"
        );
        assert_eq!(wide.0[j].to_array(), [double.0[j]; 4], "{j}");
    }
}
