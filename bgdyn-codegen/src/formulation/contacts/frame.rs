//! The gap, the axes and the contact point of a pair, fixed axes.

use bgdyn_runtime::Dd;

use super::tangents::across;
use crate::expr::{Builder, Expr};
use crate::formulation::placement::Placement;
use crate::math::{Mat3, Vec3};
use crate::mechanism::{ContactPair, ContactPartner, ContactSphere, LinkId};

/// The least square of a distance of two centres, m²: where they meet there is no normal, and the root has a derivative
/// even there.
const LEAST: f64 = 1e-30;

/// Where a pair touches.
#[derive(Clone, Copy)]
pub(super) struct PairFrame<'g> {
    /// The distance of the surfaces, m; negative where they overlap.
    pub(super) gap: Expr<'g>,
    /// The directions x and y, and the unit normal from the partner to the sphere.
    pub(super) axes: [Vec3<Expr<'g>>; 3],
    /// The centre of the sphere.
    pub(super) centre: Vec3<Expr<'g>>,
    /// How far the contact point is from the centre, against the normal, m.
    pub(super) depth: Expr<'g>,
}

impl<'g> PairFrame<'g> {
    /// Returns where a pair touches. The contact point is on the line of the normal through the centre of the sphere: on the
    /// sphere against a plane, in the middle of the gap of two spheres.
    pub(super) fn new(b: &'g Builder, placement: &Placement<'g>, pair: &ContactPair) -> Self {
        let centre = centre(b, placement, &pair.sphere);
        let radius = b.constant(pair.sphere.radius);
        match &pair.partner {
            ContactPartner::Plane { link, pose } => {
                let rotation = pose.rotation.map(|x| b.constant(x));
                let rotation = match link {
                    Some(LinkId(i)) => placement.rotations[*i] * rotation,
                    None => rotation,
                };
                let origin = place(b, placement, *link, pose.translation);
                let axes = [0, 1, 2].map(|k| rotation.column(k));
                let normal = axes[2];
                PairFrame {
                    gap: normal.dot(centre - origin) - radius,
                    axes,
                    centre,
                    depth: radius,
                }
            }
            ContactPartner::Sphere(other) => {
                let apart = centre - self::centre(b, placement, other);
                let distance = apart.dot(apart).max(b.number(LEAST)).sqrt();
                let normal = apart.scale(b.number(1.0) / distance);
                let gap = distance - b.constant(pair.sphere.radius + other.radius);
                let [x, y] = across(b, normal);
                PairFrame {
                    gap,
                    axes: [x, y, normal],
                    centre,
                    depth: radius + gap * Dd::from_f64(0.5),
                }
            }
        }
    }

    /// Returns the velocity at the contact point along x, y and n, of a body that turns with ω and whose point at the centre
    /// moves with this velocity.
    ///
    /// The contact point is the depth d below the centre, against n: x·(ω × n) = y·ω and y·(ω × n) = −x·ω. A turn about the
    /// centre has no part along n, and its columns are exactly zero there.
    pub(super) fn velocity(
        &self,
        angular: Vec3<Expr<'g>>,
        of_centre: Vec3<Expr<'g>>,
    ) -> [Expr<'g>; 3] {
        let [x, y, n] = self.axes;
        [
            x.dot(of_centre) - self.depth * y.dot(angular),
            y.dot(of_centre) + self.depth * x.dot(angular),
            n.dot(of_centre),
        ]
    }

    /// Returns its rotation, with the axes as columns, row by row, and the contact point.
    pub(super) fn pose(&self) -> Vec<Expr<'g>> {
        let rotation = Mat3(self.axes.map(|axis| axis.0)).transpose();
        let rotation = rotation.0.into_iter().flatten();
        let point = self.centre - self.axes[2].scale(self.depth);
        rotation.chain(point.0).collect()
    }
}

/// Returns the centre of a sphere.
fn centre<'g>(b: &'g Builder, placement: &Placement<'g>, sphere: &ContactSphere) -> Vec3<Expr<'g>> {
    place(b, placement, sphere.link, sphere.centre)
}

/// Returns a place on a link.
fn place<'g>(
    b: &'g Builder,
    placement: &Placement<'g>,
    link: Option<LinkId>,
    at: Vec3<Dd>,
) -> Vec3<Expr<'g>> {
    let at = b.vector(at);
    match link {
        Some(LinkId(i)) => placement.point(i, at),
        None => at,
    }
}
