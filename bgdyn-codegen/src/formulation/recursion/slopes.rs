//! Derivatives of the joint efforts by positions and velocities, from composite bodies.
//!
//! A change of q_k moves everything beyond joint k as one rigid body. So ∂τ/∂q_k and ∂τ/∂v_k need
//! no derivative of a single body beyond it: the composite inertia, the composite flow of mass
//! relative to the body before the joint, the force and moment on the composite, and the motion at
//! the joint are enough. With the joint's axis z, its rates of change ρ = ω × z and U z, and the
//! acceleration a of its origin, a mass at s that moves at v relative to the body before the joint
//! changes
//! - by q_k its acceleration by X s − z × a + 2 ρ × v with X = U [z]× − [z]× U,
//! - by v_k its acceleration by 2 ω × (z × s) + 2 z × v.
//!
//! These give each composite two wrenches; carried to the base like the momenta that give the mass
//! matrix, they give the efforts of the joints before k. The efforts of the joints beyond k change
//! by the same fields: joint k's motion against the momentum of a unit rate of the joint beyond, and
//! against 2 ∫ v × δ dm, with δ the velocity that the unit rate gives.
//!
//! Carpentier and Mansard (2018) and Singh, Russell and Wensing (2022) order the derivatives of
//! the Newton-Euler recursion by composites too.

use bgdyn_runtime::Dd;

use super::flow::Flow;
use super::frames::{Frame, Frames};
use super::inertia::{Inertia, turn};
use super::inverse::{Moving, Spin, Wrench};
use super::mass::{Momentum, unit_momentum};
use crate::expr::{Builder, Ex};
use crate::math::Vec3;
use crate::mechanism::Motion;

/// Row by row: entry (i, j) is the derivative of effort i by coordinate or rate j.
pub(super) type Square<'g> = Vec<Vec<Ex<'g>>>;

/// What differentiating needs of a joint beyond, seen from a body before it.
#[derive(Clone, Copy)]
struct Beyond<'g> {
    /// Momentum of a unit rate.
    momentum: Momentum<'g>,
    /// 2 ∫ v × δ dm: v relative to this place without turning with it, δ of a unit rate.
    swirl: Vec3<Ex<'g>>,
    /// ∂/∂q of force and moment on all beyond the joint.
    by_position: Wrench<'g>,
    /// ∂/∂v of the same.
    by_rate: Wrench<'g>,
}

impl<'g> Beyond<'g> {
    fn map(self, f: impl Fn(Vec3<Ex<'g>>) -> Vec3<Ex<'g>>) -> Self {
        Beyond {
            momentum: self.momentum.map(&f),
            swirl: f(self.swirl),
            by_position: self.by_position.map(&f),
            by_rate: self.by_rate.map(&f),
        }
    }

    /// Seen from a point from which this one is displaced by r, and relative to which it moves at
    /// half of `twice_u`.
    fn carried(self, r: Vec3<Ex<'g>>, twice_u: Vec3<Ex<'g>>) -> Self {
        Beyond {
            momentum: self.momentum.carried(r),
            swirl: self.swirl + twice_u.cross(self.momentum.linear),
            by_position: self.by_position.carried(r),
            by_rate: self.by_rate.carried(r),
        }
    }
}

/// What a body has gathered from those beyond it.
struct Gathered<'g> {
    inertia: Inertia<'g>,
    flow: Flow<'g>,
    beyond: Vec<Beyond<'g>>,
}

/// How a joint's axis moves, in one set of axes.
struct Axis<'g> {
    /// ω × z
    rate: Vec3<Ex<'g>>,
    /// U z
    second_rate: Vec3<Ex<'g>>,
    /// Acceleration of the origin.
    a: Vec3<Ex<'g>>,
}

impl<'g> Axis<'g> {
    fn new(b: &'g Builder, spin: &Spin<'g>, a: Vec3<Ex<'g>>) -> Self {
        let [x, y, _] = spin.omega.0;
        Axis {
            rate: Vec3([y, -x, b.zero()]),
            second_rate: spin.u.column(2),
            a,
        }
    }

    /// Number of components that vanish.
    fn zeros(&self) -> usize {
        let all = self.rate.0.into_iter().chain(self.second_rate.0);
        all.chain(self.a.0).filter(|e| e.is_zero()).count()
    }

    /// Derivatives of the effort of a joint beyond by this joint's coordinate and by its rate.
    fn effort_beyond(&self, motion: Motion, joint: &Beyond<'g>) -> (Ex<'g>, Ex<'g>) {
        let two = Dd::from_f64(2.0);
        let Momentum {
            linear: p,
            angular: l,
            ..
        } = joint.momentum;
        let twice = self.rate.map(|x| x * two);
        match motion {
            Motion::Rotation => {
                let pull = p.0[0] * self.a.0[1] - p.0[1] * self.a.0[0];
                (
                    l.dot(self.second_rate) + pull + joint.swirl.dot(self.rate),
                    l.dot(twice) + joint.swirl.0[2],
                )
            }
            _ => (p.dot(self.second_rate), p.dot(twice)),
        }
    }
}

/// (∂τ/∂q, ∂τ/∂v), and the lower triangle of M, which the same pass yields.
pub(super) struct Slopes<'g> {
    pub by_position: Square<'g>,
    pub by_rate: Square<'g>,
}

/// The derivatives for the motion `moving` with the forces `wrenches` on all beyond each joint.
pub(super) fn slopes<'g>(
    b: &'g Builder,
    frames: &Frames<'g>,
    moving: &[Moving<'g>],
    wrenches: &[Wrench<'g>],
) -> Slopes<'g> {
    let n = frames.bodies.len();
    let empty = || Gathered {
        inertia: Inertia::zero(b),
        flow: Flow::zero(b),
        beyond: Vec::new(),
    };
    let mut own: Vec<Gathered<'g>> = (0..n).map(|_| empty()).collect();
    let mut basis: Vec<Gathered<'g>> = (0..n).map(|_| empty()).collect();
    let mut slopes = Slopes {
        by_position: vec![vec![b.zero(); n]; n],
        by_rate: vec![vec![b.zero(); n]; n],
    };
    for j in (0..n).rev() {
        let frame = &frames.bodies[j];
        b.section(format!(
            "{}: derivatives by `{}` and by the joints beyond",
            frame.name, frame.joint
        ));
        let (inner, outer) = (&own[j], &basis[j]);
        let composite = frame.inertia.plus(&inner.inertia);
        let turned = if composite.round() {
            composite
        } else {
            composite.turned(frame.turn)
        };
        let whole = turned.plus(&outer.inertia);
        // Turning about z leaves J_zz as it is.
        let j_zz = (composite.d(0, 0) + composite.d(1, 1))
            + (outer.inertia.d(0, 0) + outer.inertia.d(1, 1));
        let twice_rate = frame.rate * Dd::from_f64(2.0);
        let flow = inner.flow.turned(frame.turn).plus(&outer.flow);
        let flow = flow.plus(&Flow::of_joint(b, frame.motion, twice_rate, &whole));

        let in_own = Axis::new(b, &moving[j].own, moving[j].a_own);
        let in_basis = Axis::new(b, &moving[j].in_basis, moving[j].a_basis);
        let mut beyond: Vec<Beyond<'g>> = Vec::new();
        for joint in &inner.beyond {
            let turned = joint.map(|v| turn(v, frame.turn));
            if in_basis.zeros() > in_own.zeros() {
                enter(&mut slopes, frames, j, &in_basis, &turned);
            } else {
                enter(&mut slopes, frames, j, &in_own, joint);
            }
            beyond.push(turned);
        }
        for joint in &outer.beyond {
            enter(&mut slopes, frames, j, &in_basis, joint);
            beyond.push(*joint);
        }
        // The motion of the body before the joint, in the same axes.
        let before = match frame.parent {
            Some(p) if frame.continues => &moving[p].in_basis,
            _ => &moving[j].basis,
        };
        let momentum = unit_momentum(b, j, frame, &whole, j_zz);
        let unit = unit(b, frame.motion, momentum, &whole, &flow, before, &in_basis, &wrenches[j]);
        enter(&mut slopes, frames, j, &in_basis, &unit);
        beyond.push(unit);
        let Some(p) = frame.parent else { continue };
        let mut twice_u = before.omega.scale(b.number(2.0)).cross(frame.position);
        if frame.motion != Motion::Rotation {
            twice_u.0[2] = twice_u.0[2] + twice_rate;
        }
        let (inertia, flow) = (whole.shifted(frame.position), flow.shifted(frame.position));
        let carried = beyond
            .into_iter()
            .map(|joint| joint.carried(frame.position, twice_u));
        let twist = frame.twist.map(|x| b.constant(x));
        let (home, inertia, flow, beyond) = if frame.continues {
            (&mut basis[p], inertia, flow, carried.collect())
        } else {
            let turned: Vec<_> = carried.map(|joint| joint.map(|v| twist * v)).collect();
            let (inertia, flow) = (inertia.rotated(b, frame.twist), flow.rotated(b, frame.twist));
            (&mut own[p], inertia, flow, turned)
        };
        home.inertia = home.inertia.plus(&inertia);
        home.flow = home.flow.plus(&flow);
        home.beyond.extend(beyond);
    }
    slopes
}

/// The four derivatives that tie joint j to one beyond it, or to itself.
fn enter<'g>(
    slopes: &mut Slopes<'g>,
    frames: &Frames<'g>,
    j: usize,
    axis: &Axis<'g>,
    joint: &Beyond<'g>,
) {
    let k = joint.momentum.joint;
    let frame = &frames.bodies[j];
    let factor = frame.effort * frames.bodies[k].effort;
    slopes.by_position[j][k] = joint.by_position.along(frame) * factor;
    slopes.by_rate[j][k] = joint.by_rate.along(frame) * factor;
    if j != k {
        let (by_position, by_rate) = axis.effort_beyond(frame.motion, joint);
        slopes.by_position[k][j] = by_position * factor;
        slopes.by_rate[k][j] = by_rate * factor;
    }
}

/// What the joint itself hands on.
fn unit<'g>(
    b: &'g Builder,
    motion: Motion,
    momentum: Momentum<'g>,
    whole: &Inertia<'g>,
    flow: &Flow<'g>,
    before: &Spin<'g>,
    axis: &Axis<'g>,
    wrench: &Wrench<'g>,
) -> Beyond<'g> {
    let zero = b.zero();
    let h = whole.first;
    // z ×
    let across = |v: Vec3<Ex<'g>>| Vec3([-v.0[1], v.0[0], zero]);
    let two = Dd::from_f64(2.0);
    let omega2 = before.omega.map(|x| x * two);
    let rate2 = axis.rate.map(|x| x * two);
    if motion != Motion::Rotation {
        let drift = flow.linear + omega2.cross(h);
        return Beyond {
            momentum,
            swirl: -across(drift),
            by_position: Wrench {
                force: whole.weigh(axis.second_rate),
                moment: h.cross(axis.second_rate) + across(wrench.force),
            },
            by_rate: Wrench {
                force: whole.weigh(rate2),
                moment: h.cross(rate2),
            },
        };
    }
    let d = |i, j| whole.d(i, j);
    let times_d = |v: Vec3<Ex<'g>>, i: usize| d(i, 0) * v.0[0] + d(i, 1) * v.0[1] + d(i, 2) * v.0[2];
    let swirl = flow.moment.row(2) + Vec3(std::array::from_fn(|i| times_d(rate2, i)));
    let by_rate = Wrench {
        force: omega2.cross(momentum.linear) + across(flow.linear),
        moment: flow.moment.column(2) + Vec3([times_d(omega2, 1), -times_d(omega2, 0), zero]),
    };
    // X = U [z]× − [z]× U: its first two rows and columns are [[t, δ], [δ, −t]].
    let u = &before.u.0;
    let (t, delta) = (u[0][1] + u[1][0], before.differences.0[2]);
    let (uxz, uyz, uzx, uzy) = (u[0][2], u[1][2], u[2][0], u[2][1]);
    // The skew part of X D.
    let turning = Vec3([
        (uzy * d(0, 1) - uzx * d(1, 1)) + (t * d(1, 2) - delta * d(0, 2)) + uxz * d(2, 2),
        (uzx * d(0, 1) - uzy * d(0, 0)) + (t * d(0, 2) + delta * d(1, 2)) + uyz * d(2, 2),
        (delta * (d(0, 0) - d(1, 1)) - (t * two) * d(0, 1)) - (uxz * d(0, 2) + uyz * d(1, 2)),
    ]);
    let [hx, hy, hz] = h.0;
    let x_h = Vec3([
        t * hx + delta * hy + uyz * hz,
        delta * hx - t * hy - uxz * hz,
        uzy * hx - uzx * hy,
    ]);
    let fall = -across(axis.a);
    let by_position = Wrench {
        force: x_h + whole.weigh(fall) + axis.rate.cross(flow.linear) + across(wrench.force),
        moment: turning + h.cross(fall) + flow.moment * axis.rate + across(wrench.moment),
    };
    Beyond {
        momentum,
        swirl,
        by_position,
        by_rate,
    }
}
