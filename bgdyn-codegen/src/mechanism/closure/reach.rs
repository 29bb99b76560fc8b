//! Closed positions with given ones: a start, locked joints.
//!
//! Given positions are reached from the closed position of the mechanism in small parts, closed after each, so that the
//! branch stays that of the mechanism.

use bgdyn_runtime::Dd;

use super::Closure;

/// Parts of the way from the closed position of the mechanism to the given one.
const PARTS: u32 = 32;

/// A residual below this is that of a closed position.
const CLOSED: f64 = 1e-25;

/// Largest difference of a given dependent position or velocity from that of the closed start: rad, m, or per second.
const AGREES: f64 = 1e-3;

/// The reason why positions or velocities do not exist in closed loops.
#[derive(Clone, Debug, PartialEq)]
pub enum Unreached {
    /// A loop stays open by this gap, m or rad, in this row.
    Open {
        /// Its name.
        closes: String,
        /// The row.
        row: &'static str,
        /// The gap.
        gap: f64,
        /// The part of the way from the mechanism's own position up to which the loops close, 0 to 1.
        part: f64,
    },
    /// The way to the given positions leads through a singular position, to another branch.
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
        for part in 1..=PARTS {
            let share = Dd::from_f64(f64::from(part) / f64::from(PARTS));
            for &j in &kept {
                let (from, to) = (self.start[position(j)], target[position(j)]);
                // In the scalar of most models.
                q[position(j)] = Dd::from_f64((from + (to - from) * share).to_f64());
            }
            let gap = self.assemble(&rows, q, &free);
            if gap > CLOSED {
                return Err(open(self, q, gap, f64::from(part - 1) / f64::from(PARTS)));
            }
        }
        if !poses.is_empty() {
            poses.iter().for_each(|&p| q[p] = target[p]);
            let gap = self.assemble(&rows, q, &free);
            if gap > CLOSED {
                return Err(open(self, q, gap, 1.0));
            }
        }
        if self.signs_at(q) != self.signs {
            return Err(Unreached::OtherBranch);
        }
        let further = moving.iter().filter(|j| is_given(j) && !kept.contains(j));
        let further = further.map(|&j| position(j));
        for p in further.chain(poses) {
            agrees(p, false, (target[p], q[p]))?;
        }
        Ok(())
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

fn open(closure: &Closure, q: &[Dd], gap: f64, part: f64) -> Unreached {
    let (residuals, _) = closure.values(&closure.position_rows(), q);
    let sizes = residuals.iter().map(|x| x.to_f64().abs());
    let worst = sizes.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    let row = closure.position_rows()[worst.map_or(0, |(row, _)| row)];
    Unreached::Open {
        closes: closure.loops[row.closes].name.clone(),
        row: row.name,
        gap,
        part,
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
