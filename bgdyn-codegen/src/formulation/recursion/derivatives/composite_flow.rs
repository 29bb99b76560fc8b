//! All bodies outboard of a joint as one body.
//!
//! It has an inertia, the flow of its mass relative to an inboard body, and the force and moment of that relative
//! motion.

use bgdyn_runtime::Dd;

use crate::expr::{Builder, Expr};
use crate::formulation::recursion::frames::BodyFrame;
use crate::formulation::recursion::inertia::BodyInertia;
use crate::formulation::recursion::inverse_dynamics::BodyWrench;
use crate::formulation::recursion::mass_matrix::Momentum;
use crate::formulation::recursion::rotation::Rotation;
use crate::formulation::recursion::rotors::FullRotor;
use crate::math::{Mat3, Vec3};
use crate::mechanism::Motion;

/// A composite body, about one point and in one set of axes; velocities and accelerations are relative to
/// an inboard body and its axes.
#[derive(Clone, Copy)]
pub(in crate::formulation::recursion) struct CompositeFlow<'g> {
    pub inertia: BodyInertia<'g>,
    /// Twice the flow of its mass; once for the Coriolis matrix.
    pub flow: Flow<'g>,
    /// Force and moment of its relative accelerations.
    pub rest: BodyWrench<'g>,
}

impl<'g> CompositeFlow<'g> {
    /// Returns zero.
    pub fn zero(b: &'g Builder) -> Self {
        CompositeFlow {
            inertia: BodyInertia::zero(b),
            flow: Flow::zero(b),
            rest: BodyWrench::zero(b),
        }
    }

    /// Returns the sum.
    pub fn plus(&self, other: &Self) -> Self {
        CompositeFlow {
            inertia: self.inertia.plus(&other.inertia),
            flow: self.flow.plus(&other.flow),
            rest: self.rest.plus(other.rest),
        }
    }

    /// Adds a rotor on the body, in the body's own axes. Relative to the body, its momentum H is a flow of
    /// mass without displacement: its E is −[H]× (times `factor` / 2), because the moment ω × H must equal
    /// E ω.
    pub fn add_rotor(&mut self, b: &'g Builder, rotor: &FullRotor<'g>, factor: Dd) {
        let half = factor * Dd::from_f64(0.5);
        let [x, y, z] = rotor.momentum().map(|x| x * half).0;
        let moment = Mat3([[b.zero(), z, -y], [-z, b.zero(), x], [y, -x, b.zero()]]);
        self.flow.moment = self.flow.moment + moment;
        self.rest.moment = self.rest.moment + rotor.momentum_rate();
    }

    /// Returns it rotated by Rz.
    pub fn turned(&self, angle: (Expr<'g>, Expr<'g>)) -> Self {
        CompositeFlow {
            inertia: self.inertia.turned(angle.into()),
            flow: self.flow.turned(angle),
            rest: self.rest.map(|v| Rotation::AboutZ(angle).apply(v)),
        }
    }

    /// Returns it relative to the body before the joint, for a joint with this momentum of a unit rate:
    /// with Z the field of a unit rate, Q increases by q̇ Z P and the rest by q̈ Z P + q̇² Z Z P + 2 q̇ Z
    /// Q. Without `twice` the flow counts once, and the rest is not valid.
    pub fn before(
        &self,
        b: &'g Builder,
        frame: &BodyFrame<'g>,
        momentum: &Momentum<'g>,
        twice: bool,
    ) -> Self {
        let step = Flow::of_joint(b, frame.motion, frame.rate, &self.inertia);
        let mid = self.flow.plus(&step);
        let mut rest = self.rest.plus(BodyWrench {
            force: momentum.linear.scale(frame.acceleration),
            moment: momentum.angular.scale(frame.acceleration),
        });
        // Z Z and Z Q vanish for a translation.
        if frame.motion == Motion::Rotation {
            let [x, y, _] = mid.linear.0;
            rest = rest.plus(BodyWrench {
                force: Vec3([-y, x, b.zero()]).scale(frame.rate),
                moment: mid.moment.column(2).scale(frame.rate),
            });
        }
        CompositeFlow {
            inertia: self.inertia,
            flow: if twice { mid.plus(&step) } else { mid },
            rest,
        }
    }

    /// Returns it about the origin of the body before, in its axes or in the basis that continues.
    pub fn handed_on(&self, b: &'g Builder, frame: &BodyFrame<'g>) -> Self {
        let shifted = CompositeFlow {
            inertia: self.inertia.shifted(frame.position),
            flow: self.flow.shifted(frame.position),
            rest: self.rest.carried(frame.position),
        };
        if frame.continues {
            return shifted;
        }
        let twist = frame.twist.map(|x| b.constant(x));
        CompositeFlow {
            inertia: shifted.inertia.rotated(b, frame.twist),
            flow: shifted.flow.rotated(b, frame.twist),
            rest: shifted.rest.map(|v| twist * v),
        }
    }

    /// Returns the number of zero entries of flow and rest.
    pub fn zeros(&self) -> usize {
        let flow = self.flow.moment.0.into_iter().flatten();
        let flow = flow.chain(self.flow.linear.0);
        let rest = self.rest.force.0.into_iter().chain(self.rest.moment.0);
        flow.chain(rest).filter(|e| e.is_zero()).count()
    }
}

/// The flow of mass: with Q = ∫ v sᵀ dm about a point, E = tr(Q)·1 − Q and p = ∫ v dm.
#[derive(Clone, Copy)]
pub(in crate::formulation::recursion) struct Flow<'g> {
    /// E
    pub moment: Mat3<Expr<'g>>,
    /// p
    pub linear: Vec3<Expr<'g>>,
}

impl<'g> Flow<'g> {
    /// Returns zero.
    pub fn zero(b: &'g Builder) -> Self {
        Flow {
            moment: Mat3([[b.zero(); 3]; 3]),
            linear: Vec3([b.zero(); 3]),
        }
    }

    /// Returns the sum.
    pub fn plus(&self, other: &Self) -> Self {
        Flow {
            moment: self.moment + other.moment,
            linear: self.linear + other.linear,
        }
    }

    /// Returns the flow of mass that moves at a joint's `rate` along or about z.
    pub fn of_joint(
        b: &'g Builder,
        motion: Motion,
        rate: Expr<'g>,
        inertia: &BodyInertia<'g>,
    ) -> Self {
        let d = |i, j| rate * inertia.d(i, j);
        let [x, y, z] = inertia.first.map(|h| rate * h).0;
        let zero = b.zero();
        match motion {
            Motion::Rotation => Flow {
                moment: Mat3([
                    [d(0, 1), d(1, 1), d(1, 2)],
                    [-d(0, 0), -d(0, 1), -d(0, 2)],
                    [zero; 3],
                ]),
                linear: Vec3([-y, x, zero]),
            },
            _ => Flow {
                moment: Mat3([[z, zero, zero], [zero, z, zero], [-x, -y, zero]]),
                linear: Vec3([zero, zero, rate * inertia.axial]),
            },
        }
    }

    /// Returns the flow about a point from which the present origin is displaced by r: E + (p·r)·1 − p rᵀ.
    pub fn shifted(&self, r: Vec3<Expr<'g>>) -> Self {
        let products = Mat3::from_fn(|i, j| self.linear.0[i] * r.0[j]);
        let entry = |i: usize, j: usize| {
            if i == j {
                let (k, l) = ((i + 1) % 3, (i + 2) % 3);
                self.moment.0[i][i] + (products.0[k][k] + products.0[l][l])
            } else {
                self.moment.0[i][j] - products.0[i][j]
            }
        };
        Flow {
            moment: Mat3::from_fn(entry),
            linear: self.linear,
        }
    }

    /// Returns the flow in axes in which the present axes have the columns of the constant `r`: R E Rᵀ, R
    /// p.
    pub fn rotated(&self, b: &'g Builder, r: Mat3<Dd>) -> Self {
        let r = r.map(|x| b.constant(x));
        Flow {
            moment: r * self.moment * r.transpose(),
            linear: r * self.linear,
        }
    }

    /// Returns the flow rotated by Rz: four multiplications for the 2 × 2 block, with
    /// e = s (E_xx − E_yy) + c (E_xy + E_yx).
    pub fn turned(&self, (c, s): (Expr<'g>, Expr<'g>)) -> Self {
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = self.moment.0;
        let e = s * (xx - yy) + c * (xy + yx);
        let (se, ce) = (s * e, c * e);
        Flow {
            moment: Mat3([
                [xx - se, ce - yx, c * xz - s * yz],
                [ce - xy, yy + se, s * xz + c * yz],
                [c * zx - s * zy, s * zx + c * zy, zz],
            ]),
            linear: Rotation::AboutZ((c, s)).apply(self.linear),
        }
    }
}
