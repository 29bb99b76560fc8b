//! Tests inner products of two tables, entry by entry.

use bgdyn_runtime::nalgebra::SMatrix;
use bgdyn_runtime::{Dd, Scalar, inner_products, mirror};

/// Component c of a row's or a column's vector.
fn number(c: usize, place: usize) -> f64 {
    (1.7 * c as f64 + 0.3 * place as f64 + 0.9).sin()
}

fn equal_plain_sums<T: Scalar>(narrow: impl Fn(f64) -> T) {
    let rows: [[T; 7]; 3] = std::array::from_fn(|c| std::array::from_fn(|i| narrow(number(c, i))));
    let runs = [[0, 2, 7], [2, 3, 5], [2, 6, 7], [4, 5, 7]];
    let columns = runs.map(|[j, ..]| std::array::from_fn(|c| narrow(number(c, 10 + j))));
    let nothing = narrow(-1.0);
    let mut found = SMatrix::<T, 7, 7>::from_element(nothing);
    inner_products(&mut found, &rows, &columns, &runs);
    for j in 0..7 {
        for i in 0..7 {
            let of = |run: &[usize; 3]| run[0] == j && (run[1]..run[2]).contains(&i);
            let wanted = runs.iter().position(of).map_or(nothing, |k| {
                let [x, y, z] = columns[k];
                let start = rows[0][i] * x;
                T::mul_add(rows[2][i], z, T::mul_add(rows[1][i], y, start))
            });
            assert_eq!(found[(i, j)], wanted, "{i}, {j}");
        }
    }
    let below = found;
    mirror(&mut found);
    assert_eq!(found, found.transpose());
    for j in 0..7 {
        for i in j..7 {
            assert_eq!(found[(i, j)], below[(i, j)]);
        }
    }
}

#[test]
fn runs_are_sums_of_products() {
    equal_plain_sums(|x| x);
    equal_plain_sums(|x| x as f32);
    equal_plain_sums(Dd::from_f64);
}

/// Rows and columns outside of the matrix or its table are skipped: no index is out of bounds.
#[test]
fn what_the_matrix_lacks_is_left_out() {
    let mut found = SMatrix::<f64, 3, 3>::from_element(-1.0);
    inner_products(
        &mut found,
        &[[2.0; 2]],
        &[[3.0], [5.0]],
        &[[1, 0, 9], [7, 0, 3]],
    );
    let wanted = SMatrix::<f64, 3, 3>::from_fn(|i, j| if j == 1 && i < 2 { 6.0 } else { -1.0 });
    assert_eq!(found, wanted);
}
