//! Positions, velocities and position rates of joints, as expressions.

use bgdyn_runtime::Dd;

use crate::bond_graph::{LinkFrame, Multibody};
use crate::expr::{Builder, Expr, Graph, Leaf, Signed};
use crate::math::{Mat3, Vec3};
use crate::mechanism::joint::PoseNumbers;
use crate::mechanism::{CoordinateId, Motion};

impl<'g> PoseNumbers<Expr<'g>> for &'g Builder {
    fn constant(&self, x: Dd) -> Expr<'g> {
        Builder::constant(self, x)
    }

    fn cos_sin(&self, angle: Expr<'g>) -> (Expr<'g>, Expr<'g>) {
        Builder::cos_sin(self, &[angle], Dd::ZERO)
    }

    fn cos_sin_from(&self, angle: Expr<'g>, phase: Dd) -> (Expr<'g>, Expr<'g>) {
        Builder::cos_sin(self, &[angle], phase)
    }

    fn twice_inverse(&self, squares: Expr<'g>) -> Expr<'g> {
        Builder::constant(self, Dd::from_f64(2.0)) / squares
    }
}

/// Returns the positions of a joint; for one that follows others Σ ratio · q + offset.
pub(super) fn joint_positions<'g>(
    b: &'g Builder,
    frame: &LinkFrame,
    q: &[Expr<'g>],
) -> Vec<Expr<'g>> {
    let degrees = &frame.degrees;
    let read = degrees.positions.iter().map(|p| q[p.0]);
    if degrees.coupling.is_none() {
        return read.collect();
    }
    let terms = read.zip(degrees.position_ratios());
    let sum = terms.fold(b.zero(), |sum, (q, ratio)| sum + q * ratio);
    vec![sum + b.constant(degrees.offset())]
}

/// Returns the velocities of a joint, or its accelerations; for a coupled joint Σ ratio · v.
pub(super) fn joint_rates<'g>(b: &'g Builder, frame: &LinkFrame, v: &[Expr<'g>]) -> Vec<Expr<'g>> {
    let degrees = &frame.degrees;
    let read = degrees.velocities.iter().map(|j| v[j.0]);
    if degrees.coupling.is_none() {
        return read.collect();
    }
    let terms = read.zip(degrees.velocity_ratios());
    vec![terms.fold(b.zero(), |sum, (v, ratio)| sum + v * ratio)]
}

/// Returns the pose of the link whose joint has several degrees of freedom, in the joint's origin: the rotation
/// from link axes to origin axes, and the link's origin, m. `first` is the joint's first coordinate. `None` for
/// other joints.
pub(crate) fn pose_in_joint<'g>(
    b: &'g Builder,
    graph: &Multibody,
    first: usize,
    q: &[Expr<'g>],
) -> Option<(Mat3<Expr<'g>>, Vec3<Expr<'g>>)> {
    let first = Some(&CoordinateId(first));
    let own = |f: &&LinkFrame| f.degrees.own_velocities() && f.degrees.velocities.first() == first;
    let frame = graph.frames.iter().find(own)?;
    match frame.motion {
        Motion::Compound(motion) => {
            let q = joint_positions(b, frame, q);
            Some(motion.pose(&frame.constants(), &q, &b))
        }
        _ => None,
    }
}

/// Returns q̇ = N(q) v.
pub(crate) fn position_rates<'g>(
    b: &'g Builder,
    graph: &Multibody,
    (q, v): (&[Expr<'g>], &[Expr<'g>]),
) -> Vec<Expr<'g>> {
    let mut rates = vec![b.zero(); graph.positions.len()];
    for frame in graph.frames.iter().filter(|f| f.degrees.own_positions()) {
        let positions = &frame.degrees.positions;
        let own = match frame.motion {
            Motion::Compound(motion) => {
                let q: Vec<Expr<'g>> = positions.iter().map(|p| q[p.0]).collect();
                motion.position_rates(&frame.constants(), (&q, &joint_rates(b, frame, v)), &b)
            }
            _ => joint_rates(b, frame, v),
        };
        for (p, rate) in positions.iter().zip(own) {
            rates[p.0] = rate;
        }
    }
    rates
}

/// Returns the rates of the positions for velocities, as the tangents of the positions' leaves.
pub(super) fn tangents<'g>(b: &'g Builder, graph: &Multibody, v: &[Expr<'g>]) -> Vec<Signed> {
    let q: Vec<Expr<'g>> = (0..graph.positions.len())
        .map(|p| b.leaf(Leaf::Position(p)))
        .collect();
    let rates = position_rates(b, graph, (&q, v));
    rates.into_iter().map(Expr::signed).collect()
}

/// Returns the tangents of the positions for a unit velocity of coordinate j.
pub(crate) fn unit_tangents(b: &Builder, graph: &Multibody, j: usize) -> Vec<Signed> {
    let n = graph.coordinates.len();
    let unit = |k: usize| b.constant(if k == j { Dd::ONE } else { Dd::ZERO });
    let v: Vec<Expr<'_>> = (0..n).map(unit).collect();
    tangents(b, graph, &v)
}

/// Returns the seed of a tangent along these rates of the positions.
pub(super) fn along(rates: Vec<Signed>) -> impl FnMut(&mut Graph, Leaf) -> Option<Signed> {
    move |_, leaf| match leaf {
        Leaf::Position(p) => Some(rates[p]),
        _ => None,
    }
}
