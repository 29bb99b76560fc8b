//! The plan: the free choices of the recursion, and the origins that follow from it.

use bgdyn_runtime::Dd;

use super::geometry::{Geometry, largest};
use crate::math::Vec3;

/// The free choices of the recursion; they change the operation count, but not the result.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plan {
    /// Displacement of each body's origin along its joint's axis, m.
    pub slides: Vec<Dd>,
    /// The unit of length, m.
    pub unit: Dd,
    /// Whether joints with parallel axes have a common basis that does not rotate with them.
    pub grouped: bool,
    /// Bodies whose own dynamics are computed in their basis: the inertia is rotated, not the vectors.
    pub in_basis: Vec<bool>,
    /// Tips whose x axis points to their centre of mass.
    pub aimed: Vec<bool>,
    /// By how many joints inboard the base parameters with run-time parameters move.
    pub carried: Vec<usize>,
    /// Bodies whose point masses with run-time parameters have separate forces; for other bodies they are
    /// merged with the body.
    pub apart: Vec<bool>,
    /// Whether inertia is regrouped into base parameters; otherwise every body retains its own.
    pub base_parameters: bool,
    /// N_z = J_zz ω̇_z + (D_xx − D_yy) ω_x ω_y + … instead of the skew part of U·D.
    pub short_moment: bool,
    /// For forward dynamics: whether the translations of a root that also rotates are eliminated before all
    /// other velocities (by articulated bodies before its rotations), or its rotations before them.
    pub linear_first: bool,
    /// For derivatives: how each joint's contribution is computed.
    pub views: Vec<PartialsPlan>,
    /// For the momentum about the centre of mass: how it is computed.
    pub momenta: MomentaPlan,
}

/// How momenta reach the world.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct MomentaPlan {
    /// The number of joints, counted from the base, across which vectors are rotated one by one; vectors of later joints
    /// are rotated at once.
    pub one_by_one: usize,
    /// Whether the momentum is the sum of those of the bodies, not of those of composite bodies per unit rates.
    pub by_bodies: bool,
}

/// How the derivatives by a joint's coordinate are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct PartialsPlan {
    /// The reference of its composite body.
    pub seen_from: SeenFrom,
    /// Whether quantities of the next rotation of its group are reused.
    pub reuse_neighbour: bool,
    /// Whether derivatives of forces on the bodies outboard remain in the body's axes for the previous
    /// rotations of the group.
    pub keep_body_axes: bool,
}

/// The body whose motion is the reference, and the axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum SeenFrom {
    /// The body before the joint or the one after it, in the axes of the basis: the one with more zeros.
    #[default]
    Sparser,
    /// The body before the joint.
    Before,
    /// The body after it.
    After,
    /// The body after it in its own axes, except for the parts that continue its basis.
    Own,
}

impl Plan {
    /// Returns a plan in metres, with the origins of the spec, for poses.
    pub(super) fn of_kinematics(geometry: &Geometry, grouped: bool) -> Self {
        let n = geometry.bodies.len();
        Plan {
            slides: vec![Dd::ZERO; n],
            unit: Dd::ONE,
            grouped,
            in_basis: vec![false; n],
            aimed: vec![false; n],
            carried: vec![0; n],
            apart: vec![false; n],
            base_parameters: true,
            short_moment: false,
            linear_first: false,
            views: vec![PartialsPlan::default(); n],
            momenta: MomentaPlan::default(),
        }
    }

    /// Returns the plan with unrotated axes of the tips.
    pub(super) fn unturned(&self) -> Self {
        Plan {
            aimed: vec![false; self.aimed.len()],
            ..self.clone()
        }
    }
}

/// Returns the position of the origin of body j relative to its parent's, in twisted axes, after the
/// slides, m. The base's position affects only the potential energy.
pub(super) fn origin_offset(geometry: &Geometry, plan: &Plan, j: usize) -> Vec3<Dd> {
    let body = &geometry.bodies[j];
    let Some(p) = body.parent else {
        return Vec3([Dd::ZERO; 3]);
    };
    let parent_z = body.twist.transpose().column(2);
    let mut offset = body.offset - parent_z.scale(plan.slides[p]);
    offset.0[2] += plan.slides[j];
    // The rounding error of the difference of two equal lengths counts as zero.
    let size = largest(body.offset);
    offset.map(|x| {
        if x.hi().abs() < 1e-26 * size {
            Dd::ZERO
        } else {
            x
        }
    })
}
