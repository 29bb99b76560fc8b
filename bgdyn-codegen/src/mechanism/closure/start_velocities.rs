//! Independent velocities of a start, for given velocities of joints of any kind at a closed position.

use bgdyn_runtime::Dd;

use super::reach::{Unreached, agrees};
use super::{Closure, eliminate, solve};

/// A row of S, relative to its largest size at the sampled positions, has no part that is smaller than this.
const ROUNDING: f64 = 1e-18;

/// With a part smaller than this a joint stands still whatever the others do, to the digits of a position: a dead centre.
const SINGULAR: f64 = 1e-9;

impl Closure {
    /// Returns the independent velocities for `given` velocities of the open tree, by index; those that do not follow
    /// are taken from the `others` as far as these are free, in their order, and are 0 then.
    ///
    /// # Errors
    /// At a singular position; if the given ones contradict each other; if one is that of a joint that stands still
    /// here whatever the others do.
    pub fn independent_velocities(
        &self,
        q: &[Dd],
        given: &[(usize, Dd)],
        others: &[(usize, Dd)],
    ) -> Result<Vec<Dd>, Unreached> {
        let Some(map) = self.velocity_map(q) else {
            return Err(Unreached::OtherBranch);
        };
        let left = self.left_free(&map, &joints(given), &joints(others));
        let others = others.iter().filter(|(j, _)| left.contains(j));
        let (own, dependents): (Vec<_>, Vec<_>) = given
            .iter()
            .chain(others)
            .copied()
            .partition(|&(j, _)| self.independents.iter().any(|i| i.0 == j));
        let mut u = vec![Dd::ZERO; self.independents.len()];
        let mut free = Vec::new();
        for (k, i) in self.independents.iter().enumerate() {
            match own.iter().rev().find(|(j, _)| *j == i.0) {
                Some(&(_, v)) => u[k] = v,
                None => free.push(k),
            }
        }
        let rows = self.scaled(&map, &joints(&dependents));
        let chosen = |row: &Vec<Dd>| free.iter().map(|&k| row[k]).collect();
        let rows: Vec<Vec<Dd>> = rows.iter().map(chosen).collect();
        let Pivots { regular, small } = pivots(&rows, free.len());
        // The regular rows and columns alone: what is left of the others is the rounding of their digits.
        let entry = |&(r, _): &(usize, usize)| regular.iter().map(|&(_, c)| rows[r][c]).collect();
        let side = |&(r, _): &(usize, usize)| {
            let (j, v) = dependents[r];
            (v - along(&map[j], &u)) / self.row_size(j)
        };
        let matrix = regular.iter().map(entry).collect();
        let sides = regular.iter().map(side).collect();
        let found = solve(matrix, &[sides], 0.0).unwrap_or_default();
        for (&(_, column), x) in regular.iter().zip(found.into_iter().flatten()) {
            u[free[column]] = x;
        }
        for (row, &(j, v)) in dependents.iter().enumerate() {
            let still = small.iter().find(|(at, _)| *at == row);
            agrees(j, true, (v, along(&map[j], &u))).map_err(|contradicts| match still {
                None => contradicts,
                Some(&(_, part)) => Unreached::Still {
                    index: j,
                    given: v.to_f64(),
                    part,
                },
            })?;
        }
        Ok(u)
    }

    /// Returns those of the `others`, in their order, that the `given` motions of joints and the others before them leave
    /// free; all are velocities of the open tree, by index, and `map` is S.
    pub fn left_free(&self, map: &[Vec<Dd>], given: &[usize], others: &[usize]) -> Vec<usize> {
        let n = self.independents.len();
        let rank = |of: &[usize]| pivots(&self.scaled(map, of), n).regular.len();
        let mut taken = given.to_vec();
        for &other in others {
            let with = [&taken[..], &[other]].concat();
            if rank(&with) > rank(&taken) {
                taken = with;
            }
        }
        taken.split_off(given.len())
    }

    /// Returns rows of S, each over its size at the sampled positions; those of independent velocities are 1.
    fn scaled(&self, map: &[Vec<Dd>], of: &[usize]) -> Vec<Vec<Dd>> {
        let row = |&j: &usize| {
            let size = self.row_size(j);
            map[j].iter().map(|&s| s / size).collect()
        };
        of.iter().map(row).collect()
    }

    /// Returns the largest entry of a row of S at the sampled positions; 1 for a row without one.
    fn row_size(&self, j: usize) -> Dd {
        let maps = self.samples.iter().filter_map(|q| self.velocity_map(q));
        let rows = maps.map(|map| map[j].iter().map(|s| s.to_f64().abs()).fold(0.0, f64::max));
        match rows.fold(0.0, f64::max) {
            size if size > 0.0 => Dd::from_f64(size),
            _ => Dd::ONE,
        }
    }
}

/// Returns the joints of velocities.
fn joints(of: &[(usize, Dd)]) -> Vec<usize> {
    of.iter().map(|&(j, _)| j).collect()
}

/// Returns the velocity of a joint with this row of S.
fn along(row: &[Dd], u: &[Dd]) -> Dd {
    let terms = row.iter().zip(u);
    terms.fold(Dd::ZERO, |sum, (s, u)| sum + *s * *u)
}

/// The pivots of rows.
struct Pivots {
    /// Row and column of each that is not small.
    regular: Vec<(usize, usize)>,
    /// Row and size of each that is small, but no rounding error.
    small: Vec<(usize, f64)>,
}

fn pivots(rows: &[Vec<Dd>], columns: usize) -> Pivots {
    let mut a = rows.to_vec();
    let (all, _) = eliminate(&mut a, columns);
    let (mut regular, mut small) = (Vec::new(), Vec::new());
    for (row, column) in all {
        match a[row][column].to_f64().abs() {
            size if size >= SINGULAR => regular.push((row, column)),
            size if size > ROUNDING => small.push((row, size)),
            _ => {}
        }
    }
    Pivots { regular, small }
}
