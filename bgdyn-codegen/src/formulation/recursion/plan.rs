//! The plan: the free choices of the recursion, and the origins that follow from it.

use bgdyn_runtime::Dd;

use super::geometry::Geometry;
use crate::math::Vec3;

/// The free choices of the recursion: none changes the result, all change the count.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plan {
    /// How far each body's origin slides along its joint's axis, m.
    pub slides: Vec<Dd>,
    /// The unit of length, m.
    pub unit: Dd,
    /// Whether joints with parallel axes share one basis that does not turn with them.
    pub grouped: bool,
    /// Bodies whose own dynamics are computed in their basis: the inertia is turned, not the
    /// vectors.
    pub in_basis: Vec<bool>,
    /// Bodies at the tips whose x axis points at their centre of mass.
    pub aimed: Vec<bool>,
    /// By how many joints inwards the base parameters of a body's run-time parameters move.
    pub carried: Vec<usize>,
    /// Bodies whose point masses with run-time parameters have a force of their own each, where
    /// the others' are merged with the body.
    pub apart: Vec<bool>,
    /// Whether inertia is regrouped into base parameters; otherwise every body keeps its own.
    pub base_parameters: bool,
    /// N_z = J_zz ω̇_z + (D_xx − D_yy) ω_x ω_y + … instead of the skew part of U·D.
    pub short_moment: bool,
    /// For derivatives: how each joint's share of them is put together.
    pub views: Vec<PartialsPlan>,
}

/// How the derivatives by a joint's coordinate are put together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct PartialsPlan {
    /// Where all that it moves is seen from.
    pub seen_from: SeenFrom,
    /// Whether what the next rotation of its group moves is taken over from that one.
    pub reuse_neighbour: bool,
    /// Whether changes of forces on what its body carries stay in the body's axes for the rotations
    /// before it in the group.
    pub keep_body_axes: bool,
}

/// The body whose motion counts as that of the carrier, and the axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum SeenFrom {
    /// The body before the joint or the one after it, in the axes of the basis: the one with more
    /// zeros.
    #[default]
    Sparser,
    /// The body before the joint.
    Before,
    /// The body after it.
    After,
    /// The same in its own axes, but for what continues its basis.
    Own,
}

impl Plan {
    /// Metres, origins where the spec has them: for poses.
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
            views: vec![PartialsPlan::default(); n],
        }
    }

    /// The same with the axes of the tips as they are.
    pub(super) fn unturned(&self) -> Self {
        Plan {
            aimed: vec![false; self.aimed.len()],
            ..self.clone()
        }
    }
}

/// Where the origin of body j is from its parent's, in twisted axes, after the slides, m. The
/// base's place enters nothing but the potential energy.
pub(super) fn origin_offset(geometry: &Geometry, plan: &Plan, j: usize) -> Vec3<Dd> {
    let body = &geometry.bodies[j];
    let Some(p) = body.parent else {
        return Vec3([Dd::ZERO; 3]);
    };
    let parent_z = body.twist.transpose().column(2);
    let mut offset = body.offset - parent_z.scale(plan.slides[p]);
    offset.0[2] += plan.slides[j];
    // What two equal lengths leave of their difference is no length.
    let size = body
        .offset
        .0
        .iter()
        .fold(0.0, |m: f64, x| m.max(x.hi().abs()));
    offset.map(|x| {
        if x.hi().abs() < 1e-26 * size {
            Dd::ZERO
        } else {
            x
        }
    })
}
