//! Tests dual numbers: values equal those of the scalar, derivatives equal differences in double-double.

use bgdyn_runtime::nalgebra::{SVector, Vector2};
use bgdyn_runtime::num_dual::{Dual, Dual2, Dual32, Dual64, DualSVec64, HyperDual, HyperDual64};
use bgdyn_runtime::{Argument, Cause, Dd, Scalar};

/// Smooth functions of two variables, positive ones, each with every operation of the trait once.
fn functions<T: Scalar>(x: T, y: T) -> [T; 14] {
    let number = T::from_f64;
    let (s, c) = T::sin_cos_sum(&[x, y, x], (0.3, 1e-17));
    [
        x * y + x / y - -y,
        x.mul_add(y, x),
        (x * y).sqrt(),
        x.sin_cos().0 * y,
        (x * y).sin_cos().1,
        s,
        c,
        (x * number(0.5) - y).exp(),
        (x + y).ln(),
        (x - y).tanh(),
        (x - y * number(10.0)).abs() * x,
        (x * x).min(y * number(100.0)),
        (x * x).max(y * number(100.0)),
        T::select((x * number(0.01)).less(y), x * y, y) * (number(-1.0) * y).sign(),
    ]
}

const POINTS: [(f64, f64); 4] = [(0.7, 1.9), (2.3, 0.4), (0.1, 0.2), (4.0, 3.0)];

fn near(what: &str, k: usize, found: f64, wanted: f64, relative: f64) {
    let error = (found - wanted).abs();
    assert!(
        error <= relative * wanted.abs().max(1.0),
        "{what} of function {k}: {found:e} instead of {wanted:e}"
    );
}

/// ∂x, ∂y, ∂x², ∂x∂y of every function, by central differences.
fn differences(x: f64, y: f64) -> [[f64; 4]; 14] {
    let h = 1e-7;
    let at = |i: f64, j: f64| {
        functions(
            Dd::from_f64(x) + Dd::from_f64(i * h),
            Dd::from_f64(y) + Dd::from_f64(j * h),
        )
    };
    let (right, left, up, down, here) = (
        at(1.0, 0.0),
        at(-1.0, 0.0),
        at(0.0, 1.0),
        at(0.0, -1.0),
        at(0.0, 0.0),
    );
    let (ne, se, nw, sw) = (at(1.0, 1.0), at(1.0, -1.0), at(-1.0, 1.0), at(-1.0, -1.0));
    let (twice, square) = (Dd::from_f64(2.0 * h), Dd::from_f64(h) * Dd::from_f64(h));
    std::array::from_fn(|k| {
        [
            (right[k] - left[k]) / twice,
            (up[k] - down[k]) / twice,
            (right[k] + left[k] - here[k] - here[k]) / square,
            (ne[k] - se[k] - nw[k] + sw[k]) / (square * Dd::from_f64(4.0)),
        ]
        .map(Dd::to_f64)
    })
}

#[test]
fn first_and_second_derivatives() {
    for (x, y) in POINTS {
        let reference = differences(x, y);
        let along_x = functions(Dual::new(x, 1.0), Dual::from_re(y));
        let along_y = functions(Dual::from_re(x), Dual::new(y, 1.0));
        let second = functions(Dual2::new(x, 1.0, 0.0), Dual2::from_re(y));
        let mixed = functions(
            HyperDual::from_re(x).derivative1(),
            HyperDual::from_re(y).derivative2(),
        );
        let nested = functions(
            Dual::new(Dual64::new(x, 1.0), Dual64::from_re(0.0)),
            Dual::new(Dual64::from_re(y), Dual64::from_re(1.0)),
        );
        let gradient = functions(
            DualSVec64::<2>::from_re(x).derivative(0),
            DualSVec64::<2>::from_re(y).derivative(1),
        );
        for k in 0..14 {
            let [dx, dy, dxx, dxy] = reference[k];
            near("∂x", k, along_x[k].eps, dx, 1e-12);
            near("∂y", k, along_y[k].eps, dy, 1e-12);
            near("∂x", k, second[k].v1, dx, 1e-12);
            near("∂x²", k, second[k].v2, dxx, 1e-10);
            near("∂x", k, mixed[k].eps1, dx, 1e-12);
            near("∂y", k, mixed[k].eps2, dy, 1e-12);
            near("∂x∂y", k, mixed[k].eps1eps2, dxy, 1e-10);
            near("∂x", k, nested[k].re.eps, dx, 1e-12);
            near("∂y", k, nested[k].eps.re, dy, 1e-12);
            near("∂x∂y", k, nested[k].eps.eps, dxy, 1e-10);
            let gradient = gradient[k].eps.0.unwrap_or_default();
            near("∂x", k, gradient[0], dx, 1e-12);
            near("∂y", k, gradient[1], dy, 1e-12);
        }
    }
}

#[test]
fn real_parts_are_those_of_the_floats() {
    for (x, y) in POINTS {
        let wanted = functions(x, y);
        let (fx, fy) = (x as f32, y as f32);
        let wanted_single = functions(fx, fy);
        let dual = functions(Dual64::new(x, 1.0), Dual64::from_re(y));
        let dual2 = functions(Dual2::new(x, 1.0, 0.0), Dual2::from_re(y));
        let hyper = functions(
            HyperDual64::from_re(x).derivative1(),
            HyperDual64::from_re(y),
        );
        let vector = functions(
            DualSVec64::<2>::from_re(x).derivative(0),
            DualSVec64::<2>::from_re(y),
        );
        let single = functions(Dual32::new(fx, 1.0), Dual32::from_re(fy));
        // The first function divides.
        for k in 1..14 {
            for found in [dual[k].re, dual2[k].re, hyper[k].re, vector[k].re] {
                assert_eq!(found.to_bits(), wanted[k].to_bits(), "function {k}");
            }
            assert_eq!(single[k].re.to_bits(), wanted_single[k].to_bits());
        }
        near("value", 0, dual[0].re, wanted[0], 4.0 * f64::EPSILON);
    }
}

#[test]
fn large_angles_keep_their_small_ones() {
    let angle = |x: f64| Dual64::new(x, 1.0);
    let (s, c) = Scalar::sin_cos(angle(1e12));
    assert_eq!((s.re, c.re), Scalar::sin_cos(1e12));
    let (s, c) = Dual64::sin_cos_sum(&[angle(1e12), angle(1e-9), angle(-1e12)], (0.0, 0.0));
    assert_eq!((s.re, s.eps), (1e-9, 3.0));
    assert_eq!((c.re, c.eps), (1.0, -3.0 * 1e-9));
}

#[test]
fn comparisons_are_decided_by_the_real_part() {
    let (small, large) = (Dual64::new(1.0, 9.0), Dual64::new(2.0, -9.0));
    assert!(small.less(large) && !large.less(small));
    let parts = |x: Dual64| (x.re, x.eps);
    assert_eq!(parts(Scalar::min(small, large)), (1.0, 9.0));
    assert_eq!(parts(Scalar::max(small, large)), (2.0, -9.0));
    assert_eq!(parts(Scalar::abs(Dual64::new(-2.0, 3.0))), (2.0, -3.0));
    assert_eq!(parts(Scalar::abs(Dual64::new(0.0, 3.0))), (0.0, 0.0));
    assert_eq!(parts(Scalar::sign(Dual64::new(-2.0, 3.0))), (-1.0, 0.0));
    let nan = Dual64::from_re(f64::NAN);
    for x in [
        Scalar::min(nan, small),
        Scalar::min(small, nan),
        Scalar::max(nan, small),
        Scalar::max(small, nan),
        Scalar::sign(nan),
    ] {
        assert!(x.re.is_nan());
    }
    assert!(!nan.less(small) && !small.less(nan));
}

#[test]
fn hyperbolic_tangent_and_exponential_stay_finite_where_they_are() {
    let x = Scalar::tanh(Dual64::new(1000.0, 1.0));
    assert_eq!((x.re, x.eps), (1.0, 0.0));
    let x = Scalar::exp(Dual64::new(-1000.0, 1.0));
    assert_eq!((x.re, x.eps), (0.0, 0.0));
}

#[test]
fn pivots_are_decided_by_the_real_part() {
    let one = Dual64::from_re(1.0);
    let mut refused = Dual64::none_refused();
    let fine = Dual64::new(0.5, -7.0).checked_pivot(one, 0, &mut refused);
    assert_eq!((fine.re, fine.eps, refused), (0.5, -7.0, None));
    for bad in [0.0, -1.0, 1e-17, f64::NAN, f64::INFINITY] {
        let mut refused = Dual64::none_refused();
        let x = Dual64::new(bad, 5.0).checked_pivot(one, 1, &mut refused);
        let _ = one.checked_pivot(Dual64::from_re(f64::NAN), 0, &mut refused);
        assert_eq!(
            (x.re.to_bits(), x.eps, refused),
            (bad.to_bits(), 5.0, Some(1)),
            "{bad}"
        );
        let zeros: SVector<Dual64, 2> = Vector2::new(one, one);
        let wild = Dual64::new(bad, 1.0);
        static NAMES: [&str; 2] = ["shoulder", "elbow"];
        let error = Dual64::finish(zeros, refused, &NAMES, |look| {
            look(Argument::Tau, &NAMES, &[one, wild])
        });
        let error = error.unwrap_err();
        assert_eq!((error.joint(), error.name()), (1, "elbow"));
        let named = matches!(
            error.cause(),
            Cause::Argument {
                argument: Argument::Tau,
                index: 1,
                ..
            }
        );
        assert_eq!(named, !bad.is_finite());
    }
}
