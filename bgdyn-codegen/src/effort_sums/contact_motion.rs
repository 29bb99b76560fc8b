//! The relative motion at a contact, and the efforts of its force.
//!
//! With the contact point c, the velocities of both bodies there give γ = v_a(c) − v_b(c), with v(c) = v + ω × (c − o)
//! for the origin o of a link. γ_n = n·γ is the rate of the gap: c is on the line of the normal through the centre of
//! a sphere. A force F on the sphere's link at c, and −F on the partner's, are wrenches at the origins of the links.
//! They are summed for each link before τ = Jᵀ w.

use super::EffortSums;
use crate::bond_graph::SiteId;
use crate::declaration::{Element, undeclared};
use crate::expr::Expr;
use crate::formulation::PairFrame;
use crate::math::{Mat3, Vec3};
use crate::mechanism::{ContactPair, ContactPartner, LinkId};

/// The relative motion at a contact, world axes.
#[derive(Clone, Copy, Debug)]
pub struct ContactMotion<'g> {
    /// The distance of the surfaces, m; negative where they overlap.
    pub gap: Expr<'g>,
    /// The unit normal, from the partner to the sphere.
    pub normal: Vec3<Expr<'g>>,
    /// The directions x and y of the plane; `None` for two spheres.
    pub along: Option<[Vec3<Expr<'g>>; 2]>,
    /// γ_n, the rate of the gap, m/s.
    pub rate: Expr<'g>,
    /// γ_t, the velocity of the sphere along the plane of contact, m/s.
    pub slip: Vec3<Expr<'g>>,
    /// c, the contact point.
    pub point: Vec3<Expr<'g>>,
    /// The two bodies, each with its lever c − o; `None` for the world.
    bodies: [Option<(SiteId, Vec3<Expr<'g>>)>; 2],
}

impl<'g> EffortSums<'g, '_> {
    /// Returns the motion at the contact of the element.
    ///
    /// # Panics
    /// If the element's effect acts at no contact, or the mechanism does not have it.
    pub fn contact_motion(&mut self, element: &Element) -> ContactMotion<'g> {
        let pair = self.contact_pair(element);
        let frame = PairFrame::new(self.b, |link| self.carried(link), &pair);
        let [x, y, normal] = frame.axes;
        let along = match &pair.partner {
            ContactPartner::Plane { .. } => Some([x, y]),
            ContactPartner::Sphere(_) => None,
        };
        let point = frame.point();
        let bodies = [pair.sphere.link, pair.partner.link()].map(|link| {
            let site = self.site_of(link?);
            Some((site, point - self.pose(site).1))
        });
        let [a, b] = bodies.map(|body| self.velocity_at(body));
        let velocity = a - b;
        let rate = normal.dot(velocity);
        ContactMotion {
            gap: frame.gap,
            normal,
            along,
            rate,
            slip: velocity - normal.scale(rate),
            point,
            bodies,
        }
    }

    /// Adds the efforts of a force on the sphere, N, world axes, and of the opposite one on its partner.
    pub fn push_contact(&mut self, motion: &ContactMotion<'g>, force: Vec3<Expr<'g>>) {
        self.contact_forces.push((motion.point, force));
        for (body, force) in motion.bodies.into_iter().zip([force, -force]) {
            let Some((site, lever)) = body else { continue };
            let moment = lever.cross(force);
            let zero = [self.b.zero(); 6];
            let sum = self.wrenches.entry(site).or_insert(zero);
            for (sum, part) in sum.iter_mut().zip(moment.0.into_iter().chain(force.0)) {
                *sum = *sum + part;
            }
        }
    }

    /// Returns contact points and forces on spheres, in the order of the elements.
    pub(crate) fn contact_forces(&self) -> &[(Vec3<Expr<'g>>, Vec3<Expr<'g>>)] {
        &self.contact_forces
    }

    /// Adds the efforts of the wrenches of contacts: τ_j += J_jᵀ w.
    pub(crate) fn push_wrenches(&mut self) {
        for (site, wrench) in std::mem::take(&mut self.wrenches) {
            for (j, column) in self.columns(site).into_iter().enumerate() {
                let products = column.into_iter().zip(wrench).map(|(a, b)| a * b);
                let effort = products.fold(self.b.zero(), |sum, x| sum + x);
                self.push_on(j, effort);
            }
        }
    }

    /// Returns the pair of the element.
    fn contact_pair(&self, element: &Element) -> ContactPair {
        let name = element.contact();
        let name = name.unwrap_or_else(|| undeclared(element, "value of the key", "contact"));
        let found = self.scene.mechanism.contact_pair(name);
        found
            .unwrap_or_else(|| undeclared(element, "contact", name))
            .clone()
    }

    /// Returns axes and origin of a link in the world.
    fn carried(&mut self, link: Option<LinkId>) -> (Mat3<Expr<'g>>, Vec3<Expr<'g>>) {
        match link {
            Some(link) => {
                let site = self.site_of(link);
                self.pose(site)
            }
            None => {
                let (zero, one) = (self.b.zero(), self.b.number(1.0));
                let identity = |i, j| if i == j { one } else { zero };
                (Mat3::from_fn(identity), Vec3([zero; 3]))
            }
        }
    }

    fn site_of(&self, link: LinkId) -> SiteId {
        self.site(&self.scene.mechanism.links()[link.0].name)
    }

    /// Returns the velocity of a body at a lever from its origin.
    fn velocity_at(&mut self, body: Option<(SiteId, Vec3<Expr<'g>>)>) -> Vec3<Expr<'g>> {
        let Some((site, lever)) = body else {
            return Vec3([self.b.zero(); 3]);
        };
        let columns = self.columns(site);
        let [wx, wy, wz, vx, vy, vz] = std::array::from_fn(|i| {
            let products = columns.iter().zip(&self.v).map(|(j, &v)| j[i] * v);
            products.fold(self.b.zero(), |sum, x| sum + x)
        });
        Vec3([vx, vy, vz]) + Vec3([wx, wy, wz]).cross(lever)
    }

    /// Returns the Jacobian of a site, which is computed once.
    fn columns(&mut self, site: SiteId) -> Vec<[Expr<'g>; 6]> {
        if let Some(known) = self.jacobians.get(&site) {
            return known.clone();
        }
        let columns = self.jacobian(site);
        self.jacobians.insert(site, columns.clone());
        columns
    }
}
