//! Tests stiff equations: a settled fast part must neither be resolved nor grow.

use bgdyn_runtime::vector;
use bgdyn_sim::{
    Dop853, Dopri5, Extrapolation12, FiniteDifferences, Gauss2, Gauss3, Integrator, Jacobian,
    Midpoint, Reason, Rk4, Rodas4, Solver, Start, Tolerance,
};
use nalgebra::SVector;

use crate::problems::{Driven, Equation, distance, fixed, ode, slope};

type Y = SVector<f64, 1>;

/// Returns y after one step of y' = z y from 1, with h = 1.
fn stability<M: Integrator<Y>>(method: &M, z: f64) -> f64 {
    struct Decay(f64);
    impl Equation<f64, 1> for Decay {
        fn rates(&self, _: f64, y: &Y) -> Y {
            y * self.0
        }

        fn jacobian(&self, _: f64, y: &Y) -> Option<Jacobian<Y>> {
            Some(Jacobian {
                state: vector([self.0]),
                time: y * 0.0,
            })
        }
    }
    let y = vector([1.0]);
    let start = Start {
        t: 0.0,
        y: &y,
        before: None,
    };
    let step = method.step(&ode::<f64, _, 1>(&Decay(z)), &start, 1.0);
    let Ok(step) = step else {
        panic!("no step for {z}")
    };
    1.0 + step.change[0]
}

#[test]
fn rodas4_damps_whatever_is_fast_and_gauss_at_least_does_not_amplify() {
    // R(∞) = 0, and |R| < 1 on the whole negative axis.
    for e in [6, 9, 12] {
        let z = -(10.0_f64.powi(e));
        let left = stability(&Rodas4, z);
        assert!(left.abs() < 20.0 / -z + 1e-11, "R({z:e}) = {left}");
    }
    for i in 1..400 {
        let z = -0.05 * f64::from(i);
        assert!(stability(&Rodas4, z).abs() < 1.0, "R({z})");
        for grown in [
            stability(&Midpoint::<f64>::new(), z),
            stability(&Gauss2::<f64>::new(), z),
            stability(&Gauss3::<f64>::new(), z),
        ] {
            assert!(grown.abs() < 1.0, "Gauss at {z}: {grown}");
        }
    }
    let far = -1e6;
    assert!((stability(&Midpoint::<f64>::new(), far) + 1.0).abs() < 1e-5);
    assert!((stability(&Gauss2::<f64>::new(), far) - 1.0).abs() < 1e-4);
    assert!((stability(&Gauss3::<f64>::new(), far) + 1.0).abs() < 1e-4);
    // An explicit integrator is unstable.
    assert!(stability(&Rk4, -10.0) > 100.0);
}

/// y' = −1e6 (y − cos t) from 0, with steps 10,000 times longer than its time constant.
#[test]
fn rodas4_follows_a_stiff_equation_with_long_steps() {
    let problem = Driven { k: 1e6 };
    let errors = [25, 50, 100, 200].map(|n| {
        let found = fixed(Rodas4, &ode::<f64, _, 1>(&problem), vector([0.0]), 1.0, n);
        (found[0] - problem.settled(1.0)).abs()
    });
    assert!(errors[2] < 1e-9, "{errors:?}");
    // From the settled state, at steps whose error is not only rounding.
    let errors = [2, 4, 8].map(|n| {
        let start = vector([problem.settled(0.0)]);
        let found = fixed(Rodas4, &ode::<f64, _, 1>(&problem), start, 2.0, n);
        (found[0] - problem.settled(2.0)).abs()
    });
    println!("rodas4, k = 1e6: {errors:?}");
    assert!(errors[2] < 1e-9 || slope(&errors) > 2.8, "{errors:?}");
    let gauss = fixed(
        Gauss2::new(),
        &ode::<f64, _, 1>(&problem),
        vector([problem.settled(0.0)]),
        1.0,
        100,
    );
    assert!((gauss[0] - problem.settled(1.0)).abs() < 1e-5, "{gauss}");
}

/// If the fast time constant is close to the step, the order is that of the smooth case.
#[test]
fn rodas4_keeps_its_order_at_moderate_stiffness() {
    let problem = Driven { k: 300.0 };
    let errors = [10, 20, 40, 80].map(|n| {
        let start = vector([problem.settled(0.0)]);
        let found = fixed(Rodas4, &ode::<f64, _, 1>(&problem), start, 2.0, n);
        (found[0] - problem.settled(2.0)).abs()
    });
    println!("rodas4, k = 300: {errors:?}");
    assert!(slope(&errors) > 2.8, "{errors:?}");
}

/// Robertson's reactions: rates from 0.04 to 3e7.
struct Robertson;

impl Equation<f64, 3> for Robertson {
    fn rates(&self, _: f64, y: &SVector<f64, 3>) -> SVector<f64, 3> {
        let slow = 0.04 * y[0] - 1e4 * y[1] * y[2];
        let fast = 3e7 * y[1] * y[1];
        vector([-slow, slow - fast, fast])
    }

    fn jacobian(&self, _: f64, y: &SVector<f64, 3>) -> Option<Jacobian<SVector<f64, 3>>> {
        let fast = 6e7 * y[1];
        let state = bgdyn_runtime::matrix([
            [-0.04, 0.04, 0.0],
            [1e4 * y[2], -1e4 * y[2] - fast, fast],
            [1e4 * y[1], -1e4 * y[1], 0.0],
        ]);
        Some(Jacobian {
            state,
            time: SVector::zeros(),
        })
    }
}

/// The stiff integrator needs some hundred steps, explicit ones ten thousands, and they agree.
#[test]
fn controlled_steps_on_robertsons_reactions() {
    fn run<M: Integrator<SVector<f64, 3>>>(method: M, tolerance: f64) -> (SVector<f64, 3>, usize) {
        let solver = Solver::new(method, 0.0, vector([1.0, 0.0, 0.0]));
        let mut solver = solver.with_tolerance(Tolerance {
            absolute: 1e-4 * tolerance,
            relative: tolerance,
        });
        let mut steps = 0;
        while solver.t() < 4.0 {
            let left = 4.0 - solver.t();
            solver
                .advance(&ode::<f64, _, 3>(&Robertson), left)
                .expect("it goes on");
            steps += 1;
        }
        (*solver.y(), steps)
    }
    let (reference, explicit) = run(Dop853, 1e-11);
    let (found, stiff) = run(Rodas4, 1e-7);
    println!("explicit {explicit} steps, rodas4 {stiff}, {reference:?}");
    let relative = found.component_div(&reference) - SVector::repeat(1.0);
    assert!(relative.abs().max() < 1e-6, "{relative}");
    assert!(explicit > 20 * stiff, "{explicit} and {stiff}");
    let (pair, _) = run(Dopri5, 1e-8);
    assert!(distance(&pair, &reference) < 1e-7);
    let (extrapolated, _) = run(Extrapolation12::default(), 1e-10);
    assert!(distance(&extrapolated, &reference) < 1e-9);
}

/// For a Rosenbrock method finite-difference slopes are as good as exact ones.
#[test]
fn slopes_from_differences() {
    let plain = ode::<f64, _, 3>(&Robertson);
    let start = vector([1.0, 0.0, 0.0]);
    let own = fixed(Rodas4, &plain, start, 0.1, 400);
    let taken = fixed(Rodas4, &FiniteDifferences(plain), start, 0.1, 400);
    assert!(distance(&own, &taken) < 1e-8, "{own} {taken}");
    assert!(own != taken, "the slopes are not the same numbers");
    // Without slopes the integrator refuses.
    struct Plain;
    impl Equation<f64, 1> for Plain {
        fn rates(&self, _: f64, y: &Y) -> Y {
            -y
        }
    }
    let mut solver = Solver::new(Rodas4, 0.0, vector([1.0]));
    let refused = solver
        .advance(&ode::<f64, _, 1>(&Plain), 0.1)
        .expect_err("no slopes");
    assert_eq!(refused.reason, Reason::NoJacobian);
}

/// Masses of 1 and 2 kg, 100 N/m from the first to a wall and 1e8 N/m between them: position, stretch and
/// their rates.
struct TwoMasses;

impl Equation<f64, 4> for TwoMasses {
    fn rates(&self, _: f64, y: &SVector<f64, 4>) -> SVector<f64, 4> {
        let (soft, stiff) = (-100.0 * y[0], 1e8 * y[1]);
        vector([y[2], y[3], soft + stiff, -soft - 1.5 * stiff])
    }

    fn jacobian(&self, t: f64, y: &SVector<f64, 4>) -> Option<Jacobian<SVector<f64, 4>>> {
        let column = |i| {
            let mut unit = y * 0.0;
            unit[i] = 1.0;
            self.rates(t, &unit)
        };
        let state = nalgebra::SMatrix::from_columns(&[column(0), column(1), column(2), column(3)]);
        let time = y * 0.0;
        Some(Jacobian { state, time })
    }
}

/// If rows are exchanged more than once in the factors, the integrator still solves its equations: the
/// masses oscillate at 1.2e4 rad/s with steps of some milliseconds, and the common oscillation has order
/// 4.
#[test]
fn rodas4_keeps_its_order_beside_a_stiff_spring() {
    let start = vector([0.1, 1e-5, 0.0, 0.0]);
    // Squares of the two angular frequencies, by their sum and product. In the slow mode the displacements
    // of the masses are 1 and `second`; the slow component of a motion is M-orthogonal to the fast mode.
    let (sum, product) = (1.5e8_f64 + 100.0, 0.5e10);
    let square = 2.0 * product / (sum + (sum * sum - 4.0 * product).sqrt());
    let second = 1.0 + (100.0 - square) / 1e8;
    let part = |place: f64, stretch: f64| {
        (place + 2.0 * second * (place + stretch)) / (1.0 + 2.0 * second * second)
    };
    let wanted = part(start[0], start[1]) * square.sqrt().cos();
    let errors = [50, 100, 200].map(|n| {
        let y = fixed(Rodas4, &ode::<f64, _, 4>(&TwoMasses), start, 1.0, n);
        (part(y[0], y[1]) - wanted).abs()
    });
    assert!(errors[0] < 1e-6, "{errors:?}");
    assert!(slope(&errors) > 3.8, "{errors:?}");
}
