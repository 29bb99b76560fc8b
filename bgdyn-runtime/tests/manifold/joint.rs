//! The three joints by one interface, numbers of three precisions, and the largest error of a test.

use bgdyn_runtime::manifold::{floating, planar, spherical};
use bgdyn_runtime::{Dd, Scalar};

use crate::random::Random;

/// Length of the longest arrays.
pub(crate) const MOST: usize = 7;

/// The three joints by one interface. Vectors are slices.
#[cfg_attr(not(all(feature = "wide", feature = "num-dual")), allow(dead_code))]
pub(crate) trait Joint {
    const NQ: usize;
    const NV: usize;
    /// Index of the first angular velocity.
    const TURN: usize;
    fn position_rates<T: Scalar>(q: &[T], v: &[T]) -> Vec<T>;
    fn integrate<T: Scalar>(q: &[T], d: &[T]) -> Vec<T>;
    fn difference<T: Scalar>(q1: &[T], q0: &[T]) -> Vec<T>;
    fn normalize<T: Scalar>(q: &[T]) -> Vec<T>;
    fn neutral<T: Scalar>() -> Vec<T>;
    fn sample<T: Scalar>(u: &[T]) -> Vec<T>;
}

pub(crate) struct Spherical;
pub(crate) struct Floating;
pub(crate) struct Planar;

macro_rules! joint {
    ($($joint:ident, $module:ident, $nq:literal, $nv:literal, $turn:literal;)*) => {$(
        impl Joint for $joint {
            const NQ: usize = $nq;
            const NV: usize = $nv;
            const TURN: usize = $turn;
            fn position_rates<T: Scalar>(q: &[T], v: &[T]) -> Vec<T> {
                $module::position_rates::<T>(array(q), array(v)).to_vec()
            }
            fn integrate<T: Scalar>(q: &[T], d: &[T]) -> Vec<T> {
                $module::integrate::<T>(array(q), array(d)).to_vec()
            }
            fn difference<T: Scalar>(q1: &[T], q0: &[T]) -> Vec<T> {
                $module::difference::<T>(array(q1), array(q0)).to_vec()
            }
            fn normalize<T: Scalar>(q: &[T]) -> Vec<T> {
                $module::normalize::<T>(array(q)).to_vec()
            }
            fn neutral<T: Scalar>() -> Vec<T> {
                $module::neutral::<T>().to_vec()
            }
            fn sample<T: Scalar>(u: &[T]) -> Vec<T> {
                $module::sample::<T>(array(u)).to_vec()
            }
        }
    )*};
}

joint! {
    Spherical, spherical, 4, 3, 0;
    Floating, floating, 7, 6, 3;
    Planar, planar, 3, 3, 2;
}

pub(crate) fn array<T: Scalar, const N: usize>(x: &[T]) -> [T; N] {
    x.try_into().unwrap()
}

/// A scalar with a name for its precision.
pub(crate) trait Word: Scalar<Mask = bool> {
    const EPSILON: f64;
    fn get(self) -> f64;
    /// A number in [0, 1) with noise in all its digits.
    fn unit(random: &mut Random) -> Self;

    fn signed(random: &mut Random) -> Self {
        let u = Self::unit(random);
        u + u - Self::from_f64(1.0)
    }
}

impl Word for f64 {
    const EPSILON: f64 = f64::EPSILON;
    fn get(self) -> f64 {
        self
    }
    fn unit(random: &mut Random) -> f64 {
        random.unit()
    }
}

impl Word for f32 {
    const EPSILON: f64 = f32::EPSILON as f64;
    fn get(self) -> f64 {
        f64::from(self)
    }
    fn unit(random: &mut Random) -> f32 {
        (random.unit() as f32).min(0.999_999_9)
    }
}

impl Word for Dd {
    const EPSILON: f64 = f64::EPSILON * f64::EPSILON;
    fn get(self) -> f64 {
        self.to_f64()
    }
    fn unit(random: &mut Random) -> Dd {
        let hi = random.unit() * 0.999;
        Dd::new(hi, hi * random.signed() * 1e-17)
    }
}

pub(crate) fn draw<T: Word>(random: &mut Random, count: usize) -> Vec<T> {
    (0..count).map(|_| T::unit(random)).collect()
}

/// Displacements with a turn by `angle` and a linear part of about a metre.
pub(crate) fn displacement<J: Joint, T: Word>(random: &mut Random, angle: f64) -> Vec<T> {
    let mut d: Vec<T> = (0..J::NV).map(|_| T::signed(random)).collect();
    let turn = &mut d[J::TURN..];
    let square = turn.iter().fold(T::from_f64(0.0), |sum, &x| sum + x * x);
    let scale = T::from_f64(angle) / square.sqrt();
    turn.iter_mut().for_each(|x| *x = *x * scale);
    d
}

pub(crate) fn wide<T: Word>(x: &[T]) -> Vec<Dd> {
    x.iter().map(|x| Dd::from_f64(x.get())).collect()
}

/// The largest distance of two vectors.
pub(crate) fn distance<T: Word>(a: &[T], b: &[T]) -> f64 {
    assert_eq!(a.len(), b.len());
    let each = a.iter().zip(b).map(|(&a, &b)| (a - b).get().abs());
    each.fold(0.0, |most, x| {
        assert!(x.is_finite(), "{a:?} {b:?}");
        f64::max(most, x)
    })
}

/// The largest error of a measure over many cases; printed with `--nocapture`.
pub(crate) struct Most(pub(crate) &'static str, pub(crate) f64);

impl Most {
    pub(crate) fn see(&mut self, error: f64, limit: f64, of: impl std::fmt::Debug) {
        self.1 = f64::max(self.1, error);
        assert!(error <= limit, "{}: {error:e} of {of:?}", self.0);
    }
}

impl Drop for Most {
    fn drop(&mut self) {
        println!("{}: {:e}", self.0, self.1);
    }
}
