//! The rows of loops and contacts from the poses of both places in fixed axes.

use bgdyn_runtime::Dd;

use crate::bond_graph::ClosedTree;
use crate::expr::{Builder, Expr};
use crate::formulation::placement::Placement;
use crate::math::{Mat3, Vec3};
use crate::mechanism::closure::{
    ClosingRow, Closure, ContactRow, ContactShape, LoopRow, PlaneContact, RelativePlace, RowKind,
};
use crate::mechanism::{LinkId, Pose};

/// A rotation and an origin.
pub(super) type Placed<'g> = (Mat3<Expr<'g>>, Vec3<Expr<'g>>);

/// The places of the loops: b in the axes of a; of contacts, the wheel in the axes of its plane.
pub(super) struct RelativePoses<'a, 'g> {
    b: &'g Builder,
    pub(super) closure: &'a Closure,
    places: Vec<Placed<'g>>,
    /// Of each loop the places in the axes that [`RelativePoses::places`] is given in, in fixed axes: a, or the plane.
    pub(super) carriers: Vec<Placed<'g>>,
}

/// The directions of a contact in the axes of its plane.
struct ContactDirections<'g> {
    /// Of the rows.
    longitudinal: Vec3<Expr<'g>>,
    lateral: Vec3<Expr<'g>>,
    /// From the centre to the contact.
    contact: Vec3<Expr<'g>>,
    /// The height of the centre above the plane where it touches.
    height: Expr<'g>,
}

impl<'a, 'g> RelativePoses<'a, 'g> {
    pub(super) fn new(b: &'g Builder, closed: &'a ClosedTree, q: &[Expr<'g>]) -> Self {
        let placement = Placement::new(b, &closed.tree, q);
        let place = |link: Option<LinkId>, pose: Pose| -> Placed<'g> {
            let rotation = pose.rotation.map(|x| b.constant(x));
            let origin = b.vector(pose.translation);
            match link {
                None => (rotation, origin),
                Some(LinkId(i)) => (
                    placement.rotations[i] * rotation,
                    placement.point(i, origin),
                ),
            }
        };
        let both = closed.closure.loops.iter().map(|one| {
            let end = place(one.links[1], one.chain.end);
            let (from, to) = match &one.contact {
                None => (place(one.links[0], one.chain.start), end),
                Some(contact) => (end, place(one.links[0], contact.place)),
            };
            let inverse = from.0.transpose();
            (from, (inverse * to.0, inverse * (to.1 - from.1)))
        });
        let (carriers, places) = both.unzip();
        RelativePoses {
            b,
            closure: &closed.closure,
            places,
            carriers,
        }
    }

    /// Returns c(q) of a row; zero for one on velocities.
    pub(super) fn condition(&self, row: &LoopRow) -> Expr<'g> {
        let one = &self.closure.loops[row.closes];
        let (rotation, position) = self.places[row.closes];
        let relative = RelativePlace {
            rotation,
            position,
            columns: Vec::new(),
        };
        match (row.kind, &one.contact) {
            (RowKind::Closing(kind), _) => {
                kind.residual(&relative, one.length, |x: Dd| self.b.constant(x))
            }
            (RowKind::Contact(ContactRow::Height), Some(contact)) => {
                position.0[2] - self.directions(row.closes, contact).height
            }
            (RowKind::Contact(_), _) => self.b.zero(),
        }
    }

    /// Returns the rate of a row on velocities along the motion for which `rate_of` returns the rates of expressions:
    /// that of the material point at the contact, which is fixed in the axes of the wheel.
    pub(super) fn slip(
        &self,
        closes: usize,
        row: ContactRow,
        rate_of: &mut impl FnMut(Expr<'g>) -> Expr<'g>,
    ) -> Expr<'g> {
        let Some(contact) = &self.closure.loops[closes].contact else {
            return self.b.zero();
        };
        let (rotation, centre) = self.places[closes];
        let directions = self.directions(closes, contact);
        let fixed = rotation.transpose() * directions.contact;
        let along = self.along(row, &directions);
        let velocity = centre.map(&mut *rate_of) + rotation.map(rate_of) * fixed;
        along.dot(velocity)
    }

    /// Returns force and moment of a loop on place b about its origin, in the axes of a; of a contact on the wheel at
    /// the contact, in the axes of the plane; and that point in these axes.
    pub(super) fn load(&self, closes: usize, lambda: &[Expr<'g>]) -> [Vec3<Expr<'g>>; 3] {
        let zero = Vec3([self.b.zero(); 3]);
        let (rotation, position) = self.places[closes];
        let one = &self.closure.loops[closes];
        let (mut force, mut moment, mut point) = (zero, zero, position);
        if let Some(contact) = &one.contact {
            point = position + self.directions(closes, contact).contact;
        }
        for (row, &x) in self.closure.rows.iter().zip(lambda) {
            if row.closes != closes {
                continue;
            }
            match (row.kind, &one.contact) {
                (RowKind::Contact(kind), Some(contact)) => {
                    let directions = self.directions(closes, contact);
                    force = force + self.along(kind, &directions).scale(x);
                }
                (RowKind::Closing(ClosingRow::Place(k)), _) => {
                    force = force + self.unit(k).scale(x)
                }
                (RowKind::Closing(ClosingRow::Tilt(k) | ClosingRow::Turn(k)), _) => {
                    moment = moment + self.unit(k).scale(x);
                }
                (RowKind::Closing(ClosingRow::Length), _) => {
                    let length = self.b.constant(one.length);
                    force = force + position.scale(x / length);
                }
                (RowKind::Closing(ClosingRow::Angle), _) => {
                    let turning = rotation.column(0).cross(self.unit(2));
                    moment = moment + turning.scale(x);
                }
                (RowKind::Contact(_), None) => {}
            }
        }
        [force, moment, point]
    }

    /// Returns the axes of a reaction: those of the link of place a, of a knife edge of its own link, else those of the
    /// contact; as the matrix from the axes of [`RelativePoses::load`].
    pub(super) fn reaction_axes(&self, closes: usize) -> Mat3<Expr<'g>> {
        let one = &self.closure.loops[closes];
        let constant = |pose: &Pose| pose.rotation.map(|x| self.b.constant(x));
        match &one.contact {
            None => constant(&one.chain.start),
            Some(contact) if matches!(contact.shape, ContactShape::Edge(_)) => {
                constant(&contact.place) * self.places[closes].0.transpose()
            }
            Some(contact) => {
                let directions = self.directions(closes, contact);
                let rows = [directions.longitudinal, directions.lateral, self.unit(2)];
                Mat3(rows.map(|row| row.0))
            }
        }
    }

    fn along(&self, row: ContactRow, directions: &ContactDirections<'g>) -> Vec3<Expr<'g>> {
        match row {
            ContactRow::Edge | ContactRow::Lateral => directions.lateral,
            ContactRow::Longitudinal => directions.longitudinal,
            ContactRow::Slip(k) => self.unit(k),
            ContactRow::Height => self.unit(2),
        }
    }

    fn directions(&self, closes: usize, contact: &PlaneContact) -> ContactDirections<'g> {
        let (rotation, _) = self.places[closes];
        let (b, up) = (self.b, self.unit(2));
        let radius = b.constant(contact.radius);
        match contact.shape {
            ContactShape::Edge(direction) => ContactDirections {
                longitudinal: up,
                lateral: rotation * b.vector(direction),
                contact: -up.scale(radius),
                height: radius,
            },
            ContactShape::Sphere => ContactDirections {
                longitudinal: self.unit(0),
                lateral: self.unit(1),
                contact: -up.scale(radius),
                height: radius,
            },
            ContactShape::Ellipsoid(half_axes) => {
                // The support of Σ (x_k / a_k)² = 1 in the direction of the plane: h = |diag(a) Rᵀ z|.
                let half_axes = b.vector(Vec3(half_axes)).0;
                let own: [Expr<'g>; 3] =
                    std::array::from_fn(|k| half_axes[k] * rotation.column(k).0[2]);
                let height = Vec3(own).dot(Vec3(own)).sqrt();
                let inverse = b.constant(Dd::ONE) / height;
                let lowest: [Expr<'g>; 3] = std::array::from_fn(|k| half_axes[k] * own[k]);
                ContactDirections {
                    longitudinal: self.unit(0),
                    lateral: self.unit(1),
                    contact: -(rotation * Vec3(lowest)).scale(inverse),
                    height,
                }
            }
            ContactShape::Disc(axle) => {
                let axle = rotation * b.vector(axle);
                let [x, y, z] = axle.0;
                let cosine = (x * x + y * y).sqrt();
                let inverse = b.constant(Dd::ONE) / cosine;
                let longitudinal = axle.cross(up).scale(inverse);
                let upward = (up - axle.scale(z)).scale(inverse);
                let crown = b.constant(contact.crown);
                ContactDirections {
                    longitudinal,
                    lateral: up.cross(longitudinal),
                    contact: -(upward.scale(radius) + up.scale(crown)),
                    height: cosine * radius + crown,
                }
            }
        }
    }

    fn unit(&self, k: usize) -> Vec3<Expr<'g>> {
        let at = |i: usize| {
            if i == k {
                self.b.constant(Dd::ONE)
            } else {
                self.b.zero()
            }
        };
        Vec3([at(0), at(1), at(2)])
    }
}
