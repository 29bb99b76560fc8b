//! Functions of positions of a mechanism: joint by joint, with loops closed, along the ways of wheels.

use std::sync::Arc;

use bgdyn_codegen::bond_graph::joint_segments;
use bgdyn_codegen::engine::CallArguments;
use bgdyn_codegen::mechanism::Motion;
use bgdyn_codegen::mechanism::closure::Closure;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;
use bgdyn_runtime::closure::follow;
use nalgebra::DVector;

use crate::joint_positions::JointPositions;
use crate::spec::{ModelData, Prepared};

/// Number of parts of a way through closed positions.
const PARTS: usize = 16;

/// The largest residual of a closed row, m or rad.
const CLOSED: f64 = 1e-12;

/// The functions of positions of a model.
pub struct Positions<'a> {
    data: &'a ModelData,
    /// The joints with the model's own velocities.
    own: JointPositions,
    loops: Option<Loops<'a>>,
}

/// What loops and wheels add.
struct Loops<'a> {
    closure: &'a Closure,
    /// The joints with the velocities of the open tree.
    tree: JointPositions,
    /// S(q) v.
    tree_velocity: Arc<Prepared>,
    /// Positions of the independent joints in loops.
    free: Vec<usize>,
    /// Positions that follow.
    dependent: Vec<usize>,
}

/// Loops that do not close; the index of the first, if it is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Open(pub Option<usize>);

/// The positions found.
pub type Found = Result<Vec<f64>, Open>;

impl<'a> Positions<'a> {
    /// Returns the functions of a model.
    ///
    /// # Errors
    /// If a function that they call cannot be generated.
    pub fn new(data: &'a ModelData) -> Result<Self, String> {
        let spec = &data.spec;
        let loops = match (spec.mechanism.closure(), spec.graph.closed.as_deref()) {
            (Some(closure), Some(closed)) => {
                let independents = closure.independents.iter();
                let positions = |j: usize| closure.positions[j].map(|p| p.0);
                Some(Loops {
                    closure,
                    tree: JointPositions::new(joint_segments(&closed.tree)),
                    tree_velocity: spec.prepared(Method::TreeVelocity)?,
                    free: independents.filter_map(|j| positions(j.0)).collect(),
                    dependent: closure
                        .dependents()
                        .filter_map(|j| positions(j.0))
                        .collect(),
                })
            }
            _ => None,
        };
        Ok(Positions {
            data,
            own: JointPositions::new(joint_segments(&spec.graph)),
            loops,
        })
    }

    /// Returns q with every coordinate zero and every quaternion (0, 0, 0, 1); with loops or wheels their start.
    pub fn neutral(&self) -> Vec<f64> {
        let mechanism = &self.data.spec.mechanism;
        if let Some(closure) = mechanism.closure() {
            return closure.start.iter().map(|x| x.to_f64()).collect();
        }
        let mut q = vec![0.0; mechanism.nq()];
        for joint in mechanism.compound_joints() {
            let Motion::Compound(motion) = joint.kind.motion else {
                continue;
            };
            for (part, at) in motion.positions.iter().zip(&joint.degrees.positions) {
                q[at.0] = f64::from(part.neutral);
            }
        }
        q
    }

    /// Returns q̇ = N(q) v.
    pub fn position_rates(&self, q: &[f64], v: &[f64]) -> Vec<f64> {
        match &self.loops {
            None => self.own.position_rates(q, v),
            Some(loops) => {
                let moved = self.tree_velocity(loops, q, v);
                loops.tree.position_rates(q, &moved)
            }
        }
    }

    /// Returns q after the constant velocities `dv` for one unit of time.
    pub fn integrate(&self, q: &[f64], dv: &[f64]) -> Found {
        let Some(loops) = &self.loops else {
            return Ok(self.own.integrate(q, dv));
        };
        if loops.closure.closes_along() {
            let moved = follow(
                &DVector::from_column_slice(q),
                |q| DVector::from_vec(self.tree_velocity(loops, q.as_slice(), dv)),
                |q, moved| loops.tree.integrate(q.as_slice(), moved.as_slice()).into(),
            );
            let there = closed(loops.closure, moved.as_slice())?;
            return match loops.closure.nonholonomic() || loops.same_branch(q, &there) {
                true => Ok(there),
                false => Err(Open(None)),
            };
        }
        let moved = self.tree_velocity(loops, q, dv);
        let target = loops.tree.integrate(q, &moved);
        // A long way may end on another branch, or nowhere.
        match closed(loops.closure, &target) {
            Ok(there) if loops.same_branch(q, &there) => Ok(there),
            _ => match loops.walked(q, &target) {
                (there, None) => Ok(there),
                (_, Some(open)) => Err(open),
            },
        }
    }

    /// Returns the displacement from q0 to q1.
    pub fn difference(&self, q1: &[f64], q0: &[f64]) -> Vec<f64> {
        match &self.loops {
            Some(loops) if loops.closure.closes_along() => loops.way(q1, q0),
            _ => self.own.difference(q1, q0),
        }
    }

    /// Returns q with quaternions of length 1.
    pub fn normalize(&self, q: &[f64]) -> Vec<f64> {
        match &self.loops {
            None => self.own.normalize(q),
            Some(loops) => loops.tree.normalize(q),
        }
    }

    /// Returns the position for numbers in [0, 1), one for each velocity. With loops it is the last closed one on the
    /// way from the start to the position for these numbers.
    pub fn sample(&self, u: &[f64]) -> Found {
        let Some(loops) = &self.loops else {
            return Ok(self.own.sample(u));
        };
        if loops.closure.closes_along() {
            let mut all = vec![0.5; loops.closure.positions.len()];
            for (j, &u) in loops.closure.independents.iter().zip(u) {
                all[j.0] = u;
            }
            let target = loops.tree.sample(&all);
            let mut q = self.neutral();
            if loops.closure.nonholonomic() {
                let there = closed(loops.closure, &target);
                return Ok(there.unwrap_or_else(|_| loops.followed(&q, &target)));
            }
            let mut part = loops.way(&target, &q);
            part.iter_mut().for_each(|x| *x /= PARTS as f64);
            for _ in 0..PARTS {
                match self.integrate(&q, &part) {
                    Ok(there) if loops.same_branch(&q, &there) => q = there,
                    _ => break,
                }
            }
            return Ok(q);
        }
        Ok(loops.walked(&self.neutral(), &self.own.sample(u)).0)
    }

    /// Returns q with the dependent positions changed so that all loops close.
    pub fn close(&self, q: &[f64]) -> Found {
        match &self.loops {
            None => Ok(q.to_vec()),
            Some(loops) => closed(loops.closure, q),
        }
    }

    fn tree_velocity(&self, loops: &Loops<'_>, q: &[f64], v: &[f64]) -> Vec<f64> {
        let from = CallArguments {
            q,
            v,
            parameters: &self.data.parameters,
            ..CallArguments::default()
        };
        loops.tree_velocity.call.value(&from).0
    }
}

impl Loops<'_> {
    /// Returns the independent velocities of the way in the open tree from q0 to q1.
    fn way(&self, q1: &[f64], q0: &[f64]) -> Vec<f64> {
        let moved = self.tree.difference(q1, q0);
        let independents = self.closure.independents.iter();
        independents.map(|j| moved[j.0]).collect()
    }

    /// Returns the last closed position on the way from the closed position `start` to `target`, in equal parts along
    /// the independent velocities; the other positions close.
    fn followed(&self, start: &[f64], target: &[f64]) -> Vec<f64> {
        let moved = self.tree.difference(target, start);
        let mut part = vec![0.0; moved.len()];
        for j in &self.closure.independents {
            part[j.0] = moved[j.0] / PARTS as f64;
        }
        let mut q = start.to_vec();
        for _ in 0..PARTS {
            match closed(self.closure, &self.tree.integrate(&q, &part)) {
                Ok(there) => q = there,
                Err(_) => break,
            }
        }
        q
    }

    fn same_branch(&self, q: &[f64], other: &[f64]) -> bool {
        self.closure.signs_at(&exact(q)) == self.closure.signs_at(&exact(other))
    }

    /// Returns the last closed position on the way from the closed position `start` to `target`, in equal parts of the
    /// independent positions, and the first loop that did not close on the way. Positions outside of loops are those of
    /// `target`.
    fn walked(&self, start: &[f64], target: &[f64]) -> (Vec<f64>, Option<Open>) {
        let mut q = target.to_vec();
        for &p in self.free.iter().chain(&self.dependent) {
            q[p] = start[p];
        }
        for part in 1..=PARTS {
            let share = part as f64 / PARTS as f64;
            let mut next = q.clone();
            for &p in &self.free {
                next[p] = start[p] + (target[p] - start[p]) * share;
            }
            match closed(self.closure, &next) {
                Ok(there) if self.same_branch(start, &there) => q = there,
                Ok(_) => return (q, Some(Open(None))),
                Err(open) => return (q, Some(open)),
            }
        }
        (q, None)
    }
}

/// Returns closed positions from these; in double-double, so that they are exact to rounding.
fn closed(closure: &Closure, q: &[f64]) -> Found {
    let rows = closure.position_rows();
    if rows.is_empty() {
        return Ok(q.to_vec());
    }
    let mut exact = exact(q);
    if closure.close(&mut exact) {
        return Ok(exact.iter().map(|x| x.to_f64()).collect());
    }
    let residuals = closure.values(&rows, &exact).0;
    // NaN is not closed either.
    let is_open = |x: f64| x.abs() > CLOSED || x.is_nan();
    let first = residuals.iter().position(|x| is_open(x.to_f64()));
    Err(Open(first.map(|row| rows[row].closes)))
}

fn exact(q: &[f64]) -> Vec<Dd> {
    q.iter().map(|&x| Dd::from_f64(x)).collect()
}
