//! Computes base parameters: moves inertia between bodies to where it costs least.
//!
//! Inertia is linear: that of a body is a sum of parts, and every part can move from body to body
//! independently. Parts that are known at generation time move as far as possible and cost nothing. A part
//! with a run-time parameter costs operations at each addition; the plan chooses how far it moves. Parts are kept apart
//! until they are summed: a factor folds into a product but not into a sum, and a multiple of one parameter stays one.

use std::cell::OnceCell;

use bgdyn_runtime::Dd;

use super::base_parameter_cache::Numbers;
use super::geometry::{Body, Geometry};
use super::inertia::{BodyInertia, Point};
use super::plan::{Plan, origin_offset};
use crate::bond_graph::{LinkFrame, Multibody};
use crate::expr::{Builder, Expr};
use crate::formulation::arguments::value;
use crate::math::Vec3;
use crate::mechanism::joint::Column;
use crate::mechanism::{Inertial, LinkId, Motion, ParameterId, Pose, Tensor, Value};

/// Inertia of a body about its origin, in its axes.
pub(super) struct Parts<'g> {
    /// The part that is known at generation time.
    pub known: BodyInertia<'g>,
    /// Parts with run-time parameters, each with the remaining number of joints by which it may move.
    varying: Vec<(BodyInertia<'g>, usize)>,
    /// Point masses with run-time parameters that remain separate.
    pub points: Vec<Point<'g>>,
}

impl<'g> Parts<'g> {
    fn add(&mut self, known: &BodyInertia<'g>, varying: Option<BodyInertia<'g>>, joints: usize) {
        self.known = self.known.plus(known);
        self.varying.extend(varying.map(|part| (part, joints)));
    }

    /// Converts to units of `length`: every part separately, where factors fold.
    pub fn in_units_of(&self, length: Dd) -> Self {
        let varying = self.varying.iter();
        Parts {
            known: self.known.in_units_of(length),
            varying: varying
                .map(|(part, k)| (part.in_units_of(length), *k))
                .collect(),
            points: self.points.iter().map(|p| p.in_units_of(length)).collect(),
        }
    }

    /// Returns the sum without the points.
    pub fn sum(&self) -> BodyInertia<'g> {
        let parts = self.varying.iter();
        parts.fold(self.known, |sum, (part, _)| sum.plus(part))
    }
}

/// The inertia of a mechanism after the regrouping.
pub(super) struct Regrouped<'g> {
    /// Of every body.
    pub bodies: Vec<Parts<'g>>,
    /// The potential energy that does not depend on q.
    pub energy: Expr<'g>,
    /// For each body on the base the first moment that was moved to the base, about the body's origin in base axes, kg·m.
    pub on_base: Vec<Vec3<Expr<'g>>>,
}

/// Returns the inertia after the regrouping.
pub(super) fn regrouped<'g>(
    b: &'g Builder,
    graph: &Multibody,
    geometry: &Geometry,
    plan: &Plan,
) -> Regrouped<'g> {
    if !graph.parameters.is_empty() {
        return regroup(b, graph, geometry, plan, |_| true);
    }
    let before = &geometry.regrouped;
    if let Some(known) = before.find(&plan.slides, plan.base_parameters) {
        let parts = known.bodies.iter().map(|numbers| Parts {
            known: BodyInertia::of_numbers(b, numbers),
            varying: Vec::new(),
            points: Vec::new(),
        });
        return Regrouped {
            bodies: parts.collect(),
            energy: b.constant(known.energy),
            on_base: known.on_base.iter().map(|&h| b.vector(h)).collect(),
        };
    }
    let made = regroup(b, graph, geometry, plan, |_| true);
    let numbers = made.bodies.iter().map(|parts| parts.known.numbers());
    let on_base = made.on_base.iter().map(|h| constant(*h));
    if let (Some(bodies), Some(energy), Some(on_base)) = (
        numbers.collect(),
        made.energy.as_constant(),
        on_base.collect(),
    ) {
        before.keep(Numbers {
            slides: plan.slides.clone(),
            base_parameters: plan.base_parameters,
            bodies,
            energy,
            on_base,
            contents: OnceCell::new(),
        });
    }
    made
}

/// Returns a vector that is known at generation time.
fn constant(v: Vec3<Expr<'_>>) -> Option<Vec3<Dd>> {
    let [x, y, z] = v.0.map(Expr::as_constant);
    Some(Vec3([x?, y?, z?]))
}

/// Regroups the inertia of these links.
pub(super) fn regroup<'g>(
    b: &'g Builder,
    graph: &Multibody,
    geometry: &Geometry,
    plan: &Plan,
    counts: impl Fn(LinkId) -> bool,
) -> Regrouped<'g> {
    let parts = |j: usize| parts(b, graph, &geometry.bodies[j], (plan, j), &counts);
    let mut bodies: Vec<Parts<'g>> = (0..geometry.bodies.len()).map(parts).collect();
    let mut energy = constant_energy(b, graph, geometry, plan);
    let mut on_base = vec![Vec3([b.zero(); 3]); bodies.len()];
    if !plan.base_parameters {
        return Regrouped {
            bodies,
            energy,
            on_base,
        };
    }
    for j in (0..bodies.len()).rev() {
        let body = &geometry.bodies[j];
        let mut take = |own: &mut BodyInertia<'g>| {
            let at_parent = take_to_parent(b, graph, geometry, (plan, j), own);
            if body.parent.is_none() {
                energy = energy - b.vector(graph.gravity).dot(at_parent.first);
                on_base[j] = on_base[j] + at_parent.first;
            }
            at_parent
        };
        let known = take(&mut bodies[j].known);
        let mut varying = Vec::new();
        for (part, joints) in &mut bodies[j].varying {
            if *joints > 0 {
                varying.push((take(part), *joints - 1));
            }
        }
        if let Some(p) = body.parent {
            bodies[p].known = bodies[p].known.plus(&known);
            bodies[p].varying.extend(varying);
        }
    }
    Regrouped {
        bodies,
        energy,
        on_base,
    }
}

/// Takes from body j the inertia that its parent moves alike, and returns it about the parent's origin, in its axes.
pub(super) fn take_to_parent<'g>(
    b: &'g Builder,
    graph: &Multibody,
    geometry: &Geometry,
    (plan, j): (&Plan, usize),
    own: &mut BodyInertia<'g>,
) -> BodyInertia<'g> {
    let body = &geometry.bodies[j];
    let offset = b.vector(origin_offset(geometry, plan, j));
    let phase = (b.constant(body.phase.0), b.constant(body.phase.1));
    // The moved part is the same in twisted axes as in own axes, about the same origin.
    let moved = match body.motion {
        Motion::Rotation => take_from_rotation(b, own),
        Motion::Translation => take_from_translation(b, own, body.planar).turned(phase.into()),
        _ => take_from_compound(b, own, body, &graph.frames[body.link().0]),
    };
    moved.shifted(offset).rotated(b, body.twist)
}

/// Returns the parts of body j in the spec, of these links. A tensor is divided by its parameters: multiples of one
/// parameter remain multiples when they move, and their factors fold.
fn parts<'g>(
    b: &'g Builder,
    graph: &Multibody,
    body: &Body,
    (plan, j): (&Plan, usize),
    counts: &impl Fn(LinkId) -> bool,
) -> Parts<'g> {
    let mut parts = Parts {
        known: BodyInertia::zero(b),
        varying: Vec::new(),
        points: Vec::new(),
    };
    let to_body = body.axes.transpose();
    let slide = b.vector(Vec3([Dd::ZERO, Dd::ZERO, plan.slides[j]]));
    for (link, pose) in body.links.iter().filter(|(link, _)| counts(*link)) {
        let inertial = graph.inertial(*link);
        let point = point(b, &inertial, pose);
        let point = Point {
            position: to_body.map(|x| b.constant(x)) * point.position - slide,
            ..point
        };
        if plan.apart[j] && !point.is_constant() {
            parts.points.push(point);
        } else {
            let (known, varying) = BodyInertia::of_point(b, &point).split(b);
            parts.add(&known, varying, plan.carried[j]);
        }
        let tensor = inertial.inertia;
        let turned = |entries| {
            BodyInertia::of_tensor(b, entries).rotated(b, to_body * pose.rotation * tensor.axes)
        };
        let only = |wanted: Option<ParameterId>| {
            tensor.entries.map(|x| match (x, wanted) {
                (Value::Fixed(_), None) => value(b, x),
                (Value::Parameter(p), Some(w)) if p == w => value(b, x),
                _ => b.zero(),
            })
        };
        parts.known = parts.known.plus(&turned(only(None)));
        for parameter in parameters(&tensor) {
            let varying = (turned(only(Some(parameter))), plan.carried[j]);
            parts.varying.push(varying);
        }
    }
    parts
}

/// Returns the distinct run-time parameters of a tensor.
fn parameters(tensor: &Tensor) -> Vec<ParameterId> {
    let mut found = Vec::new();
    for entry in tensor.entries {
        if let Value::Parameter(p) = entry
            && !found.contains(&p)
        {
            found.push(p);
        }
    }
    found
}

/// Returns a link's mass at its centre, in the axes in which the link's pose is given.
pub(super) fn point<'g>(b: &'g Builder, inertial: &Inertial, pose: &Pose) -> Point<'g> {
    let com = inertial.com.map(|x| value(b, x));
    Point {
        mass: value(b, inertial.mass),
        position: pose.rotation.map(|x| b.constant(x)) * com + b.vector(pose.translation),
    }
}

/// Returns −g·r of the mass on the base at its origin, and of the links that never move.
fn constant_energy<'g>(
    b: &'g Builder,
    graph: &Multibody,
    geometry: &Geometry,
    plan: &Plan,
) -> Expr<'g> {
    let gravity = b.vector(graph.gravity);
    let weigh = |mass: Expr<'g>, at: Vec3<Expr<'g>>| gravity.dot(at.scale(mass));
    let mut energy = b.zero();
    for (link, pose) in &geometry.fixed {
        let point = point(b, &graph.inertial(*link), pose);
        energy = energy - weigh(point.mass, point.position);
    }
    for (j, body) in geometry.bodies.iter().enumerate() {
        let mut root = j;
        while let Some(p) = geometry.bodies[root].parent {
            root = p;
        }
        let base = &geometry.bodies[root];
        let slid = Vec3([Dd::ZERO, Dd::ZERO, plan.slides[root]]);
        let origin = b.vector(base.twist * (base.offset + slid));
        for (link, _) in &body.links {
            energy = energy - weigh(value(b, graph.inertial(*link).mass), origin);
        }
    }
    energy
}

/// Takes from a rotation the inertia on its axis: mass, axial first moment, D_zz.
fn take_from_rotation<'g>(b: &'g Builder, own: &mut BodyInertia<'g>) -> BodyInertia<'g> {
    let mut moved = BodyInertia::zero(b);
    (moved.mass, moved.axial) = (own.mass, own.axial);
    moved.first.0[2] = own.first.0[2];
    moved.pseudo[2] = own.pseudo[2];
    (own.mass, own.axial) = (b.zero(), b.zero());
    own.first.0[2] = b.zero();
    own.pseudo[2] = b.zero();
    moved
}

/// Takes from another joint the inertia that its parent moves alike: from rotations about a point the mass
/// there, from rotations about z with translations D_zz; nothing if it translates and rotates in all
/// directions.
fn take_from_compound<'g>(
    b: &'g Builder,
    own: &mut BodyInertia<'g>,
    body: &Body,
    link: &LinkFrame,
) -> BodyInertia<'g> {
    let zero = Vec3([Dd::ZERO; 3]);
    let mut moved = BodyInertia::zero(b);
    let columns = link.columns();
    let of = |part: fn(&Column<Dd>) -> Vec3<Dd>| {
        let parts = columns.iter().map(move |(_, column)| part(column));
        parts.filter(|v| *v != zero).collect::<Vec<_>>()
    };
    let (turns, shifts) = (of(|c| c.angular), of(|c| c.linear));
    if shifts.is_empty() {
        (moved.mass, moved.axial) = (own.mass, own.axial);
        (own.mass, own.axial) = (b.zero(), b.zero());
    } else if body.axial || turns.iter().all(|axis| axis.0[..2] == [Dd::ZERO; 2]) {
        moved.pseudo[2] = own.pseudo[2];
        own.pseudo[2] = b.zero();
    }
    moved
}

/// Takes from a translation the inertia shared with its parent: D, because both rotate equally. A planar
/// body also moves like its parent across the axis, so that only its mass along the axis remains.
fn take_from_translation<'g>(
    b: &'g Builder,
    own: &mut BodyInertia<'g>,
    planar: bool,
) -> BodyInertia<'g> {
    let mut moved = BodyInertia::zero(b);
    moved.pseudo = own.pseudo;
    own.pseudo = [b.zero(); 6];
    if planar {
        moved.mass = own.mass;
        moved.first = Vec3([own.first.0[0], own.first.0[1], b.zero()]);
        own.mass = b.zero();
        own.first = Vec3([b.zero(), b.zero(), own.first.0[2]]);
    }
    moved
}
