//! `base: given` in compiled code: a crane on a ship, against the same crane on a floating link.

use bgdyn::nalgebra::{SVector, Vector3};
use bgdyn::runtime::wide::f64x4;
use bgdyn::runtime::{BaseMotion, Dd, Dynamics, Scalar};

use crate::boom::{self, Boom};
use crate::boom_floating::{self, BoomFloating};

type Whole<T> = SVector<T, { boom_floating::NV }>;

/// A state of the crane on a floating link: positions, velocities, accelerations.
fn state<T: Scalar>(seed: f64) -> (SVector<T, { boom_floating::NQ }>, Whole<T>, Whole<T>) {
    let number = |k: usize| (seed + 0.618_034 * (k as f64 + 1.0)).fract();
    let robot = BoomFloating::<T>::default();
    let q = robot.sample(&SVector::from_fn(|k, _| T::from_f64(number(k))));
    let v = SVector::from_fn(|k, _| T::from_f64(2.0 * number(k + 20) - 1.0));
    let a = SVector::from_fn(|k, _| T::from_f64(6.0 * number(k + 40) - 3.0));
    (q, v, a)
}

/// Returns the motion of the floating link in world axes, by its own methods, as that of a base.
fn motion(
    robot: &BoomFloating<f64>,
    q: &SVector<f64, { boom_floating::NQ }>,
    v: &Whole<f64>,
    a: &Whole<f64>,
) -> BaseMotion<f64> {
    let pose = robot.pose_carrier(q);
    let jacobian = robot.jacobian_world_carrier(q);
    let twist = jacobian * v;
    let rate = jacobian * a + robot.jacobian_dot_v_world_carrier(q, v);
    let part = |x: &SVector<f64, 6>, k: usize| Vector3::new(x[k], x[k + 1], x[k + 2]);
    BaseMotion::from_world(
        &pose.rotation,
        [&part(&twist, 0), &part(&rate, 0), &part(&rate, 3)],
        &Vector3::new(0.0, 0.0, -9.81),
    )
}

#[test]
fn efforts_on_a_ship_are_those_on_a_floating_link() {
    let other = BoomFloating::<f64>::default();
    for seed in [0.11, 0.42, 0.77] {
        let (q, v, a) = state(seed);
        let mut crane = Boom::<f64>::default();
        crane.set_base_motion(&motion(&other, &q, &v, &a));
        let own = |x: &Whole<f64>| SVector::<f64, { boom::NV }>::from_fn(|k, _| x[k + 6]);
        let positions = SVector::<f64, { boom::NQ }>::from_fn(|k, _| q[k + 7]);
        let found = crane.inverse_dynamics(&positions, &own(&v), &own(&a));
        let expected = own(&other.inverse_dynamics(&q, &v, &a));
        assert!(
            (found - expected).norm() < 1e-12 * expected.norm(),
            "{found} {expected}"
        );
        let back = crane.forward_dynamics(&positions, &own(&v), &found);
        let back = back.expect("it has inertia");
        assert!((back - own(&a)).norm() < 1e-11, "{back}");
        // The default is a base at rest.
        let still = Boom::<f64>::default().inverse_dynamics(&positions, &own(&v), &own(&a));
        assert!((found - still).norm() > 1.0);
    }
}

/// Lanes, `f32` and double-double compute the same.
#[test]
fn every_scalar_has_a_moving_base() {
    let (q, v, a) = state::<f64>(0.3);
    let motion = motion(&BoomFloating::default(), &q, &v, &a);
    fn efforts<T: Scalar>(
        motion: &BaseMotion<T>,
        number: impl Fn(f64) -> T,
        (q, v, a): (&[f64], &[f64], &[f64]),
    ) -> SVector<T, { boom::NV }> {
        let mut crane = Boom::<T>::default();
        crane.set_base_motion(motion);
        crane.inverse_dynamics(
            &SVector::from_fn(|k, _| number(q[k + 7])),
            &SVector::from_fn(|k, _| number(v[k + 6])),
            &SVector::from_fn(|k, _| number(a[k + 6])),
        )
    }
    fn given<T: Scalar>(motion: &BaseMotion<f64>) -> BaseMotion<T> {
        let of = |x: &Vector3<f64>| Vector3::from_fn(|k, _| T::from_f64(x[k]));
        BaseMotion {
            angular_velocity: of(&motion.angular_velocity),
            angular_acceleration: of(&motion.angular_acceleration),
            specific_force: of(&motion.specific_force),
        }
    }
    let state = (q.as_slice(), v.as_slice(), a.as_slice());
    let exact = efforts::<Dd>(&given(&motion), Dd::from_f64, state);
    let double = efforts::<f64>(&motion, |x| x, state);
    let single = efforts::<f32>(&given(&motion), |x| x as f32, state);
    let wide = efforts::<f64x4>(&given(&motion), f64x4::splat, state);
    for k in 0..boom::NV {
        let (expected, size) = (exact[k].to_f64(), exact.map(Dd::to_f64).amax());
        assert!((double[k] - expected).abs() < 1e-14 * size, "{k}");
        assert!((f64::from(single[k]) - expected).abs() < 1e-5 * size, "{k}");
        assert_eq!(wide[k].to_array(), [double[k]; 4], "{k}");
    }
}
