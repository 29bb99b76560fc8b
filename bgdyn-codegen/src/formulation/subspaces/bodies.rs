//! The bodies of a mechanism: welded links together, with their pose in the parent body.

use bgdyn_runtime::Dd;

use super::inertia::Inertia;
use crate::bond_graph::{LinkFrame, Multibody};
use crate::expr::{Builder, Expr};
use crate::formulation::arguments::spin;
use crate::formulation::joint_motion::joint_positions;
use crate::math::{Mat3, Vec3, rodrigues};
use crate::mechanism::joint::Column;
use crate::mechanism::{LinkId, Motion, Pose};

/// A rigid body.
pub(super) struct SubspaceBody<'g> {
    /// The parent body; `None` for the fixed base.
    pub(super) parent: Option<usize>,
    /// From the body's axes to those of the joint's origin.
    pub(super) turned: Mat3<Expr<'g>>,
    /// From the axes of the joint's origin to the parent's.
    pub(super) fixed: Mat3<Dd>,
    /// The body's origin in the parent's axes, m.
    pub(super) position: Vec3<Expr<'g>>,
    /// The columns of the joint's motion subspace by coordinate, in the body's axes at its origin.
    pub(super) columns: Vec<(usize, Column<Expr<'g>>)>,
    /// Whether all columns have one axis.
    pub(super) axial: bool,
    /// Whether it is a base whose motion is given.
    pub(super) given: bool,
    /// Inertia about the origin.
    pub(super) inertia: Inertia<'g>,
    /// The full rotors that it carries: their joint, and N J e in the body's axes.
    pub(super) rotors: Vec<(usize, Vec3<Expr<'g>>)>,
}

impl<'g> SubspaceBody<'g> {
    /// Returns a vector of the body's axes in the parent's axes.
    pub(super) fn inward(&self, b: &'g Builder, v: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
        self.fixed.map(|x| b.constant(x)) * (self.turned * v)
    }

    /// Returns a vector of the parent's axes in the body's axes.
    pub(super) fn outward(&self, b: &'g Builder, v: Vec3<Expr<'g>>) -> Vec3<Expr<'g>> {
        self.turned.transpose() * (self.fixed.transpose().map(|x| b.constant(x)) * v)
    }

    /// Returns Σ column · rate, the twist of the body relative to its parent.
    pub(super) fn twist(&self, b: &'g Builder, rates: &[Expr<'g>]) -> Column<Expr<'g>> {
        let zero = Vec3([b.zero(); 3]);
        let start = Column {
            angular: zero,
            linear: zero,
        };
        let add = |sum: Column<Expr<'g>>, (j, column): &(usize, Column<Expr<'g>>)| Column {
            angular: sum.angular + column.angular.scale(rates[*j]),
            linear: sum.linear + column.linear.scale(rates[*j]),
        };
        self.columns.iter().fold(start, add)
    }
}

/// All bodies, parents before children.
pub(in crate::formulation) struct Bodies<'a, 'g> {
    pub(super) b: &'g Builder,
    pub(super) graph: &'a Multibody,
    pub(super) bodies: Vec<SubspaceBody<'g>>,
    /// Mass and first moment of the links that never move, in world axes.
    pub(super) fixed: Inertia<'g>,
}

impl<'a, 'g> Bodies<'a, 'g> {
    /// Returns the bodies: links that are welded together are one.
    pub(super) fn new(b: &'g Builder, graph: &'a Multibody, q: &[Expr<'g>]) -> Self {
        let moving = |frame: &LinkFrame| frame.motion != Motion::None;
        Bodies::where_joints(b, graph, q, moving)
    }

    /// Returns each link as a body, in the order of the links.
    pub(in crate::formulation) fn of_links(
        b: &'g Builder,
        graph: &'a Multibody,
        q: &[Expr<'g>],
    ) -> Self {
        Bodies::where_joints(b, graph, q, |_| true)
    }

    fn where_joints(
        b: &'g Builder,
        graph: &'a Multibody,
        q: &[Expr<'g>],
        is_joint: impl Fn(&LinkFrame) -> bool,
    ) -> Self {
        let mut all = Bodies {
            b,
            graph,
            bodies: Vec::new(),
            fixed: Inertia::zero(b),
        };
        // The body of each link, and the pose of the link in its axes.
        let mut homes: Vec<(Option<usize>, Pose)> = Vec::new();
        for (i, frame) in graph.frames.iter().enumerate() {
            let (parent, pose) = match frame.parent {
                None => (None, frame.origin),
                Some(LinkId(p)) => (homes[p].0, homes[p].1.of(frame.origin)),
            };
            let mut home = (parent, pose);
            if is_joint(frame) {
                home = (Some(all.bodies.len()), Pose::IDENTITY);
                all.bodies.push(body(b, frame, (parent, pose), q));
            }
            let inertia = Inertia::of_link(b, &graph.inertial(LinkId(i)), &home.1);
            let whole = match home.0 {
                Some(body) => &mut all.bodies[body].inertia,
                None => &mut all.fixed,
            };
            *whole = whole.plus(inertia);
            homes.push(home);
        }
        for rotor in &graph.rotors {
            let Some(carrier) = &rotor.carrier else {
                continue;
            };
            if let (Some(body), pose) = homes[carrier.link.0] {
                let axis = b.vector(pose.rotation * carrier.axis);
                let momentum = axis.scale(spin(b, rotor));
                all.bodies[body].rotors.push((rotor.coordinate.0, momentum));
            }
        }
        all
    }
}

/// Returns the body that a joint moves, without inertia. `pose` is the joint's origin in the parent body.
fn body<'g>(
    b: &'g Builder,
    frame: &LinkFrame,
    (parent, pose): (Option<usize>, Pose),
    q: &[Expr<'g>],
) -> SubspaceBody<'g> {
    let own = joint_positions(b, frame, q);
    let one = |i, j| b.constant(if i == j { Dd::ONE } else { Dd::ZERO });
    let still = Vec3([b.zero(); 3]);
    let (turned, shift) = match frame.motion {
        Motion::None => (Mat3::from_fn(one), still),
        Motion::Rotation => {
            let angle = b.cos_sin(&own, Dd::ZERO);
            (rodrigues(frame.axis, angle, |x| b.constant(x)), still)
        }
        Motion::Translation => (Mat3::from_fn(one), b.vector(frame.axis).scale(own[0])),
        Motion::Compound(motion) => motion.pose(&frame.constants(), &own, &b),
    };
    let fixed = pose.rotation.map(|x| b.constant(x));
    let column = |(j, column): (crate::mechanism::CoordinateId, Column<Dd>)| {
        let column = Column {
            angular: b.vector(column.angular),
            linear: b.vector(column.linear),
        };
        (j.0, column)
    };
    SubspaceBody {
        parent,
        turned,
        fixed: pose.rotation,
        position: b.vector(pose.translation) + fixed * shift,
        columns: frame.columns().into_iter().map(column).collect(),
        axial: frame.motion.has_axis(),
        given: frame.motion.is_given(),
        inertia: Inertia::zero(b),
        rotors: Vec::new(),
    }
}
