//! A force with a moment.

use nalgebra::Vector3;

use crate::Scalar;

/// A force on a body and its moment about a point, in the same axes; the method that returns it says which.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<T> {
    /// The force, N.
    pub force: Vector3<T>,
    /// The moment about the point, N·m.
    pub moment: Vector3<T>,
}

impl<T: Scalar> Wrench<T> {
    /// Returns the same load about another point, which is displaced by `to` from the present one, m: M − to × F.
    pub fn about(&self, to: &Vector3<T>) -> Self {
        let ([[x, y, z]], [[a, b, c]]) = (to.data.0, self.force.data.0);
        let turned = Vector3::new(y * c - z * b, z * a - x * c, x * b - y * a);
        Wrench {
            force: self.force,
            moment: self.moment.zip_map(&turned, |m, n| m - n),
        }
    }
}

/// A load that the motion of rigid bodies does not determine: a unit force or a unit moment of one reaction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Undetermined {
    /// The index of the reaction, in the order of `REACTION_NAMES`.
    pub reaction: usize,
    /// The row that was left out, because it holds at every position of the joints or follows from others; it has no
    /// multiplier.
    pub row: &'static str,
    /// The direction of the force, in the axes of the reaction; zero for a moment.
    pub force: [f64; 3],
    /// The direction of the moment; zero for a force.
    pub moment: [f64; 3],
}
