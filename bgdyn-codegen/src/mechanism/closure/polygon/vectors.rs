//! Vectors in the plane of a loop, as complex numbers.

use bgdyn_runtime::Dd;

use super::{PolygonSide, TurnedVector};

/// A vector in the plane of a loop: components along two axes that are perpendicular to each other.
pub type PlaneVector = [Dd; 2];

impl TurnedVector {
    pub(super) fn negated(&self) -> Self {
        TurnedVector {
            angle: self.angle.clone(),
            vector: negated(self.vector),
        }
    }

    /// Returns the vector at a position of the open tree.
    pub(super) fn at(&self, q: &[Dd]) -> PlaneVector {
        let sum = self.angle.iter().fold(Dd::ZERO, |sum, term| {
            let q = q[term.joint.position.0];
            if term.opposite { sum - q } else { sum + q }
        });
        let (sin, cos) = sum.sin_cos();
        times(self.vector, [cos, sin])
    }
}

/// Returns the sides with those of one angle added up; sides of length zero are left out.
pub(super) fn merged(sides: &[PolygonSide]) -> Vec<PolygonSide> {
    let mut all: Vec<PolygonSide> = Vec::new();
    for side in sides {
        let same = |one: &&mut PolygonSide| {
            one.turned.angle == side.turned.angle && one.slide.is_none() && side.slide.is_none()
        };
        match all.iter_mut().find(same) {
            Some(one) => one.turned.vector = plus(one.turned.vector, side.turned.vector),
            None => all.push(side.clone()),
        }
    }
    all.retain(|side| length(side.turned.vector).to_f64() > 1e-24);
    all
}

pub(super) fn opposite(sides: &[PolygonSide]) -> Vec<PolygonSide> {
    let turned = sides.iter().map(|side| PolygonSide {
        turned: side.turned.negated(),
        slide: side.slide,
    });
    turned.collect()
}

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
