//! Mass matrix by composite bodies, and the energies, in the frames of the recursion.
//!
//! From the tips to the base, each body is combined with its outboard bodies. A unit rate of joint k gives
//! the composite body the momentum h = (−m y, m x, 0) and, about the joint's origin, L = (−D_xz, −D_yz,
//! J_zz), entries of the rotated composite; transformed to the base they give the row of k.

use std::cmp::Ordering;

use bgdyn_runtime::Dd;

use super::frames::{BodyFrame, Frames};
use super::inertia::{BodyInertia, turn, turn_back};
use super::names::{name_composite, name_vector};
use crate::expr::{Builder, Expr};
use crate::math::Vec3;
use crate::mechanism::Motion;

/// Momentum of all outboard bodies per unit rate of a joint.
#[derive(Clone, Copy)]
pub(super) struct Momentum<'g> {
    pub joint: usize,
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

    /// Returns the component in the direction of a joint.
    pub fn along(&self, frame: &BodyFrame<'g>) -> Expr<'g> {
        match frame.motion {
            Motion::Rotation => self.angular.0[2],
            _ => self.linear.0[2],
        }
    }
}

/// Momenta of joints, one for each.
#[derive(Clone)]
pub(super) struct BodyMomenta<'g>(Vec<Momentum<'g>>);

impl<'g> BodyMomenta<'g> {
    /// Adds another one, in the same axes and about the same point. The momentum of a rotor elsewhere is
    /// added to that of the bodies outboard of its joint.
    pub fn add(&mut self, more: Momentum<'g>) {
        match self.0.iter_mut().find(|m| m.joint == more.joint) {
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

/// The composite body of a joint, in the axes of its basis, and its momentum per unit rate.
struct CompositeInertia<'g> {
    whole: BodyInertia<'g>,
    unit: Momentum<'g>,
}

impl<'g> CompositeInertia<'g> {
    /// Combines body j with `inner`, its outboard bodies in its own axes, and `outer`, those in the axes
    /// of its basis.
    fn new(
        b: &'g Builder,
        j: usize,
        frame: &BodyFrame<'g>,
        inner: &BodyInertia<'g>,
        outer: &BodyInertia<'g>,
    ) -> Self {
        let composite = frame.inertia.plus(inner);
        if outer.is_zero() {
            name_composite(&composite, &frame.name);
        }
        let turned = if composite.round() {
            composite
        } else {
            composite.turned(frame.turn)
        };
        let whole = turned.plus(outer);
        name_composite(&whole, &format!("at_{}", frame.joint));
        // A rotation about z does not change J_zz.
        let j_zz = (composite.d(0, 0) + composite.d(1, 1)) + (outer.d(0, 0) + outer.d(1, 1));
        let unit = unit_momentum(b, j, frame, &whole, j_zz);
        CompositeInertia { whole, unit }
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

/// Returns the momentum of all bodies that each joint moves per unit rate, in the axes of its basis.
pub(super) fn composites<'g>(b: &'g Builder, frames: &Frames<'g>) -> Vec<Momentum<'g>> {
    let n = frames.bodies.len();
    let (mut own, mut basis) = (vec![BodyInertia::zero(b); n], vec![BodyInertia::zero(b); n]);
    let mut units = Vec::new();
    for j in (0..n).rev() {
        let frame = &frames.bodies[j];
        b.section(|| format!("{}: inertia with all it carries", frame.name));
        let composite = CompositeInertia::new(b, j, frame, &own[j], &basis[j]);
        units.push(composite.unit);
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
    let n = frames.bodies.len();
    let empty = || Gathered {
        inertia: BodyInertia::zero(b),
        momenta: BodyMomenta(Vec::new()),
    };
    let mut own: Vec<Gathered<'g>> = (0..n).map(|_| empty()).collect();
    let mut basis: Vec<Gathered<'g>> = (0..n).map(|_| empty()).collect();
    let mut mass: Vec<Vec<Expr<'g>>> = (0..n).map(|j| vec![b.zero(); j + 1]).collect();
    for j in (0..n).rev() {
        let frame = &frames.bodies[j];
        b.section(|| {
            format!(
                "{}: inertia with all it carries; row of `{}`: momenta of the joints beyond",
                frame.name, frame.joint
            )
        });
        let (inner, outer) = (&own[j], &basis[j]);
        let composite = CompositeInertia::new(b, j, frame, &inner.inertia, &outer.inertia);
        let mut momenta = BodyMomenta(Vec::new());
        momenta.extend(
            inner
                .momenta
                .0
                .iter()
                .map(|m| m.map(|v| turn(v, frame.turn))),
        );
        momenta.extend(outer.momenta.0.iter().copied());
        // The joint that drives a rotor can be anywhere: outboard of the body, inboard, or the body's own.
        for rotor in frames.rotors.on(j) {
            momenta.add(Momentum {
                joint: rotor.joint,
                angular: turn(rotor.unit_momentum(), frame.turn),
                linear: Vec3([b.zero(); 3]),
            });
        }
        enter(&mut mass, frames, j, &momenta);
        let unit = composite.unit;
        let diagonal = unit.along(frame) * (frame.effort * frame.effort);
        mass[j][j] = (mass[j][j] + (diagonal + frames.rotors.armature(j)))
            .named(|| format!("m_{}_{}", frame.joint, frame.joint));
        momenta.add(unit);
        for m in &momenta.0 {
            name_momentum(m, &frames.bodies[m.joint].joint, &frame.joint);
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

/// Adds to M the components of momenta at body j, in the axes of its basis, along its joint.
fn enter<'g>(mass: &mut [Vec<Expr<'g>>], frames: &Frames<'g>, j: usize, momenta: &BodyMomenta<'g>) {
    let frame = &frames.bodies[j];
    for m in &momenta.0 {
        let other = &frames.bodies[m.joint];
        let share = m.along(frame) * frame.effort * other.effort;
        let entry = &mut mass[m.joint.max(j)][m.joint.min(j)];
        *entry = match m.joint.cmp(&j) {
            Ordering::Greater => {
                (*entry + share).named(|| format!("m_{}_{}", frame.joint, other.joint))
            }
            // A rotor on the body of its own joint: the momentum is added in row and column.
            Ordering::Equal => share + share,
            // A rotor outboard of its joint, or on another branch.
            Ordering::Less => *entry + share,
        };
    }
}

/// Returns the momentum of `whole` per unit rate of `joint`, in the axes of its basis.
pub(super) fn unit_momentum<'g>(
    b: &'g Builder,
    joint: usize,
    frame: &BodyFrame<'g>,
    whole: &BodyInertia<'g>,
    j_zz: Expr<'g>,
) -> Momentum<'g> {
    let [x, y, _] = whole.first.0;
    match frame.motion {
        Motion::Rotation => Momentum {
            joint,
            linear: Vec3([-y, x, b.zero()]),
            angular: Vec3([-whole.d(0, 2), -whole.d(1, 2), j_zz]),
        },
        _ => Momentum {
            joint,
            linear: Vec3([b.zero(), b.zero(), whole.axial]),
            angular: Vec3([y, -x, b.zero()]),
        },
    }
}

/// Returns T = ½ Σ [ m u·u + 2 u·(ω × h) + ω·J ω ] with the velocity u of each body's origin, own axes.
pub(super) fn kinetic_energy<'g>(b: &'g Builder, frames: &Frames<'g>) -> Expr<'g> {
    let zero = Vec3([b.zero(); 3]);
    // (ω, u) in own axes, and in those of the basis.
    let mut own: Vec<(Vec3<Expr<'g>>, Vec3<Expr<'g>>)> = Vec::new();
    let mut basis: Vec<(Vec3<Expr<'g>>, Vec3<Expr<'g>>)> = Vec::new();
    let mut twice = b.zero();
    for frame in &frames.bodies {
        b.section(|| {
            format!(
                "{}: ω, velocity u of its origin; m u·u + 2 u·(ω × h) + ω·J ω",
                frame.name
            )
        });
        let (mut omega, mut u) = match frame.parent {
            None => (zero, zero),
            Some(p) if frame.continues => {
                (basis[p].0, basis[p].1 + basis[p].0.cross(frame.position))
            }
            Some(p) => {
                let back = frame.twist.transpose().map(|x| b.constant(x));
                let (omega, u) = (
                    own[p].0,
                    own[p].1 + own[p].0.cross(frame.position_in_parent),
                );
                (back * omega, back * u)
            }
        };
        match frame.motion {
            Motion::Rotation => omega.0[2] = omega.0[2] + frame.rate,
            _ => u.0[2] = u.0[2] + frame.rate,
        }
        basis.push((omega, u));
        let (omega, u) = (turn_back(omega, frame.turn), turn_back(u, frame.turn));
        name_vector(&omega, "omega", &frame.name);
        name_vector(&u, "v", &frame.name);
        own.push((omega, u));
        twice = twice + twice_kinetic_energy(&frame.inertia, omega, u);
    }
    let omega: Vec<Vec3<Expr<'g>>> = own.iter().map(|(omega, _)| *omega).collect();
    (twice + frames.rotors.twice_kinetic_energy(b, &omega)) * Dd::from_f64(0.5)
}

fn twice_kinetic_energy<'g>(
    inertia: &BodyInertia<'g>,
    omega: Vec3<Expr<'g>>,
    u: Vec3<Expr<'g>>,
) -> Expr<'g> {
    let two = Dd::from_f64(2.0);
    let d = |i, j| inertia.d(i, j);
    let [x, y, z] = omega.0;
    // J = tr(D)·1 − D
    let squares = (d(1, 1) + d(2, 2)) * (x * x)
        + (d(0, 0) + d(2, 2)) * (y * y)
        + (d(0, 0) + d(1, 1)) * (z * z);
    let products = d(0, 1) * two * (x * y) + d(0, 2) * two * (x * z) + d(1, 2) * two * (y * z);
    let swept = omega.cross(inertia.first);
    u.dot(inertia.weigh(u)) + u.dot(swept) * two + (squares - products)
}

/// Returns V = −g · Σ m r, with first moments summed from the tips.
pub(super) fn potential_energy<'g>(b: &'g Builder, frames: &Frames<'g>) -> Expr<'g> {
    let n = frames.bodies.len();
    let mut own = vec![BodyInertia::zero(b); n];
    let mut basis = vec![BodyInertia::zero(b); n];
    let mut energy = frames.constant_energy;
    for j in (0..n).rev() {
        let frame = &frames.bodies[j];
        b.section(|| format!("{}: first moment with all it carries", frame.name));
        // Masses and first moments only: the weight does not depend on D.
        let mut whole = frame.inertia.plus(&own[j]);
        whole.first = turn(whole.first, frame.turn);
        whole = whole.plus(&basis[j]);
        whole.first = whole.first + whole.weigh(frame.position);
        match frame.parent {
            None => energy = energy - frames.gravity[j].dot(whole.first),
            Some(p) if frame.continues => basis[p] = basis[p].plus(&whole),
            Some(p) => {
                whole.first = frame.twist.map(|x| b.constant(x)) * whole.first;
                own[p] = own[p].plus(&whole);
            }
        }
    }
    energy
}

/// Names the momentum per unit rate of the joint `moved`, about the origin at `joint`.
fn name_momentum(momentum: &Momentum<'_>, moved: &str, joint: &str) {
    let owner = format!("{moved}_at_{joint}");
    name_vector(&momentum.linear, "p", &owner);
    name_vector(&momentum.angular, "l", &owner);
}
