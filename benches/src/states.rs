//! Random states for all timings: the same numbers in all compared programs.

use std::f64::consts::PI;

/// That of the generator; a peer without bgdyn includes this file.
#[path = "../../bgdyn-runtime/src/random.rs"]
#[allow(dead_code)]
mod random;

use random::Random;

/// Number of states: too many for a branch predictor to learn, few enough for the cache.
pub const STATES: usize = 1024;

/// How a joint moves, as far as its positions depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// About an axis: an angle.
    Turns,
    /// Along an axis: a length.
    Slides,
    /// In any way: position and quaternion x, y, z, w; velocities linear, then angular, in link axes.
    Floats,
}

impl JointKind {
    /// Returns the number of velocities.
    pub fn nv(self) -> usize {
        match self {
            JointKind::Floats => 6,
            JointKind::Turns | JointKind::Slides => 1,
        }
    }
}

/// A state with accelerations and efforts, joint by joint.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Positions: any angle, ±0.3 m, any orientation.
    pub q: Vec<f64>,
    /// Velocities within ±2.
    pub v: Vec<f64>,
    /// Accelerations within ±2.
    pub a: Vec<f64>,
    /// Efforts within ±10.
    pub tau: Vec<f64>,
}

/// Returns the states of a mechanism; `slides` marks prismatic joints.
pub fn states(slides: &[bool]) -> Vec<State> {
    let kind = |&slides: &bool| match slides {
        true => JointKind::Slides,
        false => JointKind::Turns,
    };
    let kinds: Vec<JointKind> = slides.iter().map(kind).collect();
    states_of(&kinds)
}

/// Returns the states of a mechanism with these joints.
pub fn states_of(kinds: &[JointKind]) -> Vec<State> {
    let mut random = Random(0x5eed_5eed_1234_5678);
    let nv: usize = kinds.iter().map(|kind| kind.nv()).sum();
    let state = |_| {
        let q = positions(kinds, &mut random);
        let mut numbers = |size: f64| (0..nv).map(|_| size * random.signed()).collect();
        State {
            q,
            v: numbers(2.0),
            a: numbers(2.0),
            tau: numbers(10.0),
        }
    };
    (0..STATES).map(state).collect()
}

/// Returns random positions, joint by joint.
fn positions(kinds: &[JointKind], random: &mut Random) -> Vec<f64> {
    let mut q = Vec::new();
    for kind in kinds {
        match kind {
            JointKind::Turns => q.push(PI * random.signed()),
            JointKind::Slides => q.push(0.3 * random.signed()),
            JointKind::Floats => {
                q.extend((0..3).map(|_| 0.3 * random.signed()));
                let quaternion: [f64; 4] = std::array::from_fn(|_| random.signed());
                let length = quaternion.iter().map(|x| x * x).sum::<f64>().sqrt();
                q.extend(quaternion.map(|x| x / length));
            }
        }
    }
    q
}
