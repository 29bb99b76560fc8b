//! The shapes of results.

/// The shape of a method's result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One number.
    Scalar,
    /// NV numbers.
    Vector,
    /// NV numbers, or an error with a joint.
    CheckedVector,
    /// A symmetric NV × NV matrix; the expressions are its lower triangle, row by row.
    Symmetric,
    /// An NV × NV matrix, row by row.
    Square,
    /// Two NV × NV matrices.
    SquarePair,
    /// NV accelerations and three NV × NV matrices, or an error with a joint; only the matrices are
    /// returned.
    CheckedSquares,
    /// A rotation matrix, row by row, and a point.
    Pose,
    /// A spatial vector, angular part first.
    Spatial,
    /// A 6 × NV matrix, row by row, angular part first.
    Jacobian,
    /// A number for each velocity of the open tree.
    TreeVector,
    /// An NT × NV matrix, row by row: velocities of the open tree by independent ones.
    TreeMatrix,
    /// A number for each row of the loops.
    RowVector,
    /// An NC × NT matrix, row by row.
    RowMatrix,
    /// As many numbers as the mechanism has prescribed joints.
    Drives(usize),
    /// The named parts of a scene's result.
    Parts,
    /// The same, or an error with a coordinate.
    CheckedParts,
}

impl Shape {
    /// Returns the number of expressions of the result; 0 if it depends on more than the number of velocities.
    pub fn len(self, nv: usize) -> usize {
        match self {
            Shape::Scalar => 1,
            Shape::Vector | Shape::CheckedVector => nv,
            Shape::Symmetric => nv * (nv + 1) / 2,
            Shape::Square => nv * nv,
            Shape::SquarePair => 2 * nv * nv,
            Shape::CheckedSquares => nv + 3 * nv * nv,
            Shape::Pose => 12,
            Shape::Spatial => 6,
            Shape::Jacobian => 6 * nv,
            Shape::TreeVector | Shape::TreeMatrix | Shape::RowVector | Shape::RowMatrix => 0,
            Shape::Drives(np) => np,
            Shape::Parts | Shape::CheckedParts => 0,
        }
    }

    /// Returns whether a singular mass matrix is an error.
    pub fn checked(self) -> bool {
        matches!(
            self,
            Shape::CheckedVector | Shape::CheckedSquares | Shape::CheckedParts
        )
    }
}
