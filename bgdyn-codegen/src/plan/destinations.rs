//! Where the outputs of a function or block are in its result.

use crate::method::Shape;

/// A destination in a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Destination {
    /// An element of an array.
    Element(usize),
    /// An entry of a matrix.
    Entry {
        /// The list, where the result has several lists of matrices.
        list: usize,
        /// The matrix in that list, where the result has several.
        matrix: usize,
        /// Its row.
        row: usize,
        /// Its column.
        column: usize,
    },
}

/// Returns the destinations of outputs that are the elements of an array.
pub fn elements(count: usize) -> Vec<Vec<Destination>> {
    (0..count).map(|k| vec![Destination::Element(k)]).collect()
}

/// Returns the destinations of a function's outputs in its matrices, where the result has nothing else: entries row by
/// row, of a symmetric matrix those on and below the diagonal, each in both triangles. `None` for other results.
pub fn matrix_destinations(shape: Shape, nv: usize) -> Option<Vec<Vec<Destination>>> {
    let destination = |list, matrix, row, column| Destination::Entry {
        list,
        matrix,
        row,
        column,
    };
    let of_list = |list, matrix, rows: usize| {
        let entries = (0..rows).flat_map(move |i| (0..nv).map(move |j| (i, j)));
        entries.map(move |(i, j)| vec![destination(list, matrix, i, j)])
    };
    let full = |matrix, rows: usize| of_list(0, matrix, rows);
    Some(match shape {
        Shape::Symmetric => {
            let triangle = (0..nv).flat_map(|i| (0..=i).map(move |j| (i, j)));
            let both = |(i, j)| match i == j {
                true => vec![destination(0, 0, i, j)],
                false => vec![destination(0, 0, i, j), destination(0, 0, j, i)],
            };
            triangle.map(both).collect()
        }
        Shape::Square => full(0, nv).collect(),
        Shape::Jacobian => full(0, 6).collect(),
        Shape::PointJacobian => full(0, 3).collect(),
        Shape::Rows(rows) => full(0, rows).collect(),
        Shape::SquarePair => full(0, nv).chain(full(1, nv)).collect(),
        Shape::FourSquares => (0..4).flat_map(|matrix| full(matrix, nv)).collect(),
        Shape::FourCubes => {
            let matrices = (0..4).flat_map(|list| (0..nv).map(move |matrix| (list, matrix)));
            let entries = matrices.flat_map(|(list, matrix)| of_list(list, matrix, nv));
            entries.collect()
        }
        _ => return None,
    })
}
