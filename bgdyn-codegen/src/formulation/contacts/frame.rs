//! The gap, the axes and the contact point of a pair, fixed axes.

use bgdyn_runtime::Dd;

use super::tangents::across;
use crate::expr::{Builder, Expr};
use crate::math::{Mat3, Vec3};
use crate::mechanism::{ContactPair, ContactPartner, LinkId};

/// The least square of a distance of two centres, m²: where they meet there is no normal, and the root has a derivative
/// even there.
const LEAST: f64 = 1e-30;

/// Axes and origin of a link.
type LinkPose<'g> = (Mat3<Expr<'g>>, Vec3<Expr<'g>>);

/// Where a pair touches.
#[derive(Clone, Copy)]
pub(crate) struct PairFrame<'g> {
    /// The distance of the surfaces, m; negative where they overlap.
    pub(crate) gap: Expr<'g>,
    /// The directions x and y, and the unit normal from the partner to the sphere.
    pub(crate) axes: [Vec3<Expr<'g>>; 3],
    /// The centre of the sphere.
    pub(super) centre: Vec3<Expr<'g>>,
    /// How far the contact point is from the centre, against the normal, m.
    pub(super) depth: Expr<'g>,
}

impl<'g> PairFrame<'g> {
    /// Returns where a pair touches, with the axes and origins of links; those of the world for `None`. The contact point is on
    /// the line of the normal through the centre of the sphere: on the sphere against a plane, in the middle of the gap of two
    /// spheres.
    pub(crate) fn new(
        b: &'g Builder,
        mut pose: impl FnMut(Option<LinkId>) -> LinkPose<'g>,
        pair: &ContactPair,
    ) -> Self {
        let mut place = |link: Option<LinkId>, at: Vec3<Dd>| {
            let (axes, origin) = pose(link);
            origin + axes * b.vector(at)
        };
        let centre = place(pair.sphere.link, pair.sphere.centre);
        let radius = b.constant(pair.sphere.radius);
        match &pair.partner {
            ContactPartner::Plane { link, pose: plane } => {
                let origin = place(*link, plane.translation);
                let rotation = pose(*link).0 * plane.rotation.map(|x| b.constant(x));
                let axes = [0, 1, 2].map(|k| rotation.column(k));
                PairFrame {
                    gap: axes[2].dot(centre - origin) - radius,
                    axes,
                    centre,
                    depth: radius,
                }
            }
            ContactPartner::Sphere(other) => {
                let apart = centre - place(other.link, other.centre);
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

    /// Returns the contact point.
    pub(crate) fn point(&self) -> Vec3<Expr<'g>> {
        self.centre - self.axes[2].scale(self.depth)
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
        rotation.chain(self.point().0).collect()
    }
}
