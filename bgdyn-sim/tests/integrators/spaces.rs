//! Checks that results do not depend on the vector type of the state; tests projections.

use bgdyn_runtime::vector;
use bgdyn_sim::{
    Dop853, INTEGRATORS, Integrator, Jacobian, Ode, Rk4, Solver, Tolerance, WithIntegrator,
    with_integrator,
};
use nalgebra::{DMatrix, DVector, SVector};

use crate::problems::{As, Known, distance, known, ode, slope};

/// [`Known`] in vectors of run-time size.
struct Dynamic<'a>(As<'a, Known, f64, 4>);

impl Ode for Dynamic<'_> {
    type State = DVector<f64>;
    type Error = ();

    fn rates(&self, t: f64, y: &DVector<f64>) -> Result<DVector<f64>, ()> {
        let rates = self.0.rates(t, &SVector::from_column_slice(y.as_slice()))?;
        Ok(DVector::from_column_slice(rates.as_slice()))
    }

    fn jacobian(&self, t: f64, y: &DVector<f64>) -> Option<Result<Jacobian<DVector<f64>>, ()>> {
        let found = self
            .0
            .jacobian(t, &SVector::from_column_slice(y.as_slice()))?;
        Some(found.map(|slopes| Jacobian {
            state: DMatrix::from_column_slice(4, 4, slopes.state.as_slice()),
            time: DVector::from_column_slice(slopes.time.as_slice()),
        }))
    }

    fn positions(&self) -> usize {
        self.0.positions()
    }
}

/// The last states of 40 steps, fixed or controlled.
struct Last<'a, O> {
    ode: &'a O,
    controlled: bool,
}

impl<O: Ode> WithIntegrator<O::State> for Last<'_, O>
where
    O::State: bgdyn_sim::StateVector<Scalar = f64> + FromKnown,
    O::Error: PartialEq,
{
    type Output = Vec<f64>;

    fn with<M: Integrator<O::State>>(self, method: M) -> Vec<f64> {
        let mut solver = Solver::new(method, 0.0, O::State::start());
        if self.controlled {
            solver = solver.with_tolerance(Tolerance {
                absolute: 1e-8,
                relative: 1e-8,
            });
        }
        for _ in 0..40 {
            assert!(solver.advance(self.ode, 0.03).is_ok());
        }
        bgdyn_sim::StateVector::entries(solver.y()).to_vec()
    }
}

trait FromKnown {
    fn start() -> Self;
}

impl FromKnown for SVector<f64, 4> {
    fn start() -> Self {
        known(0.0)
    }
}

impl FromKnown for DVector<f64> {
    fn start() -> Self {
        DVector::from_column_slice(known(0.0_f64).as_slice())
    }
}

#[test]
fn vectors_of_run_time_size_give_the_same_numbers() {
    let problem = Known { slopes: true };
    for (name, controlled) in INTEGRATORS
        .iter()
        .flat_map(|name| [(name, false), (name, true)])
    {
        let fixed = ode::<f64, _, 4>(&problem);
        let ode = &fixed;
        let one = with_integrator::<SVector<f64, 4>, _>(name, Last { ode, controlled });
        let dynamic = Dynamic(crate::problems::ode(&problem));
        let ode = &dynamic;
        let other = with_integrator::<DVector<f64>, _>(name, Last { ode, controlled });
        assert!(one.is_some() && one == other, "{name}: {one:?} {other:?}");
    }
}

/// A body that rotates at the rate (0, 0, 2 cos t), as a unit quaternion of four components.
struct Turning {
    projects: bool,
}

impl Ode for Turning {
    type State = SVector<f64, 4>;
    type Error = ();

    fn rates(&self, t: f64, y: &SVector<f64, 4>) -> Result<SVector<f64, 4>, ()> {
        let rate = t.cos();
        Ok(vector([
            -rate * y[3],
            rate * y[2],
            -rate * y[1],
            rate * y[0],
        ]))
    }

    fn project(&self, _: f64, y: &mut SVector<f64, 4>) -> Result<bool, ()> {
        if self.projects {
            *y /= y.norm_squared().sqrt();
        }
        Ok(self.projects)
    }
}

/// Returns its solution: half the angle sin t about z.
fn turned(t: f64) -> SVector<f64, 4> {
    let (sin, cos) = t.sin().sin_cos();
    vector([cos, 0.0, 0.0, sin])
}

#[test]
fn projection_keeps_order_and_length() {
    let after = |projects, n| {
        let mut solver = Solver::new(Rk4, 0.0, turned(0.0));
        for _ in 0..n {
            let h = 3.0 / f64::from(n);
            solver.advance(&Turning { projects }, h).expect("it turns");
        }
        (
            distance(solver.y(), &turned(3.0)),
            (solver.y().norm() - 1.0).abs(),
        )
    };
    let errors = [10, 20, 40, 80].map(|n| after(true, n).0);
    assert!(slope(&errors) >= 3.8, "{errors:?}");
    assert!(after(true, 10).1 < 4e-16);
    assert!(after(false, 10).1 > 1e-7, "without it the length drifts");
    // Controlled steps, with rates reused from step to step.
    let tolerance = Tolerance {
        absolute: 1e-12,
        relative: 1e-12,
    };
    let mut solver = Solver::new(Dop853, 0.0, turned(0.0)).with_tolerance(tolerance);
    solver
        .advance_to(&Turning { projects: true }, 3.0)
        .expect("it turns");
    assert!(distance(solver.y(), &turned(3.0)) < 1e-11);
}
