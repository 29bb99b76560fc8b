//! Closed positions with given ones: a start, locked joints.
//!
//! Given positions are reached from the closed position of the mechanism in small parts, closed after each, so that the
//! branch stays that of the mechanism.

use bgdyn_runtime::Dd;

use super::way::Way;
use super::{Closure, Gap, LoopRow};

/// The largest part of the way from the closed position of the mechanism to the given one.
const LARGEST_PART: f64 = 1.0 / 32.0;

/// The largest motion of a given joint in one part, rad or m, on ways that are not thousands of parts long.
const LARGEST_STEP: f64 = 0.5;

/// The least of the largest parts.
const LEAST_PART: f64 = 1.0 / 4096.0;

/// A residual below this is that of a closed position.
const CLOSED: f64 = 1e-25;

/// A residual below this, which is approached slowly near singular positions, is that of a closed position too.
const ALMOST_CLOSED: f64 = 1e-12;

/// Largest difference of a given dependent position or velocity from that of the closed start: rad, m, or per second.
const AGREES: f64 = 1e-3;

/// The reason why positions or velocities do not exist in closed loops.
#[derive(Clone, Debug, PartialEq)]
pub enum Unreached {
    /// A loop stays open.
    Open {
        /// Its name.
        closes: String,
        /// Whether it is a wheel, a ball or a knife edge.
        touches: bool,
        /// The gap of the closest assembly found.
        gap: Gap,
        /// On the way from the mechanism's own position the last ones at which the loops close: indices of positions, and
        /// values. Empty if no single position moves on the way.
        nearest: Vec<(usize, f64)>,
    },
    /// The way to the given positions leads to where branches meet: indices of positions that move on the way, and their
    /// values there.
    BranchesMeet(Vec<(usize, f64)>),
    /// The given positions are on another branch than the mechanism, or singular.
    OtherBranch,
    /// The loops give a position or a velocity that differs from the given one.
    Contradicts {
        /// The position's index, or that of the velocity in the open tree.
        index: usize,
        /// Whether it is a velocity.
        velocity: bool,
        /// The given number.
        given: f64,
        /// That of the closed start.
        closed: f64,
    },
    /// The loops hold a joint with a given velocity, whatever the others do.
    Still {
        /// The velocity's index in the open tree.
        index: usize,
        /// The given number.
        given: f64,
        /// By how much less than elsewhere the joint moves with the others.
        part: f64,
    },
}

impl Closure {
    /// Closes positions of which those with the indices `given` are given. Positions outside of loops do not change.
    ///
    /// # Errors
    /// If the loops do not close at these on the branch of the mechanism.
    pub fn reach(&self, q: &mut [Dd], given: &[usize]) -> Result<(), Unreached> {
        let rows = self.position_rows();
        let closers: Vec<usize> = self.closing().map(|j| j.0).collect();
        let (moving, of_several): (Vec<usize>, Vec<usize>) = self
            .moving()
            .into_iter()
            .partition(|j| self.positions[*j].is_some());
        let closers_of_several = of_several.into_iter().filter(|j| closers.contains(j));
        let closers_of_several: Vec<usize> = closers_of_several.collect();
        let is_given = |j: &usize| self.positions[*j].is_some_and(|p| given.contains(&p.0));
        let independent = |j: &usize| !closers.contains(j);
        let freedoms = moving.len() + closers_of_several.len() - rows.len();
        // Given positions are kept, independent ones first, as many as the loops leave free; the other independent
        // ones too, unless dependent ones are given. Those of joints with several velocities change along the
        // velocities by which wheels touch, and not otherwise.
        let (first, second): (Vec<usize>, Vec<usize>) = moving
            .iter()
            .copied()
            .filter(|j| is_given(j))
            .partition(|j| independent(j));
        let others = moving.iter().copied();
        let others = others.filter(|j| second.is_empty() && !is_given(j) && independent(j));
        let others: Vec<usize> = others.collect();
        let kept = first.into_iter().chain(second).chain(others);
        let kept: Vec<usize> = kept.take(freedoms).collect();
        let free: Vec<usize> = moving
            .iter()
            .copied()
            .filter(|j| !kept.contains(j))
            .chain(closers_of_several)
            .collect();
        let target = q.to_vec();
        let position = |j: usize| self.positions[j].map_or(0, |p| p.0);
        for &j in &moving {
            q[position(j)] = self.start[position(j)];
        }
        let poses = self.given_poses(given);
        for &p in &poses {
            q[p] = self.start[p];
        }
        let kept: Vec<usize> = kept.into_iter().map(position).collect();
        self.go_to(q, (&target, &kept), (&rows, &free))?;
        if !poses.is_empty() {
            let unposed = q.to_vec();
            poses.iter().for_each(|&p| q[p] = target[p]);
            if self.assemble(&rows, q, &free) > CLOSED {
                return Err(self.open(q, Vec::new()));
            }
            let differs = |&p: &usize| agrees(p, false, (target[p], q[p])).is_err();
            if poses.iter().any(differs) {
                // In reach of joints that are not given, perhaps.
                let pins: Vec<(usize, Dd)> = poses.iter().map(|&p| (p, target[p])).collect();
                let all = self.moving().into_iter().filter(|j| !is_given(j));
                let mut drawn = unposed;
                let leads = self.draw_to(&mut drawn, &pins, (&rows, &all.collect::<Vec<_>>()));
                let differs = |&p: &usize| agrees(p, false, (target[p], drawn[p])).is_err();
                if leads && !poses.iter().any(differs) {
                    q.copy_from_slice(&drawn);
                }
            }
        }
        if self.signs_at(q) != self.signs {
            return Err(Unreached::OtherBranch);
        }
        let further = moving.iter().filter(|j| is_given(j)).map(|&j| position(j));
        let further = further.filter(|p| !kept.contains(p));
        for p in further.chain(poses) {
            agrees(p, false, (target[p], q[p]))?;
        }
        Ok(())
    }

    /// Moves the positions `kept` from the closed position of the mechanism to their targets, and closes the rows along
    /// the `free` velocities.
    fn go_to(
        &self,
        q: &mut [Dd],
        (target, kept): (&[Dd], &[usize]),
        (rows, free): (&[LoopRow], &[usize]),
    ) -> Result<(), Unreached> {
        let set = |q: &mut [Dd], share: f64| {
            for &p in kept {
                let (from, to) = (self.start[p], target[p]);
                // In the scalar of most models.
                q[p] = Dd::from_f64((from + (to - from) * Dd::from_f64(share)).to_f64());
            }
        };
        let closed = |q: &[Dd], share: f64| {
            let mut moved = q.to_vec();
            set(&mut moved, share);
            (self.assemble(rows, &mut moved, free) <= CLOSED).then_some(moved)
        };
        let moves = |p: &usize| target[*p] != self.start[*p];
        let moved: Vec<usize> = kept.iter().copied().filter(moves).collect();
        let change = |p: &usize| (target[*p] - self.start[*p]).to_f64().abs();
        let longest = moved.iter().map(change).fold(0.0, f64::max);
        let mut at = closed(q, 0.0).ok_or_else(|| self.open(q, Vec::new()))?;
        let reached = match longest > 0.0 {
            true => {
                let part = LARGEST_PART.min(LARGEST_STEP / longest).max(LEAST_PART);
                let mut way = Way::new((self, rows, free), part);
                let reached = way.go(&mut at, (0.0, 1.0), closed);
                let beyond = |share: f64| {
                    let mut moved = at.clone();
                    set(&mut moved, f64::min(1.0, share));
                    self.assemble(rows, &mut moved, free) <= ALMOST_CLOSED
                };
                reached.map_err(|share| way.closes_beyond(|part| beyond(share + part)))
            }
            false => Ok(()),
        };
        q.copy_from_slice(&at);
        let Err(others) = reached else {
            set(q, 1.0);
            return Ok(());
        };
        let last = moved.iter().map(|&p| (p, at[p].to_f64())).collect();
        if others {
            return Err(Unreached::BranchesMeet(last));
        }
        set(q, 1.0);
        self.assemble(rows, q, free);
        Err(self.open(q, last))
    }

    fn open(&self, q: &[Dd], nearest: Vec<(usize, f64)>) -> Unreached {
        let (closes, gap) = self.widest_gap(q);
        Unreached::Open {
            closes: self.loops[closes].name.clone(),
            touches: self.loops[closes].contact.is_some(),
            gap,
            nearest,
        }
    }

    /// Returns the given positions of joints in loops with several velocities. Where they end depends on the way, so that
    /// they are set after the others. Wheels bring theirs to the planes, from the first part on.
    fn given_poses(&self, given: &[usize]) -> Vec<usize> {
        if self.nonholonomic() {
            return Vec::new();
        }
        let all = self
            .compounds
            .iter()
            .flat_map(|joint| &joint.degrees.positions);
        all.map(|p| p.0).filter(|p| given.contains(p)).collect()
    }
}

/// Returns the contradiction if a given position or velocity differs from that of the closed start.
pub(super) fn agrees(
    index: usize,
    velocity: bool,
    (given, closed): (Dd, Dd),
) -> Result<(), Unreached> {
    let (given, closed) = (given.to_f64(), closed.to_f64());
    match (given - closed).abs() <= AGREES * f64::max(1.0, closed.abs()) {
        true => Ok(()),
        false => Err(Unreached::Contradicts {
            index,
            velocity,
            given,
            closed,
        }),
    }
}
