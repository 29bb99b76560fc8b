//! Locked joints of a mechanism with loops.
//!
//! The file has the positions at which the loops close with them, and what their check begins with.

use bgdyn_runtime::Dd;

use super::closure::{ChainStep, Unreached, eliminate};
use super::{LinkId, Mechanism, Motion, PositionId};
use crate::format::{Field, LoopSpec, Spec};

/// An entry below this is a rounding error, relative to the pivot of its row.
const ROUNDING: f64 = 1e-18;

/// The joints of a mechanism with loops that cannot move.
pub(crate) struct LockedTree<'a> {
    /// The mechanism in which they move.
    of: &'a Mechanism,
    /// All its positions, closed, with the locked joints where they are locked.
    q: Vec<Dd>,
    /// The links of the joints that cannot move, and their positions, rad or m: those that are locked, and those that
    /// the loops hold then.
    still: Vec<(LinkId, Dd)>,
    /// Whether only independent joints are locked, so that the others still determine the rest.
    keeps_independents: bool,
}

impl Mechanism {
    /// Returns all positions, with the loops closed and the joints of these links at these positions.
    ///
    /// # Errors
    /// If the loops do not close there on the branch of the mechanism.
    fn closed_with(&self, locks: &[(LinkId, Dd)]) -> Result<Vec<Dd>, Unreached> {
        let Some(closure) = self.closure() else {
            return Ok(Vec::new());
        };
        let mut q = closure.start.clone();
        let mut given = Vec::new();
        for (link, at) in locks {
            for position in self.links[link.0].joint.degrees.positions.iter().take(1) {
                q[position.0] = *at;
                given.push(position.0);
            }
        }
        closure.reach(&mut q, &given)?;
        Ok(q)
    }
}

impl<'a> LockedTree<'a> {
    /// Locks the joints of these links at these positions, rad or m.
    ///
    /// # Errors
    /// If the loops do not close there on the branch of the mechanism.
    pub(crate) fn new(of: &'a Mechanism, locks: &[(LinkId, Dd)]) -> Result<Self, Unreached> {
        let q = of.closed_with(locks)?;
        let position = |link: LinkId| of.links[link.0].joint.degrees.positions.first();
        let at = |&(link, at): &(LinkId, Dd)| (link, position(link).map_or(at, |p| q[p.0]));
        let mut still: Vec<(LinkId, Dd)> = locks.iter().map(at).collect();
        let keeps_independents = still
            .iter()
            .all(|(link, _)| of.coordinates().contains(link));
        for p in held(of, &q, &still) {
            still.push((of.positions()[p.0], q[p.0]));
        }
        Ok(Self {
            of,
            q,
            still,
            keeps_independents,
        })
    }

    /// Returns the name of the mechanism.
    pub(crate) fn name(&self) -> &'a str {
        self.of.name()
    }

    /// Returns the open tree in which these joints are locked.
    pub(crate) fn lock(&self, tree: &Mechanism) -> Mechanism {
        tree.locked(&self.still)
    }

    /// Returns the positions of the mechanism with locked joints.
    pub(crate) fn start(&self, locked: &Mechanism) -> Vec<Dd> {
        let place = |(p, link): (usize, &LinkId)| {
            let own = &locked.links[link.0].joint.degrees.positions;
            let part = own.iter().position(|x| x.0 == p).unwrap_or(0);
            let before = &self.of.links[link.0].joint.degrees.positions;
            before.get(part).map_or(Dd::ZERO, |x| self.q[x.0])
        };
        locked.positions().iter().enumerate().map(place).collect()
    }

    /// Returns the spec without loops in which nothing moves, without positions to start from, and with those
    /// independent joints that still move. Where a dependent joint is locked they would be too many: none.
    pub(crate) fn spec(&self, spec: &Spec) -> Spec {
        let mut spec = spec.clone();
        let names: Vec<&str> = self
            .still
            .iter()
            .map(|(link, _)| self.joint(*link))
            .collect();
        match &mut spec.independent {
            Field::Given(list) if self.keeps_independents => {
                list.value
                    .retain(|one| !names.contains(&one.value.as_str()));
            }
            independent => *independent = Field::Absent,
        }
        // Scenes act through the joints that they name, and a locked joint has no drive.
        spec.actuated = Field::Absent;
        let loops = self.of.closure().map_or(&[][..], |closure| &closure.loops);
        let moves = |step: &ChainStep| {
            step.motion != Motion::None && self.still.iter().all(|(link, _)| *link != step.link)
        };
        let held = loops
            .iter()
            .filter(|one| !one.chain.steps.iter().any(moves));
        let held: Vec<&str> = held.map(|one| one.name.as_str()).collect();
        if let Field::Given(loops) = &mut spec.loops {
            let name = |one: &LoopSpec| one.name.value().map_or("", String::as_str).to_owned();
            loops
                .value
                .retain(|one| !held.contains(&name(one).as_str()));
            for one in &mut loops.value {
                one.near = Field::Absent;
            }
        }
        spec
    }

    fn joint(&self, link: LinkId) -> &'a str {
        &self.of.links[link.0].joint.name
    }
}

/// Returns the positions that the loops hold where these joints are locked: those whose rate is zero in every solution
/// of B q̇ = 0.
fn held(of: &Mechanism, q: &[Dd], locks: &[(LinkId, Dd)]) -> Vec<PositionId> {
    // Wheels on planes roll on, whatever is locked. Of a ball single velocities may be held, which no lock is for: the
    // loops hold the joints then.
    let Some(closure) = of.closure().filter(|closure| !closure.closes_along()) else {
        return Vec::new();
    };
    let is_locked = |p: &PositionId| locks.iter().any(|(link, _)| *link == of.positions()[p.0]);
    let moving = closure.moving().into_iter();
    let free = moving.filter(|&j| !closure.positions[j].as_ref().is_some_and(is_locked));
    let free: Vec<usize> = free.collect();
    let rates = closure.solved_rates(q).into_iter();
    let mut rows: Vec<Vec<Dd>> = rates
        .map(|row| free.iter().map(|&j| row[j]).collect())
        .collect();
    let (pivots, _) = eliminate(&mut rows, free.len());
    let is_pivot = |k: usize| pivots.iter().any(|(_, column)| *column == k);
    let mut held = Vec::new();
    for &(row, column) in &pivots {
        let size = rows[row][column].to_f64().abs();
        let others = (0..free.len()).filter(|&k| !is_pivot(k));
        let largest = others
            .map(|k| rows[row][k].to_f64().abs())
            .fold(0.0, f64::max);
        if largest <= ROUNDING * size {
            held.extend(closure.positions[free[column]]);
        }
    }
    held
}
