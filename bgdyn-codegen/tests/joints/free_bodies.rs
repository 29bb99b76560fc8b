//! Newton's and Euler's laws of each link from poses alone: forces and moments that links need for a motion.

use bgdyn_codegen::mechanism::Value;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::robot::{Robot, State, cross, dot, largest};

pub type V3 = [Dd; 3];

/// A force and its moment about the origin of the world, in its axes.
#[derive(Clone, Copy, Debug)]
pub struct Load {
    pub force: V3,
    pub moment: V3,
}

/// Pose of a frame in the world.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    pub rotation: [V3; 3],
    pub origin: V3,
}

pub fn three(f: impl Fn(usize) -> Dd) -> V3 {
    std::array::from_fn(f)
}

pub fn plus(a: V3, b: V3) -> V3 {
    three(|i| a[i] + b[i])
}

pub fn scaled(a: V3, k: Dd) -> V3 {
    a.map(|x| x * k)
}

impl Placed {
    fn of(pose: &[Dd]) -> Self {
        Placed {
            rotation: std::array::from_fn(|i| three(|j| pose[3 * i + j])),
            origin: three(|i| pose[9 + i]),
        }
    }

    pub fn frame(tree: &Robot, name: &str, state: &State<Dd>) -> Self {
        let pose: Vec<Dd> = state.value(&tree.function(None, Method::Pose(tree.site(name))));
        Placed::of(&pose)
    }

    /// Returns a vector of the frame's axes in the world's.
    pub fn turned(&self, v: V3) -> V3 {
        three(|i| dot(&self.rotation[i], &v))
    }

    /// Returns a load, given as force and moment about the frame's origin in its axes.
    pub fn load(&self, of: &[Dd]) -> Load {
        let force = self.turned(three(|i| of[i]));
        Load::at(self.origin, force, self.turned(three(|i| of[3 + i])))
    }
}

impl Load {
    /// Returns a force at a point, with a moment about it.
    pub fn at(point: V3, force: V3, moment: V3) -> Self {
        Load {
            force,
            moment: plus(moment, cross(&point, &force)),
        }
    }

    pub fn plus(self, other: Load) -> Self {
        Load {
            force: plus(self.force, other.force),
            moment: plus(self.moment, other.moment),
        }
    }

    pub fn minus(self, other: Load) -> Self {
        self.plus(other.opposite())
    }

    pub fn opposite(self) -> Self {
        Load {
            force: self.force.map(|x| -x),
            moment: self.moment.map(|x| -x),
        }
    }

    pub fn size(self) -> f64 {
        let all = self.force.iter().chain(&self.moment);
        all.map(|x| x.to_f64().abs()).fold(0.0, f64::max)
    }
}

/// Returns the second derivative at 0 from values on both sides, by Richardson's extrapolation.
/// `fastest` is the largest velocity, or root of an acceleration.
fn second_derivative(fastest: f64, of: impl Fn(Dd) -> Vec<Dd>) -> Vec<Dd> {
    const LEVELS: usize = 6;
    let centre = of(Dd::ZERO);
    let mut table: Vec<Vec<Dd>> = Vec::new();
    let mut h = Dd::from_f64(1.0 / (32.0 * fastest.max(4.0)));
    for _ in 0..LEVELS {
        let (after, before) = (of(h), of(-h));
        let scale = Dd::ONE / (h * h);
        let entry = |k: usize| (after[k] + before[k] - centre[k] - centre[k]) * scale;
        table.push((0..centre.len()).map(entry).collect());
        h *= Dd::from_f64(0.5);
    }
    extrapolated(table)
}

/// Returns the limit of values whose errors are even powers of the step, from values with halved steps (Richardson).
pub fn extrapolated(mut table: Vec<Vec<Dd>>) -> Vec<Dd> {
    let mut factor = Dd::ONE;
    while table.len() > 1 {
        factor *= Dd::from_f64(4.0);
        let better = table.windows(2).map(|pair| {
            let both = pair[0].iter().zip(&pair[1]);
            both.map(|(&x, &y)| y + (y - x) / (factor - Dd::ONE))
                .collect()
        });
        table = better.collect();
    }
    table.remove(0)
}

fn fixed(value: Value) -> Dd {
    match value {
        Value::Fixed(x) => x,
        Value::Parameter(_) => panic!("a run-time parameter"),
    }
}

/// Returns the place of each link of a tree of joints with one velocity, and the load that it needs for q + v t + a t²/2
/// beside its weight: m (r̈ − g), and the moment of all its mass points.
pub fn needed(tree: &Robot, state: &State<Dd>, gravity: V3) -> Vec<(Placed, Load)> {
    let links = tree.mechanism.links().iter();
    let fastest = largest(&state.v).max(largest(&state.a).sqrt());
    let each = links.map(|link| {
        let pose = tree.function(None, Method::Pose(tree.site(&link.name)));
        let at = |t: Dd| -> Vec<Dd> {
            let half = t * t * Dd::from_f64(0.5);
            let q = (0..state.q.len()).map(|j| state.q[j] + state.v[j] * t + state.a[j] * half);
            let moved = State {
                q: q.collect(),
                ..state.clone()
            };
            moved.value(&pose)
        };
        let (now, second) = (
            Placed::of(&at(Dd::ZERO)),
            Placed::of(&second_derivative(fastest, at)),
        );
        let mass = fixed(link.inertial.mass);
        let com = link.inertial.com.map(fixed).0;
        let [xx, yy, zz, xy, xz, yz] = link.inertial.inertia.entries.map(fixed);
        let half = (xx + yy + zz) * Dd::from_f64(0.5);
        // ∫ s sᵀ dm about the centre of mass, in the axes of the tensor.
        let pseudo = [
            [half - xx, -xy, -xz],
            [-xy, half - yy, -yz],
            [-xz, -yz, half - zz],
        ];
        let axes = link.inertial.inertia.axes;
        let point = plus(now.origin, now.turned(com));
        let acceleration = plus(second.origin, second.turned(com));
        let force = scaled(plus(acceleration, gravity.map(|g| -g)), mass);
        let mut moment = [Dd::ZERO; 3];
        for i in 0..3 {
            for j in 0..3 {
                let (x, y) = (axes.column(i).0, axes.column(j).0);
                let turned = cross(&now.turned(x), &second.turned(y));
                moment = plus(moment, scaled(turned, pseudo[i][j]));
            }
        }
        (now, Load::at(point, force, moment))
    });
    each.collect()
}

/// Asserts that the loads through the joints, `joints` by link in link axes, and the loads `given` on links sum up to
/// what each link needs, and that joints have no efforts along their free axes but `efforts` by velocity of the tree.
pub fn assert_free_bodies(
    tree: &Robot,
    state: &State<Dd>,
    (joints, given, efforts): (&[Dd], &[(usize, Load)], &[Dd]),
    allowed: f64,
    what: &str,
) {
    let needed = needed(tree, state, tree.mechanism.gravity().0);
    let links = tree.mechanism.links();
    assert_eq!(joints.len(), 6 * links.len(), "{what}");
    let loads = joints.chunks(6).zip(&needed);
    let loads: Vec<Load> = loads.map(|(load, (place, _))| place.load(load)).collect();
    let mut acting = loads.clone();
    for (i, link) in links.iter().enumerate() {
        if let Some(parent) = link.parent {
            acting[parent.0] = acting[parent.0].minus(loads[i]);
        }
    }
    for (link, load) in given {
        acting[*link] = acting[*link].plus(*load);
    }
    let size = acting.iter().chain(&loads).map(|load| load.size());
    let size = size.fold(1.0, f64::max);
    for ((link, acting), (_, load)) in links.iter().zip(&acting).zip(&needed) {
        let off = acting.minus(*load).size();
        assert!(
            off <= allowed * size,
            "{what}: {}: {off:e} of {size}",
            link.name
        );
    }
    for (i, link) in links.iter().enumerate() {
        let [velocity] = link.joint.degrees.velocities[..] else {
            continue;
        };
        let part = match link.joint.kind.keyword {
            "prismatic" => 6 * i,
            _ => 6 * i + 3,
        };
        let along = dot(&link.joint.axis.0, &joints[part..part + 3]);
        let off = (along - efforts[velocity.0]).to_f64().abs();
        assert!(
            off <= allowed * size,
            "{what}: effort of {}: {off:e}",
            link.joint.name
        );
    }
}
