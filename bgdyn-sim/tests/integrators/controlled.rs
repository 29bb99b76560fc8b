//! Tests step control: errors are proportional to the tolerance, in `f64` and in double-double.

use bgdyn_runtime::Dd;
use bgdyn_sim::{Dop853, Dopri5, Extrapolation12, Integrator, Real, Rodas4, Solver, Tolerance};
use nalgebra::SVector;

use crate::problems::{Known, distance, known, ode};

/// Error at t = 3 and the number of steps.
fn run<T: Real, M: Integrator<SVector<T, 4>>>(method: M, tolerance: f64) -> (f64, u32) {
    let problem = Known { slopes: true };
    let both = T::from_f64(tolerance);
    let mut solver = Solver::new(method, T::from_f64(0.0), known(T::from_f64(0.0)));
    solver = solver.with_tolerance(Tolerance {
        absolute: both,
        relative: both,
    });
    assert!(solver.is_controlled());
    let end = T::from_f64(3.0);
    let mut steps = 0;
    while solver.t() < end {
        let left = end - solver.t();
        solver
            .advance(&ode::<T, _, 4>(&problem), left)
            .expect("it goes on");
        steps += 1;
    }
    (distance(solver.y(), &known(end)), steps)
}

#[test]
fn errors_and_steps_follow_the_tolerance() {
    fn check<M: Integrator<SVector<f64, 4>>>(method: impl Fn() -> M, tolerances: [f64; 3]) {
        let mut last = (f64::INFINITY, 0);
        for tolerance in tolerances {
            let (error, steps) = run(method(), tolerance);
            let name = method().info().name;
            println!("{name} {tolerance:e}: error {error:.1e}, {steps} steps");
            assert!(
                error < 30.0 * tolerance,
                "{name}: {error:e} at {tolerance:e}"
            );
            assert!(error > 1e-4 * tolerance, "{name} wastes steps: {error:e}");
            assert!(error < last.0 && steps > last.1, "{name}");
            last = (error, steps);
        }
    }
    check(|| Dopri5, [1e-4, 1e-6, 1e-8]);
    check(|| Dop853, [1e-6, 1e-8, 1e-11]);
    check(|| Rodas4, [1e-3, 1e-5, 1e-7]);
    check(Extrapolation12::default, [1e-5, 1e-8, 1e-11]);
}

/// References: two integrators of different kinds agree with the solution to 28 digits.
#[test]
fn references_in_double_double() {
    let (error, steps) = run::<Dd, _>(Dop853, 1e-26);
    println!("dop853: {error:.1e}, {steps} steps");
    assert!(error < 1e-25, "{error:e}");
    let (error, steps) = run::<Dd, _>(Extrapolation12::default(), 1e-28);
    println!("extrapolation12: {error:.1e}, {steps} steps");
    assert!(error < 1e-27, "{error:e}");
    let (error, steps) = run::<Dd, _>(Dopri5, 1e-15);
    println!("dopri5: {error:.1e}, {steps} steps");
    assert!(error < 1e-14, "{error:e}");
}

/// Dense output over controlled steps is as accurate as the steps, at any time.
#[test]
fn dense_output_over_a_run() {
    let problem = Known { slopes: false };
    let ode = ode::<f64, _, 4>(&problem);
    let mut solver = Solver::new(Dop853, 0.0, known(0.0)).with_tolerance(Tolerance {
        absolute: 1e-10,
        relative: 1e-10,
    });
    let (mut next, mut worst, mut samples) = (0.0, 0.0_f64, 0);
    while solver.t() < 3.0 {
        let dense = solver
            .advance_densely(&ode, 3.0 - solver.t())
            .expect("it goes on");
        while next <= dense.start() + dense.length() {
            worst = worst.max(distance(&dense.at_time(next), &known(next)));
            samples += 1;
            next += 0.01;
        }
    }
    assert!(samples >= 300, "{samples}");
    assert!(worst < 1e-9, "{worst:e}");
}

/// A first step is found for any time scale, and steps are refused if necessary.
#[test]
fn scales_of_time() {
    use crate::problems::Equation;
    use bgdyn_runtime::vector;
    struct Scaled(f64);
    impl Equation<f64, 2> for Scaled {
        fn rates(&self, _: f64, y: &SVector<f64, 2>) -> SVector<f64, 2> {
            vector([self.0 * y[1], -self.0 * y[0]])
        }
    }
    let steps = [1e-6, 1.0, 1e9].map(|rate| {
        let mut solver = Solver::new(Dopri5, 0.0, vector([1.0, 0.0]));
        solver = solver.with_tolerance(Tolerance {
            absolute: 1e-8,
            relative: 1e-8,
        });
        let mut steps = 0;
        while solver.t() < 20.0 / rate {
            let left = 20.0 / rate - solver.t();
            solver
                .advance(&ode::<f64, _, 2>(&Scaled(rate)), left)
                .expect("it goes on");
            steps += 1;
        }
        let (sin, cos) = 20.0_f64.sin_cos();
        let off = distance(solver.y(), &vector([cos, -sin]));
        assert!(off < 1e-6, "{off:e} at {rate:e}");
        steps
    });
    let (least, most) = (steps.iter().min(), steps.iter().max());
    assert!(
        most.zip(least).is_some_and(|(m, l)| m - l < 20),
        "{steps:?}"
    );
}
