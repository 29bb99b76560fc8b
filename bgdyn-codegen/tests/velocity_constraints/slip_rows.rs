//! The rows of wheels, balls and knife edges from the motion of frames of the open tree, in world axes.

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::random_mechanisms::{Constraint, Touch};
use super::robot::{Robot, State, cross, dot};

/// A vector with its rate.
type Moving = ([Dd; 3], [Dd; 3]);

/// The motion of a frame.
struct FrameMotion {
    n: usize,
    rotation: [[Dd; 3]; 3],
    /// Angular part first.
    jacobian: Vec<Vec<Dd>>,
    bias: Vec<Dd>,
    velocity: Vec<Dd>,
}

fn three(f: impl Fn(usize) -> Dd) -> [Dd; 3] {
    std::array::from_fn(f)
}

fn times(v: [Dd; 3], k: Dd) -> [Dd; 3] {
    v.map(|x| x * k)
}

fn plus(a: [Dd; 3], b: [Dd; 3]) -> [Dd; 3] {
    three(|i| a[i] + b[i])
}

fn crossed(a: Moving, b: Moving) -> Moving {
    let rate = plus(cross(&a.1, &b.0), cross(&a.0, &b.1));
    (cross(&a.0, &b.0), rate)
}

fn normalized((v, rate): Moving) -> Moving {
    let one = Dd::ONE / dot(&v, &v).sqrt();
    let v = times(v, one);
    let along = dot(&v, &rate);
    (v, times(plus(rate, times(v, -along)), one))
}

impl FrameMotion {
    fn new(tree: &Robot, name: &str, state: &State<Dd>) -> Self {
        let site = tree.site(name);
        let value = |method| -> Vec<Dd> { state.value(&tree.function(None, method)) };
        let pose = value(Method::Pose(site));
        let jacobian = value(Method::Jacobian(site));
        let n = tree.nv();
        FrameMotion {
            n,
            rotation: std::array::from_fn(|i| three(|j| pose[3 * i + j])),
            jacobian: jacobian.chunks(n).map(<[Dd]>::to_vec).collect(),
            bias: value(Method::JacobianDotV(site)),
            velocity: value(Method::Velocity(site)),
        }
    }

    /// A direction that is fixed in the frame.
    fn fixed(&self, v: [Dd; 3]) -> Moving {
        let v = three(|i| dot(&self.rotation[i], &v));
        (v, cross(&self.velocity[..3], &v))
    }

    /// The lowest point of an ellipsoid from its centre: −A n / √(n · A n) in the frame's axes, with n there and its
    /// rate −ω × n.
    fn lowest(&self, half_axes: [Dd; 3], normal: [Dd; 3]) -> Moving {
        let column = |k: usize| three(|i| self.rotation[i][k]);
        let omega = three(|i| self.velocity[i]);
        let own = |v: [Dd; 3]| three(|k| dot(&column(k), &v));
        let squares = half_axes.map(|a| a * a);
        let stretched = |n: [Dd; 3]| three(|k| squares[k] * n[k]);
        let (n, rate) = (own(normal), own(cross(&normal, &omega)));
        let height = dot(&n, &stretched(n)).sqrt();
        let height_rate = dot(&n, &stretched(rate)) / height;
        let point = times(stretched(n), -(Dd::ONE / height));
        let moved = plus(
            stretched(rate),
            times(stretched(n), -(height_rate / height)),
        );
        let moved = times(moved, -(Dd::ONE / height));
        let world = |v: [Dd; 3]| three(|i| dot(&self.rotation[i], &v));
        let arm = world(point);
        (arm, plus(cross(&omega, &arm), world(moved)))
    }

    /// The row of B and γ: the velocity of the material point at an arm from the origin, along a direction.
    fn row(&self, direction: Moving, arm: Moving) -> (Vec<Dd>, Dd) {
        let (d, d_rate) = direction;
        let part = |of: &dyn Fn(usize) -> Dd| {
            let (angular, linear) = (three(of), three(|i| of(3 + i)));
            plus(linear, cross(&angular, &arm.0))
        };
        let column = |j: usize| dot(&d, &part(&|i| self.jacobian[i][j]));
        let velocity = part(&|i| self.velocity[i]);
        let bias = plus(part(&|i| self.bias[i]), cross(&self.velocity[..3], &arm.1));
        let second = dot(&d, &bias) + dot(&d_rate, &velocity);
        ((0..self.n).map(column).collect(), -second)
    }
}

/// Returns the rows of B and γ of constraint `k`; those of a wheel: longitudinal, lateral, height.
pub fn rows(
    tree: &Robot,
    (k, one): (usize, &Constraint),
    normal: [Dd; 3],
    state: &State<Dd>,
) -> Vec<(Vec<Dd>, Dd)> {
    let frame = FrameMotion::new(tree, &format!("f{k}"), state);
    let still = three(|_| Dd::ZERO);
    let up = (normal, still);
    match one.touch {
        Touch::Edge => vec![frame.row(frame.fixed(one.axis), (still, still))],
        Touch::Ball | Touch::Ellipsoid => {
            let arm = match one.touch {
                Touch::Ball => (times(normal, -one.radius), still),
                _ => frame.lowest(one.half_axes, normal),
            };
            let axis = |k: usize| (three(|i| if i == k { Dd::ONE } else { Dd::ZERO }), still);
            [0, 1, 2].map(|k| frame.row(axis(k), arm)).to_vec()
        }
        _ => {
            let axle = frame.fixed(one.axis);
            let ahead = normalized(crossed(axle, up));
            let aside = crossed(up, ahead);
            let (e, rate) = crossed(ahead, axle);
            let crown = times(normal, -one.crown);
            let arm = (plus(times(e, -one.radius), crown), times(rate, -one.radius));
            let all = [ahead, aside, up].map(|d| frame.row(d, arm)).to_vec();
            match one.touch {
                Touch::Longitudinal | Touch::LongitudinalTyre => {
                    [all[0].clone(), all[2].clone()].to_vec()
                }
                Touch::Lateral | Touch::LateralTyre => [all[1].clone(), all[2].clone()].to_vec(),
                _ => all,
            }
        }
    }
}
