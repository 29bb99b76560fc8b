//! The bodies of [`super::geometry`] as expressions, for one plan: positions, angles, signed
//! coordinates, and inertia regrouped into base parameters.

use bgdyn_runtime::Dd;

use super::geometry::{Body, Geometry, angle_of};
use super::inertia::{Inertia, turn};
use crate::bond_graph::BondGraph;
use crate::expr::{Builder, Ex};
use crate::formulation::{Arguments, value};
use crate::math::{Mat3, Vec3};
use crate::mechanism::{LinkId, Motion, Pose};

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
    /// Whether inertia is regrouped into base parameters; otherwise every body keeps its own.
    pub base_parameters: bool,
    /// N_z = J_zz ω̇_z + (D_xx − D_yy) ω_x ω_y + … instead of the skew part of U·D.
    pub short_moment: bool,
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
            base_parameters: true,
            short_moment: false,
        }
    }
}

/// A body as the recursion sees it. Lengths are in units of the plan.
pub(super) struct Frame<'g> {
    /// Name of its link.
    pub name: String,
    /// The body that carries it.
    pub parent: Option<usize>,
    /// Rotation or translation.
    pub motion: Motion,
    /// Whether the basis of the parent goes on: parallel axes, grouped.
    pub continues: bool,
    /// Columns: twisted axes in the parent's axes.
    pub twist: Mat3<Dd>,
    /// From the parent's origin to this one: in twisted axes, or in the basis that continues.
    pub position: Vec3<Ex<'g>>,
    /// The same in the parent's own axes.
    pub position_in_parent: Vec3<Ex<'g>>,
    /// Cosine and sine of the angle from the basis to the body's axes.
    pub turn: (Ex<'g>, Ex<'g>),
    /// Coordinate's rate and second rate, along z.
    pub rate: Ex<'g>,
    /// See `rate`.
    pub acceleration: Ex<'g>,
    /// Base parameters about the origin, in own axes.
    pub inertia: Inertia<'g>,
    /// Factor from a moment or force along z to the joint's effort.
    pub effort: Dd,
}

/// All bodies, and what the base keeps.
pub(super) struct Frames<'g> {
    /// In the order of the coordinates.
    pub bodies: Vec<Frame<'g>>,
    /// For each body on the base: gravity in its twisted axes.
    pub gravity: Vec<Vec3<Ex<'g>>>,
    /// Potential energy that does not depend on q.
    pub constant_energy: Ex<'g>,
}

impl<'g> Frames<'g> {
    /// Lays the bodies out for a plan.
    pub fn new(
        b: &'g Builder,
        graph: &BondGraph,
        geometry: &Geometry,
        plan: &Plan,
        x: &Arguments<'g>,
    ) -> Self {
        let mut inertias: Vec<Inertia<'g>> = geometry
            .bodies
            .iter()
            .zip(&plan.slides)
            .map(|(body, &slide)| inertia(b, graph, body, slide))
            .collect();
        let mut energy = constant_energy(b, graph, geometry, &inertias, plan);
        if plan.base_parameters {
            regroup(b, graph, geometry, plan, &mut inertias, &mut energy);
        }
        let mut angles: Vec<(Vec<Ex<'g>>, (Dd, Dd))> = Vec::new();
        let mut bodies: Vec<Frame<'g>> = Vec::new();
        for (j, body) in geometry.bodies.iter().enumerate() {
            let (inertia, phase) = aim(b, body, plan.aimed[j], inertias[j]);
            let continues = plan.grouped && body.parallel();
            let (mut terms, start) = match body.parent {
                Some(p) if continues => angles[p].clone(),
                _ => (Vec::new(), (Dd::ONE, Dd::ZERO)),
            };
            let signed = |e: Ex<'g>| if body.opposite { -e } else { e };
            let scale = if body.motion == Motion::Rotation {
                Dd::ONE
            } else {
                Dd::ONE / plan.unit
            };
            if body.motion == Motion::Rotation {
                terms.push(signed(x.q[j]));
            }
            let phase = (
                start.0 * phase.0 - start.1 * phase.1,
                start.0 * phase.1 + start.1 * phase.0,
            );
            let mut local = b.vector(origin_offset(geometry, plan, j).scale(Dd::ONE / plan.unit));
            if body.motion == Motion::Translation {
                local.0[2] = local.0[2] + signed(x.q[j]) * scale;
            }
            let position = match body.parent {
                Some(p) if continues => turn(local, bodies[p].turn),
                _ => local,
            };
            bodies.push(Frame {
                name: body.name.clone(),
                parent: body.parent,
                motion: body.motion,
                continues,
                twist: body.twist,
                position,
                position_in_parent: body.twist.map(|t| b.constant(t)) * local,
                turn: cos_sin(b, &terms, phase),
                rate: signed(x.v[j]) * scale,
                acceleration: signed(x.a[j]) * scale,
                inertia: inertia.in_units_of(plan.unit),
                effort: if body.opposite { -scale } else { scale },
            });
            angles.push((terms, phase));
        }
        let gravity = geometry.bodies.iter().map(|body| {
            b.vector((body.twist.transpose() * graph.gravity).scale(Dd::ONE / plan.unit))
        });
        Frames {
            gravity: gravity.collect(),
            bodies,
            constant_energy: energy,
        }
    }
}

/// Where the origin of body j is from its parent's, in twisted axes, after the slides, m. The
/// base's place enters nothing but the potential energy.
fn origin_offset(geometry: &Geometry, plan: &Plan, j: usize) -> Vec3<Dd> {
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

/// Inertia of all links of a body about its origin, in its axes.
fn inertia<'g>(b: &'g Builder, graph: &BondGraph, body: &Body, slide: Dd) -> Inertia<'g> {
    let to_body = body.axes.transpose();
    let mut sum = Inertia::zero(b);
    for (link, place) in &body.links {
        let mut placed = placed_inertia(b, graph, *link, place);
        placed = placed.rotated(b, to_body);
        placed = placed.shifted(b.vector(Vec3([Dd::ZERO, Dd::ZERO, -slide])));
        sum = sum.plus(&placed);
    }
    sum
}

/// Inertia of a link about the origin of the axes in which it is placed.
fn placed_inertia<'g>(
    b: &'g Builder,
    graph: &BondGraph,
    link: LinkId,
    place: &Pose,
) -> Inertia<'g> {
    let inertial = graph.inertial(link);
    let tensor = inertial.inertia.map(|x| value(b, x));
    Inertia::at_centre(b, value(b, inertial.mass), tensor)
        .shifted(inertial.com.map(|x| value(b, x)))
        .rotated(b, place.rotation)
        .shifted(b.vector(place.translation))
}

/// −g·r of what hangs on the base at its origin, and of the links that never move.
fn constant_energy<'g>(
    b: &'g Builder,
    graph: &BondGraph,
    geometry: &Geometry,
    inertias: &[Inertia<'g>],
    plan: &Plan,
) -> Ex<'g> {
    let gravity = b.vector(graph.gravity);
    let mut moment = Vec3([b.zero(); 3]);
    for (link, place) in &geometry.fixed {
        moment = moment + placed_inertia(b, graph, *link, place).first;
    }
    for (j, body) in geometry.bodies.iter().enumerate() {
        let mut root = j;
        while let Some(p) = geometry.bodies[root].parent {
            root = p;
        }
        let base = &geometry.bodies[root];
        let slid = Vec3([Dd::ZERO, Dd::ZERO, plan.slides[root]]);
        let origin = base.twist * (base.offset + slid);
        let _ = body;
        moment = moment + b.vector(origin).scale(inertias[j].mass);
    }
    -gravity.dot(moment)
}

/// Moves what lies on a joint's axis to the parent, from the tips to the base: it moves as if it
/// belonged there. What reaches the base is dropped, but for its energy. Run-time parameters stay where they are.
fn regroup<'g>(
    b: &'g Builder,
    graph: &BondGraph,
    geometry: &Geometry,
    plan: &Plan,
    inertias: &mut [Inertia<'g>],
    energy: &mut Ex<'g>,
) {
    for j in (0..geometry.bodies.len()).rev() {
        let body = &geometry.bodies[j];
        if !inertias[j].is_constant() || body.parent.is_some_and(|p| !inertias[p].is_constant()) {
            continue;
        }
        let moved = match body.motion {
            Motion::Rotation => take_from_rotation(b, &mut inertias[j]),
            _ => {
                let phase = (b.constant(body.phase.0), b.constant(body.phase.1));
                take_from_translation(b, &mut inertias[j], body.planar).turned(phase)
            }
        };
        // What moved is the same in twisted as in own axes, about the same origin.
        let at_parent = moved
            .shifted(b.vector(origin_offset(geometry, plan, j)))
            .rotated(b, body.twist);
        match body.parent {
            Some(p) => inertias[p] = inertias[p].plus(&at_parent),
            None => *energy = *energy - b.vector(graph.gravity).dot(at_parent.first),
        }
    }
}

/// What lies on the axis of a rotation: mass, axial first moment, D_zz.
fn take_from_rotation<'g>(b: &'g Builder, own: &mut Inertia<'g>) -> Inertia<'g> {
    let mut moved = Inertia::zero(b);
    (moved.mass, moved.axial) = (own.mass, own.axial);
    moved.first.0[2] = own.first.0[2];
    moved.pseudo[2] = own.pseudo[2];
    (own.mass, own.axial) = (b.zero(), b.zero());
    own.first.0[2] = b.zero();
    own.pseudo[2] = b.zero();
    moved
}

/// What a translation shares with its parent: D, as both turn alike. A planar body also moves
/// like its parent across the axis, so that only its mass along the axis is its own.
fn take_from_translation<'g>(b: &'g Builder, own: &mut Inertia<'g>, planar: bool) -> Inertia<'g> {
    let mut moved = Inertia::zero(b);
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

/// Turns the axes of a tip about z so that x points at its centre of mass; gives its inertia in
/// the new axes and the new phase.
fn aim<'g>(
    b: &'g Builder,
    body: &Body,
    aimed: bool,
    inertia: Inertia<'g>,
) -> (Inertia<'g>, (Dd, Dd)) {
    let [x, y, _] = inertia.first.0.map(Ex::as_constant);
    let (Some(x), Some(y), true) = (x, y, aimed && inertia.is_constant()) else {
        return (inertia, body.phase);
    };
    let length = (x * x + y * y).sqrt();
    if length == Dd::ZERO {
        return (inertia, body.phase);
    }
    let (c, s) = (x / length, y / length);
    let mut turned = inertia.turned((b.constant(c), b.constant(-s)));
    turned.first.0[1] = b.zero();
    let (cos, sin) = body.phase;
    (turned, (cos * c - sin * s, sin * c + cos * s))
}

/// Cosine and sine of Σ terms + phase; quarter turns cost nothing.
fn cos_sin<'g>(b: &'g Builder, terms: &[Ex<'g>], phase: (Dd, Dd)) -> (Ex<'g>, Ex<'g>) {
    let quarter = |x: Dd| x == Dd::ZERO || x == Dd::ONE || x == -Dd::ONE;
    if terms.is_empty() {
        return (b.constant(phase.0), b.constant(phase.1));
    }
    if quarter(phase.0) && quarter(phase.1) {
        let (c, s) = b.cos_sin(terms, Dd::ZERO);
        return (c * phase.0 - s * phase.1, s * phase.0 + c * phase.1);
    }
    b.cos_sin(terms, angle_of(phase))
}
