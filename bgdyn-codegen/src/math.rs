//! 3-vectors and 3×3 matrices over any ring: double-doubles, expressions, patterns of zeros.
//!
//! It contains only the operations that the equations need.

use std::ops::{Add, Mul, Neg, Sub};

use bgdyn_runtime::Dd;

/// The entries of vectors and matrices.
pub trait Ring:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
}
impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T> + Neg<Output = T>> Ring for T {}

/// A column of three components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vec3<T>(pub [T; 3]);

/// A 3×3 matrix, row by row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mat3<T>(pub [[T; 3]; 3]);

impl<T: Copy> Vec3<T> {
    /// Applies `f` to each component.
    pub fn map<U: Copy>(self, f: impl FnMut(T) -> U) -> Vec3<U> {
        Vec3(self.0.map(f))
    }
}

impl<T: Ring> Vec3<T> {
    /// Returns self · b.
    pub fn dot(self, b: Self) -> T {
        let ([x, y, z], [u, v, w]) = (self.0, b.0);
        x * u + y * v + z * w
    }

    /// Returns self × b.
    pub fn cross(self, b: Self) -> Self {
        let ([x, y, z], [u, v, w]) = (self.0, b.0);
        Vec3([y * w - z * v, z * u - x * w, x * v - y * u])
    }

    /// Returns self times the scalar `k`.
    pub fn scale(self, k: T) -> Self {
        self.map(|x| x * k)
    }
}

impl<T: Ring> Add for Vec3<T> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Vec3(std::array::from_fn(|i| self.0[i] + b.0[i]))
    }
}

impl<T: Ring> Sub for Vec3<T> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Vec3(std::array::from_fn(|i| self.0[i] - b.0[i]))
    }
}

impl<T: Ring> Neg for Vec3<T> {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

impl<T: Copy> Mat3<T> {
    /// Returns the matrix with the entries `f(i, j)`.
    pub fn from_fn(mut f: impl FnMut(usize, usize) -> T) -> Self {
        Mat3(std::array::from_fn(|i| std::array::from_fn(|j| f(i, j))))
    }

    /// Applies `f` to each entry.
    pub fn map<U: Copy>(self, mut f: impl FnMut(T) -> U) -> Mat3<U> {
        Mat3::from_fn(|i, j| f(self.0[i][j]))
    }

    /// Returns the transposed matrix.
    pub fn transpose(self) -> Self {
        Self::from_fn(|i, j| self.0[j][i])
    }

    /// Returns column `j`.
    pub fn column(self, j: usize) -> Vec3<T> {
        Vec3([self.0[0][j], self.0[1][j], self.0[2][j]])
    }

    /// Returns row `i`.
    pub fn row(self, i: usize) -> Vec3<T> {
        Vec3(self.0[i])
    }
}

impl<T: Ring> Mul<Vec3<T>> for Mat3<T> {
    type Output = Vec3<T>;
    fn mul(self, v: Vec3<T>) -> Vec3<T> {
        Vec3(std::array::from_fn(|i| self.row(i).dot(v)))
    }
}

impl<T: Ring> Mul for Mat3<T> {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self::from_fn(|i, j| self.row(i).dot(b.column(j)))
    }
}

impl<T: Ring> Add for Mat3<T> {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self::from_fn(|i, j| self.0[i][j] + b.0[i][j])
    }
}

impl<T: Ring> Sub for Mat3<T> {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self::from_fn(|i, j| self.0[i][j] - b.0[i][j])
    }
}

/// Returns `[v]×`, the matrix of the cross product with v.
pub fn skew<T: Ring>(v: Vec3<T>, zero: T) -> Mat3<T> {
    let [x, y, z] = v.0;
    Mat3([[zero, -z, y], [z, zero, -x], [-y, x, zero]])
}

/// Returns the rotation by an angle about the unit vector n, by Rodrigues' formula:
/// `n nᵀ + cos (1 − n nᵀ) + sin [n]×`. `constant` converts a number to an entry.
pub fn rodrigues<T: Ring + Mul<Dd, Output = T>>(
    axis: Vec3<Dd>,
    (cos, sin): (T, T),
    constant: impl Fn(Dd) -> T,
) -> Mat3<T> {
    let n = axis.0;
    Mat3::from_fn(|i, j| {
        let along = n[i] * n[j];
        let across = if i == j { Dd::ONE - along } else { -along };
        let cross = match (3 + j - i) % 3 {
            0 => Dd::ZERO,
            1 => -n[3 - i - j],
            _ => n[3 - i - j],
        };
        constant(along) + cos * across + sin * cross
    })
}

/// Returns the angle with this cosine and sine, to double-double accuracy.
pub fn angle_of((cos, sin): (Dd, Dd)) -> Dd {
    // Not the platform's function: the last digit of the sum follows it, and generated code is equal everywhere.
    let near = Dd::from_f64(libm::atan2(sin.to_f64(), cos.to_f64()));
    let (s, c) = near.sin_cos();
    // sin(φ − near), so small that it is the angle.
    let rest = sin * c - cos * s;
    near + rest
}
