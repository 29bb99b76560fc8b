//! Dynamics of mechanisms with loops in double-double: dependent velocities by elimination, then the open tree of
//! `loop_tree.rs` times Sᵀ.

use bgdyn_runtime::Dd;
use nalgebra::DMatrix;

use crate::bars::{norm, rounded};
use crate::loop_tree::{At, Tree};

/// Arguments: positions, independent velocities, accelerations and efforts.
#[derive(Clone, Debug)]
pub(crate) struct Arguments {
    /// Positions of the open tree.
    pub q: Vec<Dd>,
    /// Independent velocities.
    pub u: Vec<Dd>,
    /// Their accelerations.
    pub a: Vec<Dd>,
    /// Their efforts.
    pub tau: Vec<Dd>,
}

/// A mechanism at one position and velocity.
pub(crate) struct Exact {
    /// The open tree, at q̇ = S u.
    pub tree: At,
    /// S, row by row.
    pub map: Vec<Vec<Dd>>,
    /// z
    pub second: Vec<Dd>,
    /// q̇ = S u
    pub rates: Vec<Dd>,
    /// Sᵀ M S
    pub mass: Vec<Vec<Dd>>,
    /// The condition number of the columns of the dependent velocities.
    pub cond_rows: f64,
}

/// Returns Σ_j a_ij x_j.
pub(crate) fn times(a: &[Vec<Dd>], x: &[Dd]) -> Vec<Dd> {
    let row = |row: &Vec<Dd>| {
        row.iter()
            .zip(x)
            .fold(Dd::ZERO, |sum, (&a, &x)| sum + a * x)
    };
    a.iter().map(row).collect()
}

/// Returns aᵀ, with the number of its rows.
pub(crate) fn transposed(a: &[Vec<Dd>], rows: usize) -> Vec<Vec<Dd>> {
    let row = |i: usize| a.iter().map(|row| row[i]).collect();
    (0..rows).map(row).collect()
}

/// Returns the sum of two vectors.
pub(crate) fn plus(x: &[Dd], y: &[Dd]) -> Vec<Dd> {
    x.iter().zip(y).map(|(&x, &y)| x + y).collect()
}

/// Solves a x = b for each of the sides b, by elimination with pivots of the largest magnitude in the column.
///
/// # Panics
/// If the matrix is singular.
pub(crate) fn solve(mut a: Vec<Vec<Dd>>, mut sides: Vec<Vec<Dd>>) -> Vec<Vec<Dd>> {
    let n = a.len();
    for k in 0..n {
        let size = |&i: &usize| a[i][k].to_f64().abs();
        let pivot = (k..n)
            .max_by(|i, j| size(i).total_cmp(&size(j)))
            .expect("a row");
        assert!(size(&pivot) > 0.0, "the reference is singular");
        a.swap(k, pivot);
        sides.iter_mut().for_each(|b| b.swap(k, pivot));
        let row = a[k].clone();
        for i in k + 1..n {
            let factor = a[i][k] / row[k];
            for (x, &y) in a[i].iter_mut().zip(&row).skip(k) {
                *x -= factor * y;
            }
            for b in &mut sides {
                let above = b[k];
                b[i] -= factor * above;
            }
        }
    }
    for b in &mut sides {
        for i in (0..n).rev() {
            let later = (i + 1..n).fold(Dd::ZERO, |sum, j| sum + a[i][j] * b[j]);
            b[i] = (b[i] - later) / a[i][i];
        }
    }
    sides
}

/// Returns the condition number of a square matrix.
fn condition(a: &[Vec<Dd>]) -> f64 {
    let entries: Vec<f64> = a.iter().flat_map(|row| rounded(row)).collect();
    let values = DMatrix::from_row_slice(a.len(), a.len(), &entries).singular_values();
    values.max() / values.min()
}

impl Tree {
    /// Returns the arguments with the dependent positions at which the loops close in double-double, by Newton's method.
    pub fn closed(&self, s: &Arguments) -> Arguments {
        let mut s = s.clone();
        for _ in 0..6 {
            let at = self.at(&s.q, &vec![Dd::ZERO; self.len()]);
            let row = |row: &Vec<Dd>| self.dependents.iter().map(|&j| row[j]).collect();
            let step = solve(at.rows.iter().map(row).collect(), vec![at.open]).remove(0);
            for (&j, step) in self.dependents.iter().zip(step) {
                s.q[j] -= step;
            }
        }
        s
    }
}

impl Exact {
    /// Returns everything at a position and independent velocities.
    pub fn new(tree: &Tree, q: &[Dd], u: &[Dd]) -> Exact {
        let n = tree.len();
        let rows = tree.at(q, &vec![Dd::ZERO; n]).rows;
        let square: Vec<Vec<Dd>> = (rows.iter())
            .map(|row| tree.dependents.iter().map(|&j| row[j]).collect())
            .collect();
        let column = |j: usize| rows.iter().map(|row| -row[j]).collect::<Vec<Dd>>();
        let columns = tree.independents.iter().map(|&j| column(j)).collect();
        let solved = solve(square.clone(), columns);
        let mut map = vec![vec![Dd::ZERO; u.len()]; n];
        for (k, &i) in tree.independents.iter().enumerate() {
            map[i][k] = Dd::ONE;
            for (&j, &x) in tree.dependents.iter().zip(&solved[k]) {
                map[j][k] = x;
            }
        }
        let rates = times(&map, u);
        let at = tree.at(q, &rates);
        let solved = solve(square.clone(), vec![at.gamma.clone()]);
        let mut second = vec![Dd::ZERO; n];
        for (&j, &x) in tree.dependents.iter().zip(&solved[0]) {
            second[j] = x;
        }
        let across = transposed(&map, u.len());
        let moved: Vec<Vec<Dd>> = across
            .iter()
            .map(|column| times(&at.mass, column))
            .collect();
        let mass = moved.iter().map(|moved| times(&across, moved)).collect();
        Exact {
            cond_rows: condition(&square),
            tree: at,
            map,
            second,
            rates,
            mass,
        }
    }

    /// Returns Sᵀ x.
    pub fn reduced(&self, x: &[Dd]) -> Vec<Dd> {
        times(&transposed(&self.map, self.mass.len()), x)
    }

    /// Returns S a + z.
    pub fn accelerations(&self, a: &[Dd]) -> Vec<Dd> {
        plus(&times(&self.map, a), &self.second)
    }

    /// Returns M q̈ + h of the tree.
    pub fn efforts(&self, accelerations: &[Dd]) -> Vec<Dd> {
        plus(&times(&self.tree.mass, accelerations), &self.tree.bias)
    }

    /// Returns the efforts of the independent velocities.
    pub fn inverse(&self, a: &[Dd]) -> Vec<Dd> {
        self.reduced(&self.efforts(&self.accelerations(a)))
    }

    /// Returns the accelerations of the independent velocities.
    pub fn forward(&self, tau: &[Dd]) -> Vec<Dd> {
        let none = vec![Dd::ZERO; tau.len()];
        let side = tau.iter().zip(self.inverse(&none)).map(|(&t, h)| t - h);
        solve(self.mass.clone(), vec![side.collect()]).remove(0)
    }

    /// Returns (64 + 4 cond J_d + cond M_u) eps.
    pub fn share(&self, eps: f64) -> f64 {
        (64.0 + 4.0 * self.cond_rows + condition(&self.mass)) * eps
    }
}

/// Returns the change of a value if each position, velocity and effort is rounded, by half an eps of itself: the
/// sum over all of them.
pub(crate) fn rounding(at: &Arguments, eps: f64, value: impl Fn(&Arguments) -> Vec<Dd>) -> f64 {
    let (here, slightly) = (value(at), Dd::ONE + Dd::from_f64(eps / 2.0));
    let mut sum = 0.0;
    for (kind, size) in [at.q.len(), at.u.len(), at.tau.len()]
        .into_iter()
        .enumerate()
    {
        for i in 0..size {
            let mut moved = at.clone();
            let of = [&mut moved.q, &mut moved.u, &mut moved.tau];
            of.into_iter().nth(kind).expect("three kinds")[i] *= slightly;
            let off: Vec<f64> = (value(&moved).iter().zip(&here))
                .map(|(&x, &y)| (x - y).to_f64())
                .collect();
            sum += norm(&off);
        }
    }
    sum
}
