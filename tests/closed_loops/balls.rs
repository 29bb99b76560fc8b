//! Loops through joints of several velocities in compiled code: a spatial slider-crank whose rod has a ball at both ends,
//! and a table on a floating joint that three rods hold.

use bgdyn::nalgebra::{SVector, vector};
use bgdyn::runtime::wide::f64x4;
use bgdyn::runtime::{Cause, Dd};
use bgdyn::{Dynamics, Scalar};
use bgdyn_codegen::random::Random;

use crate::held_table::HeldTable;
use crate::laws::{numbers, position};
use crate::spatial_slider_crank::{self as crank, SpatialSliderCrank};

/// Walks random ways and returns the largest gap of the loops, and the largest change of the quaternions' lengths.
fn gaps<T: Scalar>(size: impl Fn(T) -> f64) -> [f64; 2] {
    let (model, table) = (
        SpatialSliderCrank::<T>::default(),
        HeldTable::<T>::default(),
    );
    let mut random = Random(7);
    let (mut q, mut p) = (model.neutral(), table.neutral());
    let [mut gap, mut length] = [0.0_f64; 2];
    for _ in 0..40 {
        q = model.integrate(&q, &numbers(&mut random, 0.3));
        p = table.integrate(&p, &numbers(&mut random, 0.1));
        let open = model.constraint_residual(&q);
        let other = table.constraint_residual(&p);
        for &x in open.iter().chain(other.iter()) {
            gap = gap.max(size(x));
        }
        for quaternion in [&q.as_slice()[1..5], &p.as_slice()[3..7]] {
            let square = quaternion.iter().map(|&x| x * x);
            let off = square.fold(T::from_f64(-1.0), |sum, x| sum + x);
            length = length.max(size(off));
        }
    }
    [gap, length]
}

/// Closed positions stay closed along random ways, in every scalar; quaternions keep their length.
#[test]
fn ways_end_at_closed_positions() {
    let lanes = |x: f64x4| x.to_array().into_iter().map(f64::abs).fold(0.0, f64::max);
    for (found, eps) in [
        (gaps::<f64>(f64::abs), f64::EPSILON),
        (gaps::<f32>(|x| f64::from(x.abs())), f64::from(f32::EPSILON)),
        (gaps::<Dd>(|x| x.to_f64().abs()), 1e-17),
        (gaps::<f64x4>(lanes), f64::EPSILON),
    ] {
        assert!(found.iter().all(|x| *x < 8.0 * eps), "{found:?}");
    }
}

/// Rates of positions are the slope of `integrate`; `difference` undoes it to second order, as the rod's spin does not
/// commute with its other turns, and exactly where the independent joints have positions of their own.
#[test]
fn positions_and_velocities_fit_each_other() {
    fn slope<M: Dynamics<Dd, NQ, NV>, const NQ: usize, const NV: usize>(model: &M) {
        let mut random = Random(3);
        let q = position(model, &mut random);
        let d: SVector<Dd, NV> = numbers(&mut random, 0.1);
        let h = Dd::from_f64(1e-8);
        let [ahead, behind] = [h, -h].map(|h| model.integrate(&q, &d.map(|x| x * h)));
        let rates = model.position_rates(&q, &d);
        for (k, rate) in rates.iter().enumerate() {
            let slope = (ahead[k] - behind[k]) / (h + h);
            let off = (slope - *rate).to_f64().abs();
            assert!(off < 1e-12, "{k}: {off:e} of {rate:?}, {NQ}");
        }
        let off = |size: f64| {
            let d = d.map(|x| x * Dd::from_f64(size));
            let back = model.difference(&model.integrate(&q, &d), &q);
            (back - d)
                .iter()
                .map(|x| x.to_f64().abs())
                .fold(0.0, f64::max)
        };
        let (whole, half) = (off(1.0), off(0.5));
        assert!(whole < 1e-4 && half < 0.15 * whole, "{whole:e}, {half:e}");
    }
    slope(&SpatialSliderCrank::<Dd>::default());
    slope(&HeldTable::<Dd>::default());
}

/// The slider is where a sphere of the rod's length about the crank's ball meets its rail.
#[test]
fn the_slider_is_where_the_rod_reaches() {
    let model = SpatialSliderCrank::<f64>::default();
    let mut random = Random(11);
    for _ in 0..20 {
        let mut q = model.neutral();
        q[0] += 0.4 * random.signed();
        let q = model.close(&q).expect("in reach");
        let (sin, cos) = q[0].sin_cos();
        let ball = [0.12 * cos, 0.12 * sin, 0.02];
        let across = (0.05 - ball[1]).powi(2) + (0.15 - ball[2]).powi(2);
        let wanted = ball[0] + (0.4_f64.powi(2) - across).sqrt();
        assert!((q[5] - wanted).abs() < 1e-15, "{} and {wanted}", q[5]);
    }
    assert_eq!(crank::TREE_JOINT_NAMES.len(), 5);
    assert_eq!(crank::JOINT_NAMES, ["crank_angle", "rod_ball_rx"]);
}

/// The spin of the rod is free: about the line of its balls no load acts but what its own inertia needs.
#[test]
fn forces_go_through_the_balls() {
    let model = SpatialSliderCrank::<f64>::default();
    let mut random = Random(13);
    for _ in 0..5 {
        let q = position(&model, &mut random);
        let v = vector![1.5, -4.0];
        let tau = vector![0.7, 0.0];
        let a = model.forward_dynamics(&q, &v, &tau).expect("regular");
        let back = model.inverse_dynamics(&q, &v, &a);
        assert!((back - tau).amax() < 1e-13, "{back}");
        let loads = model.joint_reactions(&q, &v, &a);
        // On the rod from the crank: a ball carries no moment.
        assert!(loads[1].moment.amax() < 1e-13, "{:?}", loads[1]);
        assert!((loads[0].moment[2] - 0.7).abs() < 1e-13);
    }
}

/// Samples are closed; a slider out of the rod's reach is an error with the loop's name.
#[test]
fn samples_are_closed_and_positions_out_of_reach_refused() {
    let model = SpatialSliderCrank::<f64>::default();
    let mut random = Random(17);
    for _ in 0..20 {
        let u = SVector::<f64, 2>::from_fn(|_, _| random.unit());
        let q = model.sample(&u);
        assert!(model.constraint_residual(&q).amax() < 1e-15, "{q}");
    }
    let short = crate::short_strut::ShortStrut::<f64>::default();
    let mut q = short.neutral();
    q[0] = -1.5;
    let refused = short.close(&q).expect_err("out of reach");
    assert_eq!(
        (refused.cause(), refused.name()),
        (Cause::OutOfReach, "slider_ball")
    );
}

/// A way out of reach ends at no position at all: no function takes a turn that is not closed for a closed one.
#[test]
fn positions_out_of_reach_are_no_numbers() {
    let model = crate::planar_rod::PlanarRod::<f64>::default();
    let start = model.neutral();
    let near = model.integrate(&start, &vector![0.4]);
    assert!(model.constraint_residual(&near).amax() < 1e-15, "{near}");
    // The crank's reach ends at asin(0.15 / 0.2) = 0.848 rad.
    for way in [0.86, 1.0, 1.5, -1.2] {
        let far = model.integrate(&start, &vector![way]);
        assert!(far.iter().all(|x| x.is_nan()), "{way}: {far}");
        let nothing = vector![0.0];
        assert!(model.forward_dynamics(&far, &nothing, &nothing).is_err());
    }
}

/// From a rough guess the same closed position, with the crank kept.
#[test]
fn positions_are_assembled() {
    let model = SpatialSliderCrank::<f64>::default();
    let q = model.neutral();
    let mut guess = q;
    guess[5] += 0.1;
    guess[1] += 0.05;
    let mut free = [true; 5];
    free[0] = false;
    let found = model.assemble(&guess, &free).expect("assembled");
    assert!(model.constraint_residual(&found).amax() < 1e-15);
    assert!((found[5] - q[5]).abs() < 1e-15 && found[0] == q[0]);
}

/// Without friction a run of 2 s keeps its energy, and the loop closed.
#[test]
fn runs_keep_energy_and_loops() {
    let scene = crate::spatial_run::SpatialRun::<f64>::default();
    let mut run = bgdyn_sim::Run::new(&scene);
    while run.t() < 2.0 {
        run.step(1e-3).expect("it goes on");
    }
    let audit = run.audit();
    assert!(audit.drift().abs() < 1e-8, "{:e}", audit.drift());
    let model = SpatialSliderCrank::<f64>::default();
    let q = SVector::<f64, 6>::from_fn(|k, _| run.y()[k]);
    assert!(model.constraint_residual(&q).amax() < 2e-15, "{q}");
    // The crank swings: it moved.
    assert!((q[0] - 0.4).abs() > 0.1, "{q}");
}
