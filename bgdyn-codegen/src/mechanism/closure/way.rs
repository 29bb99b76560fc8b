//! Ways through closed positions that pass none at which branches meet.
//!
//! Where branches meet, the rows r_i of the loops depend on each other, in the columns of the joints that follow. How
//! far they are from that tells their volume V = Π ‖r_i⊥‖, with the part r_i⊥ of each row that is perpendicular to those
//! before it (Gram and Schmidt), with the sign of the determinant if there are as many joints. A part of the way on which V falls to less than 0.6 is made smaller. V vanishes in
//! proportion to the distance d: parts of at most 1.3 d, beyond which V is below 0.3, do not lead over the position.

use bgdyn_runtime::Dd;

use super::solve::is_positive;
use super::{Closure, LoopRow};

/// V may fall to this part of itself in one part of the way.
const FALL: f64 = 0.6;

/// The growth of a part after another one.
const GROWTH: f64 = 1.3;

/// The first part, over the largest one: the start may be close to a position at which branches meet.
const FIRST: f64 = 1.0 / 256.0;

/// The smallest part, over the largest one.
const LEAST: f64 = 1e-7;

/// How far beyond its end a way is tried, over the largest part.
const BEYOND: [f64; 2] = [1e-3, 1e-1];

/// A way through closed positions along which these velocities follow.
pub(super) struct Way<'a> {
    closure: &'a Closure,
    rows: &'a [LoopRow],
    free: &'a [usize],
    largest: f64,
    part: f64,
}

impl<'a> Way<'a> {
    /// Returns a way with the rows that close along the `free` velocities, in parts of at most this size.
    pub(super) fn new(
        (closure, rows, free): (&'a Closure, &'a [LoopRow], &'a [usize]),
        largest: f64,
    ) -> Self {
        Way {
            closure,
            rows,
            free,
            largest,
            part: FIRST * largest,
        }
    }

    /// Goes on from one place of the way to another one. `closed` returns the closed position at a place, near another one.
    ///
    /// # Errors
    /// With the place up to which it leads; `q` is the position there.
    pub(super) fn go(
        &mut self,
        q: &mut Vec<Dd>,
        (from, to): (f64, f64),
        closed: impl Fn(&[Dd], f64) -> Option<Vec<Dd>>,
    ) -> Result<(), f64> {
        let (mut gone, mut volume) = (from, self.volume(q));
        while gone < to {
            let next = match to - gone <= self.part {
                true => to,
                false => gone + self.part,
            };
            let moved = closed(q, next).map(|moved| (self.volume(&moved), moved));
            match moved.filter(|(there, _)| *there * volume >= FALL * volume * volume) {
                Some((there, moved)) => {
                    *q = moved;
                    (gone, volume) = (next, there);
                    self.part = f64::min(GROWTH * self.part, self.largest);
                }
                None => {
                    self.part = 0.5 * (next - gone);
                    if self.part < LEAST * self.largest {
                        return Err(gone);
                    }
                }
            }
        }
        Ok(())
    }

    /// Returns whether the loops close beyond the place up to which a way leads, by how far: other branches begin there.
    pub(super) fn closes_beyond(&self, closes: impl Fn(f64) -> bool) -> bool {
        let mut beyond = BEYOND.iter();
        beyond.any(|part| closes(part * self.largest))
    }

    fn volume(&self, q: &[Dd]) -> f64 {
        let parts = self.closure.perpendicular_parts(self.rows, self.free, q);
        let volume: f64 = parts.into_iter().map(|(part, _)| part).product();
        match self.rows.len() == self.free.len()
            && !self.closure.is_positive_at(self.rows, self.free, q)
        {
            true => -volume,
            false => volume,
        }
    }
}

impl Closure {
    /// Returns whether the determinant of as many rows and columns is positive.
    fn is_positive_at(&self, rows: &[LoopRow], free: &[usize], q: &[Dd]) -> bool {
        let (_, jacobian) = self.values(rows, q);
        let columns = |row: &Vec<Dd>| free.iter().map(|&j| row[j]).collect();
        is_positive(jacobian.iter().map(columns).collect())
    }

    /// Returns for each row, in the columns of these velocities, ‖r⊥‖ of the part that those before it do not determine, and
    /// ‖r‖.
    pub fn perpendicular_parts(
        &self,
        rows: &[LoopRow],
        free: &[usize],
        q: &[Dd],
    ) -> Vec<(f64, f64)> {
        let (_, jacobian) = self.values(rows, q);
        let mut units: Vec<Vec<Dd>> = Vec::new();
        let part = |all: &Vec<Dd>| {
            let mut row: Vec<Dd> = free.iter().map(|&j| all[j]).collect();
            let whole = dot(&row, &row).sqrt();
            for unit in &units {
                let along = dot(&row, unit);
                row.iter_mut().zip(unit).for_each(|(x, &y)| *x -= along * y);
            }
            let left = dot(&row, &row).sqrt();
            if left > Dd::ZERO {
                units.push(row.iter().map(|&x| x / left).collect());
            }
            (left.to_f64(), whole.to_f64())
        };
        jacobian.iter().map(part).collect()
    }
}

fn dot(x: &[Dd], y: &[Dd]) -> Dd {
    x.iter().zip(y).fold(Dd::ZERO, |sum, (&x, &y)| sum + x * y)
}
