//! Φ and Γ of linear equations by zero-order hold, against closed forms and against double-double.

use bgdyn_runtime::Dd;
use bgdyn_runtime::nalgebra::{Matrix2, Matrix3, SMatrix, SVector};
use bgdyn_sim::discretised;

/// The largest relative difference, by the size of the largest entry.
fn off<const N: usize, const M: usize>(
    got: &SMatrix<f64, N, M>,
    wanted: &SMatrix<f64, N, M>,
) -> f64 {
    (got - wanted).amax() / wanted.amax()
}

#[test]
fn a_mass_under_a_force_moves_by_its_polynomial() {
    let (phi, gamma) = discretised(
        &Matrix2::new(0.0, 1.0, 0.0, 0.0),
        &SVector::from([0.0, 0.5]),
        3.0,
    );
    assert_eq!(phi, Matrix2::new(1.0, 3.0, 0.0, 1.0));
    assert_eq!(gamma, SVector::from([2.25, 1.5]));
}

/// ẍ = −ω² x − 2 d ẋ + u over parts of a period and over several.
#[test]
fn an_oscillator_has_its_closed_form() {
    let (w2, d) = (40.0, 1.5);
    let a = Matrix2::new(0.0, 1.0, -w2, -2.0 * d);
    for h in [1e-4, 0.01, 0.3, 2.0] {
        let (phi, gamma) = discretised(&a, &SVector::from([0.0, 1.0]), h);
        let w = f64::sqrt(w2 - d * d);
        let (e, (s, c)) = ((-d * h).exp(), (w * h).sin_cos());
        let wanted = Matrix2::new(
            e * (c + d / w * s),
            e / w * s,
            -e * w2 / w * s,
            e * (c - d / w * s),
        );
        let moved = (1.0 - wanted[(0, 0)]) / w2;
        // The squarings of h/2ˢ lose some digits of a decayed matrix.
        assert!(off(&phi, &wanted) < 1e-13, "{h}: {phi}{wanted}");
        assert!(
            (gamma[0] - moved).abs() < 1e-13 * moved.abs().max(1e-16 / 1e-13),
            "{h}"
        );
        assert!(
            (gamma[1] - wanted[(0, 1)]).abs() < 1e-13 * gamma.amax(),
            "{h}"
        );
    }
}

/// Random matrices in f64 have the digits of double-double.
#[test]
fn roundings_are_those_of_the_scalar() {
    let mut random = bgdyn_runtime::random::Random(5);
    for _ in 0..200 {
        let a = SMatrix::<f64, 5, 5>::from_fn(|_, _| 3.0 * random.signed());
        let b = SMatrix::<f64, 5, 2>::from_fn(|_, _| random.signed());
        let h = 0.2 * random.unit();
        let (phi, gamma) = discretised(&a, &b, h);
        let (exact_phi, exact_gamma) =
            discretised(&a.map(Dd::from_f64), &b.map(Dd::from_f64), Dd::from_f64(h));
        assert!(off(&phi, &exact_phi.map(Dd::to_f64)) < 3e-15);
        assert!(off(&gamma, &exact_gamma.map(Dd::to_f64)) < 3e-15);
    }
}

/// exp is multiplicative: two halves are a whole, to all digits of double-double.
#[test]
fn two_halves_are_a_whole() {
    let a = Matrix3::new(0.1, 2.0, 0.3, -4.0, 0.5, 1.0, 0.7, -1.1, -6.0).map(Dd::from_f64);
    let b = SVector::from([1.0, -2.0, 0.5]).map(Dd::from_f64);
    let (half, pushed) = discretised(&a, &b, Dd::from_f64(0.4));
    let (whole, both) = discretised(&a, &b, Dd::from_f64(0.8));
    let small = |x: f64| x.abs() < 1e-28;
    for i in 0..3 {
        let sum = |j: usize| {
            let terms = (0..3).map(|k| half[(i, k)] * half[(k, j)]);
            terms.fold(Dd::ZERO, |sum, x| sum + x)
        };
        for j in 0..3 {
            assert!(small((sum(j) - whole[(i, j)]).to_f64()));
        }
        let twice = (0..3).fold(pushed[i], |sum, k| sum + half[(i, k)] * pushed[k]);
        assert!(small((twice - both[i]).to_f64()));
    }
}

#[test]
fn what_is_not_finite_stays_so() {
    let (phi, _) = discretised(
        &SMatrix::<f64, 1, 1>::new(f64::NAN),
        &SVector::from([1.0]),
        1.0,
    );
    assert!(phi[0].is_nan());
    let (phi, _) = discretised(
        &SMatrix::<f64, 1, 1>::new(f64::INFINITY),
        &SVector::from([1.0]),
        1.0,
    );
    assert!(!phi[0].is_finite());
}
