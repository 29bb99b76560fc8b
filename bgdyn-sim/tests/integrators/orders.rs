//! Checks that every integrator of the list has its stated order: of its steps, its estimate, its dense
//! output.

use bgdyn_runtime::Dd;
use bgdyn_sim::{
    Dop853, Dopri5, Extrapolation, Gauss, INTEGRATORS, Integrator, Real, Rk4, Rodas4, Start,
    with_integrator,
};

use crate::order::{Errors, Y, known_run};
use crate::problems::{Known, dd, distance, fixed, known, ode, slope};

/// Bar: the order fitted over three halvings is less than the stated one by at most 0.2.
#[test]
fn every_method_has_its_order() {
    for name in INTEGRATORS {
        for slopes in [true, false] {
            if *name == "rodas4" && !slopes {
                continue;
            }
            let found = with_integrator(name, Errors { slopes });
            let (info, errors) = found.expect("a name of the list");
            assert_eq!(info.name, *name);
            let slope = slope(&errors);
            println!("{name}, slopes {slopes}: order {slope:.3}, errors {errors:?}");
            let stated = f64::from(info.order);
            assert!(slope >= stated - 0.2, "{name}: {slope} of {errors:?}");
            assert!(errors[3] > 1e-26, "{name} ends in rounding: {errors:?}");
        }
    }
}

/// More stages and rows than in the list.
#[test]
fn families_have_their_orders() {
    fn order<M: Integrator<Y> + Clone>(method: &M) -> f64 {
        let errors = [4, 8, 16, 32].map(|n| {
            let problem = Known { slopes: true };
            distance(
                &known_run(method, &ode::<Dd, _, 4>(&problem), n),
                &known(dd(2.0)),
            )
        });
        slope(&errors)
    }
    for (found, stated) in [
        (order(&Gauss::<Dd, 5>::new()), 10.0),
        (order(&Gauss::<Dd, 6>::new()), 12.0),
        (order(&Extrapolation::<4>), 8.0),
        (order(&Extrapolation::<8>), 16.0),
    ] {
        assert!(found >= stated - 0.2, "{found}, not {stated}");
    }
}

/// Returns, for one step from t = 0.3, its estimated error and the largest error of its dense output.
fn local<M: Integrator<Y>>(method: &M, h: Dd) -> (Option<f64>, f64) {
    let problem = Known { slopes: true };
    let ode = ode::<Dd, _, 4>(&problem);
    let t = dd(0.3);
    let y = known(t);
    let start = Start {
        t,
        y: &y,
        before: None,
    };
    let Ok(step) = method.step(&ode, &start, h) else {
        panic!("a step fails")
    };
    let estimate = method.error(&step, &Y::repeat(dd(1.0)));
    let Ok(dense) = method.dense(&ode, &start, &step) else {
        panic!("no dense output")
    };
    assert!(
        distance(&dense.at(dd(0.0)), &y) == 0.0,
        "it begins where the step does"
    );
    assert!(
        distance(&dense.at(dd(1.0)), &(y + step.change)) < 1e-30,
        "and ends there"
    );
    let thetas = (1..20).map(|i| dd(f64::from(i) / 20.0));
    let errors = thetas.map(|theta| distance(&dense.at(theta), &known(t + theta * h)));
    (estimate.map(Real::to_f64), errors.fold(0.0, f64::max))
}

#[test]
fn estimates_and_dense_outputs_fall_with_their_powers() {
    fn check<M: Integrator<Y>>(method: &M, dense_order: f64) {
        let hs = [0.1, 0.05, 0.025, 0.0125];
        let found = hs.map(|h| local(method, dd(h)));
        let info = method.info();
        let dense = slope(&found.map(|f| f.1));
        // The error within a step is proportional to the step to the power of the order plus one.
        assert!(dense >= dense_order + 0.8, "{}: dense {dense}", info.name);
        assert!(dense <= dense_order + 1.7, "{}: dense {dense}", info.name);
        let Some(stated) = info.estimate else { return };
        let estimate = slope(&found.map(|f| f.0.expect("it has an estimate")));
        let off = (estimate - f64::from(stated)).abs();
        assert!(
            off < 0.6,
            "{}: estimate {estimate}, not {stated}",
            info.name
        );
    }
    check(&Rk4, 3.0);
    check(&Gauss::<Dd, 3>::new(), 3.0);
    check(&Rodas4, 3.0);
    check(&Dopri5, 4.0);
    check(&Dop853, 7.0);
    check(&Extrapolation::<4>, 3.0);
}

/// In `f64` and `f32` the integrators are the same, within rounding.
#[test]
fn orders_hold_in_single_and_double_precision() {
    let problem = Known { slopes: false };
    let single = ode::<f32, _, 4>(&problem);
    let errors = [5, 10, 20].map(|n| {
        let found = fixed(Rk4, &single, known(0.0_f32), 2.0, n);
        distance(&found, &known(2.0_f32))
    });
    assert!(slope(&errors) >= 3.8, "{errors:?}");
    let double = ode::<f64, _, 4>(&problem);
    let errors = [6, 12, 24].map(|n| {
        let found = fixed(Gauss::<f64, 3>::new(), &double, known(0.0), 2.0, n);
        distance(&found, &known(2.0))
    });
    assert!(slope(&errors) >= 5.8, "{errors:?}");
}

#[test]
fn names_that_are_not_listed_are_none() {
    let none = with_integrator::<Y, _>("rk5", Errors { slopes: true });
    assert!(none.is_none());
    assert_eq!(INTEGRATORS.len(), 11);
}
