//! Bodies by ten free numbers: against sums over point masses, differences in double-double.

use bgdyn_runtime::inertia::pseudo_inertia;
use bgdyn_runtime::{Dd, LogCholesky};
use nalgebra::{Matrix3, Matrix4, SVector};

use crate::random::Random;

fn random_numbers(random: &mut Random) -> SVector<f64, 10> {
    // Masses of 0.02 kg to 50 kg, lengths of 5 cm to 1 m.
    SVector::from_fn(|k, _| match k {
        0 => 2.0 * random.signed(),
        1..4 => 1.5 * random.signed() - 1.5,
        _ => random.signed(),
    })
}

/// The parameters of point masses: mass, and place.
fn of_points(points: &[(f64, [f64; 3])]) -> SVector<f64, 10> {
    let mut sum = SVector::zeros();
    for &(m, [x, y, z]) in points {
        sum += m * SVector::from([
            1.0,
            x,
            y,
            z,
            y * y + z * z,
            -x * y,
            x * x + z * z,
            -x * z,
            -y * z,
            x * x + y * y,
        ]);
    }
    sum
}

fn is_finite(numbers: &LogCholesky<f64>) -> bool {
    numbers.0.iter().all(|x| x.is_finite())
}

#[test]
fn numbers_and_parameters_are_each_others_inverse() {
    let mut random = Random(7);
    for _ in 0..200 {
        let numbers = random_numbers(&mut random);
        let parameters = LogCholesky(numbers).to_parameters();
        let back = LogCholesky::from_parameters(&parameters).0;
        assert!((back - numbers).amax() < 1e-9, "{numbers} {back}");
        let exact = LogCholesky(numbers.map(Dd::from_f64)).to_parameters();
        let back = LogCholesky::from_parameters(&exact).0;
        assert!((back.map(|x| x.to_f64()) - numbers).amax() < 1e-15);
    }
}

#[test]
fn points_have_the_parameters_of_their_numbers() {
    let mut random = Random(11);
    for _ in 0..100 {
        let point = |_| {
            let place = [(); 3].map(|()| random.signed());
            (0.1 + random.unit(), place)
        };
        let points: Vec<_> = (0..6).map(point).collect();
        let parameters = of_points(&points);
        let numbers = LogCholesky::from_parameters(&parameters);
        let back = numbers.to_parameters();
        assert!((back - parameters).amax() < 1e-13 * parameters.amax());
        assert!((numbers.0[0].exp().powi(2) - parameters[0]).abs() < 1e-14 * parameters[0]);
    }
}

#[test]
fn every_body_can_exist() {
    let mut random = Random(13);
    for _ in 0..200 {
        let p = LogCholesky(random_numbers(&mut random)).to_parameters();
        let tensor = Matrix3::new(p[4], p[5], p[7], p[5], p[6], p[8], p[7], p[8], p[9]);
        let mut sigma = Matrix4::zeros();
        let moments = pseudo_inertia(&tensor);
        sigma.fixed_view_mut::<3, 3>(0, 0).copy_from(&moments);
        for k in 0..3 {
            (sigma[(k, 3)], sigma[(3, k)]) = (p[k + 1], p[k + 1]);
        }
        sigma[(3, 3)] = p[0];
        assert!(sigma.cholesky().is_some(), "{p}");
    }
}

#[test]
fn the_jacobian_is_the_derivative() {
    let mut random = Random(17);
    let (step, twice) = (Dd::from_f64(1e-9), Dd::from_f64(2e-9));
    for _ in 0..20 {
        let numbers = random_numbers(&mut random).map(Dd::from_f64);
        let jacobian = LogCholesky(numbers).jacobian();
        let size = jacobian
            .iter()
            .fold(0.0, |m: f64, x| m.max(x.to_f64().abs()));
        for k in 0..10 {
            let moved = |step: Dd| {
                let mut there = numbers;
                there[k] += step;
                LogCholesky(there).to_parameters()
            };
            let (after, before) = (moved(step), moved(-step));
            for i in 0..10 {
                let slope = (after[i] - before[i]) / twice;
                let error = (slope - jacobian[(i, k)]).to_f64().abs();
                assert!(error < 1e-15 * size, "{i} {k}: {error:e}");
            }
        }
        assert!(jacobian.map(|x| x.to_f64()).determinant().abs() > 0.0);
    }
}

#[test]
fn bodies_without_a_volume_have_no_numbers() {
    let flat = [
        [0.1, 0.0, 0.0],
        [0.0, 0.2, 0.0],
        [-0.3, 0.1, 0.0],
        [0.0, -0.1, 0.0],
    ];
    let flat = flat.map(|place| (1.0, place));
    assert!(!is_finite(&LogCholesky::from_parameters(&of_points(&flat))));
    assert!(!is_finite(&LogCholesky::from_parameters(&SVector::zeros())));
    let mut heavy = flat.to_vec();
    heavy.push((0.5, [0.0, 0.0, 0.4]));
    assert!(is_finite(&LogCholesky::from_parameters(&of_points(&heavy))));
    // A tensor that breaks the triangle inequality.
    let mut broken = of_points(&heavy);
    broken[4] += 3.0;
    assert!(!is_finite(&LogCholesky::from_parameters(&broken)));
}

#[test]
fn single_precision_agrees() {
    let mut random = Random(19);
    for _ in 0..50 {
        let numbers = random_numbers(&mut random);
        let wide = LogCholesky(numbers).to_parameters();
        let single = LogCholesky(numbers.map(|x| x as f32)).to_parameters();
        let error = single.map(f64::from) - wide;
        assert!(error.amax() < 1e-5 * wide.amax());
    }
}
