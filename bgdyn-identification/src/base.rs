//! Base parameters: the combinations of parameters that have an effect on the efforts, found by a rank-revealing
//! orthogonalisation of the regressor at random states.

use bgdyn_runtime::random::Random;
use nalgebra::{DMatrix, DVector};

use crate::model::{BODY_PARAMETERS, Model, Unknown, joint_columns};

/// A column is a combination of others if less than this share of it is left.
const RANK: f64 = 1e-8;
/// A column smaller than this share of the largest is zero.
const ZERO: f64 = 1e-12;
/// The order in which parameters of a body are taken: Ixx, Ixy, Ixz, Iyz, Izz, mx, my, mz, Iyy, m.
const ORDER: [usize; BODY_PARAMETERS] = [4, 5, 7, 8, 9, 1, 2, 3, 6, 0];

/// Base parameters π_b = K π of the free unknowns π.
#[derive(Clone, Debug, PartialEq)]
pub struct Base {
    /// The unknowns that are identified.
    pub free: Vec<Unknown>,
    /// Those whose columns are kept, as indices into `free`.
    pub kept: Vec<usize>,
    /// K.
    pub map: DMatrix<f64>,
}

/// Returns the base parameters of a model.
pub fn base(model: &Model<'_>) -> Base {
    let unknowns = model.unknowns();
    let free: Vec<Unknown> = unknowns.into_iter().filter(|u| model.is_free(*u)).collect();
    let rows = random_rows(model, &free);
    let kept = independent(&rows, &order(model, &free), RANK);
    let map = combinations(&rows, &kept);
    Base { free, kept, map }
}

impl Base {
    /// Returns the names: the kept parameter with the others that act as it does, `link3.Ixx + 0.1 link4.mx`.
    pub fn names(&self, model: &Model<'_>) -> Vec<String> {
        let name = |i: usize| {
            let own = self.kept[i];
            let mut text = model.name(self.free[own]);
            for (k, factor) in self.map.row(i).iter().enumerate() {
                if k == own || *factor == 0.0 {
                    continue;
                }
                let sign = if *factor < 0.0 { '−' } else { '+' };
                let size = factor.abs();
                let size = match (size - 1.0).abs() < 1e-9 {
                    true => String::new(),
                    false => format!("{} ", crate::fault::short(size)),
                };
                text += &format!(" {sign} {size}{}", model.name(self.free[k]));
            }
            text
        };
        (0..self.kept.len()).map(name).collect()
    }
}

/// Returns the order in which columns are taken: friction and offsets, then bodies, then rotors, which act like tensors.
fn order(model: &Model<'_>, free: &[Unknown]) -> Vec<usize> {
    let joints = |wanted: &[usize]| -> Vec<usize> {
        let own = |u: &Unknown| matches!(u, Unknown::Joint(c, _) if wanted.contains(c));
        (0..free.len()).filter(|i| own(&free[*i])).collect()
    };
    let links = (0..model.links.len()).flat_map(|l| ORDER.map(|k| Unknown::Link(l, k)));
    let links = links.filter_map(|u| free.iter().position(|f| *f == u));
    let friction = joints(&[1, 2, 3]).into_iter();
    friction.chain(links).chain(joints(&[0])).collect()
}

/// Returns the regressor of the free unknowns at random states.
fn random_rows(model: &Model<'_>, free: &[Unknown]) -> DMatrix<f64> {
    let n = model.joints.len();
    let states = 60.max(12 * n);
    let mut random = Random(1);
    let mut within = |most: f64| most * random.signed();
    let mut rows = DMatrix::zeros(states * n, free.len());
    let mut of_bodies = DMatrix::zeros(n, BODY_PARAMETERS * model.rows.bodies());
    for s in 0..states {
        let spread = |linear: bool| if linear { 0.5 } else { 2.5 };
        let q: Vec<f64> = model
            .joints
            .iter()
            .map(|j| within(spread(j.linear)))
            .collect();
        let v: Vec<f64> = (0..n).map(|_| within(2.0)).collect();
        let a: Vec<f64> = (0..n).map(|_| within(4.0)).collect();
        model.rows.effort_rows(&q, &v, &a, &mut of_bodies);
        let of_links = model.rows_of_links(&of_bodies);
        for (column, unknown) in free.iter().enumerate() {
            match *unknown {
                Unknown::Link(l, k) => {
                    for i in 0..n {
                        rows[(s * n + i, column)] = of_links[(i, BODY_PARAMETERS * l + k)];
                    }
                }
                Unknown::Joint(c, j) => rows[(s * n + j, column)] = joint_columns(v[j], a[j])[c],
            }
        }
    }
    rows
}

/// Returns the independent columns, in the given order: those of which more than `rank` is left after the projection
/// on those before (Gram–Schmidt, twice: Giraud, Langou, Rozložník 2005). Zero columns are none. Ascending.
pub fn independent(rows: &DMatrix<f64>, order: &[usize], rank: f64) -> Vec<usize> {
    let mut kept = Vec::new();
    let mut q: Vec<DVector<f64>> = Vec::new();
    let largest = largest_column(rows);
    for &j in order {
        let mut column: DVector<f64> = rows.column(j).into();
        let size = column.norm();
        if size <= ZERO * largest {
            continue;
        }
        for _ in 0..2 {
            for q in &q {
                let share = q.dot(&column);
                column.axpy(-share, q, 1.0);
            }
        }
        let left = column.norm();
        if left > rank * size {
            q.push(column / left);
            kept.push(j);
        }
    }
    kept.sort_unstable();
    kept
}

fn largest_column(rows: &DMatrix<f64>) -> f64 {
    rows.column_iter().map(|c| c.norm()).fold(0.0, f64::max)
}

/// Returns K with `rows` = `rows[kept]` · K, by QR. Entries that are rounding errors are zero.
fn combinations(rows: &DMatrix<f64>, kept: &[usize]) -> DMatrix<f64> {
    let own = rows.select_columns(kept);
    let scales: Vec<f64> = own.column_iter().map(|c| c.norm()).collect();
    let mut scaled = own;
    for (mut column, scale) in scaled.column_iter_mut().zip(&scales) {
        column /= *scale;
    }
    let qr = scaled.qr();
    let mut map = qr.q().tr_mul(rows);
    let solved = qr.r().solve_upper_triangular_mut(&mut map);
    assert!(solved, "kept columns are independent");
    let largest = largest_column(rows);
    for i in 0..map.nrows() {
        for j in 0..map.ncols() {
            let size = rows.column(j).norm();
            let is_zero = size <= ZERO * largest || map[(i, j)].abs() < 1e-7 * size;
            map[(i, j)] = match is_zero {
                true => 0.0,
                false => map[(i, j)] / scales[i],
            };
        }
    }
    map
}
