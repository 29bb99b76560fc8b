//! Transforms inertia tensors to another point and to other axes.
//!
//! Masses in kg, lengths in m, inertias in kg·m². A tensor's off-diagonal entries are *minus* the products
//! of inertia (Kuzmin 2007, eq. 1), as in URDF. Tensors are symmetric; every result is exactly symmetric.

use nalgebra::{Matrix3, Vector3};

use crate::Scalar;

/// Returns the symmetric matrix with the given entries on and above the diagonal.
fn symmetric<T: Scalar>(entry: impl Fn(usize, usize) -> T) -> Matrix3<T> {
    let (xx, xy, xz) = (entry(0, 0), entry(0, 1), entry(0, 2));
    let (yy, yz, zz) = (entry(1, 1), entry(1, 2), entry(2, 2));
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

fn trace<T: Scalar>(m: &Matrix3<T>) -> T {
    m[(0, 0)] + m[(1, 1)] + m[(2, 2)]
}

/// Returns `factor · 1 − m`.
fn scalar_minus<T: Scalar>(factor: T, m: &Matrix3<T>) -> Matrix3<T> {
    symmetric(|i, j| {
        if i == j {
            factor - m[(i, i)]
        } else {
            -m[(i, j)]
        }
    })
}

/// Returns the inertia of the point mass `mass` (kg) at `offset` (m), about the origin of `offset` and in
/// its axes: m·(d·d 1 − d dᵀ), Steiner's term.
pub fn parallel_axis<T: Scalar>(mass: T, offset: &Vector3<T>) -> Matrix3<T> {
    let [x, y, z] = (*offset).into();
    let (mx, my, mz) = (mass * x, mass * y, mass * z);
    let (xx, yy, zz) = (mx * x, my * y, mz * z);
    let (xy, xz, yz) = (-(mx * y), -(mx * z), -(my * z));
    Matrix3::new(yy + zz, xy, xz, xy, xx + zz, yz, xz, yz, xx + yy)
}

/// Returns the inertia of a body about the origin of a frame, in the axes of the frame.
///
/// `inertia_com` is the inertia (kg·m²) about the centre of mass, in the same axes; `mass` in kg; `com`
/// the centre of mass in the frame, m.
pub fn about_origin<T: Scalar>(inertia_com: &Matrix3<T>, mass: T, com: &Vector3<T>) -> Matrix3<T> {
    let steiner = parallel_axis(mass, com);
    symmetric(|i, j| inertia_com[(i, j)] + steiner[(i, j)])
}

/// Returns R·J·Rᵀ: the inertia `inertia`, given in the axes of a child frame, in the axes of the parent,
/// where `x_parent = rotation · x_child`. The point and the units do not change.
pub fn rotate<T: Scalar>(inertia: &Matrix3<T>, rotation: &Matrix3<T>) -> Matrix3<T> {
    let (m, r) = (inertia, rotation);
    let rm = Matrix3::from_fn(|i, j| {
        r[(i, 0)] * m[(0, j)] + r[(i, 1)] * m[(1, j)] + r[(i, 2)] * m[(2, j)]
    });
    symmetric(|i, j| rm[(i, 0)] * r[(j, 0)] + rm[(i, 1)] * r[(j, 1)] + rm[(i, 2)] * r[(j, 2)])
}

/// Returns the second moments of mass of a body of the inertia J, ∫ r rᵀ dm = ½ tr(J) 1 − J, in kg·m²,
/// about the same point and in the same axes: the 3×3 block of the pseudo-inertia matrix. They are
/// positive semidefinite for a body of nonnegative mass density.
pub fn pseudo_inertia<T: Scalar>(inertia: &Matrix3<T>) -> Matrix3<T> {
    scalar_minus(T::from_f64(0.5) * trace(inertia), inertia)
}

/// Returns the inertia of a body of the second moments of mass D, tr(D) 1 − D, in kg·m². It is the inverse
/// of [`pseudo_inertia`].
pub fn from_pseudo_inertia<T: Scalar>(moments: &Matrix3<T>) -> Matrix3<T> {
    scalar_minus(trace(moments), moments)
}
