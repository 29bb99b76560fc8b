//! Values and Jacobians of loops in double-double, and positions that close them.

use bgdyn_runtime::Dd;

use super::solve::is_positive;
use super::{Closure, ClosureBlock, LoopRow, RowAxes, TwistPoint, solve};
use crate::mechanism::Motion;
use crate::mechanism::joint::DoubleDouble;
use crate::random::Random;

/// Largest residual of a closed position, relative to 1 m or 1 rad.
const CLOSED: f64 = 1e-27;

/// Steps of Newton's method and of Levenberg and Marquardt's.
const STEPS: usize = 60;

/// Largest change of a position in one step, rad or m.
const LARGEST_STEP: f64 = 0.5;

/// Positions at which the loops are open.
const OPEN: u64 = 4;

/// The least cosine of a wheel's lean at sampled positions.
const LEAST_COSINE: f64 = 0.05;

/// Steps of a walk between two sampled positions, and their size.
const WALK: (usize, f64) = (8, 0.3);

impl Closure {
    /// Returns c(q), and B(q) row by row; c is zero for rows on velocities. Rows of contacts are along their planes.
    pub fn values(&self, rows: &[LoopRow], q: &[Dd]) -> (Vec<Dd>, Vec<Vec<Dd>>) {
        self.values_in(rows, q, true)
    }

    /// Returns c(q) and B(q), with rows of contacts along their planes or in the axes in which they are solved.
    fn values_in(&self, rows: &[LoopRow], q: &[Dd], of_plane: bool) -> (Vec<Dd>, Vec<Vec<Dd>>) {
        let axes = RowAxes {
            reversed: false,
            of_plane,
            closed: false,
        };
        let all = 0..self.loops.len();
        let all: Vec<_> = all
            .map(|closes| self.rows_at(closes, axes, (q, &DoubleDouble)))
            .collect();
        let value = |row: &LoopRow| {
            let mut rates = vec![Dd::ZERO; self.positions.len()];
            for (j, rate) in all[row.closes].rates(row.kind) {
                rates[j.0] = rate;
            }
            let residual = all[row.closes].residual(row.kind, &DoubleDouble);
            (residual, rates)
        };
        rows.iter().map(value).unzip()
    }

    /// Returns the rates of the rows that are solved.
    pub fn solved_rates(&self, q: &[Dd]) -> Vec<Vec<Dd>> {
        let (_, rates) = self.values_in(&self.rows, q, false);
        if self.combined.is_empty() {
            return rates;
        }
        let entry = |factors: &Vec<Dd>, j: usize| dot(rates.iter().map(|row| row[j]), factors);
        let row = |factors: &Vec<Dd>| {
            let all = 0..self.positions.len();
            all.map(|j| entry(factors, j)).collect()
        };
        self.combined.iter().map(row).collect()
    }

    /// Returns S, row by row for the velocities of the open tree; `None` at a singular position.
    pub fn velocity_map(&self, q: &[Dd]) -> Option<Vec<Vec<Dd>>> {
        let (_, jacobian) = self.values(&self.rows, q);
        let dependents: Vec<usize> = self.dependents().map(|j| j.0).collect();
        let square = jacobian
            .iter()
            .map(|row| dependents.iter().map(|&j| row[j]).collect());
        let sides: Vec<Vec<Dd>> = (self.independents.iter())
            .map(|i| jacobian.iter().map(|row| -row[i.0]).collect())
            .collect();
        let solved = solve(square.collect(), &sides, 1e-20)?;
        let mut map = vec![vec![Dd::ZERO; self.independents.len()]; self.positions.len()];
        for (k, i) in self.independents.iter().enumerate() {
            map[i.0][k] = Dd::ONE;
            for (d, &j) in dependents.iter().enumerate() {
                map[j][k] = solved[k][d];
            }
        }
        Some(map)
    }

    /// Changes the dependent positions so that the loops close. Returns whether they do.
    pub fn close(&self, q: &mut [Dd]) -> bool {
        let dependents: Vec<usize> = self.closing().map(|j| j.0).collect();
        let rows = self.position_rows();
        for _ in 0..STEPS {
            let (residuals, jacobian) = self.values(&rows, q);
            if largest(&residuals) <= CLOSED {
                return true;
            }
            if dependents.len() > rows.len() {
                let Some(step) = least_step(&jacobian, &residuals, &dependents, 0.0) else {
                    return false;
                };
                self.move_by(q, &step);
                continue;
            }
            let square = jacobian
                .iter()
                .map(|row| dependents.iter().map(|&j| row[j]).collect());
            let Some(step) = solve(square.collect(), &[residuals], 1e-20) else {
                return false;
            };
            let steps: Vec<(usize, Dd)> = dependents
                .iter()
                .copied()
                .zip(step[0].iter().map(|x| -*x))
                .collect();
            self.move_by(q, &steps);
        }
        false
    }

    /// Returns the velocities of the open tree nearest to these with which the positions stay closed, where only
    /// [`Closure::closing`] change; `None` at a singular position.
    pub fn closed_along(&self, q: &[Dd], velocities: &[Dd]) -> Option<Vec<Dd>> {
        let closers: Vec<usize> = self.closing().map(|j| j.0).collect();
        let (_, jacobian) = self.values(&self.position_rows(), q);
        let open = jacobian.iter();
        let open: Vec<Dd> = open
            .map(|row| dot(row.iter().copied(), velocities))
            .collect();
        let mut moved = velocities.to_vec();
        for (j, step) in least_step(&jacobian, &open, &closers, 0.0)? {
            moved[j] += step;
        }
        Some(moved)
    }

    /// Changes the positions of these velocities as little as possible so that the loops close. Returns the largest
    /// residual.
    pub fn assemble(&self, rows: &[LoopRow], q: &mut [Dd], free: &[usize]) -> f64 {
        self.minimize(q, free, CLOSED, |q| self.values(rows, q))
    }

    /// Does the same until the largest residual is `enough`.
    pub fn assemble_to(&self, rows: &[LoopRow], q: &mut [Dd], free: &[usize], enough: f64) -> f64 {
        self.minimize(q, free, enough, |q| self.values(rows, q))
    }

    /// Changes the positions of these velocities as little as possible so that residuals with these rates become small,
    /// until the largest is `enough` (Levenberg and Marquardt's method). Returns the largest residual.
    pub(super) fn minimize(
        &self,
        q: &mut [Dd],
        free: &[usize],
        enough: f64,
        values: impl Fn(&[Dd]) -> (Vec<Dd>, Vec<Vec<Dd>>),
    ) -> f64 {
        let mut damping = 1e-3;
        let (mut residuals, mut jacobian) = values(q);
        for _ in 0..STEPS {
            let size = square(&residuals);
            if largest(&residuals) <= enough {
                break;
            }
            let Some(step) = least_step(&jacobian, &residuals, free, damping) else {
                break;
            };
            let mut moved = q.to_vec();
            self.move_by(&mut moved, &step);
            let (found, there) = values(&moved);
            if square(&found) < size {
                q.copy_from_slice(&moved);
                (residuals, jacobian) = (found, there);
                damping = f64::max(damping * 0.02, 1e-22);
            } else {
                damping *= 8.0;
                if damping > 1e6 {
                    break;
                }
            }
        }
        largest(&residuals)
    }

    /// Returns positions of the tree at which the loops are open: the start, with the loops' joints anywhere.
    pub fn open_positions(&self) -> Vec<Vec<Dd>> {
        let anywhere = |seed| {
            let (mut random, mut q) = (Random(seed), self.start.clone());
            for p in self.moved_positions() {
                q[p.0] = Dd::from_f64(3.0 * random.signed());
            }
            self.normalize(&mut q);
            q
        };
        (0..OPEN).map(anywhere).collect()
    }

    /// Moves the positions of the loops' joints a random way through closed positions; once the signs of the start
    /// are known, on its branch.
    pub fn walk(&self, rows: &[LoopRow], q: &mut [Dd], random: &mut Random) {
        let free: Vec<usize> = self.moving();
        for _ in 0..WALK.0 {
            let (_, jacobian) = self.values(rows, q);
            let direction: Vec<Dd> = free.iter().map(|_| Dd::from_f64(random.signed())).collect();
            let along = |row: &Vec<Dd>| dot(free.iter().map(|&j| row[j]), &direction);
            let off: Vec<Dd> = jacobian.iter().map(along).collect();
            let Some(back) = least_step(&jacobian, &off, &free, 1e-20) else {
                continue;
            };
            let size = Dd::from_f64(WALK.1);
            let tangent = direction
                .iter()
                .zip(&back)
                .map(|(&x, (j, y))| (*j, (x + *y) * size));
            let mut moved = q.to_vec();
            self.move_by(&mut moved, &tangent.collect::<Vec<_>>());
            let closed = self.assemble(rows, &mut moved, &free) <= CLOSED;
            if closed
                && self.flat_wheel(&moved, LEAST_COSINE).is_none()
                && self.signs_at(&moved) == self.signs
            {
                q.copy_from_slice(&moved);
            }
        }
    }

    /// Returns the first wheel whose lean has a cosine below `least`. Where it is 0 other branches of positions begin,
    /// on which the wheel lies flat whatever else moves.
    pub fn flat_wheel(&self, q: &[Dd], least: f64) -> Option<usize> {
        let axes = RowAxes {
            reversed: false,
            of_plane: false,
            closed: false,
        };
        let cosine = |closes| {
            self.rows_at(closes, axes, (q, &DoubleDouble))
                .cosine_of_lean()
        };
        let flat = |&closes: &usize| cosine(closes).is_some_and(|x| x.to_f64().abs() < least);
        (0..self.loops.len()).find(flat)
    }

    /// Returns for each block whether the determinant of its columns is positive; none before the signs of the start
    /// are known.
    pub fn signs_at(&self, q: &[Dd]) -> Vec<bool> {
        let jacobian = self.solved_rates(q);
        let positive = |block: &ClosureBlock| {
            let rows = block.rows.iter();
            let columns = |&r: &usize| block.dependents.iter().map(|j| jacobian[r][j.0]).collect();
            is_positive(rows.map(columns).collect())
        };
        self.blocks.iter().map(positive).collect()
    }

    /// Returns the velocities of the joints in loops and contacts.
    pub fn moving(&self) -> Vec<usize> {
        let compounds = self.compounds.iter();
        let of_compounds: Vec<usize> = compounds
            .flat_map(|joint| joint.degrees.velocities.iter().map(|j| j.0))
            .collect();
        let all = 0..self.positions.len();
        all.filter(|j| self.positions[*j].is_some() || of_compounds.contains(j))
            .collect()
    }

    /// Returns on which side of the line from the first link's joint to the last link's the places of a planar
    /// loop lie: positive for left, seen against the loop's axis.
    pub fn side(&self, closes: usize, q: &[Dd]) -> Option<f64> {
        let one = &self.loops[closes];
        let axis = one.axis?;
        let frames = one.chain.frames(q, &DoubleDouble);
        let [p, o] = frames.pivots();
        Some((o - p).cross(-p).dot(axis).to_f64())
    }

    /// Returns whether a rotation that is held is turned by half a turn.
    pub fn flipped(&self, closes: usize, q: &[Dd]) -> bool {
        let one = &self.loops[closes];
        let frames = one.chain.frames(q, &DoubleDouble);
        let place = one.chain.place(&frames, TwistPoint::B, &DoubleDouble);
        let turned = place.rotation.0;
        let names = one.kind.rows.iter().map(|(name, _)| *name);
        let held = |axis: &str| names.clone().any(|name| name.starts_with(axis));
        let against = |k: usize| turned[k][k] < Dd::ZERO;
        (held("turn") && (0..3).any(against)) || (held("tilt") && against(2))
    }

    /// Adds the steps to the positions, scaled down if one is large.
    fn move_by(&self, q: &mut [Dd], steps: &[(usize, Dd)]) {
        let largest = steps
            .iter()
            .map(|(_, x)| x.to_f64().abs())
            .fold(0.0, f64::max);
        let scale = Dd::from_f64(f64::min(1.0, LARGEST_STEP / largest));
        let scaled = steps.iter().map(|&(j, step)| (j, step * scale));
        self.displace(q, &scaled.collect::<Vec<_>>());
    }

    /// Adds the steps to the positions: q + N(q) v, with quaternions of length 1.
    pub fn displace(&self, q: &mut [Dd], steps: &[(usize, Dd)]) {
        for &(j, step) in steps {
            if let Some(p) = self.positions[j] {
                q[p.0] += step;
            }
        }
        for joint in &self.compounds {
            let Motion::Compound(motion) = joint.motion else {
                continue;
            };
            let of = |j: &usize| steps.iter().find(|(k, _)| k == j).map(|(_, x)| *x);
            let velocities = joint.degrees.velocities.iter();
            let own: Vec<Dd> = velocities.map(|j| of(&j.0).unwrap_or(Dd::ZERO)).collect();
            let positions = &joint.degrees.positions;
            let at: Vec<Dd> = positions.iter().map(|p| q[p.0]).collect();
            let rates = motion.position_rates(
                &joint.degrees.constants(joint.axis),
                (&at, &own),
                &DoubleDouble,
            );
            for (p, rate) in positions.iter().zip(rates) {
                q[p.0] += rate;
            }
        }
        self.normalize(q);
    }

    /// Scales the quaternions of the contacts' joints to length 1.
    pub fn normalize(&self, q: &mut [Dd]) {
        for joint in &self.compounds {
            let Motion::Compound(motion) = joint.motion else {
                continue;
            };
            let Some(first) = motion.quaternion() else {
                continue;
            };
            let own = &joint.degrees.positions[first..first + 4];
            let square = own.iter().fold(Dd::ZERO, |sum, p| sum + q[p.0] * q[p.0]);
            let length = square.sqrt();
            own.iter().for_each(|p| q[p.0] /= length);
        }
    }
}

/// Returns the shortest x of these velocities with B x = −c, damped: −Bᵀ (B Bᵀ + μ)⁻¹ c.
fn least_step(
    jacobian: &[Vec<Dd>],
    residuals: &[Dd],
    free: &[usize],
    damping: f64,
) -> Option<Vec<(usize, Dd)>> {
    let columns: Vec<Vec<Dd>> = jacobian
        .iter()
        .map(|row| free.iter().map(|&j| row[j]).collect())
        .collect();
    let mut normal: Vec<Vec<Dd>> = columns
        .iter()
        .map(|row| {
            columns
                .iter()
                .map(|other| dot(row.iter().copied(), other))
                .collect()
        })
        .collect();
    let trace = (0..normal.len()).fold(0.0, |sum, k| sum + normal[k][k].to_f64());
    for (k, row) in normal.iter_mut().enumerate() {
        row[k] += Dd::from_f64(damping * f64::max(trace, 1e-12));
    }
    if normal.is_empty() {
        return Some(free.iter().map(|&j| (j, Dd::ZERO)).collect());
    }
    let multipliers = solve(normal, &[residuals.to_vec()], 0.0)?.remove(0);
    let step = free.iter().enumerate().map(|(k, &j)| {
        let sum = dot(columns.iter().map(|row| row[k]), &multipliers);
        (j, -sum)
    });
    Some(step.collect())
}

fn dot(x: impl Iterator<Item = Dd>, y: &[Dd]) -> Dd {
    x.zip(y).fold(Dd::ZERO, |sum, (x, y)| sum + x * *y)
}

fn square(x: &[Dd]) -> f64 {
    x.iter().map(|x| x.to_f64() * x.to_f64()).sum()
}

/// Returns the largest size; infinite if one is no number.
fn largest(x: &[Dd]) -> f64 {
    let size = |x: &Dd| match x.to_f64().abs() {
        size if size.is_nan() => f64::INFINITY,
        size => size,
    };
    x.iter().map(size).fold(0.0, f64::max)
}
