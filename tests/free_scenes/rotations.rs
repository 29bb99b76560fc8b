//! Motion at constant velocity, which the semi-implicit method integrates exactly.

use bgdyn_sim::{Run, ScenePlant, SemiImplicitEuler};

use crate::disc_run::DiscRun;
use crate::quaternion;

/// A ball turns about a fixed axis by 1 rad/s: steps of any length give the angle to rounding.
#[test]
fn a_ball_turns_exactly_by_the_semi_implicit_method() {
    let scene = DiscRun::<f64>::default();
    for h in [1e-3, 0.7] {
        let mut run = Run::by(
            SemiImplicitEuler,
            ScenePlant::new(&scene),
            Run::begin(&scene),
        );
        for _ in 0..1000 {
            run.step(h).expect("it turns");
        }
        let (sine, cosine) = (500.0 * h).sin_cos();
        let found = quaternion(run.y().as_slice(), 3);
        for (found, wanted) in found.into_iter().zip([0.6 * sine, 0.0, 0.8 * sine, cosine]) {
            assert!(
                (found - wanted).abs() < 1e-12,
                "{h}: {found} instead of {wanted}"
            );
        }
    }
}
