//! Positions assembled from anywhere: on the branch of the file, with the shortest steps, or an error.

use bgdyn::nalgebra::{SVector, vector};
use bgdyn::runtime::wide::f64x4;
use bgdyn::runtime::{Cause, Dd};
use bgdyn::{Dynamics, Scalar};
use bgdyn_codegen::random::Random;

bgdyn::bgdyn!(
    "../../specs/loops/five_bar.yaml",
    methods = [dynamics, assemble]
);
bgdyn::bgdyn!(
    "../../specs/loops/delta_robot.yaml",
    methods = [dynamics, assemble]
);
bgdyn::bgdyn!(
    "../../specs/loops/stewart_platform.yaml",
    methods = [dynamics, assemble]
);
bgdyn::bgdyn!(
    "../../specs/loops/slider_crank.yaml",
    methods = [dynamics, assemble]
);
bgdyn::bgdyn!(
    "../../specs/constraints/rolling_disc.yaml",
    methods = [dynamics, assemble]
);

use five_bar::FiveBar;

/// From 100 guesses anywhere: positions close to rounding, and the functions of the branch accept them.
macro_rules! from_anywhere {
    ($test:ident, $module:ident, $model:ident, $size:expr) => {
        #[test]
        fn $test() {
            let model = $module::$model::<f64>::default();
            let mut numbers = Random(5);
            let (mut far, mut returned) = (0.0_f64, 0);
            for k in 0..100 {
                let guess =
                    SVector::<f64, { $module::NQ }>::from_fn(|_, _| $size * numbers.signed());
                let q = model.assemble(&guess, &[true; $module::NT]);
                let q = q.unwrap_or_else(|error| panic!("{k}: {error}"));
                let open = model.constraint_residual(&q).amax();
                assert!(open <= 16.0 * f64::EPSILON, "{k}: open by {open:e}");
                let still = SVector::<f64, { $module::NV }>::zeros();
                let moved = model.forward_dynamics(&q, &still, &still);
                assert!(moved.is_ok(), "{k}: {:?}", moved.err());
                far = far.max((q - guess).amax());
                returned += usize::from((q - model.neutral()).amax() < 1e-12);
                // What closes stays.
                let again = model.assemble(&q, &[true; $module::NT]).expect("closed");
                assert!((again - q).amax() < 1e-13, "{k}");
            }
            assert!(far > 0.1, "{far}");
            // Few guesses lead nowhere, so that only the start is left.
            println!("{}: {returned}", stringify!($test));
            assert!(returned <= 30, "{returned}");
        }
    };
}

from_anywhere!(five_bars_close_from_anywhere, five_bar, FiveBar, 3.0);
from_anywhere!(
    delta_robots_close_from_anywhere,
    delta_robot,
    DeltaRobot,
    1.5
);
from_anywhere!(
    stewart_platforms_close_from_anywhere,
    stewart_platform,
    StewartPlatform,
    1.0
);
from_anywhere!(
    slider_cranks_close_from_anywhere,
    slider_crank,
    SliderCrank,
    3.0
);

/// A guess that is off by little is changed by little: its change along the motions that the loop allows is small
/// against the change that closes it.
#[test]
fn a_guess_near_a_closed_position_changes_least() {
    let model = FiveBar::<f64>::default();
    let mut numbers = Random(8);
    for _ in 0..50 {
        let closed = model.integrate(
            &model.neutral(),
            &vector![0.3 * numbers.signed(), 0.3 * numbers.signed()],
        );
        let off = SVector::<f64, 4>::from_fn(|_, _| 0.01 * numbers.signed());
        let guess = closed + off;
        let q = model.assemble(&guess, &[true; 4]).expect("near");
        let change = guess - q;
        assert!(change.norm() <= 1.02 * off.norm());
        let along = model.velocity_map(&q).transpose() * change;
        assert!(
            along.norm() < 0.05 * off.norm(),
            "{} {}",
            along.norm(),
            off.norm()
        );
    }
}

#[test]
fn joints_that_are_not_free_stay() {
    let model = FiveBar::<f64>::default();
    let mut guess = model.neutral();
    (guess[0], guess[1], guess[2], guess[3]) = (2.3, 0.1, 0.9, -0.4);
    let free = [false, true, false, true];
    let q = model.assemble(&guess, &free).expect("within reach");
    assert_eq!((q[0], q[2]), (2.3, 0.9));
    let near = model.close(&model.assemble(&guess, &[true; 4]).expect("closed"));
    assert!(near.is_ok());
    // A distal joint is held: the others follow.
    let free = [true, false, true, true];
    let q = model.assemble(&guess, &free).expect("within reach");
    assert_eq!(q[1], 0.1);
    assert!(model.constraint_residual(&q).amax() < 1e-15);
}

#[test]
fn out_of_reach_and_on_another_branch_are_different_errors() {
    let model = FiveBar::<f64>::default();
    let mut guess = model.neutral();
    (guess[0], guess[2]) = (3.1, 0.0);
    let cranks_held = [false, true, false, true];
    let error = model
        .assemble(&guess, &cranks_held)
        .expect_err("0.8 m apart");
    assert_eq!(
        (error.name(), error.cause()),
        ("tip_pin", Cause::NotAssembled)
    );
    assert_eq!(error.joint(), five_bar::NQ);
    // The mirror image of the rods, with everything held but one crank and its rod.
    let q = model.neutral();
    let elbow = |crank: f64, x: f64| [x + 0.25 * crank.cos(), 0.25 * crank.sin()];
    let ([px, py], [ox, oy]) = (elbow(q[0], 0.0), elbow(q[2], 0.3));
    let line = (oy - py).atan2(ox - px);
    let mut other = q;
    (other[1], other[3]) = (
        2.0 * line - q[1] - 2.0 * q[0],
        2.0 * line - q[3] - 2.0 * q[2],
    );
    assert!(model.constraint_residual(&other).amax() < 1e-15);
    let error = model
        .assemble(&other, &[false; 4])
        .expect_err("another branch");
    assert_eq!((error.name(), error.cause()), ("tip_pin", Cause::Branch));
    assert!(error.to_string().contains("another branch"), "{error}");
    // Free, it returns to the branch of the file.
    let back = model.assemble(&other, &cranks_held).expect("the rods turn");
    assert!((back - q).map(f64::sin).amax() < 1e-12, "{back} {q}");
    let mut lost = q;
    lost[2] = f64::NAN;
    assert!(model.assemble(&lost, &[true; 4]).is_err());
    lost[2] = f64::INFINITY;
    assert!(model.assemble(&lost, &[true; 4]).is_err());
}

#[test]
fn every_scalar_assembles() {
    fn assembled<T: Scalar>(free: &[bool; 4]) -> SVector<T, 4> {
        let model = FiveBar::<T>::default();
        let guess = [2.4, -0.9, 0.7, 1.8].map(T::from_f64);
        let found = model.assemble(&guess.into(), free);
        found.unwrap_or_else(|error| panic!("{error:?}"))
    }
    for free in [[true; 4], [false, true, true, true]] {
        let exact = assembled::<Dd>(&free);
        let open = FiveBar::<Dd>::default().constraint_residual(&exact);
        assert!(open.iter().all(|x| x.to_f64().abs() < 1e-18), "{open:?}");
        let (long, short, lanes) = (
            assembled::<f64>(&free),
            assembled::<f32>(&free),
            assembled::<f64x4>(&free),
        );
        for j in 0..4 {
            assert!((long[j] - exact[j].to_f64()).abs() < 1e-9);
            assert!((f64::from(short[j]) - exact[j].to_f64()).abs() < 1e-3);
            assert_eq!(lanes[j].to_array(), [long[j]; 4]);
        }
    }
    // Lanes fail one by one.
    let model = FiveBar::<f64x4>::default();
    let mut guess: SVector<f64x4, 4> = model.neutral();
    guess[0] = f64x4::new([1.9, 3.1, 2.0, 2.1]);
    guess[2] = f64x4::new([1.1, 0.0, 1.2, 1.0]);
    let error = model.assemble(&guess, &[false, true, false, true]);
    let error = error.expect_err("one lane is out of reach");
    let failed: Vec<usize> = error.failed().map(|(lane, _)| lane).collect();
    assert_eq!(failed, [1]);
}

/// A disc above the ground, turned anyhow: it touches, and its quaternion has length 1.
#[test]
fn a_disc_is_put_on_the_ground() {
    let model = rolling_disc::RollingDisc::<f64>::default();
    let mut numbers = Random(3);
    for k in 0..100 {
        let mut guess = model.neutral();
        let moved = SVector::<f64, { rolling_disc::NQ }>::from_fn(|_, _| 0.4 * numbers.signed());
        guess = model.normalize(&(guess + moved));
        let q = model.assemble(&guess, &[true; rolling_disc::NT]);
        let q = q.unwrap_or_else(|error| panic!("{k}: {error}"));
        let rows = model.constraint_residual(&q).amax();
        assert!(rows < 1e-14, "{k}: {rows:e}");
        assert!((model.normalize(&q) - q).amax() < 1e-13, "{k}");
    }
}
