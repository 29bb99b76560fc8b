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
    /// Four NV × NV matrices.
    FourSquares,
    /// Four lists of NV matrices, NV × NV each.
    FourCubes,
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
    /// Three times NV numbers.
    VectorTriple,
    /// NV numbers that are finite exactly if the result is, and the entries of the result, or an error with a joint; only
    /// the entries are returned.
    Checked(Entries),
    /// So many numbers.
    Numbers(usize),
    /// A matrix with so many rows and NV columns, row by row.
    Rows(usize),
    /// So many poses, each a rotation matrix, row by row, and a point.
    Poses(usize),
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
            Shape::FourSquares => 4 * nv * nv,
            Shape::FourCubes => 4 * nv * nv * nv,
            Shape::CheckedSquares => nv + 3 * nv * nv,
            Shape::VectorTriple => 3 * nv,
            Shape::Checked(Entries::ParameterColumns(_)) => 0,
            Shape::Checked(entries) => nv + entries.len(nv),
            Shape::Pose => 12,
            Shape::Spatial => 6,
            Shape::Jacobian => 6 * nv,
            Shape::Point => 3,
            Shape::PointJacobian => 3 * nv,
            Shape::TreeVector | Shape::TreeMatrix | Shape::RowVector | Shape::RowMatrix => 0,
            Shape::CheckedTree | Shape::CheckedTreeAndRows => 0,
            Shape::CheckedWrenches | Shape::LinkWrenches => 0,
            Shape::SlopesByTree | Shape::CheckedSlopesByTree => 0,
            Shape::Numbers(count) => count,
            Shape::Rows(rows) => rows * nv,
            Shape::Poses(count) => Shape::Pose.len(nv) * count,
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
                | Shape::Checked(_)
                | Shape::CheckedParts
                | Shape::CheckedBundle
        )
    }
}

/// The entries of a [`Shape::Checked`] result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entries {
    /// A symmetric NV × NV matrix; the expressions are its lower triangle, row by row.
    Joints,
    /// A symmetric 6 × 6 matrix, likewise.
    Task,
    /// An NV × 6 matrix, row by row.
    TaskColumns,
    /// Six numbers, angular part first.
    TaskVector,
    /// Three times NV numbers.
    VectorTriple,
    /// A symmetric matrix with so many rows; the expressions are its lower triangle, row by row.
    Symmetric(usize),
    /// A matrix with NV rows and so many columns, row by row.
    Columns(usize),
    /// A matrix with a row for each velocity and a column for each parameter, row by row.
    ParameterColumns(ParameterSet),
}

impl Entries {
    /// Returns the number of expressions; 0 if it depends on more than the number of velocities.
    pub fn len(self, nv: usize) -> usize {
        match self {
            Entries::Joints => nv * (nv + 1) / 2,
            Entries::Task => 21,
            Entries::TaskColumns => 6 * nv,
            Entries::TaskVector => 6,
            Entries::VectorTriple => 3 * nv,
            Entries::Symmetric(rows) => rows * (rows + 1) / 2,
            Entries::Columns(columns) => nv * columns,
            Entries::ParameterColumns(_) => 0,
        }
    }

    /// Returns the size of the symmetric matrix whose lower triangle the expressions are.
    pub fn symmetric(self, nv: usize) -> Option<usize> {
        match self {
            Entries::Joints => Some(nv),
            Entries::Task => Some(6),
            Entries::Symmetric(rows) => Some(rows),
            _ => None,
        }
    }

    /// Returns the result from the expressions: a symmetric matrix whole, row by row.
    pub fn spread<T: Clone>(self, values: &[T], nv: usize) -> Vec<T> {
        match self.symmetric(nv) {
            None => values.to_vec(),
            Some(n) => {
                let entry = |k: usize| {
                    let (i, j) = (k / n, k % n);
                    values[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)].clone()
                };
                (0..n * n).map(entry).collect()
            }
        }
    }
}

/// What the columns of a regressor, or of a derivative by parameters, belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterSet {
    /// The ten parameters of each body.
    Bodies,
    /// The base parameters.
    Base,
    /// The ten parameters of a payload.
    Payload,
    /// The run-time parameters of the mechanism; their number.
    RunTime(usize),
}
