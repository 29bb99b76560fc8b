//! Tests failures: the reason, the time, and the state afterwards.

use bgdyn_runtime::vector;
use bgdyn_sim::{
    Dop853, Dopri5, Failure, Gauss2, Integrator, Jacobian, Midpoint, Ode, Reason, Rk4, Rodas4,
    Solver, Tolerance,
};
use nalgebra::SVector;

type Y = SVector<f64, 1>;

/// The causes of failures.
enum Trouble {
    /// ẏ = y² blows up at t = 1 from y = 1.
    BlowsUp,
    /// ẏ = 1, but the rates do not exist beyond this y.
    EndsAt(f64),
    /// ẏ = k y, with its slope.
    Grows(f64),
    /// ẏ = −k y, without its slope.
    Stiff(f64),
    /// The rates are NaN.
    NoNumber,
}

impl Ode for Trouble {
    type State = Y;
    type Error = &'static str;

    fn rates(&self, _: f64, y: &Y) -> Result<Y, &'static str> {
        Ok(vector([match self {
            Self::BlowsUp => y[0] * y[0],
            Self::EndsAt(end) if y[0] > *end => return Err("no rates here"),
            Self::EndsAt(_) => 1.0,
            Self::Grows(k) => k * y[0],
            Self::Stiff(k) => -k * y[0],
            Self::NoNumber => f64::NAN,
        }]))
    }

    fn jacobian(&self, _: f64, _: &Y) -> Option<Result<Jacobian<Y>, &'static str>> {
        match self {
            Self::Grows(k) => Some(Ok(Jacobian {
                state: vector([*k]),
                time: Y::zeros(),
            })),
            _ => None,
        }
    }
}

/// Checks the failure from y = 1 with steps of `h`, with step control if a tolerance is given, and that
/// the solver remains at the last good state.
fn fails<M: Integrator<Y>>(
    method: M,
    trouble: &Trouble,
    h: f64,
    tolerance: Option<f64>,
) -> Failure<Y, &'static str> {
    let mut solver = Solver::new(method, 0.0, vector([1.0]));
    if let Some(tolerance) = tolerance {
        solver = solver.with_tolerance(Tolerance {
            absolute: tolerance,
            relative: tolerance,
        });
    }
    for _ in 0..100_000 {
        if let Err(failure) = solver.advance(trouble, h) {
            assert_eq!((failure.t, failure.y), (solver.t(), *solver.y()));
            assert!(failure.y[0].is_finite());
            assert!(
                failure
                    .to_string()
                    .contains(&format!("t = {:?} s", failure.t))
            );
            return failure;
        }
    }
    panic!("it does not fail")
}

#[test]
fn rates_that_do_not_exist() {
    let failure = fails(Rk4, &Trouble::EndsAt(2.0), 0.3, None);
    assert_eq!(failure.reason, Reason::Singular("no rates here"));
    assert!((failure.t - 0.9).abs() < 1e-12 && (failure.y[0] - 1.9).abs() < 1e-12);
    assert!(failure.to_string().contains("no rates here"));
    // Controlled steps approach the end to the resolution of time.
    let failure = fails(Dop853, &Trouble::EndsAt(2.0), 0.3, Some(1e-8));
    assert_eq!(failure.reason, Reason::Singular("no rates here"));
    assert!((failure.t - 1.0).abs() < 1e-13, "{failure}");
    let failure = fails(Gauss2::new(), &Trouble::EndsAt(1.2), 0.5, None);
    assert_eq!(failure.reason, Reason::Singular("no rates here"));
}

#[test]
fn states_that_would_not_be_finite() {
    let failure = fails(Rk4, &Trouble::BlowsUp, 0.1, None);
    assert_eq!(failure.reason, Reason::NotFinite);
    assert!(failure.t >= 1.0, "fixed steps go past the pole: {failure}");
    let failure = fails(Rk4, &Trouble::NoNumber, 0.1, None);
    assert_eq!((failure.reason, failure.t), (Reason::NotFinite, 0.0));
    let failure = fails(Dopri5, &Trouble::NoNumber, 0.1, Some(1e-6));
    assert_eq!((failure.reason, failure.t), (Reason::NotFinite, 0.0));
    let failure = fails(Gauss2::new(), &Trouble::NoNumber, 0.1, None);
    assert_eq!((failure.reason, failure.t), (Reason::NotFinite, 0.0));
}

#[test]
fn steps_too_small_for_time() {
    for failure in [
        fails(Dopri5, &Trouble::BlowsUp, 10.0, Some(1e-10)),
        fails(Dop853, &Trouble::BlowsUp, 10.0, Some(1e-10)),
    ] {
        let Reason::StepTooSmall { h, error } = failure.reason else {
            panic!("{failure}")
        };
        assert!(h < 1e-14 && error > 0.0, "{failure}");
        assert!((failure.t - 1.0).abs() < 1e-9, "{failure}");
        assert!(failure.y[0] > 1e9, "it has followed the pole: {failure}");
    }
}

#[test]
fn iterations_that_do_not_converge() {
    // h k = 50: fixed-point iteration is no contraction.
    let failure = fails(Gauss2::new(), &Trouble::Stiff(500.0), 0.1, None);
    let diverges = matches!(
        failure.reason,
        Reason::NoConvergence { iterations, change } if iterations > 5 && change > 1e3
    );
    assert!(diverges && failure.t == 0.0, "{failure}");
    assert!(failure.to_string().contains("iterations"));
    // h k/2 = 0.99: it is a contraction, but too slow.
    let failure = fails(Midpoint::new(), &Trouble::Stiff(1.98), 1.0, None);
    assert!(
        matches!(
            failure.reason,
            Reason::NoConvergence {
                iterations: 100,
                ..
            }
        ),
        "{failure}"
    );
}

#[test]
fn matrices_that_are_singular() {
    // 1 − h k/2 = 0
    let failure = fails(Midpoint::new(), &Trouble::Grows(4.0), 0.5, None);
    assert_eq!((failure.reason, failure.t), (Reason::SingularMatrix, 0.0));
    // 1/(h γ) − k = 0
    let failure = fails(Rodas4, &Trouble::Grows(8.0), 0.5, None);
    assert_eq!((failure.reason, failure.t), (Reason::SingularMatrix, 0.0));
    let failure = fails(Rodas4, &Trouble::Stiff(8.0), 0.5, None);
    assert_eq!(failure.reason, Reason::NoJacobian);
    assert!(failure.to_string().contains("slopes"));
}
