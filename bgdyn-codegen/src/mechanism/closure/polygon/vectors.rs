//! Vectors in the plane of a loop, as complex numbers.

use bgdyn_runtime::Dd;

/// A vector in the plane of a loop: components along two axes that are perpendicular to each other.
pub type PlaneVector = [Dd; 2];

pub(super) fn negated(v: PlaneVector) -> PlaneVector {
    v.map(|x| -x)
}

pub(super) fn plus([x, y]: PlaneVector, [u, v]: PlaneVector) -> PlaneVector {
    [x + u, y + v]
}

pub(super) fn length([x, y]: PlaneVector) -> Dd {
    (x * x + y * y).sqrt()
}

pub(super) fn conjugate([x, y]: PlaneVector) -> PlaneVector {
    [x, -y]
}

/// Returns the product of complex numbers.
pub(super) fn times([x, y]: PlaneVector, [u, v]: PlaneVector) -> PlaneVector {
    [x * u - y * v, x * v + y * u]
}

/// Returns the vector with components that are rounding errors of the other one set to zero.
pub fn snapped([x, y]: PlaneVector) -> PlaneVector {
    let (wide, high) = (x.to_f64().abs(), y.to_f64().abs());
    let unit = |x: Dd| {
        let one = if x < Dd::ZERO { -Dd::ONE } else { Dd::ONE };
        if (x - one).to_f64().abs() < 1e-28 {
            one
        } else {
            x
        }
    };
    match (wide < 1e-28 * high, high < 1e-28 * wide) {
        (true, _) => [Dd::ZERO, unit(y)],
        (_, true) => [unit(x), Dd::ZERO],
        _ => [x, y],
    }
}
