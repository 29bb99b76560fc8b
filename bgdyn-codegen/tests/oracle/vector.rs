//! Vectors and matrices of three in double-double.

use bgdyn_runtime::Dd;

pub type V3 = [Dd; 3];
/// Rows.
pub type M3 = [V3; 3];

pub const ZERO: V3 = [Dd::ZERO; 3];

pub fn dd(x: f64) -> Dd {
    Dd::from_f64(x)
}

pub fn v3(f: impl FnMut(usize) -> Dd) -> V3 {
    std::array::from_fn(f)
}

pub fn m3(f: impl Fn(usize, usize) -> Dd) -> M3 {
    std::array::from_fn(|i| std::array::from_fn(|j| f(i, j)))
}

pub fn identity() -> M3 {
    m3(|i, j| if i == j { Dd::ONE } else { Dd::ZERO })
}

pub fn add(a: V3, b: V3) -> V3 {
    v3(|i| a[i] + b[i])
}

pub fn sub(a: V3, b: V3) -> V3 {
    v3(|i| a[i] - b[i])
}

pub fn scale(a: V3, k: Dd) -> V3 {
    v3(|i| a[i] * k)
}

pub fn dot(a: V3, b: V3) -> Dd {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn norm(a: V3) -> Dd {
    dot(a, a).sqrt()
}

pub fn cross(a: V3, b: V3) -> V3 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub fn apply(m: M3, v: V3) -> V3 {
    v3(|i| dot(m[i], v))
}

pub fn times(a: M3, b: M3) -> M3 {
    m3(|i, j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j])
}

pub fn transposed(a: M3) -> M3 {
    m3(|i, j| a[j][i])
}

/// A turn by `angle` about the unit vector n: each axis of the body is moved on its own,
/// x cos + (n × x) sin + n (n·x) (1 − cos).
pub fn turn(n: V3, angle: Dd) -> M3 {
    let (sin, cos) = angle.sin_cos();
    let moved = |k: usize| {
        let x = identity()[k];
        let across = scale(cross(n, x), sin);
        let along = scale(n, dot(n, x) * (Dd::ONE - cos));
        add(add(scale(x, cos), across), along)
    };
    transposed([moved(0), moved(1), moved(2)])
}

/// Roll, pitch, yaw about the fixed axes x, y, z in this order.
pub fn rpy([roll, pitch, yaw]: V3) -> M3 {
    let [x, y, z] = identity();
    times(turn(z, yaw), times(turn(y, pitch), turn(x, roll)))
}
