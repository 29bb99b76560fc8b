//! Positions of mechanisms by the functions of the runtime, around those of the evaluator.

use std::f64::consts::PI;

use bgdyn_codegen::bond_graph::{ClosedTree, JointSegment, joint_segments};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::plan::{dependent_joint, independent_positions};
use bgdyn_runtime::ACTUATORS;
use bgdyn_runtime::closure::{self, Dependent};
use bgdyn_runtime::manifold;
use bgdyn_runtime::nalgebra::SVector;

use crate::runtime_polygons::close_polygons;
use crate::values::CNumber;

/// Room for the positions and velocities of every mechanism here.
pub const ROOM: usize = 64;

/// Positions or velocities, followed by zeros.
pub type Vector<T> = SVector<T, ROOM>;

/// A mechanism, with the arguments that its functions read beside positions and velocities.
pub struct Reference<'a, T> {
    pub model: &'a Model,
    pub parameters: Vec<T>,
}

impl<T: CNumber> Reference<'_, T> {
    fn function(&self, method: Method, q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
        vector(&self.values(method, q, v))
    }

    /// Returns the values of a function.
    pub fn values(&self, method: Method, q: &Vector<T>, v: &Vector<T>) -> Vec<T> {
        let inputs = Inputs {
            q: q.as_slice().to_vec(),
            v: v.as_slice().to_vec(),
            parameters: self.parameters.clone(),
            ..Inputs::default()
        };
        let function = self.model.function(method).expect("a usual method");
        function.evaluate(inputs).0
    }

    fn dependents(&self, closed: &ClosedTree) -> Vec<Dependent> {
        let all = closed.closure.closing();
        all.map(|j| dependent_joint(closed, j)).collect()
    }

    /// Returns the closed position, and the number of the cause if there is none.
    pub fn close(
        &self,
        closed: &ClosedTree,
        q: Vector<T>,
        from: Option<&Vector<T>>,
    ) -> (closure::Closing<Vector<T>>, i128) {
        let dependents = self.dependents(closed);
        let step = |q: &Vector<T>| self.function(Method::ClosingStep, q, &vector(&[]));
        let polygons = close_polygons(closed, &q, from);
        let closing = match (closed.closure.closes_along(), polygons) {
            (_, Some(polygons)) if polygons.others.is_empty() => polygons.closing,
            (_, Some(polygons)) => polygons.closing.then(&polygons.others, ROOM, step),
            (false, None) => closure::close(q, &dependents, step),
            (true, None) => {
                let joints = joint_segments(&closed.tree);
                let moved = |q: &Vector<T>, v: &Vector<T>| integrated(&joints, q, v);
                closure::close_along(q, &dependents, step, moved)
            }
        };
        let nq = self.model.mechanism.nq();
        let cause = match closing.refused {
            Some(cause) => (cause % ACTUATORS - ROOM + nq + 1) as i128,
            None => -i128::from(closing.q.iter().any(|x| !x.is_finite())),
        };
        (closing, cause)
    }

    /// Returns the position after velocities, and the number of the cause if there is none.
    pub fn integrate(&self, q: &Vector<T>, dv: &Vector<T>) -> (Vector<T>, i128) {
        let Some(closed) = self.model.bond_graph.closed.as_deref() else {
            let joints = joint_segments(&self.model.bond_graph);
            return (integrated(&joints, q, dv), 0);
        };
        let joints = joint_segments(&closed.tree);
        let rates = |q: &Vector<T>| self.function(Method::TreeVelocity, q, dv);
        let moved = |q: &Vector<T>, v: &Vector<T>| integrated(&joints, q, v);
        let along = closed.closure.closes_along();
        let found = match along {
            false => moved(q, &rates(q)),
            true => closure::follow(q, rates, moved),
        };
        if self.model.function(Method::ClosingStep).is_none() {
            return (found, 0);
        }
        let (closing, cause) = self.close(closed, found, Some(q));
        let q = match along {
            true => closing.or_all_nan(),
            false => closing.or_nan(&self.dependents(closed), &independent_positions(closed)),
        };
        let is_wild = q.iter().any(|x| !x.is_finite());
        (
            q,
            if cause > 0 {
                cause
            } else {
                -i128::from(is_wild)
            },
        )
    }

    /// Returns the rates of the positions at velocities.
    pub fn position_rates(&self, q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
        match self.model.bond_graph.closed.as_deref() {
            None => rates(&joint_segments(&self.model.bond_graph), q, v),
            Some(closed) => {
                let moved = self.function(Method::TreeVelocity, q, v);
                rates(&joint_segments(&closed.tree), q, &moved)
            }
        }
    }

    /// Returns the velocities that lead from q0 to q1.
    pub fn difference(&self, q1: &Vector<T>, q0: &Vector<T>) -> Vector<T> {
        let graph = &self.model.bond_graph;
        let (joints, independents): (_, Option<Vec<usize>>) = match graph.closed.as_deref() {
            None => (joint_segments(graph), None),
            Some(closed) => {
                let all = closed.closure.independents.iter();
                (
                    joint_segments(&closed.tree),
                    Some(all.map(|j| j.0).collect()),
                )
            }
        };
        let (mut all, mut at) = (Vec::new(), 0);
        for joint in &joints {
            let [q1, q0] = [q1, q0].map(|q| unit(joint, &q.as_slice()[at..at + joint.nq]));
            at += joint.nq;
            if joint.leaders.is_empty() {
                all.extend(match joint.manifold {
                    "spherical" => manifold::spherical::difference(array(&q1), array(&q0)).to_vec(),
                    "floating" => manifold::floating::difference(array(&q1), array(&q0)).to_vec(),
                    "planar" => manifold::planar::difference(array(&q1), array(&q0)).to_vec(),
                    _ => q1.iter().zip(&q0).map(|(&x, &y)| x - y).collect(),
                });
            }
        }
        match independents {
            None => vector(&all),
            Some(own) => vector(&own.iter().map(|&j| all[j]).collect::<Vec<T>>()),
        }
    }

    /// Returns evenly distributed positions from numbers in 0 … 1.
    pub fn sample(&self, u: &Vector<T>) -> Vector<T> {
        let graph = &self.model.bond_graph;
        let Some(closed) = graph.closed.as_deref() else {
            return sampled(&joint_segments(graph), u);
        };
        let dependents = self.dependents(closed);
        let step = |q: &Vector<T>| self.function(Method::ClosingStep, q, &vector(&[]));
        if !closed.closure.closes_along() {
            let target = sampled(&joint_segments(graph), u);
            let independents = independent_positions(closed);
            let start = self.neutral();
            return closure::towards(start, target, (&independents, &dependents), step);
        }
        let joints = joint_segments(&closed.tree);
        let mut moved = Vector::repeat(T::from_f64(0.5));
        for (j, &u) in closed.closure.independents.iter().zip(u) {
            moved[j.0] = u;
        }
        let q = sampled(&joints, &moved);
        if !closed.closure.nonholonomic() {
            let start = self.neutral();
            let share = T::from_f64(1.0 / closure::PARTS as f64);
            let part = self.difference(&q, &start).map(|x| x * share);
            let rates = |q: &Vector<T>| self.function(Method::TreeVelocity, q, &part);
            let moved = |q: &Vector<T>, v: &Vector<T>| integrated(&joints, q, v);
            return closure::walk(start, |q| {
                let q = closure::follow(q, rates, moved);
                closure::close_along(q, &dependents, step, moved)
            });
        }
        if self.model.function(Method::ClosingStep).is_none() {
            return q;
        }
        let moved = |q: &Vector<T>, v: &Vector<T>| integrated(&joints, q, v);
        let close = |q: Vector<T>| closure::close_along(q, &dependents, step, moved);
        let (start, share) = (self.neutral(), T::from_f64(1.0 / closure::PARTS as f64));
        let way = self.difference(&q, &start).map(|x| x * share);
        let mut own = Vector::repeat(T::default());
        for (j, &part) in closed.closure.independents.iter().zip(way.iter()) {
            own[j.0] = part;
        }
        close(q).or(closure::walk(start, |q| close(moved(q, &own))))
    }

    /// Returns the neutral position, or with loops one at which all close.
    pub fn neutral(&self) -> Vector<T> {
        if let Some(closed) = self.model.bond_graph.closed.as_deref() {
            let start = closed.closure.start.iter().map(|x| T::from_f64(x.hi()));
            return vector(&start.collect::<Vec<T>>());
        }
        let joints = joint_segments(&self.model.bond_graph);
        let nothing = vector(&[]);
        joint_by_joint(
            &joints,
            &nothing,
            &nothing,
            &|joint, q, _| match joint.manifold {
                "spherical" => manifold::spherical::neutral().to_vec(),
                "floating" => manifold::floating::neutral().to_vec(),
                _ => q.to_vec(),
            },
        )
    }

    /// Returns the positions with quaternions of length 1.
    pub fn normalize(&self, q: &Vector<T>) -> Vector<T> {
        let graph = &self.model.bond_graph;
        let joints = match graph.closed.as_deref() {
            None => joint_segments(graph),
            Some(closed) => joint_segments(&closed.tree),
        };
        joint_by_joint(&joints, q, &vector(&[]), &|joint, q, _| {
            normalized(joint, q)
        })
    }
}

/// Returns the values, followed by zeros.
pub fn vector<T: CNumber>(values: &[T]) -> Vector<T> {
    let mut all = Vector::repeat(T::from_f64(0.0));
    all.as_mut_slice()[..values.len()].copy_from_slice(values);
    all
}

fn array<T: Copy, const N: usize>(values: &[T]) -> [T; N] {
    values.try_into().expect("the joint's own components")
}

/// A function of a joint's own positions and velocities.
type OfJoint<T> = dyn Fn(&JointSegment, &[T], &[T]) -> Vec<T>;

/// Returns the positions of the joints from those of each, its velocities, and all velocities.
fn joint_by_joint<T: CNumber>(
    joints: &[JointSegment],
    q: &Vector<T>,
    v: &Vector<T>,
    of: &OfJoint<T>,
) -> Vector<T> {
    let (mut found, mut at) = (Vec::new(), 0);
    for joint in joints {
        let own = &q.as_slice()[found.len()..found.len() + joint.nq];
        let term = |&(j, ratio): &(usize, f64)| T::from_f64(ratio) * v[j];
        let led = joint.leaders.iter().map(term).reduce(|x, y| x + y);
        let moved = match led {
            Some(sum) => vec![sum],
            None => v.as_slice()[at..at + joint.nv].to_vec(),
        };
        found.extend(of(joint, own, &moved));
        at += joint.nv;
    }
    vector(&found)
}

fn normalized<T: CNumber>(joint: &JointSegment, q: &[T]) -> Vec<T> {
    match joint.manifold {
        "spherical" => manifold::spherical::normalize(array(q)).to_vec(),
        "floating" => manifold::floating::normalize(array(q)).to_vec(),
        _ => q.to_vec(),
    }
}

/// Returns the positions of a joint, with its quaternion scaled to length 1 if it may have any.
fn unit<T: CNumber>(joint: &JointSegment, q: &[T]) -> Vec<T> {
    match joint.any_length {
        true => normalized(joint, q),
        false => q.to_vec(),
    }
}

/// Returns evenly distributed positions of these joints from numbers in 0 … 1; those that follow others are zero.
fn sampled<T: CNumber>(joints: &[JointSegment], u: &Vector<T>) -> Vector<T> {
    let one = T::from_f64(1.0);
    let (mut found, mut at) = (Vec::new(), 0);
    for joint in joints {
        let own = &u.as_slice()[at..at + joint.nv];
        at += joint.nv;
        let half = T::from_f64(if joint.turns { PI } else { 1.0 });
        found.extend(match joint.manifold {
            _ if joint.nv == 0 => vec![T::default(); joint.nq],
            "spherical" => manifold::spherical::sample(array(own)).to_vec(),
            "floating" => manifold::floating::sample(array(own)).to_vec(),
            "planar" => manifold::planar::sample(array(own)).to_vec(),
            _ => own.iter().map(|&u| (u + u - one) * half).collect(),
        });
    }
    vector(&found)
}

/// Returns the positions after velocities of these joints.
pub fn integrated<T: CNumber>(joints: &[JointSegment], q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
    joint_by_joint(joints, q, v, &|joint, q, d| {
        let unit = unit(joint, q);
        match joint.manifold {
            "spherical" => manifold::spherical::integrate(array(&unit), array(d)).to_vec(),
            "floating" => manifold::floating::integrate(array(&unit), array(d)).to_vec(),
            "planar" => manifold::planar::integrate(array(&unit), array(d)).to_vec(),
            _ => q.iter().zip(d).map(|(&q, &d)| q + d).collect(),
        }
    })
}

fn rates<T: CNumber>(joints: &[JointSegment], q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
    joint_by_joint(joints, q, v, &|joint, q, v| {
        let unit = unit(joint, q);
        match joint.manifold {
            "spherical" => manifold::spherical::position_rates(array(q), array(v)).to_vec(),
            "floating" => {
                let [turned, own] =
                    [&unit[..], q].map(|q| manifold::floating::position_rates(array(q), array(v)));
                turned[..3].iter().chain(&own[3..]).copied().collect()
            }
            "planar" => manifold::planar::position_rates(array(q), array(v)).to_vec(),
            _ => v.to_vec(),
        }
    })
}
