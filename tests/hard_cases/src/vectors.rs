//! Vectors and quaternions in double-double.

use bgdyn_runtime::Dd;
use bgdyn_runtime::manifold::{rotation, spherical};

use crate::reference::larger;

/// Three components.
pub(crate) type Vector = [Dd; 3];

/// a × b
pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    let entry = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [entry(1, 2), entry(2, 0), entry(0, 1)]
}

/// a · b
pub(crate) fn dot(a: Vector, b: Vector) -> Dd {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a + b
pub(crate) fn sum(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] + b[i])
}

/// k a
pub(crate) fn scaled(k: Dd, a: Vector) -> Vector {
    a.map(|x| k * x)
}

/// Returns the length of a vector.
pub(crate) fn length(a: Vector) -> f64 {
    dot(a, a).to_f64().sqrt()
}

/// Returns the largest component of a − b; NaN if one is NaN.
pub(crate) fn apart(a: Vector, b: Vector) -> f64 {
    let off = [0, 1, 2].map(|i| (a[i] - b[i]).to_f64().abs());
    off.into_iter().fold(0.0, larger)
}

/// Returns three components of a state.
pub(crate) fn part(y: &[f64], from: usize) -> Vector {
    [0, 1, 2].map(|i| Dd::from_f64(y[from + i]))
}

/// Returns a vector in the axes of the world, by the quaternion x, y, z, w at an index of a state, which is
/// divided by its length.
pub(crate) fn turned(y: &[f64], quaternion: usize, a: Vector) -> Vector {
    let q = [0, 1, 2, 3].map(|i| Dd::from_f64(y[quaternion + i]));
    let r = rotation(spherical::normalize(q));
    [0, 1, 2].map(|i| r[(i, 0)] * a[0] + r[(i, 1)] * a[1] + r[(i, 2)] * a[2])
}

/// Returns |q|² − 1 of the quaternion at an index of a state.
pub(crate) fn excess(y: &[f64], quaternion: usize) -> f64 {
    let square = |i: usize| Dd::from_f64(y[quaternion + i]) * Dd::from_f64(y[quaternion + i]);
    (square(0) + square(1) + square(2) + square(3) - Dd::ONE).to_f64()
}
