//! Wheels that touch: a disc and a bicycle, whose heights are conditions on positions.

use bgdyn::nalgebra::{Quaternion, SVector, UnitQuaternion, Vector3, vector};
use bgdyn::runtime::{Cause, Dd};
use bgdyn::{Dynamics, Scalar};
use bgdyn_codegen::random::Random;

use crate::laws::{dynamics, numbers, positions_and_velocities};
use crate::motions::{Reference, State, errors, step};
use crate::rolling_disc::{self, RollingDisc};
use crate::whipple_bicycle::{self, WhippleBicycle};

/// Returns a position near the start at which the wheels touch.
fn touching<T: Scalar, M: Dynamics<T, NQ, NV>, const NQ: usize, const NV: usize>(
    model: &M,
    random: &mut Random,
) -> SVector<T, NQ> {
    model.integrate(&model.neutral(), &numbers(random, 0.3))
}

#[test]
fn positions_and_velocities_fit_each_other() {
    let disc = RollingDisc::<Dd>::default();
    positions_and_velocities(&disc, |random| touching(&disc, random));
    let bicycle = WhippleBicycle::<Dd>::default();
    positions_and_velocities(&bicycle, |random| touching(&bicycle, random));
}

#[test]
fn the_methods_fit_each_other() {
    let disc = RollingDisc::<Dd>::default();
    dynamics(&disc, |random| touching(&disc, random));
    let bicycle = WhippleBicycle::<Dd>::default();
    dynamics(&bicycle, |random| touching(&bicycle, random));
}

/// Height and pitch follow from lean and steer: from positions far from touching, in few steps.
#[test]
fn wheels_touch_after_closing() {
    let (bicycle, disc) = (
        WhippleBicycle::<f64>::default(),
        RollingDisc::<f64>::default(),
    );
    let mut random = Random(17);
    for _ in 0..100 {
        let mut q: SVector<f64, { whipple_bicycle::NQ }> = numbers(&mut random, 0.6);
        q[5] *= 0.3;
        let closed = bicycle.close(&q).expect("within reach");
        let open = bicycle.constraint_residual(&closed).amax();
        assert!(open <= 4.0 * f64::EPSILON, "{open:e}");
        let kept = |p: usize| ![3, 5].contains(&p);
        assert!((0..9).filter(|&p| kept(p)).all(|p| closed[p] == q[p]));
        let q = disc.normalize(&(disc.neutral() + numbers(&mut random, 0.4)));
        let closed = disc.close(&q).expect("within reach");
        let open = disc.constraint_residual(&closed).amax();
        assert!(open <= 4.0 * f64::EPSILON, "{open:e}");
        // Straight up.
        let turned = (closed - q).fixed_rows::<4>(3).amax();
        assert!(turned <= f64::EPSILON, "{turned:e}");
    }
    let dependents = whipple_bicycle::DEPENDENTS.map(|d| d.velocity);
    let names = dependents.map(|j| whipple_bicycle::TREE_JOINT_NAMES[j]);
    assert_eq!(names, ["height", "pitch"]);
}

/// Flat on the plane a disc has no lowest point: an error, not a number.
#[test]
fn a_disc_that_lies_flat_is_an_error() {
    let model = RollingDisc::<f64>::default();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let q = vector![0.0, 0.0, 0.1, half, 0.0, 0.0, half];
    let still = vector![0.0, 0.0, 0.0];
    let error = model.forward_dynamics(&q, &vector![1.0, 2.0, 3.0], &still);
    let error = error.expect_err("flat");
    assert_eq!((error.name(), error.cause()), ("rim", Cause::Loop));
    let nowhere = model.neutral() * f64::NAN;
    let error = model.close(&nowhere).expect_err("not a number");
    assert_eq!((error.name(), error.cause()), ("rim", Cause::OutOfReach));
}

/// The disc on its steady circle, 10 s. The axle is the direction that the reference has.
#[test]
fn the_disc_follows_its_reference() {
    let model = RollingDisc::<f64>::default();
    let file = Reference::read("rolling_disk_steady.json");
    let at = |k: usize, columns: [&str; 3]| Vector3::from(columns.map(|c| file.at(k, c)));
    let axle = |k| at(k, ["ax", "ay", "az"]);
    let start = UnitQuaternion::rotation_between(&Vector3::y(), &axle(0)).expect("not opposite");
    let mut q = SVector::<f64, 7>::from_element(0.0);
    q.fixed_rows_mut::<3>(0)
        .copy_from(&at(0, ["cx", "cy", "cz"]));
    q.fixed_rows_mut::<4>(3).copy_from(&start.coords);
    let v = start.inverse() * at(0, ["wx", "wy", "wz"]);
    let error = |steps: u32| {
        let (mut now, mut worst): (State<7, 3>, f64) = ((q, v), 0.0);
        for k in 1..file.samples.len() {
            let (from, to) = (file.at(k - 1, "t"), file.at(k, "t"));
            let h = (to - from) / f64::from(steps);
            for _ in 0..steps {
                now = step(&model, now, (0.0, h), |_, _| vector![0.0, 0.0, 0.0]);
                now.0 = model.normalize(&now.0);
            }
            let part = now.0.fixed_rows::<4>(3).into_owned();
            let turned = UnitQuaternion::from_quaternion(Quaternion::from(part));
            let centre = now.0.fixed_rows::<3>(0).into_owned();
            worst = worst
                .max((centre - at(k, ["cx", "cy", "cz"])).amax())
                .max((turned * Vector3::y() - axle(k)).amax())
                .max((turned * now.1 - at(k, ["wx", "wy", "wz"])).amax());
        }
        worst
    };
    let [coarse, fine] = [100, 200].map(error);
    let order = (coarse / fine).log2();
    assert!((3.8..4.3).contains(&order), "{coarse:e}, {fine:e}");
    assert!(fine < 3e-8, "{fine:e}");
}

/// The bicycle after a push, 3 s.
#[test]
fn the_bicycle_follows_its_reference() {
    let model = WhippleBicycle::<f64>::default();
    let file = Reference::read("whipple_bicycle.json");
    let state = |k: usize| -> State<9, 3> {
        let at = |column| file.at(k, column);
        let q = [
            "x",
            "y",
            "yaw",
            "z",
            "lean",
            "rear_frame",
            "rear_wheel",
            "fork",
            "front_wheel",
        ];
        let v = ["lean_rate", "rear_wheel_rate", "fork_rate"];
        (SVector::from(q.map(at)), SVector::from(v.map(at)))
    };
    let error = errors(&model, &file, state, |_, _| vector![0.0, 0.0, 0.0], 4);
    assert!(error < 1e-7, "{error:e}");
}

/// `integrate` keeps a wheel on the ground over many steps.
#[test]
fn integrate_stays_on_the_ground() {
    let model = RollingDisc::<f64>::default();
    let mut q = model.neutral();
    for k in 0..2000 {
        let t = f64::from(k) * 1e-2;
        let moved = vector![0.3 * t.cos(), 2.0, 0.4 * t.sin()] * 1e-2;
        q = model.normalize(&model.integrate(&q, &moved));
        let open = model.constraint_residual(&q).amax();
        assert!(open <= 8.0 * f64::EPSILON, "{open:e}");
    }
    let [edges, rows] = [rolling_disc::PIVOT_NAMES.len(), rolling_disc::NC];
    assert_eq!((edges, rows), (rolling_disc::NV + 1, 3));
}
