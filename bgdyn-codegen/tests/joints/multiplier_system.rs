//! The open tree with multipliers: M q̈ − Bᵀ λ = P − h, B q̈ = γ, solved in double-double.

use bgdyn_runtime::Dd;

/// Solves a system by elimination with complete pivoting; pivots below 1e-20 are those of dependent rows.
pub fn solve(mut a: Vec<Vec<Dd>>, b: &[Dd]) -> Vec<Dd> {
    let n = b.len();
    a.iter_mut().zip(b).for_each(|(row, &x)| row.push(x));
    let (mut rows, mut columns, mut found): (Vec<usize>, Vec<usize>, Vec<(usize, usize)>) =
        ((0..n).collect(), (0..n).collect(), vec![]);
    while !rows.is_empty() {
        let size = |&(i, j): &(usize, usize)| a[i][j].to_f64().abs();
        let places = rows
            .iter()
            .flat_map(|&i| columns.iter().map(move |&j| (i, j)));
        let (i, j) = places
            .max_by(|x, y| size(x).total_cmp(&size(y)))
            .expect("a place");
        if size(&(i, j)) < 1e-20 {
            break;
        }
        let pivot = a[i].clone();
        for (k, row) in a.iter_mut().enumerate() {
            let factor = row[j] / pivot[j];
            if k != i {
                row.iter_mut()
                    .zip(&pivot)
                    .for_each(|(x, &y)| *x -= factor * y);
            }
        }
        rows.retain(|&row| row != i);
        columns.retain(|&column| column != j);
        found.push((i, j));
    }
    let mut x = vec![Dd::ZERO; n];
    for (i, j) in found {
        x[j] = a[i][n] / a[i][j];
    }
    x
}

/// Returns x and λ of M x − Bᵀ λ = f, B x = r; each row of `b` is one of B.
pub fn with_rows(mass: &[Vec<Dd>], b: &[(Vec<Dd>, Dd)], [f, r]: [&[Dd]; 2]) -> Vec<Dd> {
    let (n, m) = (f.len(), r.len());
    let mut system = vec![vec![Dd::ZERO; n + m]; n + m];
    for i in 0..n {
        system[i][..n].copy_from_slice(&mass[i]);
    }
    for (k, (row, _)) in b.iter().enumerate() {
        for j in 0..n {
            system[n + k][j] = row[j];
            system[j][n + k] = -row[j];
        }
    }
    solve(system, &[f, r].concat())
}
