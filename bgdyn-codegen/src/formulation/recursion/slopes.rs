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
use super::inverse::{Moving, Spin, Wrench, dynamics};
use super::mass::{Momentum, unit_momentum};
use crate::expr::{Builder, Ex};
use crate::math::{Mat3, Vec3};
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
    /// In a group of parallel axes: from the present body's origin to the point that all this is
    /// about, and twice the relative velocity of the two.
    offset: Vec3<Ex<'g>>,
    twice_u: Vec3<Ex<'g>>,
    /// The entries of the last rotation of the group, and where its origin is from the present one's.
    last: Option<(Entries<'g>, Vec3<Ex<'g>>)>,
}

/// The four derivatives that tie a joint to one beyond it.
#[derive(Clone, Copy)]
struct Entries<'g> {
    by_position: Ex<'g>,
    by_rate: Ex<'g>,
    beyond_by_position: Ex<'g>,
    beyond_by_rate: Ex<'g>,
}

impl<'g> Beyond<'g> {
    fn map(self, f: impl Fn(Vec3<Ex<'g>>) -> Vec3<Ex<'g>>) -> Self {
        Beyond {
            momentum: self.momentum.map(&f),
            swirl: f(self.swirl),
            by_position: self.by_position.map(&f),
            by_rate: self.by_rate.map(&f),
            ..self
        }
    }

    fn moved(self, r: Vec3<Ex<'g>>, twice_u: Vec3<Ex<'g>>) -> Self {
        Beyond {
            offset: self.offset + r,
            twice_u: self.twice_u + twice_u,
            last: self.last.map(|(e, since)| (e, since + r)),
            ..self
        }
    }

    fn settled(self, b: &'g Builder) -> Self {
        let zero = Vec3([b.zero(); 3]);
        Beyond {
            offset: zero,
            twice_u: zero,
            last: None,
            ..self.carried(self.offset, self.twice_u)
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
            ..self
        }
    }
}

/// What a body has gathered from those beyond it.
struct Gathered<'g> {
    inertia: Inertia<'g>,
    flow: Flow<'g>,
    rest: Wrench<'g>,
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
        rest: Wrench::zero(b),
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
        b.section(format!("{j} composite"));
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
        b.section(format!("{j} flow"));
        let twice_rate = frame.rate * Dd::from_f64(2.0);
        let flow = inner.flow.turned(frame.turn).plus(&outer.flow);
        let step = Flow::of_joint(b, frame.motion, frame.rate, &whole);
        let inner_flow = flow;
        let mid = flow.plus(&step);
        let flow = mid.plus(&step);
        b.section(format!("{j} rest"));
        let momentum = unit_momentum(b, j, frame, &whole, j_zz);
        let inner_rest = inner.rest.map(|v| turn(v, frame.turn)).plus(outer.rest);
        let mut rest = inner_rest.plus(Wrench {
            force: momentum.linear.scale(frame.acceleration),
            moment: momentum.angular.scale(frame.acceleration),
        });
        if frame.motion == Motion::Rotation {
            let [x, y, _] = mid.linear.0;
            rest = rest.plus(Wrench {
                force: Vec3([-y, x, b.zero()]).scale(frame.rate),
                moment: mid.moment.column(2).scale(frame.rate),
            });
        }

        let in_own = Axis::new(b, &moving[j].own, moving[j].a_own);
        let in_basis = Axis::new(b, &moving[j].in_basis, moving[j].a_basis);
        let mut beyond: Vec<Beyond<'g>> = Vec::new();
        for joint in &inner.beyond {
            b.section(format!("{j} turn rows"));
            let turned = joint.map(|v| turn(v, frame.turn));
            b.section(format!("{j} dots"));
            let entries = if in_basis.zeros() > in_own.zeros() {
                entries(frame, &in_basis, &turned)
            } else {
                entries(frame, &in_own, joint)
            };
            enter(&mut slopes, frames, j, joint.momentum.joint, &entries);
            let last = (frame.motion == Motion::Rotation).then(|| (entries, Vec3([b.zero(); 3])));
            beyond.push(Beyond { last, ..turned });
        }
            b.section(format!("{j} dots"));
        for joint in &outer.beyond {
            let mut joint = *joint;
            let entries = match joint.last {
                Some((last, since)) if frame.motion == Motion::Rotation => {
                    let [x, y, _] = since.0;
                    let step = Vec3([-y, x, b.zero()]);
                    let spin = &moving[j].in_basis;
                    let p = joint.momentum.linear;
                    let e = Entries {
                        by_position: last.by_position + step.dot(joint.by_position.force),
                        by_rate: last.by_rate + step.dot(joint.by_rate.force),
                        beyond_by_position: last.beyond_by_position + p.dot(spin.u * step),
                        beyond_by_rate: last.beyond_by_rate
                            + p.dot(spin.omega.map(|x| x * Dd::from_f64(2.0)).cross(step)),
                    };
                    e
                }
                _ => {
                    if frame.motion == Motion::Rotation {
                        joint = joint.settled(b);
                    }
                    entries(frame, &in_basis, &joint)
                }
            };
            enter(&mut slopes, frames, j, joint.momentum.joint, &entries);
            if frame.motion == Motion::Rotation {
                joint.last = Some((entries, Vec3([b.zero(); 3])));
            }
            beyond.push(joint);
        }
            b.section(format!("{j} unit"));
        // The motion of the body before the joint, in the same axes.
        let before = match frame.parent {
            Some(p) if frame.continues => &moving[p].in_basis,
            _ => &moving[j].basis,
        };
        let after = &moving[j].in_basis;
        let force = after.u * whole.first
            + whole.weigh(in_basis.a)
            + after.omega.cross(inner_flow.linear)
            + inner_rest.force;
        let zeros = |spin: &Spin<'g>, flow: &Flow<'g>, rest: &Wrench<'g>| {
            let all = spin.omega.0.into_iter().chain(spin.u.0.into_iter().flatten());
            let all = all.chain(flow.moment.0.into_iter().flatten()).chain(flow.linear.0);
            all.chain(rest.force.0).chain(rest.moment.0).filter(|e| e.is_zero()).count()
        };
        let (spin, flow_at, rest_at) = if zeros(after, &inner_flow, &inner_rest) > zeros(before, &flow, &rest) {
            (after, &inner_flow, &inner_rest)
        } else {
            (before, &flow, &rest)
        };
        let unit = unit(b, frame.motion, momentum, &whole, flow_at, spin, &in_basis, rest_at, force);
        let diagonal = (unit.by_position.along(frame), unit.by_rate.along(frame));
        let entries = Entries {
            by_position: diagonal.0,
            by_rate: diagonal.1,
            beyond_by_position: diagonal.0,
            beyond_by_rate: diagonal.1,
        };
        enter(&mut slopes, frames, j, j, &entries);
        let last = (frame.motion == Motion::Rotation).then(|| (entries, Vec3([b.zero(); 3])));
        beyond.push(Beyond { last, ..unit });
        let Some(p) = frame.parent else { continue };
            b.section(format!("{j} carry w"));
        let mut twice_u = before.omega.scale(b.number(2.0)).cross(frame.position);
        if frame.motion != Motion::Rotation {
            twice_u.0[2] = twice_u.0[2] + twice_rate;
        }
            b.section(format!("{j} composite"));
            whole.shifted(frame.position);
            b.section(format!("{j} flow"));
            b.section(format!("{j} rest"));
        let rest = rest.carried(frame.position);
        let rest = if frame.continues { rest } else { rest.map(|v| frame.twist.map(|x| b.constant(x)) * v) };
        let (inertia, flow) = (whole.shifted(frame.position), flow.shifted(frame.position));
        let carried = beyond
            .into_iter()
            .map(|joint| joint.moved(frame.position, twice_u));
            b.section(format!("{j} carry rows"));
        let twist = frame.twist.map(|x| b.constant(x));
        let (home, inertia, flow, beyond) = if frame.continues {
            (&mut basis[p], inertia, flow, carried.collect())
        } else {
            let turned: Vec<_> = carried.map(|joint| joint.settled(b).map(|v| twist * v)).collect();
            let (inertia, flow) = (inertia.rotated(b, frame.twist), flow.rotated(b, frame.twist));
            (&mut own[p], inertia, flow, turned)
        };
            b.section(format!("{p} composite"));
        home.inertia = home.inertia.plus(&inertia);
            b.section(format!("{p} flow"));
        home.flow = home.flow.plus(&flow);
        home.rest = home.rest.plus(rest);
        home.beyond.extend(beyond);
    }
    slopes
}

fn entries<'g>(frame: &Frame<'g>, axis: &Axis<'g>, joint: &Beyond<'g>) -> Entries<'g> {
    let (beyond_by_position, beyond_by_rate) = axis.effort_beyond(frame.motion, joint);
    Entries {
        by_position: joint.by_position.along(frame),
        by_rate: joint.by_rate.along(frame),
        beyond_by_position,
        beyond_by_rate,
    }
}

fn enter<'g>(slopes: &mut Slopes<'g>, frames: &Frames<'g>, j: usize, k: usize, e: &Entries<'g>) {
    let factor = frames.bodies[j].effort * frames.bodies[k].effort;
    slopes.by_position[k][j] = e.beyond_by_position * factor;
    slopes.by_rate[k][j] = e.beyond_by_rate * factor;
    slopes.by_position[j][k] = e.by_position * factor;
    slopes.by_rate[j][k] = e.by_rate * factor;
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
    force: Vec3<Ex<'g>>,
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
                moment: h.cross(axis.second_rate) + across(force),
            },
            by_rate: Wrench {
                force: whole.weigh(rate2),
                moment: h.cross(rate2),
            },
            offset: Vec3([zero; 3]),
            twice_u: Vec3([zero; 3]),
            last: None,
        };
    }
    let d = |i, j| whole.d(i, j);
    let times_d = |v: Vec3<Ex<'g>>, i: usize| d(i, 0) * v.0[0] + d(i, 1) * v.0[1] + d(i, 2) * v.0[2];
    let swirl = flow.moment.row(2) + Vec3(std::array::from_fn(|i| times_d(rate2, i)));
    let by_rate = Wrench {
        force: omega2.cross(momentum.linear) + across(flow.linear),
        moment: flow.moment.column(2) + Vec3([times_d(omega2, 1), -times_d(omega2, 0), zero]),
    };
    // How the composite changes as it turns about z.
    let turning = Inertia {
        mass: zero,
        axial: zero,
        first: across(h),
        pseudo: [
            d(0, 1) * -two,
            d(0, 1) * two,
            zero,
            d(0, 0) - d(1, 1),
            -d(1, 2),
            d(0, 2),
        ],
    };
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, _]] = flow.moment.0;
    let (sum, difference) = (xy + yx, xx - yy);
    let swinging = Mat3([
        [-sum, difference, -yz],
        [difference, sum, xz],
        [-zy, zx, zero],
    ]);
    let by_position = dynamics(&turning, zero, before, axis.a, false)
        .plus(Wrench {
            force: before.omega.cross(across(flow.linear)),
            moment: swinging * before.omega,
        })
        .plus(wrench.map(across));
    Beyond {
        momentum,
        swirl,
        by_position,
        by_rate,
        offset: Vec3([zero; 3]),
        twice_u: Vec3([zero; 3]),
        last: None,
    }
}
