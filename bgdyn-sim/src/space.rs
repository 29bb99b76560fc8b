//! The vector operations on states that integrators need.

use core::fmt::Debug;

use bgdyn_runtime::{Dd, Scalar};
use nalgebra::{SMatrix, SVector};

/// A scalar that is one number: what step control and iterations need to compare.
pub trait Real: Scalar<Mask = bool> + PartialOrd {
    /// A bound on the relative rounding error of one operation.
    const EPSILON: Self;

    /// The nearest `f64`.
    fn to_f64(self) -> f64;

    /// Whether it is neither infinite nor NaN.
    fn is_finite(self) -> bool;
}

impl Real for f64 {
    const EPSILON: Self = f64::EPSILON;

    fn to_f64(self) -> f64 {
        self
    }

    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}

impl Real for f32 {
    const EPSILON: Self = f32::EPSILON;

    fn to_f64(self) -> f64 {
        self.into()
    }

    fn is_finite(self) -> bool {
        f32::is_finite(self)
    }
}

impl Real for Dd {
    const EPSILON: Self = Dd::EPSILON;

    fn to_f64(self) -> f64 {
        Dd::to_f64(self)
    }

    fn is_finite(self) -> bool {
        Dd::is_finite(self)
    }
}

/// A vector space of states, of a size known when compiling ([`SVector`]) or, with the feature
/// `std`, when running (`DVector`).
pub trait Space: Clone + Debug {
    /// What its components are.
    type Scalar: Scalar;
    /// A square matrix on it.
    type Matrix: Clone + Debug;
    /// One row number per component.
    type Pivots: Clone + Debug + AsRef<[usize]> + AsMut<[usize]>;

    /// The components.
    fn entries(&self) -> &[Self::Scalar];
    /// The components, to be changed.
    fn entries_mut(&mut self) -> &mut [Self::Scalar];
    /// Zero, of the same size.
    fn zero(&self) -> Self;
    /// The zero matrix.
    fn matrix(&self) -> Self::Matrix;
    /// The row numbers 0, 0, …
    fn pivots(&self) -> Self::Pivots;
    /// A matrix's entries, column by column.
    fn columns(matrix: &Self::Matrix) -> &[Self::Scalar];
    /// A matrix's entries, column by column, to be changed.
    fn columns_mut(matrix: &mut Self::Matrix) -> &mut [Self::Scalar];

    /// Adds k·x.
    fn add(&mut self, k: Self::Scalar, x: &Self) {
        for (y, &x) in self.entries_mut().iter_mut().zip(x.entries()) {
            *y = *y + k * x;
        }
    }

    /// self + k·x
    fn plus(&self, k: Self::Scalar, x: &Self) -> Self {
        let mut sum = self.clone();
        sum.add(k, x);
        sum
    }

    /// k·self
    fn times(&self, k: Self::Scalar) -> Self {
        let mut product = self.clone();
        for x in product.entries_mut() {
            *x = k * *x;
        }
        product
    }

    /// matrix · self
    fn mapped(&self, matrix: &Self::Matrix) -> Self {
        let mut image = self.zero();
        let n = self.entries().len().max(1);
        for (column, &x) in Self::columns(matrix).chunks(n).zip(self.entries()) {
            for (y, &m) in image.entries_mut().iter_mut().zip(column) {
                *y = *y + m * x;
            }
        }
        image
    }
}

/// The components of the vectors of `Y`.
pub type Of<Y> = <Y as Space>::Scalar;

/// The largest of |x|ᵢ/sᵢ; a component whose scale is 0 counts only if it is not 0 itself. NaN
/// where a component is.
pub(crate) fn largest<Y: Space>(x: &Y, scale: &Y) -> Of<Y>
where
    Of<Y>: Real,
{
    let zero = Of::<Y>::from_f64(0.0);
    let ratios = x.entries().iter().zip(scale.entries());
    ratios.fold(zero, |most, (&x, &s)| {
        if x == zero {
            most
        } else {
            most.max(x.abs() / s)
        }
    })
}

/// Whether every component is finite.
pub(crate) fn finite<Y: Space>(x: &Y) -> bool
where
    Of<Y>: Real,
{
    x.entries().iter().all(|x| x.is_finite())
}

impl<T: Scalar, const N: usize> Space for SVector<T, N> {
    type Scalar = T;
    type Matrix = SMatrix<T, N, N>;
    type Pivots = [usize; N];

    fn entries(&self) -> &[T] {
        self.as_slice()
    }

    fn entries_mut(&mut self) -> &mut [T] {
        self.as_mut_slice()
    }

    fn zero(&self) -> Self {
        SVector::repeat(T::from_f64(0.0))
    }

    fn matrix(&self) -> Self::Matrix {
        SMatrix::repeat(T::from_f64(0.0))
    }

    fn pivots(&self) -> [usize; N] {
        [0; N]
    }

    fn columns(matrix: &Self::Matrix) -> &[T] {
        matrix.as_slice()
    }

    fn columns_mut(matrix: &mut Self::Matrix) -> &mut [T] {
        matrix.as_mut_slice()
    }
}

#[cfg(feature = "std")]
mod dynamic {
    use std::vec;
    use std::vec::Vec;

    use bgdyn_runtime::Scalar;
    use nalgebra::{DMatrix, DVector};

    use super::Space;

    impl<T: Scalar> Space for DVector<T> {
        type Scalar = T;
        type Matrix = DMatrix<T>;
        type Pivots = Vec<usize>;

        fn entries(&self) -> &[T] {
            self.as_slice()
        }

        fn entries_mut(&mut self) -> &mut [T] {
            self.as_mut_slice()
        }

        fn zero(&self) -> Self {
            DVector::repeat(self.len(), T::from_f64(0.0))
        }

        fn matrix(&self) -> DMatrix<T> {
            DMatrix::repeat(self.len(), self.len(), T::from_f64(0.0))
        }

        fn pivots(&self) -> Vec<usize> {
            vec![0; self.len()]
        }

        fn columns(matrix: &DMatrix<T>) -> &[T] {
            matrix.as_slice()
        }

        fn columns_mut(matrix: &mut DMatrix<T>) -> &mut [T] {
            matrix.as_mut_slice()
        }
    }
}
