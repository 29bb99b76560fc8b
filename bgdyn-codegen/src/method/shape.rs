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
    /// As many numbers as the mechanism has actuated joints, or an error with a joint or a loop.
    CheckedActuated(usize),
    /// A symmetric NV × NV matrix; the expressions are its lower triangle, row by row.
    Symmetric,
    /// An NV × NV matrix, row by row.
    Square,
    /// Two NV × NV matrices.
    SquarePair,
    /// NV accelerations and three NV × NV matrices, or an error with a joint; only the matrices are
    /// returned.
    CheckedSquares,
    /// An NV × NT and an NV × NV matrix: by positions along the velocities of the open tree, by v.
    SlopesByTree,
    /// NV accelerations, an NV × NT and two NV × NV matrices, or an error with a joint; only the matrices are returned.
    CheckedSlopesByTree,
    /// A rotation matrix, row by row, and a point.
    Pose,
    /// A spatial vector, angular part first.
    Spatial,
    /// A 6 × NV matrix, row by row, angular part first.
    Jacobian,
    /// A point, or a vector of three components.
    Point,
    /// A 3 × NV matrix, row by row.
    PointJacobian,
    /// A number for each velocity of the open tree.
    TreeVector,
    /// An NT × NV matrix, row by row: velocities of the open tree by independent ones.
    TreeMatrix,
    /// A number for each row of the loops.
    RowVector,
    /// An NC × NT matrix, row by row.
    RowMatrix,
    /// A number for each velocity of the open tree, or an error with a joint or a loop.
    CheckedTree,
    /// A number for each velocity of the open tree and one for each row, or an error.
    CheckedTreeAndRows,
    /// NV accelerations, and a force and a moment for each loop or contact, or an error; only the forces and moments
    /// are returned.
    CheckedWrenches,
    /// A force and a moment for each link that is not hidden.
    LinkWrenches,
    /// As many numbers as the mechanism has prescribed joints.
    Drives(usize),
    /// A matrix with a row for each velocity and a column for each parameter, row by row.
    ParameterColumns(ParameterSet),
    /// A number for each parameter.
    ParameterVector(ParameterSet),
    /// The named parts of a scene's result.
    Parts,
    /// The same, or an error with a coordinate.
    CheckedParts,
    /// The results of several methods, one after the other.
    Bundle,
    /// The same, or an error with a joint.
    CheckedBundle,
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
            Shape::Point => 3,
            Shape::PointJacobian => 3 * nv,
            Shape::TreeVector | Shape::TreeMatrix | Shape::RowVector | Shape::RowMatrix => 0,
            Shape::CheckedTree | Shape::CheckedTreeAndRows => 0,
            Shape::CheckedWrenches | Shape::LinkWrenches => 0,
            Shape::SlopesByTree | Shape::CheckedSlopesByTree => 0,
            Shape::Drives(np) => np,
            Shape::CheckedActuated(na) => na,
            Shape::ParameterColumns(_) | Shape::ParameterVector(_) => 0,
            Shape::Parts | Shape::CheckedParts | Shape::Bundle | Shape::CheckedBundle => 0,
        }
    }

    /// Returns whether a singular mass matrix is an error.
    pub fn checked(self) -> bool {
        matches!(
            self,
            Shape::CheckedVector
                | Shape::CheckedActuated(_)
                | Shape::CheckedSquares
                | Shape::CheckedSlopesByTree
                | Shape::CheckedTree
                | Shape::CheckedTreeAndRows
                | Shape::CheckedWrenches
                | Shape::CheckedParts
                | Shape::CheckedBundle
        )
    }
}

/// What the columns of a regressor belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterSet {
    /// The ten parameters of each body.
    Bodies,
    /// The base parameters.
    Base,
}
