//! The end of the reach: typed errors, never NaN, never another branch.

use bgdyn::Dynamics;
use bgdyn::nalgebra::{SVector, vector};
use bgdyn::runtime::Cause;
use bgdyn::runtime::wide::f64x4;

use crate::five_bar::{CLOSING_NAMES, FiveBar, NQ};
use crate::slider_crank_near_singular::SliderCrankNearSingular;

/// The outer cranks far apart: the rods do not reach each other.
#[test]
fn a_position_out_of_reach_is_an_error_that_names_the_loop() {
    let model = FiveBar::<f64>::default();
    let mut q = model.neutral();
    (q[0], q[2]) = (3.1, 0.0);
    let error = model.close(&q).expect_err("0.8 m apart");
    assert_eq!(
        (error.name(), error.cause()),
        ("tip_pin", Cause::OutOfReach)
    );
    assert_eq!(error.joint(), NQ);
    assert_eq!(CLOSING_NAMES[NQ], "tip_pin");
    assert_eq!(
        error.to_string(),
        "loop or constraint `tip_pin` is out of reach here, or at the end of its reach"
    );
    // What cannot report an error makes the positions of the loop useless, those that accelerations in closed form read
    // too, and the next function says so.
    let far = model.integrate(&model.neutral(), &vector![1.1, -1.1]);
    assert!(far.iter().all(|q| q.is_nan()), "{far}");
    let error = model.forward_dynamics(&far, &vector![0.0, 0.0], &vector![0.0, 0.0]);
    let error = error.expect_err("a position that is no number");
    assert!(error.to_string().contains("proximal1_angle"), "{error}");
}

/// In lanes only those out of reach fail.
#[test]
fn lanes_fail_one_by_one() {
    let model = FiveBar::<f64x4>::default();
    let mut q: SVector<f64x4, NQ> = model.neutral();
    q[0] = f64x4::new([1.9, 3.1, 2.0, 2.1]);
    q[2] = f64x4::new([1.1, 0.0, 1.2, 1.0]);
    let error = model.close(&q).expect_err("one lane is out of reach");
    let failed: Vec<usize> = error.failed().map(|(lane, _)| lane).collect();
    assert_eq!(failed, [1]);
}

/// From the side of a wrong guess the positions close on the branch of the guess; the sign of the elbow at `left`
/// does not change along a path.
#[test]
fn closing_keeps_the_branch() {
    let model = FiveBar::<f64>::default();
    let mut q = model.neutral();
    for k in 0..400 {
        let t = f64::from(k) * 0.02;
        (q[0], q[2]) = (2.0 + 0.5 * t.sin(), 1.1 + 0.4 * (1.7 * t).cos());
        q = model.close(&q).expect("within reach");
        assert!(model.constraint_residual(&q).amax() <= 4.0 * f64::EPSILON);
        // The tip lies left of the line from elbow 1 to elbow 2.
        let elbow = |crank: f64, x: f64| [x + 0.25 * crank.cos(), 0.25 * crank.sin()];
        let ([px, py], [ox, oy]) = (elbow(q[0], 0.0), elbow(q[2], 0.3));
        let tip = [
            px + 0.35 * (q[0] + q[1]).cos(),
            py + 0.35 * (q[0] + q[1]).sin(),
        ];
        let area = (ox - px) * (tip[1] - py) - (oy - py) * (tip[0] - px);
        assert!(area > 0.0, "{k}");
    }
}

/// A sweep of the crank through the position where the rod is almost upright: numbers or errors, never NaN.
#[test]
fn near_a_singular_position_there_are_numbers_or_errors() {
    let model = SliderCrankNearSingular::<f64>::default();
    let mut q = model.neutral();
    let (mut most, n) = (0.0_f64, 100_000);
    for k in 0..n {
        q[0] = 0.3 + std::f64::consts::TAU * f64::from(k) / f64::from(n);
        q = model.close(&q).expect("the rod is longer than the crank");
        let a = model
            .forward_dynamics(&q, &vector![9.0], &vector![0.5])
            .expect("regular");
        assert!(a[0].is_finite());
        most = most.max(a[0].abs());
    }
    assert!(most > 1e3, "{most}");
}

/// Functions in closed form read the independent positions alone: with the dependent ones of the other branch they
/// compute the branch of the spec. `close` stays on the branch of its argument.
#[test]
fn the_other_branch_is_not_computed() {
    let model = FiveBar::<f64>::default();
    let q = model.neutral();
    // The mirror image of the tip at the line between the elbows.
    let elbow = |crank: f64, x: f64| [x + 0.25 * crank.cos(), 0.25 * crank.sin()];
    let ([px, py], [ox, oy]) = (elbow(q[0], 0.0), elbow(q[2], 0.3));
    let line = (oy - py).atan2(ox - px);
    let [rod, back] = [q[0] + q[1], q[2] + q[3]];
    let mut other = q;
    (other[1], other[3]) = (2.0 * line - rod - q[0], 2.0 * line - back - q[2]);
    assert!(model.constraint_residual(&other).amax() < 1e-15);
    let (v, tau) = (vector![0.4, -0.3], vector![0.2, 0.1]);
    let [own, there] = [q, other].map(|q| model.forward_dynamics(&q, &v, &tau).expect("regular"));
    assert_eq!(own, there);
    let back = model.close(&other).expect("closed already");
    assert!((back - other).amax() < 1e-12, "{back}");
    assert!((back - q).amax() > 0.1);
}
