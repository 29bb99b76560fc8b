//! How far an independent joint moves with the loops closed, and how well the others follow there.

use std::cell::Cell;

use bgdyn_runtime::Dd;

use super::solve::rank;
use super::way::Way;
use super::{Closure, LoopRow, solve};
use crate::mechanism::CoordinateId;

/// Steps of a turn, or of the way to both limits.
const STEPS: f64 = 180.0;

/// Without limits a slide is followed this many sizes of the largest loop.
const SIZES: f64 = 4.0;

/// The largest motion of a dependent joint in a step, rad or m: beyond, it is on another branch.
const JUMP: f64 = 0.7;

/// A condition number above this is that of a singular position.
const SINGULAR: f64 = 1e12;

/// What ends a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RangeEnd {
    /// The loops do not close beyond, or lose their branch.
    Reach,
    /// Branches meet there: which one follows is not determined.
    BranchesMeet,
    /// The joint's limit, or that of a dependent joint with this index in the open tree.
    Limit(CoordinateId),
    /// Nothing: a whole turn from the start, or as far as was followed.
    None,
}

/// The positions of an independent joint at which the loops close; the other independent joints stay at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedRange {
    /// The joint, in the open tree.
    pub joint: CoordinateId,
    /// The first and the last position, rad or m.
    pub ends: [f64; 2],
    /// What ends the range there.
    pub why: [RangeEnd; 2],
    /// The least and the largest condition number of the dependent columns of the rows, ‖J‖∞ ‖J⁻¹‖∞, each with the
    /// position, at steps of 2° or of a 180th of the way.
    pub condition: [(f64, f64); 2],
}

/// Limits of the positions of the open tree's velocities, rad or m.
pub type TreeLimits = [[Option<f64>; 2]];

impl Closure {
    /// Returns the range of each independent joint in a loop, without those of joints with several velocities;
    /// `turns` tells for each velocity of the open tree whether it is a rotation.
    pub fn ranges(&self, limits: &TreeLimits, turns: &[bool]) -> Vec<ClosedRange> {
        let own = self.independents.iter().copied();
        let own = own.filter(|j| self.positions[j.0].is_some() && !self.nonholonomic());
        own.map(|j| self.range(j, limits, turns[j.0])).collect()
    }

    fn range(&self, joint: CoordinateId, limits: &TreeLimits, turns: bool) -> ClosedRange {
        let at = self.positions[joint.0].map_or(0, |p| p.0);
        let start = self.start[at].to_f64();
        let far = match turns {
            true => std::f64::consts::TAU,
            false => SIZES * self.size(),
        };
        let of_start = (self.condition(&self.start), start);
        let mut range = ClosedRange {
            joint,
            ends: [start; 2],
            why: [RangeEnd::None; 2],
            condition: [of_start; 2],
        };
        // Upward first: after a whole turn there is nothing left.
        for (end, sign) in [(1, 1.0), (0, -1.0)] {
            let limit = limits[joint.0][end].map(|limit| sign * (limit - start));
            let way = limit.map_or(far, |limit| limit.max(0.0));
            let (reached, why) = self.follow((joint, at), (sign, way), limits, &mut range);
            range.ends[end] = reached;
            range.why[end] = match (why, limit) {
                (RangeEnd::None, Some(_)) => RangeEnd::Limit(joint),
                (why, _) => why,
            };
            if turns && range.why[end] == RangeEnd::None {
                return range;
            }
        }
        range
    }

    /// Follows the closed positions along a joint. Returns its last position, and what ended the way.
    fn follow(
        &self,
        (joint, at): (CoordinateId, usize),
        (sign, way): (f64, f64),
        limits: &TreeLimits,
        range: &mut ClosedRange,
    ) -> (f64, RangeEnd) {
        let start = self.start[at].to_f64();
        let whole = way / STEPS;
        let rows = self.position_rows();
        let free: Vec<usize> = self.closing().map(|j| j.0).collect();
        let (mut q, mut gone) = (self.start.clone(), 0.0);
        let mut walk = Way::new((self, &rows, &free), whole);
        let why = Cell::new(RangeEnd::None);
        while gone < way {
            let next = f64::min(gone + whole, way);
            let moved = walk.go(&mut q, (gone, next), |q, gone| {
                let step = self.step_to(q, (joint, at, start + sign * gone), limits);
                why.set(step.as_ref().err().copied().unwrap_or(RangeEnd::Reach));
                step.ok()
            });
            if let Err(reached) = moved {
                let beyond = |part| self.near(&q, at, start + sign * (reached + part)).is_some();
                let meet = why.get() == RangeEnd::Reach && walk.closes_beyond(beyond);
                let why = if meet {
                    RangeEnd::BranchesMeet
                } else {
                    why.get()
                };
                return (start + sign * reached, why);
            }
            gone = next;
            note(range, (self.condition(&q), start + sign * gone));
        }
        (start + sign * gone, RangeEnd::None)
    }

    /// Returns the closed position with this one of a joint, near q, on the branch of the mechanism and within the limits.
    fn step_to(
        &self,
        q: &[Dd],
        (joint, at, to): (CoordinateId, usize, f64),
        limits: &TreeLimits,
    ) -> Result<Vec<Dd>, RangeEnd> {
        let moved = self.near(q, at, to).ok_or(RangeEnd::Reach)?;
        if self.signs_at(&moved) != self.signs || self.condition(&moved) > SINGULAR {
            return Err(RangeEnd::Reach);
        }
        let outside = |j: &CoordinateId| {
            let Some(p) = self.positions[j.0] else {
                return false;
            };
            let x = moved[p.0].to_f64();
            let [lower, upper] = limits[j.0];
            // A start beyond a limit may come closer to it.
            let from = self.start[p.0].to_f64();
            lower.is_some_and(|least| x < f64::min(least, from))
                || upper.is_some_and(|most| x > f64::max(most, from))
        };
        match self.dependents().find(outside) {
            Some(j) if j != joint => Err(RangeEnd::Limit(j)),
            _ => Ok(moved),
        }
    }

    /// Returns the closed position with this position of a joint, near q.
    fn near(&self, q: &[Dd], at: usize, to: f64) -> Option<Vec<Dd>> {
        let mut moved = q.to_vec();
        moved[at] = Dd::from_f64(to);
        let closes = self.close(&mut moved);
        let mut parts = moved.iter().zip(q);
        let jumps = parts.any(|(x, y)| (*x - *y).to_f64().abs() > JUMP);
        (closes && !jumps).then_some(moved)
    }

    /// Returns ‖J‖∞ ‖J⁻¹‖∞ of the dependent columns J of the rows that are solved; infinite at a singular position.
    pub fn condition(&self, q: &[Dd]) -> f64 {
        let rates = self.solved_rates(q);
        let dependents: Vec<usize> = self.dependents().map(|j| j.0).collect();
        let part = |row: &Vec<Dd>| dependents.iter().map(|&j| row[j]).collect();
        let matrix: Vec<Vec<Dd>> = rates.iter().map(part).collect();
        let unit = |k: usize| {
            let entry = |i: usize| if i == k { Dd::ONE } else { Dd::ZERO };
            (0..matrix.len()).map(entry).collect()
        };
        let units: Vec<Vec<Dd>> = (0..matrix.len()).map(unit).collect();
        let norm = |sums: Vec<f64>| sums.into_iter().fold(0.0, f64::max);
        let size = |row: &Vec<Dd>| row.iter().map(|x| x.to_f64().abs()).sum();
        let own = norm(matrix.iter().map(size).collect());
        // The columns of the inverse.
        let Some(inverse) = solve(matrix, &units, 1e-28) else {
            return f64::INFINITY;
        };
        let row = |i: usize| inverse.iter().map(|column| column[i].to_f64().abs()).sum();
        own * norm((0..inverse.len()).map(row).collect())
    }

    /// Returns the rank of all rows, with those that follow from others, of each loop and at last of all loops: at closed
    /// positions, and at random positions of the joints.
    pub fn ranks(&self) -> Vec<[usize; 2]> {
        let following = self.following.iter().map(|one| one.row);
        let all: Vec<LoopRow> = self.rows.iter().copied().chain(following).collect();
        let of_loop = |closes: usize| -> Vec<LoopRow> {
            let own = all.iter().filter(|row| row.closes == closes);
            own.copied().collect()
        };
        let loops = (0..self.loops.len()).map(of_loop);
        let sets: Vec<Vec<LoopRow>> = loops.chain([all.clone()]).collect();
        let open = self.open_positions();
        let rank_at = |rows: &[LoopRow], q: &Vec<Dd>| {
            let (_, mut jacobian) = self.values(rows, q);
            rank(&mut jacobian, self.positions.len())
        };
        let most = |rows: &[LoopRow], at: &[Vec<Dd>]| {
            let ranks = at.iter().map(|q| rank_at(rows, q));
            ranks.max().unwrap_or(0)
        };
        let both = |rows: &Vec<LoopRow>| [most(rows, &self.samples), most(rows, &open)];
        sets.iter().map(both).collect()
    }
}

/// Adds a condition number with its position.
fn note(range: &mut ClosedRange, found: (f64, f64)) {
    let [least, largest] = &mut range.condition;
    if found.0 < least.0 {
        *least = found;
    }
    if found.0 > largest.0 {
        *largest = found;
    }
}
