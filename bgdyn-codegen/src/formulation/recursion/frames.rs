//! The bodies of [`super::geometry`] as expressions, for one plan.
//!
//! They have positions, angles, signed coordinates, and inertia regrouped into base parameters.

use bgdyn_runtime::Dd;

use super::base_parameters::{Parts, regrouped};
use super::body_joint::BodyJoint;
use super::contents::contents;
use super::geometry::Geometry;
use super::inertia::{BodyInertia, Point};
use super::joint_columns::{ColumnDirection, JointColumn, joint_columns};
use super::names::{name_body, name_contents, name_number};
use super::plan::{Plan, origin_offset};
use super::rotation::{JointPose, Rotation, joint_pose};
use super::rotors::Rotors;
use crate::bond_graph::Multibody;
use crate::expr::{Builder, Expr};
use crate::formulation::arguments::Arguments;
use crate::math::{Mat3, Vec3, angle_of};
use crate::mechanism::joint::Column;
use crate::mechanism::{LinkId, Motion};

/// A body of the recursion. Lengths are in units of the plan.
pub(super) struct BodyFrame<'g> {
    /// Name of its link.
    pub name: String,
    /// Name of its joint.
    pub joint: String,
    /// The parent body.
    pub parent: Option<usize>,
    /// The motion that its joint allows.
    pub motion: Motion,
    /// Whether its joint has one velocity, about or along z.
    pub axial: bool,
    /// Whether it is a base whose motion is given: gravity is part of its acceleration.
    pub given: bool,
    /// The columns of its joint's motion subspace.
    pub columns: Vec<JointColumn>,
    /// Whether it continues the basis of the parent: parallel axes, grouped.
    pub continues: bool,
    /// Columns: twisted axes in the parent's axes.
    pub twist: Mat3<Dd>,
    /// From the parent's origin to this one: in twisted axes, or in the continued basis.
    pub position: Vec3<Expr<'g>>,
    /// The same in the parent's own axes.
    pub position_in_parent: Vec3<Expr<'g>>,
    /// Rotation from the basis to the body's axes.
    pub turn: Rotation<'g>,
    /// Cosine and sine of the angle about z by which the plan rotates the body's axes.
    pub aim: (Dd, Dd),
    /// Rate of the coordinate, along z; zero for a joint with several.
    pub rate: Expr<'g>,
    /// Second rate of the coordinate, along z.
    pub acceleration: Expr<'g>,
    /// Velocity and acceleration of the body relative to its parent, in own axes, for a joint with several
    /// velocities. The acceleration is that of the velocities alone.
    pub relative: Option<[Column<Expr<'g>>; 2]>,
    /// Base parameters about the origin, in own axes.
    pub inertia: BodyInertia<'g>,
    /// The same without the separate point masses.
    pub rest: BodyInertia<'g>,
    /// The separate point masses.
    pub points: Vec<Point<'g>>,
    /// Factor from a moment or force along z to the joint's effort; 1 for a joint with several velocities.
    pub effort: Dd,
}

impl<'g> BodyFrame<'g> {
    /// Returns the axes of its basis in the world, from the basis and the own axes of the parent there.
    pub fn basis_in_world(
        &self,
        b: &'g Builder,
        parent: Option<(&Mat3<Expr<'g>>, &Mat3<Expr<'g>>)>,
    ) -> Mat3<Expr<'g>> {
        let twist = self.twist.map(|x| b.constant(x));
        match parent {
            None => twist,
            Some((basis, _)) if self.continues => *basis,
            Some((_, own)) => *own * twist,
        }
    }

    /// Returns whether the joint does not move; a base whose motion is given counts as at rest.
    pub fn at_rest(&self, accelerated: bool) -> bool {
        if self.given {
            return true;
        }
        let zero = |column: &Column<Expr<'_>>| {
            let mut all = column.angular.0.iter().chain(&column.linear.0);
            all.all(|x| x.is_zero())
        };
        let alone = if accelerated {
            self.acceleration
        } else {
            self.rate
        };
        alone.is_zero() && (self.relative.iter()).all(|both| zero(&both[usize::from(accelerated)]))
    }
}

/// All bodies, and the constant terms of the base.
pub(super) struct Frames<'g> {
    /// Parents before children. In a plain mechanism in the order of the coordinates.
    pub bodies: Vec<BodyFrame<'g>>,
    /// For each body on the base: gravity in its twisted axes.
    pub gravity: Vec<Vec3<Expr<'g>>>,
    /// Potential energy that does not depend on q.
    pub constant_energy: Expr<'g>,
    /// For each body on the base the first moment that base parameters moved to the base, about the body's origin in base
    /// axes, kg·m.
    pub on_base: Vec<Vec3<Expr<'g>>>,
    /// Rotors behind gears.
    pub rotors: Rotors<'g>,
    /// Names of the coordinates.
    pub names: Vec<String>,
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
        let whole = regrouped(b, graph, geometry, plan);
        let parts = &whole.bodies;
        let mut angles: Vec<(Vec<Expr<'g>>, (Dd, Dd))> = Vec::new();
        let mut bodies: Vec<BodyFrame<'g>> = Vec::new();
        // Cosine and sine of the angle by which each body's axes are rotated about z.
        let mut aims: Vec<(Dd, Dd)> = Vec::new();
        for (j, body) in geometry.bodies.iter().enumerate() {
            b.section(|| format!("{}: place and inertia", body.name));
            let parts = parts[j].in_units_of(plan.unit);
            let (weight, aimed) = aim(b, plan.aimed[j], &parts);
            let mut phase = after(body.phase, aimed);
            aims.push(aimed);
            let continues = plan.grouped && body.parallel;
            let (mut terms, start) = match body.parent {
                Some(p) if continues => angles[p].clone(),
                _ => (Vec::new(), (Dd::ONE, Dd::ZERO)),
            };
            let link = &graph.frames[body.link().0];
            let columns =
                joint_columns(body, link, |k| graph.coordinates[k].name.clone(), plan.unit);
            let own = BodyJoint {
                body,
                link,
                unit: plan.unit,
            };
            let offset = origin_offset(geometry, plan, j);
            let JointPose {
                twist,
                origin: local,
                turn,
            } = match body.axial {
                true => {
                    let (angle, constant) = own.angle(b, x);
                    terms.extend(angle);
                    phase = after(after(start, constant), phase);
                    let local = b.vector(offset.scale(Dd::ONE / plan.unit));
                    JointPose {
                        twist: body.twist,
                        origin: own.slid(b, local, x),
                        turn: Rotation::AboutZ(cos_sin(b, &terms, phase)),
                    }
                }
                false => joint_pose(b, body, link, &x.q, (offset, plan.unit)),
            };
            let position = match body.parent {
                Some(p) if continues => bodies[p].turn.apply(local),
                _ => local,
            };
            let (rate, acceleration) = own.rates(b, &columns, x);
            bodies.push(BodyFrame {
                name: body.name.clone(),
                joint: body.joint.clone(),
                parent: body.parent,
                motion: body.motion,
                axial: body.axial,
                given: body.motion.is_given(),
                continues,
                twist,
                position,
                position_in_parent: twist.map(|t| b.constant(t)) * local,
                turn,
                aim: aimed,
                rate,
                acceleration,
                relative: own.relative(b, x),
                inertia: weight.inertia,
                rest: weight.rest,
                points: weight.points,
                effort: if body.axial {
                    columns[0].effort
                } else {
                    Dd::ONE
                },
                columns,
            });
            angles.push((terms, phase));
        }
        let gravity = geometry.bodies.iter().map(|body| {
            b.vector((body.twist.transpose() * graph.gravity).scale(Dd::ONE / plan.unit))
        });
        let gravity = gravity.collect();
        let rotors = Rotors::new(b, graph, geometry, (&aims, &efforts(graph, &bodies)), x);
        let frames = Frames {
            gravity,
            bodies,
            constant_energy: whole.energy,
            on_base: whole.on_base,
            rotors,
            names: graph.coordinates.iter().map(|c| c.name.clone()).collect(),
        };
        name_data(&frames);
        if !b.is_silent() {
            describe_data(&frames, graph, geometry, (plan, &aims));
        }
        frames
    }
}

impl Frames<'_> {
    /// Returns the coordinates in which roots that also rotate translate.
    pub fn translations(&self) -> Vec<usize> {
        let roots = self
            .bodies
            .iter()
            .filter(|f| f.parent.is_none() && !f.axial);
        let columns = roots.flat_map(|frame| &frame.columns);
        let linear = columns.filter(|c| matches!(c.direction, ColumnDirection::Along(_)));
        linear.map(|column| column.coordinate).collect()
    }
}

/// Returns, for each coordinate, the factor from the component in its direction to its effort; of the
/// joint that mimics no other.
fn efforts(graph: &Multibody, bodies: &[BodyFrame<'_>]) -> Vec<Dd> {
    let mut efforts = vec![Dd::ONE; graph.coordinates.len()];
    let columns = bodies.iter().flat_map(|frame| &frame.columns);
    for column in columns.filter(|column| !column.follows) {
        efforts[column.coordinate] = column.effort;
    }
    efforts
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
    let mut turned = rest.turned(back.into());
    turned.first.0[1] = b.zero();
    let points = parts.points.iter().map(|p| p.turned(back.into())).collect();
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

/// Says which links the numbers of each body are sums of.
fn describe_data(
    frames: &Frames<'_>,
    graph: &Multibody,
    geometry: &Geometry,
    (plan, aims): (&Plan, &[(Dd, Dd)]),
) {
    let contents = contents(graph, geometry, plan);
    let bodies = frames.bodies.iter().zip(&geometry.bodies);
    for (((frame, body), contents), aim) in bodies.zip(contents.iter()).zip(aims) {
        let own: Vec<LinkId> = body.links.iter().map(|(link, _)| *link).collect();
        let aimed = *aim != (Dd::ONE, Dd::ZERO);
        let name = |link: LinkId| graph.frames[link.0].name.clone();
        name_contents(&frame.inertia, (&own, aimed), contents, name);
    }
}
