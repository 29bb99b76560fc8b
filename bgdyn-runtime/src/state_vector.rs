//! Vectors of scalars that scenes and integrators share, of a size known at compile time or at run time.

use core::fmt::Debug;

use nalgebra::{SMatrix, SVector};

use crate::Scalar;

/// A vector of states for integrators, of a size known at compile time ([`SVector`]) or, with the feature
/// `alloc`, at run time (`DVector`).
pub trait StateVector: Clone + Debug + PartialEq {
    /// The type of the components.
    type Scalar: Scalar;
    /// A square matrix that maps such vectors to such vectors.
    type Matrix: Clone + Debug;
    /// One value of any type per component.
    type Array<X: Copy + Debug + 'static>: Clone + Debug + AsRef<[X]> + AsMut<[X]> + 'static;

    /// Returns the components.
    fn entries(&self) -> &[Self::Scalar];
    /// Returns the components, mutable.
    fn entries_mut(&mut self) -> &mut [Self::Scalar];
    /// Returns a zero vector of the same size.
    fn zero(&self) -> Self;
    /// Returns the zero matrix.
    fn matrix(&self) -> Self::Matrix;
    /// Returns an array with the same value for every component.
    fn array<X: Copy + Debug + 'static>(&self, value: X) -> Self::Array<X>;
    /// Returns a matrix's entries, column by column.
    fn columns(matrix: &Self::Matrix) -> &[Self::Scalar];
    /// Returns a matrix's entries, column by column, mutable.
    fn columns_mut(matrix: &mut Self::Matrix) -> &mut [Self::Scalar];

    /// Adds k·x.
    fn add(&mut self, k: Self::Scalar, x: &Self) {
        for (y, &x) in self.entries_mut().iter_mut().zip(x.entries()) {
            *y = *y + k * x;
        }
    }

    /// Returns self + k·x.
    fn plus(&self, k: Self::Scalar, x: &Self) -> Self {
        let mut sum = self.clone();
        sum.add(k, x);
        sum
    }

    /// Returns k·self.
    fn times(&self, k: Self::Scalar) -> Self {
        let mut product = self.clone();
        for x in product.entries_mut() {
            *x = k * *x;
        }
        product
    }

    /// Returns matrix · self.
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

/// One value of the type `X` per component of the vectors `V`.
pub type ArrayOf<V, X> = <V as StateVector>::Array<X>;
/// The square matrices that map vectors `V` to vectors `V`.
pub type MatrixOf<V> = <V as StateVector>::Matrix;

/// A vector of a size known at compile time: a scene's state, its modes, inputs, events, outputs.
pub trait FixedVector: StateVector + Copy {
    /// The number of components.
    const LEN: usize;

    /// Returns the vector with the components `entry(index)`.
    fn from_entries(entry: impl FnMut(usize) -> Self::Scalar) -> Self;

    /// Returns the zero vector.
    fn zero_vector() -> Self {
        Self::from_entries(|_| Self::Scalar::from_f64(0.0))
    }
}

impl<T: Scalar, const N: usize> StateVector for SVector<T, N> {
    type Scalar = T;
    type Matrix = SMatrix<T, N, N>;
    type Array<X: Copy + Debug + 'static> = [X; N];

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

    fn array<X: Copy + Debug + 'static>(&self, value: X) -> [X; N] {
        [value; N]
    }

    fn columns(matrix: &Self::Matrix) -> &[T] {
        matrix.as_slice()
    }

    fn columns_mut(matrix: &mut Self::Matrix) -> &mut [T] {
        matrix.as_mut_slice()
    }
}

impl<T: Scalar, const N: usize> FixedVector for SVector<T, N> {
    const LEN: usize = N;

    fn from_entries(mut entry: impl FnMut(usize) -> T) -> Self {
        SVector::from_fn(|i, _| entry(i))
    }
}

#[cfg(feature = "alloc")]
mod dynamic {
    extern crate alloc;

    use alloc::vec;
    use alloc::vec::Vec;
    use core::fmt::Debug;

    use nalgebra::{DMatrix, DVector};

    use super::StateVector;
    use crate::Scalar;

    impl<T: Scalar> StateVector for DVector<T> {
        type Scalar = T;
        type Matrix = DMatrix<T>;
        type Array<X: Copy + Debug + 'static> = Vec<X>;

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

        fn array<X: Copy + Debug + 'static>(&self, value: X) -> Vec<X> {
            vec![value; self.len()]
        }

        fn columns(matrix: &DMatrix<T>) -> &[T] {
            matrix.as_slice()
        }

        fn columns_mut(matrix: &mut DMatrix<T>) -> &mut [T] {
            matrix.as_mut_slice()
        }
    }
}
