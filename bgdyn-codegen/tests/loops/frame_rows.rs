//! The rows of loops from Jacobians and accelerations of frames of the open tree, in world axes.

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::random_loops::Loop;
use super::robot::{Robot, State, cross, dot};

/// Position, rotation, Jacobian and J̇ v of a frame of the open tree.
pub struct FrameMotion {
    pub rotation: [[Dd; 3]; 3],
    pub origin: [Dd; 3],
    /// Angular part first.
    pub jacobian: Vec<Vec<Dd>>,
    pub bias: Vec<Dd>,
    pub velocity: Vec<Dd>,
}

impl FrameMotion {
    pub fn new(tree: &Robot, name: &str, state: &State<Dd>) -> Self {
        let site = tree.site(name);
        let value = |method| -> Vec<Dd> { state.value(&tree.function(None, method)) };
        let pose = value(Method::Pose(site));
        let jacobian = value(Method::Jacobian(site));
        let n = tree.nv();
        FrameMotion {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| pose[3 * i + j])),
            origin: std::array::from_fn(|i| pose[9 + i]),
            jacobian: jacobian.chunks(n).map(<[Dd]>::to_vec).collect(),
            bias: value(Method::JacobianDotV(site)),
            velocity: value(Method::Velocity(site)),
        }
    }

    pub fn direction(&self, k: usize) -> [Dd; 3] {
        std::array::from_fn(|i| self.rotation[i][k])
    }

    /// Returns a vector of the frame's axes in the world's.
    pub fn turned(&self, v: [Dd; 3]) -> [Dd; 3] {
        std::array::from_fn(|i| dot(&self.rotation[i], &v))
    }
}

pub fn minus(a: &[Dd], b: &[Dd]) -> Vec<Dd> {
    a.iter().zip(b).map(|(&x, &y)| x - y).collect()
}

/// Returns rows of B and γ: the motion of b relative to a along directions that turn with a.
pub fn rows(one: &Loop, a: &FrameMotion, b: &FrameMotion) -> Vec<(Vec<Dd>, Dd)> {
    let n = a.jacobian[0].len();
    let d: [Dd; 3] = std::array::from_fn(|i| b.origin[i] - a.origin[i]);
    let (omega, velocity) = a.velocity.split_at(3);
    let relative = minus(&b.velocity, &a.velocity);
    let bias = minus(&b.bias, &a.bias);
    // e · (ṙ_b − ṙ_a − ω_a × d)
    let place = |e: [Dd; 3]| {
        let turned = cross(omega, &e);
        let lever = cross(&d, &e);
        let rate = |j: usize| {
            let linear = (0..3).map(|i| {
                e[i] * (b.jacobian[3 + i][j] - a.jacobian[3 + i][j]) - lever[i] * a.jacobian[i][j]
            });
            linear.fold(Dd::ZERO, |sum, x| sum + x)
        };
        let moved = minus(&relative[3..], &cross(omega, &d));
        let second = dot(&e, &bias[3..]) - dot(&lever, &a.bias[..3]) + dot(&turned, &moved)
            - dot(&e, &cross(omega, &relative[3..]));
        ((0..n).map(rate).collect(), -second)
    };
    // e · (ω_b − ω_a)
    let turn = |e: [Dd; 3]| {
        let rate = |j: usize| {
            (0..3).fold(Dd::ZERO, |sum, i| {
                sum + e[i] * (b.jacobian[i][j] - a.jacobian[i][j])
            })
        };
        let second = dot(&e, &bias[..3]) + dot(&cross(omega, &e), &relative[..3]);
        ((0..n).map(rate).collect(), -second)
    };
    let _ = velocity;
    let axes = [0, 1, 2].map(|k| a.direction(k));
    let axis = a.turned(one.axis);
    let least = (0..3)
        .min_by(|&i, &j| {
            one.axis[i]
                .to_f64()
                .abs()
                .total_cmp(&one.axis[j].to_f64().abs())
        })
        .expect("three");
    let first = cross(&axis, &axes[least]);
    let second = cross(&axis, &first);
    match one.kind {
        "point" => axes.map(place).to_vec(),
        "hinge" => axes
            .map(place)
            .into_iter()
            .chain([first, second].map(turn))
            .collect(),
        "weld" => axes.map(place).into_iter().chain(axes.map(turn)).collect(),
        "slider" => [first, second]
            .map(place)
            .into_iter()
            .chain(axes.map(turn))
            .collect(),
        "universal" => {
            // z_a · x_b
            let (z, x) = (a.direction(2), b.direction(0));
            let normal = cross(&x, &z);
            let rate = |j: usize| {
                (0..3).fold(Dd::ZERO, |sum, i| {
                    sum + normal[i] * (b.jacobian[i][j] - a.jacobian[i][j])
                })
            };
            let slopes = minus(
                &cross(&cross(&b.velocity[..3], &x), &z),
                &cross(&cross(omega, &z), &x),
            );
            let second = dot(&normal, &bias[..3]) + dot(&slopes, &relative[..3]);
            axes.map(place)
                .into_iter()
                .chain([((0..n).map(rate).collect(), -second)])
                .collect()
        }
        "distance" => {
            let rate = |j: usize| {
                (0..3).fold(Dd::ZERO, |sum, i| {
                    sum + d[i] * (b.jacobian[3 + i][j] - a.jacobian[3 + i][j])
                })
            };
            let second = dot(&d, &bias[3..]) + dot(&relative[3..], &relative[3..]);
            vec![((0..n).map(rate).collect(), -second)]
        }
        other => panic!("{other}"),
    }
}
