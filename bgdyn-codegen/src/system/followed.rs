//! Computed torques: the efforts with which followed joints move as they should (Luh, Walker, Paul 1980).
//!
//! A followed joint shall have the acceleration a_f = r̈ + d (ṙ − q̇_f) + k (r − q_f). That of an independent joint is
//! an entry of u̇. Those of joints in loops determine the entries of u̇ that move them and are not followed, with the
//! rows of S: S_f u̇ + Ṡ_f u = a_f. The others are 0. With g, the efforts along u that u̇ needs by equation (6) less those
//! of the effects, the efforts P of the followed joints in loops are A P = g with the transposed columns of the same
//! matrix, and those of the independent ones g − A P in their rows.

use super::dynamics::needed;
use super::waveform::{course, rate};
use super::{EffortSums, SceneEquations};
use crate::expr::{Builder, Expr};
use crate::formulation::solve_square;
use crate::layout::DependentJoint;
use crate::scene::InputSource;

/// Returns the effort of each input that is a computed torque.
pub(super) fn computed_torques<'g>(
    system: &SceneEquations,
    b: &'g Builder,
    sums: &EffortSums<'g, '_>,
) -> Vec<Option<Expr<'g>>> {
    let layout = &system.scene.layout;
    let mut at: Vec<Option<Expr<'g>>> = vec![None; layout.nv()];
    let mut in_loops: Vec<FollowedInLoop<'_, 'g>> = Vec::new();
    for (i, drive) in system.scene.drives.iter().enumerate() {
        let InputSource::ComputedTorque {
            target,
            stiffness,
            damping,
        } = drive
        else {
            continue;
        };
        let part = &layout.inputs[i];
        let port = sums.coordinate(part.follows.as_deref().unwrap_or_default());
        let place = course(b, target);
        let speed = rate(b, place);
        let error = (place - port.displacement) * *stiffness + (speed - port.rate) * *damping;
        let acceleration = rate(b, speed) + error;
        match (part.drives, part.drives_dependent) {
            (Some(j), _) => at[j] = Some(acceleration),
            (None, Some(d)) => in_loops.push(FollowedInLoop {
                input: i,
                joint: &layout.dependents[d],
                acceleration,
            }),
            (None, None) => {}
        }
    }
    let mut torques = vec![None; layout.inputs.len()];
    if in_loops.is_empty() && at.iter().all(Option::is_none) {
        return torques;
    }
    let loops = LoopFollowing::new(system, sums, &in_loops, &at);
    let mut at: Vec<Expr<'g>> = at.iter().map(|a| a.unwrap_or(b.zero())).collect();
    loops.complete(b, sums, &mut at);
    let mut efforts = needed(system, sums, &at);
    for (followed, effort) in in_loops.iter().zip(loops.share(b, &mut efforts)) {
        torques[followed.input] = Some(effort);
    }
    for (i, drive) in system.scene.drives.iter().enumerate() {
        let j = layout.inputs[i].drives;
        if let (InputSource::ComputedTorque { .. }, Some(j)) = (drive, j) {
            torques[i] = Some(sums.before_gear(j, efforts[j]));
        }
    }
    torques
}

/// A dependent joint that follows a target.
struct FollowedInLoop<'a, 'g> {
    /// The input that is its effort.
    input: usize,
    joint: &'a DependentJoint,
    /// a_f
    acceleration: Expr<'g>,
}

/// The equations of the followed joints in loops.
struct LoopFollowing<'a, 'g> {
    followed: &'a [FollowedInLoop<'a, 'g>],
    /// Their rows of S, over all coordinates.
    rows: Vec<Vec<Expr<'g>>>,
    /// The independent velocities that they determine.
    along: Vec<usize>,
    samples: &'a [Vec<bgdyn_runtime::Dd>],
}

impl<'a, 'g> LoopFollowing<'a, 'g> {
    /// Sets the equations up; `at` are the accelerations of the independent joints that are followed themselves.
    fn new(
        system: &'a SceneEquations,
        sums: &EffortSums<'g, '_>,
        followed: &'a [FollowedInLoop<'a, 'g>],
        at: &[Option<Expr<'g>>],
    ) -> Self {
        let joints: Vec<_> = followed.iter().map(|one| one.joint.velocity).collect();
        let closure = system
            .scene
            .mechanism
            .closure()
            .filter(|_| !joints.is_empty());
        let movers = closure.map_or_else(Vec::new, |closure| closure.movers(&joints));
        let row = |one: &FollowedInLoop<'_, 'g>| {
            let mut row = vec![sums.b.zero(); at.len()];
            for (k, s) in sums.coordinate(&one.joint.name).transformers {
                row[k] = s;
            }
            row
        };
        LoopFollowing {
            followed,
            rows: followed.iter().map(row).collect(),
            along: movers.into_iter().filter(|&k| at[k].is_none()).collect(),
            samples: closure.map_or(&[], |closure| &closure.samples),
        }
    }

    /// Sets the accelerations that follow from those of the joints in loops: S_f u̇ = a_f − Ṡ_f u.
    fn complete(&self, b: &'g Builder, sums: &EffortSums<'g, '_>, at: &mut [Expr<'g>]) {
        let equation = |(one, row): (&FollowedInLoop<'_, 'g>, &Vec<Expr<'g>>)| {
            let own = sums.rate_at_constant_velocity(sums.coordinate(&one.joint.name).rate);
            let terms = row.iter().zip(at.iter());
            let side = terms.fold(one.acceleration - own, |side, (s, a)| side - *s * *a);
            (self.along.iter().map(|&k| row[k]).collect(), side)
        };
        let equations = self.followed.iter().zip(&self.rows).map(equation);
        let found = solve_square(b, equations.collect(), self.samples);
        for (&k, x) in self.along.iter().zip(found) {
            at[k] = x;
        }
    }

    /// Returns the efforts of the followed joints in loops, which give all efforts along the velocities that they
    /// determine, and subtracts what they give along the others.
    fn share(&self, b: &'g Builder, efforts: &mut [Expr<'g>]) -> Vec<Expr<'g>> {
        let equation = |&k: &usize| {
            let row: Vec<Expr<'g>> = self.rows.iter().map(|row| row[k]).collect();
            (row, efforts[k])
        };
        let equations = self.along.iter().map(equation).collect();
        let found = solve_square(b, equations, self.samples);
        for (row, &effort) in self.rows.iter().zip(&found) {
            for (left, s) in efforts.iter_mut().zip(row) {
                *left = *left - *s * effort;
            }
        }
        found
    }
}
