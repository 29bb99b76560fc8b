//! Functions of positions joint by joint, on slices: how q changes along velocities of the open tree.

use bgdyn_codegen::bond_graph::JointSegment;
use bgdyn_runtime::manifold::{floating, planar, spherical};

/// The number of components of a quaternion, the last positions of a joint that has one.
const QUATERNION: usize = 4;

/// A function of one joint's numbers.
type OfOne = fn(&[f64]) -> Vec<f64>;
/// A function of two.
type OfTwo = fn(&[f64], &[f64]) -> Vec<f64>;

/// The functions of a module of `bgdyn_runtime::manifold`.
struct Manifold {
    name: &'static str,
    position_rates: OfTwo,
    integrate: OfTwo,
    difference: OfTwo,
    normalize: OfOne,
    sample: OfOne,
}

/// Returns the functions of a module, on slices of its sizes.
macro_rules! manifold {
    ($module:ident) => {
        Manifold {
            name: stringify!($module),
            position_rates: |q, v| $module::position_rates(array(q), array(v)).to_vec(),
            integrate: |q, d| $module::integrate(array(q), array(d)).to_vec(),
            difference: |q1, q0| $module::difference(array(q1), array(q0)).to_vec(),
            normalize: |q| $module::normalize(array(q)).to_vec(),
            sample: |u| $module::sample(array(u)).to_vec(),
        }
    };
}

static MANIFOLDS: [Manifold; 3] = [manifold!(floating), manifold!(planar), manifold!(spherical)];

fn array<const N: usize>(from: &[f64]) -> [f64; N] {
    core::array::from_fn(|i| from[i])
}

/// The joints of a mechanism, in the order of q and v.
#[derive(Debug)]
pub struct JointPositions {
    joints: Vec<JointSegment>,
}

/// One joint with its numbers of each vector.
struct Joint<'a> {
    segment: &'a JointSegment,
    manifold: Option<&'static Manifold>,
    /// The indices of its first position and of its first velocity.
    at: [usize; 2],
}

impl JointPositions {
    /// Returns the functions of these joints.
    pub fn new(joints: Vec<JointSegment>) -> Self {
        JointPositions { joints }
    }

    /// Returns q̇ = N(q) v.
    pub fn position_rates(&self, q: &[f64], v: &[f64]) -> Vec<f64> {
        let one = |joint: Joint<'_>| match joint.manifold {
            _ if joint.follows() => vec![joint.followed(v)],
            None => joint.velocities(v).to_vec(),
            Some(m) => {
                let (own, v) = (joint.positions(q), joint.velocities(v));
                let mut rates = (m.position_rates)(&joint.normal(q), v);
                // A quaternion of any length has rates that are proportional to it.
                if joint.segment.any_length {
                    let first = rates.len() - QUATERNION;
                    rates[first..].copy_from_slice(&(m.position_rates)(own, v)[first..]);
                }
                rates
            }
        };
        self.each().flat_map(one).collect()
    }

    /// Returns q after the constant velocities d for one unit of time.
    pub fn integrate(&self, q: &[f64], d: &[f64]) -> Vec<f64> {
        let one = |joint: Joint<'_>| match joint.manifold {
            _ if joint.follows() => vec![joint.positions(q)[0] + joint.followed(d)],
            None => pairs(joint.positions(q), joint.velocities(d), |q, d| q + d),
            Some(m) => (m.integrate)(&joint.normal(q), joint.velocities(d)),
        };
        self.each().flat_map(one).collect()
    }

    /// Returns the displacement from q0 to q1.
    pub fn difference(&self, q1: &[f64], q0: &[f64]) -> Vec<f64> {
        let one = |joint: Joint<'_>| match joint.manifold {
            _ if joint.segment.nv == 0 => vec![],
            None => pairs(joint.positions(q1), joint.positions(q0), |q1, q0| q1 - q0),
            Some(m) => (m.difference)(&joint.normal(q1), &joint.normal(q0)),
        };
        self.each().flat_map(one).collect()
    }

    /// Returns q with quaternions of length 1.
    pub fn normalize(&self, q: &[f64]) -> Vec<f64> {
        let one = |joint: Joint<'_>| match joint.manifold {
            None => joint.positions(q).to_vec(),
            Some(m) => (m.normalize)(joint.positions(q)),
        };
        self.each().flat_map(one).collect()
    }

    /// Returns the position for numbers in [0, 1), one for each velocity: angles in [−π, π), displacements in
    /// [−1, 1) m, orientations evenly distributed. Positions without a velocity are 0.
    pub fn sample(&self, u: &[f64]) -> Vec<f64> {
        let one = |joint: Joint<'_>| match joint.manifold {
            _ if joint.segment.nv == 0 => vec![0.0; joint.segment.nq],
            None => {
                let half = match joint.segment.turns {
                    true => std::f64::consts::PI,
                    false => 1.0,
                };
                let own = joint.velocities(u).iter();
                own.map(|u| (u + u - 1.0) * half).collect()
            }
            Some(m) => (m.sample)(joint.velocities(u)),
        };
        self.each().flat_map(one).collect()
    }

    fn each(&self) -> impl Iterator<Item = Joint<'_>> {
        let mut at = [0, 0];
        self.joints.iter().map(move |segment| {
            let mut manifolds = MANIFOLDS.iter();
            let joint = Joint {
                segment,
                manifold: manifolds.find(|m| m.name == segment.manifold),
                at,
            };
            at = [at[0] + segment.nq, at[1] + segment.nv];
            joint
        })
    }
}

impl Joint<'_> {
    fn positions<'q>(&self, q: &'q [f64]) -> &'q [f64] {
        &q[self.at[0]..self.at[0] + self.segment.nq]
    }

    fn velocities<'v>(&self, v: &'v [f64]) -> &'v [f64] {
        &v[self.at[1]..self.at[1] + self.segment.nv]
    }

    /// Returns its positions, with length 1 of a quaternion that may have any.
    fn normal(&self, q: &[f64]) -> Vec<f64> {
        let own = self.positions(q);
        match self.manifold {
            Some(m) if self.segment.any_length => (m.normalize)(own),
            _ => own.to_vec(),
        }
    }

    /// Returns whether its rate follows from velocities of other joints.
    fn follows(&self) -> bool {
        !self.segment.leaders.is_empty()
    }

    fn followed(&self, v: &[f64]) -> f64 {
        let leaders = self.segment.leaders.iter();
        leaders.map(|&(j, ratio)| ratio * v[j]).sum()
    }
}

fn pairs(a: &[f64], b: &[f64], with: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    a.iter().zip(b).map(|(&x, &y)| with(x, y)).collect()
}
