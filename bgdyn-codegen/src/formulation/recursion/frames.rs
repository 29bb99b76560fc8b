//! The bodies of [`super::geometry`] as expressions, for one plan: positions, angles, signed
//! coordinates, and inertia regrouped into base parameters.

use bgdyn_runtime::Dd;

use super::base_parameters::{Parts, regrouped};
use super::geometry::{Geometry, angle_of};
use super::inertia::{BodyInertia, Point, turn};
use super::names::{name_body, name_number};
use super::plan::{Plan, origin_offset};
use super::rotors::Rotors;
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr};
use crate::formulation::arguments::Arguments;
use crate::math::{Mat3, Vec3};
use crate::mechanism::Motion;

/// A body of the recursion. Lengths are in units of the plan.
pub(super) struct BodyFrame<'g> {
    /// Name of its link.
    pub name: String,
    /// Name of its joint.
    pub joint: String,
    /// The parent body.
    pub parent: Option<usize>,
    /// Rotation or translation.
    pub motion: Motion,
    /// Whether it continues the basis of the parent: parallel axes, grouped.
    pub continues: bool,
    /// Columns: twisted axes in the parent's axes.
    pub twist: Mat3<Dd>,
    /// From the parent's origin to this one: in twisted axes, or in the continued basis.
    pub position: Vec3<Expr<'g>>,
    /// The same in the parent's own axes.
    pub position_in_parent: Vec3<Expr<'g>>,
    /// Cosine and sine of the angle from the basis to the body's axes.
    pub turn: (Expr<'g>, Expr<'g>),
    /// Rate of the coordinate, along z.
    pub rate: Expr<'g>,
    /// Second rate of the coordinate, along z.
    pub acceleration: Expr<'g>,
    /// Base parameters about the origin, in own axes.
    pub inertia: BodyInertia<'g>,
    /// The same without the separate point masses.
    pub rest: BodyInertia<'g>,
    /// The separate point masses.
    pub points: Vec<Point<'g>>,
    /// Factor from a moment or force along z to the joint's effort.
    pub effort: Dd,
}

/// All bodies, and the constant terms of the base.
pub(super) struct Frames<'g> {
    /// In the order of the coordinates.
    pub bodies: Vec<BodyFrame<'g>>,
    /// For each body on the base: gravity in its twisted axes.
    pub gravity: Vec<Vec3<Expr<'g>>>,
    /// Potential energy that does not depend on q.
    pub constant_energy: Expr<'g>,
    /// Rotors behind gears.
    pub rotors: Rotors<'g>,
}

impl<'g> Frames<'g> {
    /// Creates the frames for a plan.
    pub fn new(
        b: &'g Builder,
        graph: &Multibody,
        geometry: &Geometry,
        plan: &Plan,
        x: &Arguments<'g>,
    ) -> Self {
        b.unit_of_length(plan.unit);
        let (parts, energy) = regrouped(b, graph, geometry, plan);
        let mut angles: Vec<(Vec<Expr<'g>>, (Dd, Dd))> = Vec::new();
        let mut bodies: Vec<BodyFrame<'g>> = Vec::new();
        // Cosine and sine of the angle by which each body's axes are rotated about z.
        let mut aims: Vec<(Dd, Dd)> = Vec::new();
        for (j, body) in geometry.bodies.iter().enumerate() {
            b.section(|| format!("{}: place and inertia", body.name));
            let parts = parts[j].in_units_of(plan.unit);
            let (weight, aimed) = aim(b, plan.aimed[j], &parts);
            let phase = after(body.phase, aimed);
            aims.push(aimed);
            let continues = plan.grouped && body.parallel();
            let (mut terms, start) = match body.parent {
                Some(p) if continues => angles[p].clone(),
                _ => (Vec::new(), (Dd::ONE, Dd::ZERO)),
            };
            let signed = |e: Expr<'g>| if body.opposite { -e } else { e };
            let scale = if body.motion == Motion::Rotation {
                Dd::ONE
            } else {
                Dd::ONE / plan.unit
            };
            if body.motion == Motion::Rotation {
                terms.push(signed(x.q[j]));
            }
            let phase = after(start, phase);
            let mut local = b.vector(origin_offset(geometry, plan, j).scale(Dd::ONE / plan.unit));
            if body.motion == Motion::Translation {
                local.0[2] = local.0[2] + signed(x.q[j]) * scale;
            }
            let position = match body.parent {
                Some(p) if continues => turn(local, bodies[p].turn),
                _ => local,
            };
            bodies.push(BodyFrame {
                name: body.name.clone(),
                joint: body.joint.clone(),
                parent: body.parent,
                motion: body.motion,
                continues,
                twist: body.twist,
                position,
                position_in_parent: body.twist.map(|t| b.constant(t)) * local,
                turn: cos_sin(b, &terms, phase),
                rate: signed(x.v[j]) * scale,
                acceleration: signed(x.a[j]) * scale,
                inertia: weight.inertia,
                rest: weight.rest,
                points: weight.points,
                effort: if body.opposite { -scale } else { scale },
            });
            angles.push((terms, phase));
        }
        let gravity = geometry.bodies.iter().map(|body| {
            b.vector((body.twist.transpose() * graph.gravity).scale(Dd::ONE / plan.unit))
        });
        let gravity = gravity.collect();
        let efforts: Vec<Dd> = bodies.iter().map(|frame| frame.effort).collect();
        let rotors = Rotors::new(b, graph, geometry, (&aims, &efforts), x);
        let frames = Frames {
            gravity,
            bodies,
            constant_energy: energy,
            rotors,
        };
        name_data(&frames);
        frames
    }
}

/// Inertia of a body: in total, and without the points.
struct Weight<'g> {
    inertia: BodyInertia<'g>,
    rest: BodyInertia<'g>,
    points: Vec<Point<'g>>,
}

impl<'g> Weight<'g> {
    fn new(b: &'g Builder, rest: BodyInertia<'g>, points: Vec<Point<'g>>) -> Self {
        let all = |sum: BodyInertia<'g>, point| sum.plus(&BodyInertia::of_point(b, point));
        Weight {
            inertia: points.iter().fold(rest, all),
            rest,
            points,
        }
    }
}

/// Rotates the axes of a tip about z so that x points to its centre of mass. Returns its inertia in the
/// new axes, and cosine and sine of the angle.
fn aim<'g>(b: &'g Builder, aimed: bool, parts: &Parts<'g>) -> (Weight<'g>, (Dd, Dd)) {
    let rest = parts.sum();
    let straight = || {
        let weight = Weight::new(b, rest, parts.points.clone());
        (weight, (Dd::ONE, Dd::ZERO))
    };
    let [x, y, _] = rest.first.0.map(Expr::as_constant);
    let (Some(x), Some(y), true) = (x, y, aimed && rest.is_constant()) else {
        return straight();
    };
    let length = (x * x + y * y).sqrt();
    if length == Dd::ZERO {
        return straight();
    }
    let (c, s) = (x / length, y / length);
    let back = (b.constant(c), b.constant(-s));
    let mut turned = rest.turned(back);
    turned.first.0[1] = b.zero();
    let points = parts.points.iter().map(|p| p.turned(back)).collect();
    (Weight::new(b, turned, points), (c, s))
}

/// Returns cosine and sine of the sum of two angles.
fn after(first: (Dd, Dd), second: (Dd, Dd)) -> (Dd, Dd) {
    (
        first.0 * second.0 - first.1 * second.1,
        first.0 * second.1 + first.1 * second.0,
    )
}

/// Returns cosine and sine of Σ terms + phase; quarter turns need no operations.
fn cos_sin<'g>(b: &'g Builder, terms: &[Expr<'g>], phase: (Dd, Dd)) -> (Expr<'g>, Expr<'g>) {
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

/// Names the numbers of a mechanism: gravity, positions, inertias.
fn name_data(frames: &Frames<'_>) {
    for (frame, gravity) in frames.bodies.iter().zip(&frames.gravity) {
        if frame.parent.is_none() {
            name_number(gravity, "g", &frame.name);
        }
        name_number(&frame.position, "r", &frame.name);
        name_body(&frame.inertia, &frame.name);
    }
}
