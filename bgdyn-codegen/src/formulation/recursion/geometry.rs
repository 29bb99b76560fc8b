//! Body frames for the recursion.
//!
//! The axis z is along the joint's axis, x along the common normal with the next joint's axis, and origins can
//! slide along z.
//!
//! Welded links are one body; body j is moved by coordinate j. Between a body and its parent are the
//! *twisted axes* T: the parent's axes rotated by a constant rotation whose third column is the joint's
//! axis. The body's own axes are T rotated by Rz(φ), φ = ±q + a constant.
//!
//! A joint with several velocities has no such axis. Its body has the axes of its link, in which the
//! columns of its motion subspace are constant, and T are the axes of the joint's origin.

use bgdyn_runtime::Dd;

use super::base_parameter_cache::BaseParameterCache;
use crate::bond_graph::Multibody;
use crate::math::{Mat3, Vec3};
use crate::mechanism::{LinkId, Motion, Pose};

/// A component of a rotation below this size is the rounding error of a zero in double-double.
const NOISE: f64 = 1e-26;

/// Largest ratio of the distance to two axes' common normal to the distance of their origins.
const FAR: f64 = 4.0;

/// A rigid body: the links that one joint moves, and their frame.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    /// Name of the link outboard of the joint.
    pub name: String,
    /// Name of the joint.
    pub joint: String,
    /// The parent body; `None` for the fixed base.
    pub parent: Option<usize>,
    /// The motion that its joint allows.
    pub motion: Motion,
    /// Whether its joint has one velocity, about or along z.
    pub axial: bool,
    /// Whether its axis is parallel to the axis of its parent body.
    pub parallel: bool,
    /// Whether z is opposite to the joint's axis, so that parallel joints have one direction.
    pub opposite: bool,
    /// Whether every joint from the base to this one has the same axis: the body moves in a plane, and
    /// along the axis.
    pub planar: bool,
    /// Columns: twisted axes in the parent's body axes (in world axes for the base).
    pub twist: Mat3<Dd>,
    /// The body's origin in twisted axes at coordinate zero, from the parent's origin.
    pub offset: Vec3<Dd>,
    /// Cosine and sine of the constant part of φ.
    pub phase: (Dd, Dd),
    /// Columns: body axes in the axes of the link outboard of the joint.
    pub axes: Mat3<Dd>,
    /// Whether the direction of x is not determined by another joint.
    pub free_x: bool,
    /// Links of the body with their poses in the first link's axes.
    pub links: Vec<(LinkId, Pose)>,
    /// Whether one of them has a run-time parameter.
    pub varying: bool,
    /// Whether it is the link without mass between two joints in series.
    pub hidden: bool,
}

impl Body {
    /// Returns the link outboard of its joint.
    pub fn link(&self) -> LinkId {
        self.links[0].0
    }

    /// Returns the feet of the common normal with the parent's axis: (distance from the parent's origin
    /// along its z, distance from the foot to this origin along this z). Parallel axes have no unique
    /// normal; then the whole distance counts as this body's. For almost parallel axes the normal is so
    /// far away that inertia relative to it would lose its digits: they count as parallel. A body without
    /// an axis has its origin as its foot.
    pub fn normal_feet(&self) -> (Dd, Dd) {
        if !self.axial {
            return ((self.twist * self.offset).0[2], Dd::ZERO);
        }
        let [_, sin, cos] = (self.twist.transpose() * unit(2)).0;
        let [_, y, z] = self.offset.0;
        let size = largest(self.offset);
        if y.hi().abs() > FAR * size * sin.hi().abs() || sin == Dd::ZERO {
            return (Dd::ZERO, z);
        }
        let along_parent = y / sin;
        (along_parent, z - along_parent * cos)
    }

    /// Returns the displacements of its origin along its axis for which the origin is closest to the
    /// parent's, or for which a coordinate of the origin in the parent's axes is zero. Where the axis is
    /// almost perpendicular to that coordinate's, the displacement is as far as in
    /// [`Body::normal_feet`], and left out for the same reason.
    pub fn near_parent(&self) -> Vec<Dd> {
        let [origin, z] = [self.twist * self.offset, self.twist.column(2)].map(|v| v.0);
        let size = largest(self.offset);
        let near =
            |k: &usize| z[*k] != Dd::ZERO && origin[*k].hi().abs() <= FAR * size * z[*k].hi().abs();
        let zeros = (0..3).filter(near).map(|k| -origin[k] / z[k]);
        [-self.offset.0[2]].into_iter().chain(zeros).collect()
    }
}

/// The bodies, parents before children, and the links welded to the world.
pub(crate) struct Geometry {
    /// Parents before children. In a plain mechanism in the order of the coordinates.
    pub bodies: Vec<Body>,
    /// Links that never move, with their poses in the world.
    pub fixed: Vec<(LinkId, Pose)>,
    /// Cache of regrouped inertia.
    pub(super) regrouped: BaseParameterCache,
}

impl Geometry {
    /// Returns the parent of each body.
    pub fn parents(&self) -> Vec<Option<usize>> {
        self.bodies.iter().map(|body| body.parent).collect()
    }

    /// Returns whether a body has an axis and carries no other body.
    pub fn axial_tip(&self, j: usize) -> bool {
        self.bodies[j].axial && self.bodies.iter().all(|body| body.parent != Some(j))
    }
}

/// Returns the bodies of a bond graph.
pub(crate) fn geometry(graph: &Multibody) -> Geometry {
    let mut made = Geometry {
        bodies: Vec::new(),
        fixed: Vec::new(),
        regrouped: BaseParameterCache::default(),
    };
    // The body of each link, and its pose in the axes of the body's first link.
    let mut homes: Vec<(Option<usize>, Pose)> = Vec::new();
    let mut placed: Vec<Pose> = Vec::new();
    for (i, frame) in graph.frames.iter().enumerate() {
        let (parent, pose) = match frame.parent {
            None => (None, frame.origin),
            Some(p) => (homes[p.0].0, compose(&homes[p.0].1, &frame.origin)),
        };
        if frame.motion == Motion::None {
            homes.push((parent, pose));
            match parent {
                Some(body) => made.bodies[body].links.push((LinkId(i), pose)),
                None => made.fixed.push((LinkId(i), pose)),
            }
            continue;
        }
        let still = Pose::IDENTITY;
        let axial = frame.motion.has_axis();
        homes.push((Some(made.bodies.len()), still));
        placed.push(pose);
        made.bodies.push(Body {
            name: frame.name.clone(),
            joint: match frame.coordinate {
                Some(j) => graph.coordinates[j.0].name.clone(),
                None => frame.name.clone(),
            },
            parent,
            motion: frame.motion,
            axial,
            parallel: false,
            opposite: false,
            planar: false,
            twist: identity(),
            offset: pose.translation,
            phase: (Dd::ONE, Dd::ZERO),
            axes: match axial {
                true => basis_with_z(frame.axis),
                false => identity(),
            },
            free_x: true,
            links: vec![(LinkId(i), still)],
            varying: false,
            hidden: frame.hidden,
        });
    }
    align_parallel_axes(&mut made.bodies, &placed);
    for body in &mut made.bodies {
        body.varying = (body.links.iter()).any(|(link, _)| graph.inertial(*link).varies());
    }
    for j in 0..made.bodies.len() {
        match made.bodies[j].axial {
            true => orient(&mut made.bodies, &placed, j),
            false => place_in_parent(&mut made.bodies, &placed[j], j),
        }
    }
    made
}

/// Reverses z if the axis is opposite to the parent's, so that parallel axes are equal.
fn align_parallel_axes(bodies: &mut [Body], placed: &[Pose]) {
    for j in 0..bodies.len() {
        let Some(p) = bodies[j].parent else { continue };
        if !(bodies[j].axial && bodies[p].axial) {
            continue;
        }
        let z = bodies[p].axes.transpose() * (placed[j].rotation * bodies[j].axes.column(2));
        if along_z(z) && z.0[2] < Dd::ZERO {
            bodies[j].opposite = true;
            bodies[j].axes = bodies[j].axes * half_turn_about_x();
        }
    }
}

/// Chooses x of body j, then its twist, offset and phase.
fn orient(bodies: &mut [Body], placed: &[Pose], j: usize) {
    let parent_axes = bodies[j].parent.map_or(identity(), |p| bodies[p].axes);
    // The body's pose in the parent's body axes, with the original x.
    let rotation = clean_matrix(parent_axes.transpose() * placed[j].rotation * bodies[j].axes);
    let offset = parent_axes.transpose() * placed[j].translation;
    let twist = match bodies[j].parent {
        Some(_) => twisted_axes(rotation.column(2)),
        None => rotation,
    };
    let x = normal_to_child(bodies, placed, j);
    bodies[j].free_x = x.is_none();
    // If the direction of x is free, the phase is zero.
    let x = x.unwrap_or_else(|| {
        let in_link = placed[j].rotation.transpose() * (parent_axes * twist.column(0));
        clean(in_link)
    });
    let z = bodies[j].axes.column(2);
    bodies[j].axes = clean_matrix(columns(x, z.cross(x), z));
    let turned = clean_matrix(
        twist.transpose() * (parent_axes.transpose() * placed[j].rotation * bodies[j].axes),
    );
    match bodies[j].parent {
        Some(_) => {
            bodies[j].twist = twist;
            bodies[j].phase = (turned.0[0][0], turned.0[1][0]);
        }
        // The base has no axes of its own: the twisted axes are the body's axes at zero.
        None => bodies[j].twist = clean_matrix(placed[j].rotation * bodies[j].axes),
    }
    bodies[j].offset = clean_length(bodies[j].twist.transpose() * offset);
    let parent = bodies[j].parent;
    bodies[j].parallel = parent.is_some_and(|p| bodies[p].axial) && bodies[j].twist == identity();
    bodies[j].planar = parent.is_none_or(|p| bodies[p].planar && bodies[j].parallel);
}

/// Computes twist and offset of body j, whose joint has several velocities: T are the axes of the joint's
/// origin.
fn place_in_parent(bodies: &mut [Body], placed: &Pose, j: usize) {
    let to_parent = bodies[j]
        .parent
        .map_or(identity(), |p| bodies[p].axes.transpose());
    let twist = clean_matrix(to_parent * placed.rotation);
    bodies[j].twist = twist;
    bodies[j].offset = clean_length(twist.transpose() * (to_parent * placed.translation));
}

/// Returns the direction of the common normal with the axis of the first child that has one, in the axes
/// of the first link of body j.
fn normal_to_child(bodies: &[Body], placed: &[Pose], j: usize) -> Option<Vec3<Dd>> {
    let z = bodies[j].axes.column(2);
    let children = (0..bodies.len()).filter(|&c| bodies[c].parent == Some(j));
    let normal = |c: usize| {
        let child_z = placed[c].rotation * bodies[c].axes.column(2);
        let normal = match bodies[c].axial {
            true => clean(z.cross(child_z)),
            false => Vec3([Dd::ZERO; 3]),
        };
        if normal != Vec3([Dd::ZERO; 3]) {
            return Some(perpendicular(normal, z));
        }
        // Parallel axes, or a child without an axis: from one to the other. The remainder of a distance
        // along z does not count.
        let p = placed[c].translation;
        let across = p - z.scale(z.dot(p));
        let apart = across.dot(across) > p.dot(p) * Dd::from_f64(NOISE * NOISE);
        apart.then(|| perpendicular(clean_length(across), z))
    };
    children.into_iter().find_map(normal)
}

/// Returns whether a direction is parallel to the third unit vector, within rounding. The perpendicular
/// components decide: the third component is 1 to the last digit already for axes 1e-16 rad apart.
fn along_z(z: Vec3<Dd>) -> bool {
    z.0[..2].iter().all(|x| x.hi().abs() < NOISE)
}

/// Returns axes with third column `z` and the first one along the common normal with the third unit
/// vector; the identity if they are parallel.
fn twisted_axes(z: Vec3<Dd>) -> Mat3<Dd> {
    if along_z(z) {
        return match z.0[2] < Dd::ZERO {
            true => half_turn_about_x(),
            false => identity(),
        };
    }
    let mut x = normalised(clean(unit(2).cross(z)));
    // Of the two directions, choose the one with a positive leading component, to avoid half a turn.
    if x.0[0] < Dd::ZERO || (x.0[0] == Dd::ZERO && x.0[1] < Dd::ZERO) {
        x = -x;
    }
    clean_matrix(columns(x, z.cross(x), z))
}

/// Returns right-handed axes with third column `z`. If z is a unit vector to the last digit in every
/// component, so are the axes; a component is 1 in double-double also for axes that are 1e-16 rad off.
fn basis_with_z(z: Vec3<Dd>) -> Mat3<Dd> {
    let least = (0..3)
        .rev()
        .min_by(|&a, &b| z.0[a].abs().hi().total_cmp(&z.0[b].abs().hi()));
    let exact = |k: usize| (0..3).all(|i| i == k || z.0[i] == Dd::ZERO);
    let third = (0..3).find(|&k| exact(k));
    let x = match third {
        Some(k) => unit((k + 1) % 3),
        None => {
            let e = unit(least.unwrap_or(0));
            normalised(e - z.scale(e.dot(z)))
        }
    };
    clean_matrix(columns(x, z.cross(x), z))
}

pub(crate) fn identity() -> Mat3<Dd> {
    Mat3::from_fn(|i, j| if i == j { Dd::ONE } else { Dd::ZERO })
}

fn half_turn_about_x() -> Mat3<Dd> {
    Mat3::from_fn(|i, j| match (i, j) {
        (0, 0) => Dd::ONE,
        (1, 1) | (2, 2) => -Dd::ONE,
        _ => Dd::ZERO,
    })
}

fn unit(k: usize) -> Vec3<Dd> {
    Vec3(std::array::from_fn(
        |i| if i == k { Dd::ONE } else { Dd::ZERO },
    ))
}

fn columns(x: Vec3<Dd>, y: Vec3<Dd>, z: Vec3<Dd>) -> Mat3<Dd> {
    Mat3([x.0, y.0, z.0]).transpose()
}

fn normalised(v: Vec3<Dd>) -> Vec3<Dd> {
    v.scale(Dd::ONE / v.dot(v).sqrt())
}

/// Returns the direction of `v`, perpendicular to the unit vector `z` to the last digit: a short `v` from
/// a cancellation is only roughly perpendicular.
fn perpendicular(v: Vec3<Dd>, z: Vec3<Dd>) -> Vec3<Dd> {
    let v = normalised(v);
    normalised(v - z.scale(z.dot(v)))
}

/// Returns a direction with rounding errors removed from its zeros, and from its one if all others are
/// zero.
fn clean(v: Vec3<Dd>) -> Vec3<Dd> {
    let small = |x: &Dd| x.hi().abs() < NOISE;
    let alone = v.0.iter().filter(|x| small(x)).count() == 2;
    v.map(|x| {
        if small(&x) {
            return Dd::ZERO;
        }
        let ones = [Dd::ONE, -Dd::ONE].into_iter();
        let mut near = ones.filter(|&one| alone && small(&(x - one)));
        near.next().unwrap_or(x)
    })
}

/// Applies [`clean`] to each column of a rotation.
fn clean_matrix(m: Mat3<Dd>) -> Mat3<Dd> {
    let [x, y, z] = std::array::from_fn(|k| clean(m.column(k)));
    columns(x, y, z)
}

/// Returns the largest absolute component.
pub(super) fn largest(v: Vec3<Dd>) -> f64 {
    v.0.iter().fold(0.0, |m: f64, x| m.max(x.hi().abs()))
}

/// Returns a position with rounding errors removed from its zeros.
fn clean_length(v: Vec3<Dd>) -> Vec3<Dd> {
    let size = largest(v);
    v.map(|x| {
        if x.hi().abs() < NOISE * size {
            Dd::ZERO
        } else {
            x
        }
    })
}

/// Returns the pose of `inner`, given in the axes of `outer`, in the axes in which `outer` is given.
fn compose(outer: &Pose, inner: &Pose) -> Pose {
    Pose {
        rotation: clean_matrix(outer.rotation * inner.rotation),
        translation: outer.translation + outer.rotation * inner.translation,
    }
}
