//! What a method returns in Python: its arrays, and which numbers of the function each contains.

use bgdyn_codegen::method::{Entries, Method, Shape};

/// The sizes of a mechanism that shapes depend on.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    /// Number of velocities.
    pub nv: usize,
    /// Number of velocities of the open tree.
    pub nt: usize,
    /// Number of rows of the loops, wheels and knife edges.
    pub nc: usize,
}

/// One array of a result.
#[derive(Clone, Debug)]
pub struct Part {
    /// The shape for one state; empty for a number.
    pub shape: Vec<usize>,
    /// For each entry, row by row, the index of the function's number.
    pub source: Vec<usize>,
}

/// The arrays of a result, and the class that has their names.
#[derive(Clone, Debug)]
pub struct Parts {
    /// The class of `bgdyn`, if there are several arrays.
    pub class: Option<&'static str>,
    /// The arrays.
    pub arrays: Vec<Part>,
}

impl Part {
    /// Returns the numbers from `first` on in this shape.
    fn run(first: usize, shape: &[usize]) -> Self {
        let len: usize = shape.iter().product();
        Part {
            shape: shape.to_vec(),
            source: (first..first + len).collect(),
        }
    }

    /// Returns a symmetric matrix, of which the function computes the lower triangle.
    fn symmetric(n: usize) -> Self {
        let entry = |i: usize, j: usize| i.max(j) * (i.max(j) + 1) / 2 + i.min(j);
        let rows = (0..n).flat_map(|i| (0..n).map(move |j| entry(i, j)));
        Part {
            shape: vec![n, n],
            source: rows.collect(),
        }
    }

    /// Returns the entries after the numbers that are only checked.
    fn entries(entries: Entries, nv: usize, results: usize) -> Self {
        let shape = match entries {
            Entries::Joints => vec![nv, nv],
            Entries::Task => vec![6, 6],
            Entries::TaskColumns => vec![nv, 6],
            Entries::TaskVector => vec![6],
            Entries::VectorTriple => vec![3, nv],
            Entries::Symmetric(rows) => vec![rows, rows],
            Entries::Columns(columns) => vec![nv, columns],
            Entries::ParameterColumns(_) => vec![nv, (results - nv) / nv.max(1)],
        };
        let all: Vec<usize> = (nv..results).collect();
        Part {
            shape,
            source: entries.spread(&all, nv),
        }
    }

    /// Returns so many entries of this shape (from `at` on) in each of `number` poses.
    fn of_poses(number: usize, at: usize, shape: &[usize]) -> Self {
        let each = Shape::Pose.len(0);
        let len: usize = shape.iter().product();
        let entries = (0..number).flat_map(|k| (0..len).map(move |i| each * k + at + i));
        Part {
            shape: [&[number], shape].concat(),
            source: entries.collect(),
        }
    }

    /// Returns the forces (`at` 0) or moments (`at` 3) of wrenches from `first` on.
    fn of_wrenches(first: usize, number: usize, at: usize) -> Self {
        let entries = (0..number).flat_map(|k| (0..3).map(move |i| first + 6 * k + at + i));
        Part {
            shape: vec![number, 3],
            source: entries.collect(),
        }
    }

    /// Returns the number of entries.
    pub fn len(&self) -> usize {
        self.source.len()
    }
}

impl Parts {
    /// Returns the arrays of a method whose function computes `results` numbers.
    pub fn of(method: Method, sizes: Sizes, results: usize) -> Self {
        let Sizes { nv, nt, nc } = sizes;
        let square = |k: usize, first: usize| Part::run(first + k * nv * nv, &[nv, nv]);
        let wrenches = |first: usize| {
            let number = (results - first) / 6;
            [0, 3]
                .map(|at| Part::of_wrenches(first, number, at))
                .to_vec()
        };
        let (class, arrays) = match method.shape() {
            Shape::Scalar => (None, vec![Part::run(0, &[])]),
            Shape::Symmetric => (None, vec![Part::symmetric(nv)]),
            Shape::Square => (None, vec![Part::run(0, &[nv, nv])]),
            Shape::Jacobian => (None, vec![Part::run(0, &[6, nv])]),
            Shape::PointJacobian => (None, vec![Part::run(0, &[3, nv])]),
            Shape::Rows(rows) => (None, vec![Part::run(0, &[rows, nv])]),
            Shape::Poses(number) => (
                Some("Pose"),
                vec![
                    Part::of_poses(number, 0, &[3, 3]),
                    Part::of_poses(number, 9, &[3]),
                ],
            ),
            Shape::TreeMatrix => (None, vec![Part::run(0, &[nt, nv])]),
            Shape::RowMatrix => (None, vec![Part::run(0, &[nc, nt])]),
            Shape::VectorTriple => (None, vec![Part::run(0, &[3, nv])]),
            Shape::Checked(entries) => (None, vec![Part::entries(entries, nv, results)]),
            Shape::SquarePair => (Some("InverseDerivatives"), vec![square(0, 0), square(1, 0)]),
            Shape::FourSquares => (Some("Curvature"), (0..4).map(|k| square(k, 0)).collect()),
            Shape::FourCubes => {
                let cube = |k: usize| Part::run(k * nv * nv * nv, &[nv, nv, nv]);
                (Some("SecondDerivatives"), (0..4).map(cube).collect())
            }
            Shape::CheckedSquares => (
                Some("ForwardDerivatives"),
                (0..3).map(|k| square(k, nv)).collect(),
            ),
            Shape::SlopesByTree => (
                Some("InverseDerivatives"),
                vec![Part::run(0, &[nv, nt]), Part::run(nv * nt, &[nv, nv])],
            ),
            Shape::CheckedSlopesByTree => (
                Some("ForwardDerivatives"),
                vec![
                    Part::run(nv, &[nv, nt]),
                    square(0, nv + nv * nt),
                    square(1, nv + nv * nt),
                ],
            ),
            Shape::Pose => (
                Some("Pose"),
                vec![Part::run(0, &[3, 3]), Part::run(9, &[3])],
            ),
            Shape::CheckedTreeAndRows => (
                Some("ConstrainedDynamics"),
                vec![Part::run(0, &[nt]), Part::run(nt, &[results - nt])],
            ),
            Shape::CheckedWrenches => (Some("Wrenches"), wrenches(nv)),
            Shape::LinkWrenches => (Some("Wrenches"), wrenches(0)),
            Shape::ParameterColumns(_) => (None, vec![Part::run(0, &[nv, results / nv.max(1)])]),
            Shape::Vector
            | Shape::ParameterVector(_)
            | Shape::CheckedVector
            | Shape::CheckedActuated(_)
            | Shape::Spatial
            | Shape::Point
            | Shape::TreeVector
            | Shape::RowVector
            | Shape::CheckedTree
            | Shape::Drives(_)
            | Shape::Numbers(_)
            | Shape::Parts
            | Shape::CheckedParts
            | Shape::Bundle
            | Shape::CheckedBundle => (None, vec![Part::run(0, &[results])]),
        };
        Parts { class, arrays }
    }
}
