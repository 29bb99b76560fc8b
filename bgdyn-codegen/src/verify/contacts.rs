//! Checks the methods of contacts against the literal poses and velocities of the links.
//!
//! Rates are those in dual numbers: the rate of the gap is γ_n, that of γ at constant velocities is J̇ v. They do not use the
//! Jacobian, nor the generator's own derivatives.

use std::collections::BTreeMap;

use bgdyn_runtime::{Dd, Scalar};

use super::compare::{SizedLaw, largest, minus, plus, times};
use super::dual::{Direction, Dual, along, rates, with_rates};
use crate::bond_graph::{BondGraph, Site, SiteId};
use crate::expr::Inputs;
use crate::function::Function;
use crate::math::{Mat3, Vec3};
use crate::mechanism::{ContactPair, ContactPartner, ContactSphere, LinkId, Pose};
use crate::method::{CONTACT_DIRECTIONS, ContactMethod, Method, Shape};
use crate::random::Random;

/// A number in which the literal functions are computed.
trait PlainScalar: Scalar<Mask = bool, Refused = Option<usize>> {}
impl<T: Scalar<Mask = bool, Refused = Option<usize>>> PlainScalar for T {}

/// The contacts by the literal poses and velocities of the links.
struct LiteralContacts<'a> {
    graph: &'a BondGraph,
    /// The pose and the velocity of each link that has contacts.
    links: BTreeMap<LinkId, [Function; 2]>,
}

/// The motion of a link.
struct ContactLink<T> {
    rotation: Mat3<T>,
    origin: Vec3<T>,
    angular: Vec3<T>,
    linear: Vec3<T>,
}

/// A contact: what its methods return.
struct Touch<T> {
    gap: T,
    axes: [Vec3<T>; 3],
    point: Vec3<T>,
    velocity: [T; 3],
}

impl<'a> LiteralContacts<'a> {
    /// Returns the contacts of a mechanism; `None` where a link has no literal form.
    fn new(graph: &'a BondGraph, form: &dyn Fn(Method) -> Option<Function>) -> Option<Self> {
        let mut links = BTreeMap::new();
        let pairs = graph.contacts.iter();
        let all = pairs.flat_map(|pair| [pair.sphere.link, pair.partner.link()]);
        for link in all.flatten() {
            let own = |s: &Site| s.link == Some(link) && s.pose == Pose::IDENTITY;
            let site = SiteId(graph.sites.iter().position(own)?);
            links.insert(
                link,
                [form(Method::Pose(site))?, form(Method::Velocity(site))?],
            );
        }
        Some(LiteralContacts { graph, links })
    }

    /// Returns the contacts at a state.
    fn touches<T: PlainScalar>(&self, at: &Inputs<T>) -> Vec<Touch<T>> {
        let links = self.links.iter();
        let motions = links.map(|(link, functions)| (*link, link_motion(functions, at)));
        let motions: BTreeMap<LinkId, ContactLink<T>> = motions.collect();
        let pairs = self.graph.contacts.iter();
        pairs.map(|pair| touch(pair, &motions)).collect()
    }

    /// Returns γ at other velocities.
    fn velocity(&self, at: &Inputs<Dd>, v: Vec<Dd>) -> Vec<Dd> {
        velocities(&self.touches(&Inputs { v, ..at.clone() }))
    }

    /// Returns J, row by row: γ for unit velocities.
    fn jacobian(&self, at: &Inputs<Dd>) -> Vec<Dd> {
        let n = at.v.len();
        let still = self.velocity(at, vec![Dd::ZERO; n]);
        let column = |k: usize| {
            let mut unit = vec![Dd::ZERO; n];
            unit[k] = Dd::ONE;
            minus(&self.velocity(at, unit), &still)
        };
        let columns: Vec<Vec<Dd>> = (0..n).map(column).collect();
        let rows = 0..still.len();
        rows.flat_map(|r| columns.iter().map(move |column| column[r]))
            .collect()
    }

    /// Returns the state that moves with constant velocities and, where they are prescribed, accelerations.
    fn moving(&self, at: &Inputs<Dd>) -> Inputs<Dual> {
        let none = |n: usize| vec![Dd::ZERO; n];
        let direction = Direction {
            q: self.graph.position_rates(&at.q, &at.v),
            v: none(at.v.len()),
            x: none(at.x.len()),
            t: Dd::ZERO,
        };
        let mut inputs = along(at, &direction);
        let mut moved = none(at.parameters.len());
        let released = self.graph.released.iter();
        for prescribed in released.flat_map(|released| &released.prescribed) {
            let [position, velocity, acceleration] = prescribed.motion;
            moved[position.0] = at.parameters[velocity.0];
            moved[velocity.0] = at.parameters[acceleration.0];
        }
        inputs.parameters = with_rates(&at.parameters, &moved);
        inputs
    }
}

fn link_motion<T: PlainScalar>([pose, velocity]: &[Function; 2], at: &Inputs<T>) -> ContactLink<T> {
    let (pose, velocity) = (pose.evaluate(at.clone()).0, velocity.evaluate(at.clone()).0);
    let vector = |x: &[T]| Vec3([x[0], x[1], x[2]]);
    ContactLink {
        rotation: Mat3::from_fn(|i, j| pose[3 * i + j]),
        origin: vector(&pose[9..]),
        angular: vector(&velocity[..3]),
        linear: vector(&velocity[3..]),
    }
}

fn touch<T: PlainScalar>(
    pair: &ContactPair,
    motions: &BTreeMap<LinkId, ContactLink<T>>,
) -> Touch<T> {
    let of = |link: Option<LinkId>| link.and_then(|link| motions.get(&link));
    let number = |x: Dd| T::from_parts(x.hi(), x.lo());
    let half = T::from_f64(0.5);
    let place = |link, at: Vec3<Dd>| {
        let at = at.map(number);
        of(link).map_or(at, |motion| motion.origin + motion.rotation * at)
    };
    let centre = |sphere: &ContactSphere| place(sphere.link, sphere.centre);
    let (own, radius) = (centre(&pair.sphere), number(pair.sphere.radius));
    let (gap, axes, depth) = match &pair.partner {
        ContactPartner::Plane { link, pose } => {
            let rotation = pose.rotation.map(number);
            let rotation = of(*link).map_or(rotation, |motion| motion.rotation * rotation);
            let axes = [0, 1, 2].map(|k| rotation.column(k));
            let gap = axes[2].dot(own - place(*link, pose.translation)) - radius;
            (gap, axes, radius)
        }
        ContactPartner::Sphere(other) => {
            let apart = own - centre(other);
            let distance = apart.dot(apart).sqrt();
            let gap = distance - radius - number(other.radius);
            let normal = apart.map(|x| x / distance);
            (gap, basis(normal), radius + half * gap)
        }
    };
    let point = own - axes[2].scale(depth);
    let [a, b] = [pair.sphere.link, pair.partner.link()].map(|link| {
        let still = Vec3([T::from_f64(0.0); 3]);
        of(link).map_or(still, |motion| {
            motion.linear + motion.angular.cross(point - motion.origin)
        })
    });
    Touch {
        gap,
        axes,
        point,
        velocity: axes.map(|axis| axis.dot(a - b)),
    }
}

/// Returns x, y and n: with s e_z on the side of n, x = e_x − n_x (n + s e_z)/(1 + s n_z), the turn of e_x that takes s e_z
/// to n on the shortest way, and y = n × x.
fn basis<T: PlainScalar>(normal: Vec3<T>) -> [Vec3<T>; 3] {
    let one = T::from_f64(1.0);
    let zero = T::from_f64(0.0);
    let [x, _, z] = normal.0;
    let side = if z.less(zero) { -one } else { one };
    let towards = normal + Vec3([zero, zero, side]);
    let first = Vec3([one, zero, zero]) - towards.scale(x / (one + side * z));
    [first, normal.cross(first), normal]
}

/// Returns γ, contact after contact.
fn velocities<T: PlainScalar>(touches: &[Touch<T>]) -> Vec<T> {
    touches.iter().flat_map(|touch| touch.velocity).collect()
}

fn gaps<T: PlainScalar>(touches: &[Touch<T>]) -> Vec<T> {
    touches.iter().map(|touch| touch.gap).collect()
}

/// Returns axes and contact points as the method does.
fn frames(touches: &[Touch<Dd>]) -> Vec<Dd> {
    let frame = |touch: &Touch<Dd>| {
        let rotation = Mat3(touch.axes.map(|axis| axis.0)).transpose();
        let rotation = rotation.0.into_iter().flatten();
        rotation.chain(touch.point.0).collect::<Vec<Dd>>()
    };
    touches.iter().flat_map(frame).collect()
}

/// Returns the laws of a method of contacts; none where the literal mass matrix is singular.
pub(super) fn laws(
    graph: &BondGraph,
    form: &dyn Fn(Method) -> Option<Function>,
    of: ContactMethod,
    (at, found): (&Inputs<Dd>, &[Dd]),
) -> Option<Vec<SizedLaw>> {
    let literal = LiteralContacts::new(graph, form)?;
    let touches = literal.touches(at);
    let speed = largest(&at.v);
    let found = found.to_vec();
    let expected = velocities(&touches);
    Some(match of {
        ContactMethod::Gaps(_) => vec![("its literal form", found, gaps(&touches), 1.0)],
        ContactMethod::Frames(_) => vec![("its literal form", found, frames(&touches), 1.0)],
        ContactMethod::Velocity(_) => {
            let along = found.iter().skip(2).step_by(CONTACT_DIRECTIONS);
            let along: Vec<Dd> = along.copied().collect();
            let gap_rates = rates(&gaps(&literal.touches(&literal.moving(at))));
            vec![
                ("its literal form", found, expected, speed),
                ("γ_n = the rate of the gap", along, gap_rates, speed),
            ]
        }
        ContactMethod::Jacobian(_) => {
            let still = literal.velocity(at, vec![Dd::ZERO; at.v.len()]);
            let moved = plus(&times(&found, &at.v), &still);
            vec![("J v = γ(v) − γ(0)", moved, expected, speed)]
        }
        ContactMethod::Bias(_) => {
            let moving = velocities(&literal.touches(&literal.moving(at)));
            let text = "J̇ v = the rate of γ at constant velocities";
            vec![(text, found, rates(&moving), speed * speed)]
        }
        ContactMethod::Delassus(_) | ContactMethod::Response(_) => {
            vec![of_impulses(&literal, form, of, (at, &found))?]
        }
    })
}

/// Returns the law of G or of M⁻¹ Jᵀ, for random impulses w: M⁻¹ Jᵀ w = q̈(Jᵀ w) − q̈(0).
fn of_impulses(
    literal: &LiteralContacts<'_>,
    form: &dyn Fn(Method) -> Option<Function>,
    of: ContactMethod,
    (at, found): (&Inputs<Dd>, &[Dd]),
) -> Option<SizedLaw> {
    let n = at.v.len();
    let Shape::Checked(shape) = Method::Contact(of).shape() else {
        return None;
    };
    let entries = shape.spread(&found[n..], n);
    let jacobian = literal.jacobian(at);
    let mut random = Random(37);
    let rows = CONTACT_DIRECTIONS * of.contacts();
    let impulses: Vec<Dd> = (0..rows).map(|_| Dd::from_f64(random.signed())).collect();
    let column = |k: usize| {
        let column = jacobian.iter().skip(k).step_by(n);
        let terms = column.zip(&impulses);
        terms.fold(Dd::ZERO, |sum, (j, w)| sum + *j * *w)
    };
    let efforts: Vec<Dd> = (0..n).map(column).collect();
    let forward = form(Method::ForwardDynamics)?;
    let accelerations = |u: Vec<Dd>| {
        let (found, refused) = forward.evaluate(Inputs { u, ..at.clone() });
        refused.is_none().then_some(found)
    };
    let free = accelerations(vec![Dd::ZERO; n])?;
    let solved = minus(&accelerations(efforts)?, &free);
    let moved = times(&entries, &impulses);
    Some(match of {
        ContactMethod::Response(_) => ("M⁻¹ Jᵀ w = q̈(Jᵀ w) − q̈(0)", moved, solved, 0.0),
        _ => {
            let expected = times(&jacobian, &solved);
            ("G w = J (q̈(Jᵀ w) − q̈(0))", moved, expected, 0.0)
        }
    })
}
