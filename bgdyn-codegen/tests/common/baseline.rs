//! The Newton–Euler recursion in link axes with base parameters only, as a generator of customised
//! symbolic models makes it (Khalil and Kleinfinger 1987). Numbers are folded, products with 0 and 1 are
//! omitted, equal expressions are shared. No origin slides, no axes are grouped, no inertia is rotated,
//! nothing is factored, lengths are in metres.
//!
//! The frames are those of the links in the spec; each joint's axis must be z.

use bgdyn_codegen::expr::{Builder, Expr, Graph, Leaf, Operations, Signed, count};
use bgdyn_codegen::math::{Mat3, Vec3};
use bgdyn_codegen::mechanism::{Link, Mechanism, Motion, Value};
use bgdyn_runtime::Dd;

/// The formula for the moment of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moment {
    /// J ω̇ + ω × J ω
    Tensor,
    /// The skew part of U·D with U = [ω̇]× + [ω]×[ω]× and D = ½ tr(J)·1 − J.
    PseudoInertia,
}

/// The tensor entry that base parameters set to zero: the position along the axis is free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Zero {
    Jxx,
    Jyy,
    Dzz,
}

/// Mass, first moment and D = ∫ s sᵀ dm about a link's origin, in its axes.
#[derive(Clone, Copy)]
struct Body {
    mass: Dd,
    first: Vec3<Dd>,
    pseudo: Mat3<Dd>,
}

/// Sets a rounding error to zero.
fn clean(x: Dd) -> Dd {
    if x.hi().abs() < 1e-24 { Dd::ZERO } else { x }
}

fn products(a: Vec3<Dd>, b: Vec3<Dd>) -> Mat3<Dd> {
    Mat3::from_fn(|i, j| a.0[i] * b.0[j])
}

fn number(value: Value) -> Dd {
    match value {
        Value::Fixed(x) => x,
        Value::Parameter(_) => panic!("a number is wanted"),
    }
}

impl Body {
    fn new(link: &Link) -> Self {
        let inertial = &link.inertial;
        let (mass, com) = (number(inertial.mass), inertial.com.map(number));
        let [xx, yy, zz, xy, xz, yz] = inertial.inertia.entries.map(number);
        let half = Dd::from_f64(0.5);
        let central = Mat3([
            [(yy + zz - xx) * half, -xy, -xz],
            [-xy, (zz + xx - yy) * half, -yz],
            [-xz, -yz, (xx + yy - zz) * half],
        ]);
        Body {
            mass,
            first: com.scale(mass),
            pseudo: central + products(com, com).map(|x| x * mass),
        }
    }

    fn zero() -> Self {
        Body {
            mass: Dd::ZERO,
            first: Vec3([Dd::ZERO; 3]),
            pseudo: Mat3([[Dd::ZERO; 3]; 3]),
        }
    }

    fn plus(&self, other: &Body) -> Body {
        Body {
            mass: self.mass + other.mass,
            first: self.first + other.first,
            pseudo: self.pseudo + other.pseudo,
        }
    }

    fn minus(&self, other: &Body) -> Body {
        Body {
            mass: self.mass - other.mass,
            first: self.first - other.first,
            pseudo: self.pseudo - other.pseudo,
        }
    }

    /// Returns it in the parent's axes and about its origin.
    fn placed(&self, link: &Link) -> Body {
        let (r, p) = (link.joint.origin.rotation, link.joint.origin.translation);
        let h = r * self.first;
        let turned = r * self.pseudo * r.transpose();
        Body {
            mass: self.mass,
            first: h + p.scale(self.mass),
            pseudo: turned
                + products(p, h)
                + products(h, p)
                + products(p, p).map(|x| x * self.mass),
        }
    }

    /// Returns the part that can be moved to the parent.
    fn movable(&self, motion: Motion, zero: Zero) -> Body {
        let mut part = Body::zero();
        let d = |i: usize| self.pseudo.0[i][i];
        match motion {
            Motion::Rotation => {
                part.mass = self.mass;
                part.first.0[2] = self.first.0[2];
                // J_xx = D_yy + D_zz, J_yy = D_xx + D_zz
                part.pseudo.0[2][2] = match zero {
                    Zero::Dzz => d(2),
                    Zero::Jxx => d(2) + d(1),
                    Zero::Jyy => d(2) + d(0),
                };
            }
            _ => part.pseudo = self.pseudo,
        }
        part
    }

    fn cleaned(&self) -> Body {
        Body {
            mass: clean(self.mass),
            first: self.first.map(clean),
            pseudo: self.pseudo.map(clean),
        }
    }
}

/// Returns the base parameters of every link, tips first.
fn regrouped(mechanism: &Mechanism, zero: Zero) -> Vec<Body> {
    let links = mechanism.links();
    let mut bodies: Vec<Body> = links.iter().map(Body::new).collect();
    for i in (0..links.len()).rev() {
        let motion = links[i].joint.kind.motion;
        let part = bodies[i].movable(motion, zero);
        bodies[i] = bodies[i].minus(&part).cleaned();
        if let Some(p) = links[i].parent {
            bodies[p.0] = bodies[p.0].plus(&part.placed(&links[i]));
        }
    }
    bodies
}

/// ω, ω̇ and the acceleration of the origin minus gravity, in the link's axes.
#[derive(Clone, Copy)]
struct Moving<'g> {
    omega: Vec3<Expr<'g>>,
    omega_dot: Vec3<Expr<'g>>,
    a: Vec3<Expr<'g>>,
}

/// U = [ω̇]× + [ω]×[ω]×
fn u_of<'g>(omega: Vec3<Expr<'g>>, omega_dot: Vec3<Expr<'g>>) -> Mat3<Expr<'g>> {
    let ([x, y, z], [dx, dy, dz]) = (omega.0, omega_dot.0);
    let (xx, yy, zz) = (x * x, y * y, z * z);
    Mat3([
        [-(yy + zz), x * y - dz, x * z + dy],
        [x * y + dz, -(xx + zz), y * z - dx],
        [x * z - dy, y * z + dx, -(xx + yy)],
    ])
}

/// The graph of inverse dynamics.
pub fn inverse_dynamics(mechanism: &Mechanism, moment: Moment, zero: Zero) -> (Graph, Vec<Signed>) {
    let b = Builder::new();
    let outputs = {
        let efforts = efforts(&b, mechanism, moment, &regrouped(mechanism, zero));
        efforts.into_iter().map(Expr::signed).collect()
    };
    (b.into_graph(), outputs)
}

/// Returns the operations of the cheapest of the usual choices of base parameters.
pub fn operations(mechanism: &Mechanism, moment: Moment) -> Operations {
    let choices = [Zero::Jxx, Zero::Jyy, Zero::Dzz].into_iter();
    let counts = choices.map(|zero| {
        let (graph, outputs) = inverse_dynamics(mechanism, moment, zero);
        count(&graph, &outputs)
    });
    counts.min_by_key(|o| o.mul + o.add).expect("three choices")
}

fn efforts<'g>(
    b: &'g Builder,
    mechanism: &Mechanism,
    moment: Moment,
    bodies: &[Body],
) -> Vec<Expr<'g>> {
    let links = mechanism.links();
    let base = Moving {
        omega: Vec3([b.zero(); 3]),
        omega_dot: Vec3([b.zero(); 3]),
        a: b.vector(-mechanism.gravity()),
    };
    let joints: Vec<Joint<'g>> = links.iter().map(|link| Joint::new(b, link)).collect();
    let mut moving: Vec<Moving<'g>> = Vec::new();
    for (link, joint) in links.iter().zip(&joints) {
        let parent = link.parent.map_or(base, |p| moving[p.0]);
        moving.push(joint.outwards(&parent));
    }
    let mut wrenches: Vec<_> = moving
        .iter()
        .zip(bodies)
        .map(|(motion, body)| load(b, motion, body, moment))
        .collect();
    let mut efforts = vec![b.zero(); mechanism.nv()];
    for i in (0..links.len()).rev() {
        let (force, torque) = wrenches[i];
        if let Some(j) = links[i].joint.coordinate {
            efforts[j.0] = match joints[i].motion {
                Motion::Rotation => torque.0[2],
                _ => force.0[2],
            };
        }
        if let Some(p) = links[i].parent {
            let (f, n) = joints[i].inwards(force, torque);
            wrenches[p.0] = (wrenches[p.0].0 + f, wrenches[p.0].1 + n);
        }
    }
    efforts
}

/// Returns the force and moment about the origin that a link's motion requires.
fn load<'g>(
    b: &'g Builder,
    motion: &Moving<'g>,
    body: &Body,
    moment: Moment,
) -> (Vec3<Expr<'g>>, Vec3<Expr<'g>>) {
    let (omega, u) = (motion.omega, u_of(motion.omega, motion.omega_dot));
    let h = b.vector(body.first);
    let d = body.pseudo.0;
    let force = u * h + motion.a.map(|x| x * body.mass);
    let turning = match moment {
        Moment::Tensor => {
            let trace = d[0][0] + d[1][1] + d[2][2];
            let on = |i: usize, j: usize| if i == j { trace } else { Dd::ZERO };
            let tensor = Mat3::from_fn(|i, j| b.constant(clean(on(i, j) - d[i][j])));
            tensor * motion.omega_dot + omega.cross(tensor * omega)
        }
        Moment::PseudoInertia => {
            let d = Mat3(d).map(|x| b.constant(x));
            let u = u.0;
            let (zy, xz, yx) = (u[2][2] - u[1][1], u[0][0] - u[2][2], u[1][1] - u[0][0]);
            let d = |i: usize, j: usize| d.0[i][j];
            Vec3([
                d(1, 1) * u[2][1] - d(2, 2) * u[1][2]
                    + d(1, 2) * zy
                    + (d(0, 1) * u[2][0] - d(0, 2) * u[1][0]),
                d(2, 2) * u[0][2] - d(0, 0) * u[2][0]
                    + d(0, 2) * xz
                    + (d(1, 2) * u[0][1] - d(0, 1) * u[2][1]),
                d(0, 0) * u[1][0] - d(1, 1) * u[0][1]
                    + d(0, 1) * yx
                    + (d(0, 2) * u[1][2] - d(1, 2) * u[0][2]),
            ])
        }
    };
    (force, turning + h.cross(motion.a))
}

/// A joint's expressions.
struct Joint<'g> {
    motion: Motion,
    /// The joint's axes at coordinate zero, in the parent's.
    rotation: Mat3<Expr<'g>>,
    /// The link's origin in the parent's axes, and in those of the joint.
    place: Vec3<Expr<'g>>,
    place_here: Vec3<Expr<'g>>,
    /// cos q and sin q.
    turn: (Expr<'g>, Expr<'g>),
    rate: Expr<'g>,
    acceleration: Expr<'g>,
}

impl<'g> Joint<'g> {
    fn new(b: &'g Builder, link: &Link) -> Self {
        let (joint, origin) = (&link.joint, &link.joint.origin);
        let motion = joint.kind.motion;
        let at = |leaf: fn(usize) -> Leaf| joint.coordinate.map_or(b.zero(), |j| b.leaf(leaf(j.0)));
        let q = at(Leaf::Position);
        if joint.coordinate.is_some() {
            assert!(
                joint.axis == Vec3([Dd::ZERO, Dd::ZERO, Dd::ONE]),
                "{}",
                link.name
            );
        }
        let back = origin.rotation.transpose();
        let along = |place: Vec3<Expr<'g>>, axis: Vec3<Dd>| match motion {
            Motion::Translation => place + axis.map(|x| q * x),
            _ => place,
        };
        let z = Vec3([Dd::ZERO, Dd::ZERO, Dd::ONE]);
        Joint {
            motion,
            rotation: origin.rotation.map(|x| b.constant(x)),
            place: along(b.vector(origin.translation), origin.rotation * z),
            place_here: along(b.vector((back * origin.translation).map(clean)), z),
            turn: match motion {
                Motion::Rotation => b.cos_sin(&[q], Dd::ZERO),
                _ => (b.constant(Dd::ONE), b.zero()),
            },
            rate: at(Leaf::Velocity),
            acceleration: at(Leaf::Acceleration),
        }
    }

    fn outwards(&self, parent: &Moving<'g>) -> Moving<'g> {
        let back = self.rotation.transpose();
        let u = u_of(parent.omega, parent.omega_dot);
        let (c, s) = self.turn;
        let turned = |v: Vec3<Expr<'g>>| {
            let [x, y, z] = v.0;
            Vec3([c * x + s * y, c * y - s * x, z])
        };
        let mut omega = turned(back * parent.omega);
        let mut omega_dot = turned(back * parent.omega_dot);
        let mut a = back * (parent.a + u * self.place);
        let [x, y, _] = omega.0;
        match self.motion {
            Motion::Rotation => {
                omega_dot.0[0] = omega_dot.0[0] + y * self.rate;
                omega_dot.0[1] = omega_dot.0[1] - x * self.rate;
                omega_dot.0[2] = omega_dot.0[2] + self.acceleration;
                omega.0[2] = omega.0[2] + self.rate;
            }
            _ => {
                let twice = self.rate * Dd::from_f64(2.0);
                a = a + Vec3([y * twice, -(x * twice), self.acceleration]);
            }
        }
        Moving {
            omega,
            omega_dot,
            a: turned(a),
        }
    }

    /// Returns force and moment about the parent's origin, in its axes.
    fn inwards(
        &self,
        force: Vec3<Expr<'g>>,
        moment: Vec3<Expr<'g>>,
    ) -> (Vec3<Expr<'g>>, Vec3<Expr<'g>>) {
        let (c, s) = self.turn;
        let turned = |v: Vec3<Expr<'g>>| {
            let [x, y, z] = v.0;
            Vec3([c * x - s * y, s * x + c * y, z])
        };
        let force = turned(force);
        let moment = turned(moment) + self.place_here.cross(force);
        (self.rotation * force, self.rotation * moment)
    }
}
