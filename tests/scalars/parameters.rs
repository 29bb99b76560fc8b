//! Tests run-time parameters in lanes, dual numbers and double-double.

use bgdyn::Scalar;
use bgdyn::nalgebra::SVector;
use bgdyn::runtime::Dd;
use bgdyn::runtime::num_dual::Dual64;
use bgdyn::runtime::wide::f64x4;
use bgdyn_codegen::random::Random;

use crate::models::lifter::Lifter;
use crate::models::{State, results, vector, widen};

fn state(random: &mut Random) -> State<f64, 2> {
    [3.0, 2.0, 5.0].map(|size| vector(random, size))
}

/// Each lane has a different payload.
#[test]
fn lanes_carry_different_payloads() {
    let mut random = Random(3);
    let (masses, sags) = ([0.0, 0.7, 1.1, 5.0], [0.0, 0.1, -0.03, 0.02]);
    let together = Lifter::<f64x4> {
        payload: f64x4::new(masses),
        sag: f64x4::new(sags),
        ..Lifter::default()
    };
    for _ in 0..20 {
        let state = state(&mut random);
        let [q, v, tau] = &widen::<f64x4, 2>(&state);
        let found = results(&together, &[*q, *v, *tau]);
        let solved = together.forward_dynamics(q, v, tau).expect("M is regular");
        for k in 0..4 {
            let alone = Lifter {
                payload: masses[k],
                sag: sags[k],
                ..Lifter::default()
            };
            for ((name, found), (_, wanted)) in found.iter().zip(results(&alone, &state)) {
                let lane: Vec<f64> = found.iter().map(|x| x.to_array()[k]).collect();
                assert_eq!(lane, wanted, "{name}");
            }
            let [q, v, tau] = &state;
            let wanted = alone.forward_dynamics(q, v, tau).expect("M is regular");
            assert_eq!(solved.map(|x| x.to_array()[k]), wanted);
        }
    }
}

/// The sensitivity to a parameter: efforts are linear in the mass, so that their derivative is a
/// difference with any step; and quadratic in the centre of mass, so that central differences are exact.
#[test]
fn dual_numbers_give_the_derivative_by_a_parameter() {
    let mut random = Random(4);
    for _ in 0..20 {
        let state = state(&mut random);
        let [q, v, a] = &widen::<Dual64, 2>(&state);
        let slope = |model: Lifter<Dual64>| model.inverse_dynamics(q, v, a).map(|x| x.eps);
        let effort = |payload: f64, sag: f64| {
            let [q, v, a] = &state;
            Lifter {
                payload,
                sag,
                ..Lifter::default()
            }
            .inverse_dynamics(q, v, a)
        };
        let near = |x: SVector<f64, 2>, y: SVector<f64, 2>| {
            assert!((x - y).amax() < 1e-12 * y.amax().max(1.0), "{x} and {y}");
        };
        let by_mass = Lifter {
            payload: Dual64::new(1.1, 1.0),
            ..Lifter::default()
        };
        near(slope(by_mass), effort(2.0, -0.03) - effort(1.0, -0.03));
        let by_sag = Lifter {
            sag: Dual64::new(-0.03, 1.0),
            ..Lifter::default()
        };
        near(
            slope(by_sag),
            (effort(1.1, 0.97) - effort(1.1, -1.03)) / 2.0,
        );
    }
}

#[test]
fn double_double_extends_double_precision() {
    let mut random = Random(5);
    let (narrow, wide) = (Lifter::<f64>::default(), Lifter::<Dd>::default());
    assert_eq!(
        wide.payload,
        Dd::from_f64(1.1),
        "the default is the scalar's, from f64"
    );
    for _ in 0..20 {
        let state = state(&mut random);
        let found = results(&narrow, &state);
        let wanted = results(&wide, &widen(&state));
        for ((name, found), (_, wanted)) in found.iter().zip(wanted) {
            let size = wanted.iter().fold(1.0, |m: f64, x| m.max(x.to_f64().abs()));
            for (x, y) in found.iter().zip(wanted) {
                let off = (<Dd as Scalar>::from_f64(*x) - y).to_f64().abs();
                assert!(off < 1e-14 * size, "{name}: off by {off:e}");
            }
        }
    }
}
