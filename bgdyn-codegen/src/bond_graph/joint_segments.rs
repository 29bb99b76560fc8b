//! The positions and velocities of the joints in q and v: what computes a vector joint by joint reads them.

use super::{LinkFrame, Multibody};
use crate::mechanism::Motion;

/// The positions and velocities of a joint that follow each other in q and v.
#[derive(Clone, Debug)]
pub struct JointSegment {
    /// Its module of `bgdyn_runtime::manifold`; empty if q̇ = v.
    pub manifold: &'static str,
    /// Number of positions.
    pub nq: usize,
    /// Number of velocities.
    pub nv: usize,
    /// Whether its position is an angle.
    pub turns: bool,
    /// Whether its quaternion may have any length.
    pub any_length: bool,
    /// For a position whose rate is a sum of velocities of other joints: their indices with ratios.
    pub leaders: Vec<(usize, f64)>,
}

impl JointSegment {
    /// A joint with one position and q̇ = v.
    pub const PLAIN: Self = JointSegment {
        manifold: "",
        nq: 1,
        nv: 1,
        turns: true,
        any_length: false,
        leaders: Vec::new(),
    };
}

/// Returns the joints in the order of q and v.
pub fn joint_segments(graph: &Multibody) -> Vec<JointSegment> {
    let own = graph.frames.iter().filter(|f| f.degrees.own_positions());
    let moving = own.filter(|frame| frame.motion != Motion::None);
    let segment = |frame: &LinkFrame| JointSegment {
        manifold: match frame.motion {
            Motion::Compound(motion) => motion.manifold,
            _ => "",
        },
        nq: frame.motion.nq(),
        nv: match frame.degrees.own_velocities() {
            true => frame.motion.nv(),
            false => 0,
        },
        turns: frame.motion != Motion::Translation,
        any_length: frame.degrees.any_length,
        leaders: leaders(frame),
    };
    moving.map(segment).collect()
}

/// Returns the velocities that a joint's follows, with ratios; none for a joint with a velocity of its own.
fn leaders(frame: &LinkFrame) -> Vec<(usize, f64)> {
    let degrees = &frame.degrees;
    if degrees.own_velocities() {
        return vec![];
    }
    let velocities = degrees.velocities.iter().map(|j| j.0);
    let ratios = degrees.velocity_ratios().into_iter();
    velocities.zip(ratios.map(|ratio| ratio.to_f64())).collect()
}
