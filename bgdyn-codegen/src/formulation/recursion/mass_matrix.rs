//! Mass matrix by composite bodies, in the frames of the recursion.
//!
//! From the tips to the base, each body is combined with its outboard bodies. A unit rate of joint k gives
//! the composite body the momentum h = (−m y, m x, 0) and, about the joint's origin, L = (−D_xz, −D_yz,
//! J_zz), entries of the rotated composite; transformed to the base they give the row of k.

use std::cmp::Ordering;

use bgdyn_runtime::Dd;

use super::frames::{BodyFrame, Frames};
use super::inertia::BodyInertia;
use super::joint_columns::{ColumnDirection, JointColumn};
use super::names::{name_composite, name_vector};
use crate::expr::{Builder, Expr};
use crate::math::Vec3;

/// Momentum of all outboard bodies per unit rate in the direction of a coordinate.
#[derive(Clone, Copy)]
pub(super) struct Momentum<'g> {
    /// The coordinate.
    pub joint: usize,
    /// Factor from the velocity of the coordinate to that rate.
    pub effort: Dd,
    pub linear: Vec3<Expr<'g>>,
    pub angular: Vec3<Expr<'g>>,
}

impl<'g> Momentum<'g> {
    /// Applies `f`, a change of axes.
    pub fn map(self, f: impl Fn(Vec3<Expr<'g>>) -> Vec3<Expr<'g>>) -> Self {
        Momentum {
            linear: f(self.linear),
            angular: f(self.angular),
            ..self
        }
    }

    /// Returns the momentum about a point from which the present origin is displaced by p.
    pub fn carried(self, p: Vec3<Expr<'g>>) -> Self {
        Momentum {
            angular: self.angular + p.cross(self.linear),
            ..self
        }
    }

    /// Returns the component in the direction of a column.
    pub fn along(&self, column: &JointColumn) -> Expr<'g> {
        column.direction.component(self.angular, self.linear)
    }
}

/// Momenta of coordinates, one for each coordinate and factor.
#[derive(Clone)]
pub(super) struct BodyMomenta<'g>(Vec<Momentum<'g>>);

impl<'g> BodyMomenta<'g> {
    /// Adds another one, in the same axes and about the same point. The momentum of a rotor elsewhere is
    /// added to that of the bodies outboard of its joint.
    pub fn add(&mut self, more: Momentum<'g>) {
        let same = |m: &&mut Momentum<'g>| (m.joint, m.effort) == (more.joint, more.effort);
        match self.0.iter_mut().find(same) {
            Some(m) => {
                m.linear = m.linear + more.linear;
                m.angular = m.angular + more.angular;
            }
            None => self.0.push(more),
        }
    }
}

impl<'g> Extend<Momentum<'g>> for BodyMomenta<'g> {
    fn extend<I: IntoIterator<Item = Momentum<'g>>>(&mut self, more: I) {
        more.into_iter().for_each(|m| self.add(m));
    }
}

/// The sum of outboard bodies.
struct Gathered<'g> {
    inertia: BodyInertia<'g>,
    momenta: BodyMomenta<'g>,
}

/// The composite body of a joint, and its momenta per unit rates.
struct CompositeInertia<'g> {
    /// In the axes of the basis.
    whole: BodyInertia<'g>,
    /// In the axes of the columns.
    units: Vec<Momentum<'g>>,
}

impl<'g> CompositeInertia<'g> {
    /// Combines body j with `inner`, its outboard bodies in its own axes, and `outer`, those in the axes
    /// of its basis.
    fn new(
        b: &'g Builder,
        frame: &BodyFrame<'g>,
        inner: &BodyInertia<'g>,
        outer: &BodyInertia<'g>,
    ) -> Self {
        let composite = frame.inertia.plus(inner);
        if outer.is_zero() {
            name_composite(&composite, &frame.name);
        }
        let whole = composite.turned(frame.turn).plus(outer);
        name_composite(&whole, &format!("at_{}", frame.joint));
        // A rotation about z does not change J_zz.
        let j_zz = (composite.d(0, 0) + composite.d(1, 1)) + (outer.d(0, 0) + outer.d(1, 1));
        let moved = if frame.axial { &whole } else { &composite };
        let unit = |column| unit_momentum(b, column, moved, frame.axial.then_some(j_zz));
        let units = frame.columns.iter().map(unit).collect();
        CompositeInertia { whole, units }
    }
}

/// Returns the inertia about the parent's origin, in the parent's axes or in the basis that continues.
fn turned_on<'g>(
    b: &'g Builder,
    frame: &BodyFrame<'g>,
    shifted: &BodyInertia<'g>,
) -> BodyInertia<'g> {
    if frame.continues {
        *shifted
    } else {
        shifted.rotated(b, frame.twist)
    }
}

/// Returns, for each body, the momenta of all bodies that its joint moves per unit rates about the joint's origin: in the
/// axes of the columns.
pub(super) fn composites<'g>(b: &'g Builder, frames: &Frames<'g>) -> Vec<Vec<Momentum<'g>>> {
    let n = frames.bodies.len();
    let (mut own, mut basis) = (vec![BodyInertia::zero(b); n], vec![BodyInertia::zero(b); n]);
    let mut units = Vec::new();
    for j in (0..n).rev() {
        let frame = &frames.bodies[j];
        b.section(|| format!("{}: inertia with all it carries", frame.name));
        let composite = CompositeInertia::new(b, frame, &own[j], &basis[j]);
        units.push(composite.units);
        let Some(p) = frame.parent else { continue };
        let home = if frame.continues {
            &mut basis[p]
        } else {
            &mut own[p]
        };
        let shifted = composite.whole.shifted(frame.position);
        *home = home.plus(&turned_on(b, frame, &shifted));
    }
    units.reverse();
    units
}

/// Returns the lower triangle of M.
pub(super) fn mass_matrix<'g>(b: &'g Builder, frames: &Frames<'g>) -> Vec<Vec<Expr<'g>>> {
    let (n, all) = (frames.bodies.len(), frames.rotors.coordinates());
    let empty = || Gathered {
        inertia: BodyInertia::zero(b),
        momenta: BodyMomenta(Vec::new()),
    };
    let mut own: Vec<Gathered<'g>> = (0..n).map(|_| empty()).collect();
    let mut basis: Vec<Gathered<'g>> = (0..n).map(|_| empty()).collect();
    let mut mass: Vec<Vec<Expr<'g>>> = (0..all).map(|j| vec![b.zero(); j + 1]).collect();
    for j in (0..n).rev() {
        let frame = &frames.bodies[j];
        b.section(|| {
            format!(
                "{}: inertia with all it carries; row of `{}`: momenta of the joints beyond",
                frame.name, frame.joint
            )
        });
        let (inner, outer) = (&own[j], &basis[j]);
        let composite = CompositeInertia::new(b, frame, &inner.inertia, &outer.inertia);
        // The joint that drives a rotor can be anywhere: outboard of the body, inboard, or the body's own.
        let rotors = frames.rotors.on(j).map(|rotor| Momentum {
            joint: rotor.joint,
            effort: rotor.effort,
            angular: rotor.unit_momentum(),
            linear: Vec3([b.zero(); 3]),
        });
        let turned = |m: &Momentum<'g>| m.map(|v| frame.turn.apply(v));
        let mut momenta = BodyMomenta(Vec::new());
        if frame.axial {
            momenta.extend(inner.momenta.0.iter().map(turned));
            momenta.extend(outer.momenta.0.iter().copied());
            momenta.extend(rotors.map(|m| turned(&m)));
            enter(&mut mass, frames, frame, &momenta);
            enter_own(&mut mass, frames, frame, &composite.units);
            composite.units.iter().for_each(|&unit| momenta.add(unit));
        } else {
            let mut at_joint = inner.momenta.clone();
            at_joint.extend(rotors);
            enter(&mut mass, frames, frame, &at_joint);
            enter_own(&mut mass, frames, frame, &composite.units);
            composite.units.iter().for_each(|&unit| at_joint.add(unit));
            if frame.parent.is_some() {
                momenta.extend(at_joint.0.iter().map(turned));
            }
        }
        for m in &momenta.0 {
            name_momentum(m, &frames.names[m.joint], &frame.joint);
        }
        let Some(p) = frame.parent else { continue };
        let shifted = composite.whole.shifted(frame.position);
        let carried = momenta.0.into_iter().map(|m| m.carried(frame.position));
        let twist = frame.twist.map(|x| b.constant(x));
        let (home, momenta) = if frame.continues {
            (&mut basis[p], carried.collect())
        } else {
            let turned: Vec<_> = carried.map(|m| m.map(|v| twist * v)).collect();
            (&mut own[p], turned)
        };
        home.inertia = home.inertia.plus(&turned_on(b, frame, &shifted));
        home.momenta.extend(momenta);
    }
    mass
}

/// Adds to M the components of momenta at a body, in the axes of its columns, in their directions.
fn enter<'g>(
    mass: &mut [Vec<Expr<'g>>],
    frames: &Frames<'g>,
    frame: &BodyFrame<'g>,
    momenta: &BodyMomenta<'g>,
) {
    for m in &momenta.0 {
        for column in &frame.columns {
            let j = column.coordinate;
            let share = m.along(column) * column.effort * m.effort;
            let entry = &mut mass[m.joint.max(j)][m.joint.min(j)];
            *entry = match m.joint.cmp(&j) {
                Ordering::Greater => (*entry + share)
                    .named(|| format!("m_{}_{}", column.name, frames.names[m.joint])),
                // A rotor on the body of its own joint, or a joint that mimics this one: the momentum is
                // added in row and column.
                Ordering::Equal => *entry + (share + share),
                // A rotor outboard of its joint, or on another branch.
                Ordering::Less => *entry + share,
            };
        }
    }
}

/// Adds to M the components of a joint's own unit momenta in the directions of its columns, and the
/// inertia of rotors.
fn enter_own<'g>(
    mass: &mut [Vec<Expr<'g>>],
    frames: &Frames<'g>,
    frame: &BodyFrame<'g>,
    units: &[Momentum<'g>],
) {
    for (k, column) in frame.columns.iter().enumerate() {
        let i = column.coordinate;
        for (unit, other) in units.iter().zip(&frame.columns).take(k) {
            let share = unit.along(column) * (column.effort * other.effort);
            let j = other.coordinate;
            let entry = &mut mass[i.max(j)][i.min(j)];
            *entry = (*entry + share).named(|| format!("m_{}_{}", other.name, column.name));
        }
        let diagonal = units[k].along(column) * (column.effort * column.effort);
        // Once for each coordinate: at the joint that mimics no other.
        let own = if column.follows {
            diagonal
        } else {
            diagonal + frames.rotors.armature(i)
        };
        mass[i][i] = (mass[i][i] + own).named(|| format!("m_{}_{}", column.name, column.name));
    }
}

/// Returns the momentum of a composite body per unit rate in the direction of a column, in the axes of the
/// column; `j_zz` is the moment of inertia about z, if it is known in a cheaper form.
pub(super) fn unit_momentum<'g>(
    b: &'g Builder,
    column: &JointColumn,
    moved: &BodyInertia<'g>,
    j_zz: Option<Expr<'g>>,
) -> Momentum<'g> {
    let [x, y, z] = moved.first.0;
    let [h_x, h_y, h_z] = [
        Vec3([b.zero(), -z, y]),
        Vec3([z, b.zero(), -x]),
        Vec3([-y, x, b.zero()]),
    ];
    let about = |k: usize| {
        let mut angular = moved.tensor().column(k);
        if let (Some(j_zz), 2) = (j_zz, k) {
            angular.0[2] = j_zz;
        }
        // e × h
        ([h_x, h_y, h_z][k], angular)
    };
    let along = |k: usize| {
        let mut linear = Vec3([b.zero(); 3]);
        linear.0[k] = if k == 2 { moved.axial } else { moved.mass };
        // h × e
        (linear, -[h_x, h_y, h_z][k])
    };
    let (linear, angular) = match column.direction {
        ColumnDirection::About(k) => about(k),
        ColumnDirection::Along(k) => along(k),
        ColumnDirection::Screw(pitch) => {
            let (turn, slide) = (about(2), along(2));
            let sum = |a: Vec3<Expr<'g>>, b: Vec3<Expr<'g>>| a + b.map(|x| x * pitch);
            (sum(turn.0, slide.0), sum(turn.1, slide.1))
        }
    };
    Momentum {
        joint: column.coordinate,
        effort: column.effort,
        linear,
        angular,
    }
}

/// Names the momentum per unit rate of the joint `moved`, about the origin at `joint`.
fn name_momentum(momentum: &Momentum<'_>, moved: &str, joint: &str) {
    let owner = format!("{moved}_at_{joint}");
    name_vector(&momentum.linear, "p", &owner);
    name_vector(&momentum.angular, "l", &owner);
}
