//! Reference of mechanisms with loops, in double-double: equation (6) of the open tree, added up body by body in
//! the axes of the world, and the rows of the loops. Of the generator only the reader of specs is used.

use bgdyn_codegen::mechanism::closure::Closure;
use bgdyn_codegen::mechanism::{Mechanism, Motion, Pose, Value};
use bgdyn_runtime::Dd;

use crate::vectors::{Vector, cross, dot, length, scaled, sum};

/// A rotation matrix, row by row.
type Matrix = [[Dd; 3]; 3];

const NOTHING: Vector = [Dd::ZERO; 3];

fn times(m: &Matrix, x: Vector) -> Vector {
    [0, 1, 2].map(|i| dot(m[i], x))
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let column = |j: usize| [0, 1, 2].map(|i| b[i][j]);
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(a[i], column(j))))
}

fn transposed(m: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[j][i]))
}

fn minus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] - b[i])
}

/// A link of the open tree, with its joint.
struct Body {
    parent: Option<usize>,
    rotation: Matrix,
    translation: Vector,
    axis: Vector,
    turns: bool,
    mass: Dd,
    com: Vector,
    /// About the centre of mass, in link axes.
    inertia: Matrix,
}

/// A place of a loop: its link, and its pose there.
type Place = (Option<usize>, Pose);

/// The open tree of a mechanism, and its loops.
pub(crate) struct Tree {
    bodies: Vec<Body>,
    /// Names of the links.
    pub names: Vec<String>,
    gravity: Vector,
    /// Places a and b and the direction of each row.
    rows: Vec<([Place; 2], usize)>,
    /// The independent velocities, in the order of u.
    pub independents: Vec<usize>,
    /// The dependent ones.
    pub dependents: Vec<usize>,
    closure: Closure,
}

/// The motion of a link if no joint accelerates: rotation, origin, angular velocity, velocity, angular
/// acceleration, acceleration, and the sums of the lengths of the terms of the last two.
#[derive(Clone, Copy)]
struct Moving {
    turned: Matrix,
    origin: Vector,
    omega: Vector,
    velocity: Vector,
    alpha: Vector,
    acceleration: Vector,
    sizes: [f64; 2],
}

impl Moving {
    const WORLD: Moving = Moving {
        turned: Pose::IDENTITY.rotation.0,
        origin: NOTHING,
        omega: NOTHING,
        velocity: NOTHING,
        alpha: NOTHING,
        acceleration: NOTHING,
        sizes: [0.0; 2],
    };

    /// Moves the origin by a segment that is fixed to the link, in world axes.
    fn shifted(self, s: Vector) -> Moving {
        let inward = cross(self.omega, cross(self.omega, s));
        let moved = sum(cross(self.alpha, s), inward);
        let size = (self.sizes[0] + dot(self.omega, self.omega).to_f64()) * length(s);
        Moving {
            origin: sum(self.origin, s),
            velocity: sum(self.velocity, cross(self.omega, s)),
            acceleration: sum(self.acceleration, moved),
            sizes: [self.sizes[0], self.sizes[1] + size],
            ..self
        }
    }

    /// Goes through the joint of a body.
    fn through(self, body: &Body, q: Dd, v: Dd) -> Moving {
        let at = self.shifted(times(&self.turned, body.translation));
        let turned = product(&at.turned, &body.rotation);
        let axis = times(&turned, body.axis);
        let rate = scaled(v, axis);
        let with = cross(at.omega, rate);
        let [turning, moving] = at.sizes;
        let (two, size) = (Dd::from_f64(2.0), length(at.omega) * length(rate));
        if body.turns {
            return Moving {
                turned: product(&turned, &rotation(body.axis, q)),
                omega: sum(at.omega, rate),
                alpha: sum(at.alpha, with),
                sizes: [turning + size, moving],
                ..at
            };
        }
        let slid = Moving { turned, ..at }.shifted(scaled(q, axis));
        Moving {
            velocity: sum(slid.velocity, rate),
            acceleration: sum(slid.acceleration, scaled(two, with)),
            sizes: [turning, slid.sizes[1] + 2.0 * size],
            ..slid
        }
    }
}

/// The rotation by an angle about a unit vector.
fn rotation(n: Vector, angle: Dd) -> Matrix {
    let (sin, cos) = angle.sin_cos();
    let unit = |i: usize| [0, 1, 2].map(|j| if i == j { Dd::ONE } else { Dd::ZERO });
    // Columns: what becomes of the axes.
    let column = |i: usize| {
        let e = unit(i);
        let along = scaled(dot(n, e) * (Dd::ONE - cos), n);
        sum(sum(scaled(cos, e), along), scaled(sin, cross(n, e)))
    };
    transposed(&[0, 1, 2].map(column))
}

/// The open tree at one position and velocity.
pub(crate) struct At {
    /// The mass matrix, row by row.
    pub mass: Vec<Vec<Dd>>,
    /// Efforts at zero accelerations.
    pub bias: Vec<Dd>,
    /// The magnitudes of their terms, added up.
    pub bias_size: Vec<f64>,
    /// B, row by row.
    pub rows: Vec<Vec<Dd>>,
    /// γ
    pub gamma: Vec<Dd>,
    /// The magnitudes of their terms, added up.
    pub gamma_size: Vec<f64>,
    /// By how much the rows are open, m.
    pub open: Vec<Dd>,
}

impl Tree {
    /// Reads a spec.
    ///
    /// # Panics
    /// If the spec is refused, has no loop, or has joints or rows other than those of single axes and points.
    pub fn new(text: &str, name: &str) -> Tree {
        let read = |text: &str| -> Mechanism {
            let (mechanism, faults) = bgdyn_codegen::read(text, Some(name));
            mechanism.unwrap_or_else(|| panic!("{}", faults.render(name, text)))
        };
        let (whole, open) = (read(text), read(&opened(text)));
        let closure = whole.closure().expect("loops");
        let place = |link: Option<usize>, pose: Pose| (link, pose);
        let rows = closure.rows.iter().map(|row| {
            let one = &closure.loops[row.closes];
            let links = one.links.map(|link| link.map(|link| link.0));
            let ends = [
                place(links[0], one.chain.start),
                place(links[1], one.chain.end),
            ];
            let direction = ["x", "y", "z"].iter().position(|own| *own == row.name);
            (ends, direction.expect("a row of a point"))
        });
        Tree {
            bodies: open.links().iter().map(body).collect(),
            names: open.links().iter().map(|link| link.name.clone()).collect(),
            gravity: open.gravity().0,
            rows: rows.collect(),
            independents: closure.independents.iter().map(|j| j.0).collect(),
            dependents: closure.dependents().map(|j| j.0).collect(),
            closure: closure.clone(),
        }
    }

    /// Number of velocities of the tree.
    pub fn len(&self) -> usize {
        self.bodies.len()
    }

    /// Returns whether a closed position is on the branch of the start, by the signs of the determinants of the
    /// blocks of rows.
    pub fn on_branch(&self, q: &[Dd]) -> bool {
        self.closure.signs_at(q) == self.closure.signs
    }

    /// Returns whether a joint is a rotation.
    pub fn turns(&self, joint: usize) -> bool {
        self.bodies[joint].turns
    }

    /// The motion of all links.
    fn moving(&self, q: &[Dd], v: &[Dd]) -> Vec<Moving> {
        let mut all: Vec<Moving> = vec![];
        for (j, body) in self.bodies.iter().enumerate() {
            let from = body.parent.map_or(Moving::WORLD, |parent| all[parent]);
            all.push(from.through(body, q[j], v[j]));
        }
        all
    }

    /// The columns of the angular velocity of a link and of the velocity of a point, by joint.
    fn columns(
        &self,
        all: &[Moving],
        link: Option<usize>,
        point: Vector,
    ) -> Vec<(usize, [Vector; 2])> {
        let (mut columns, mut next) = (vec![], link);
        while let Some(j) = next {
            let axis = times(&all[j].turned, self.bodies[j].axis);
            let lever = minus(point, all[j].origin);
            columns.push((
                j,
                match self.bodies[j].turns {
                    true => [axis, cross(axis, lever)],
                    false => [NOTHING, axis],
                },
            ));
            next = self.bodies[j].parent;
        }
        columns
    }

    /// Returns everything at a position and a velocity.
    pub fn at(&self, q: &[Dd], v: &[Dd]) -> At {
        let (n, all) = (self.len(), self.moving(q, v));
        let mut at = At {
            mass: vec![vec![Dd::ZERO; n]; n],
            bias: vec![Dd::ZERO; n],
            bias_size: vec![0.0; n],
            rows: vec![],
            gamma: vec![],
            gamma_size: vec![],
            open: vec![],
        };
        for (i, body) in self.bodies.iter().enumerate() {
            let link = all[i];
            let centre = link.shifted(times(&link.turned, body.com));
            let inertia = product(
                &product(&link.turned, &body.inertia),
                &transposed(&link.turned),
            );
            let columns = self.columns(&all, Some(i), centre.origin);
            let force = scaled(body.mass, minus(centre.acceleration, self.gravity));
            let spin = times(&inertia, link.omega);
            let moment = sum(times(&inertia, link.alpha), cross(link.omega, spin));
            let stiff = inertia
                .map(length)
                .iter()
                .fold(0.0, |most: f64, x| most.max(*x));
            let square = dot(link.omega, link.omega).to_f64();
            let forces = body.mass.to_f64() * (centre.sizes[1] + length(self.gravity));
            let moments = stiff * (centre.sizes[0] + square);
            for (j, [turn, shift]) in &columns {
                at.bias[*j] += dot(*shift, force) + dot(*turn, moment);
                at.bias_size[*j] += length(*shift) * forces + length(*turn) * moments;
                let momentum = scaled(body.mass, *shift);
                let turned = times(&inertia, *turn);
                for (k, [other_turn, other_shift]) in &columns {
                    at.mass[*j][*k] += dot(momentum, *other_shift) + dot(turned, *other_turn);
                }
            }
        }
        for (ends, direction) in &self.rows {
            self.row(&mut at, &all, ends, *direction);
        }
        at
    }

    /// Returns the size of the loop of each row, m: half the way around it, through the origins of its links.
    pub fn sizes(&self, q: &[Dd]) -> Vec<f64> {
        let all = self.moving(q, &vec![Dd::ZERO; self.len()]);
        let way = |(link, pose): &Place| {
            let carrier = link.map_or(Moving::WORLD, |link| all[link]);
            let place = carrier.shifted(times(&carrier.turned, pose.translation.0));
            let (mut links, mut next) = (vec![], *link);
            while let Some(j) = next {
                links.push(j);
                next = self.bodies[j].parent;
            }
            (place.origin, links)
        };
        let size = |(ends, _): &([Place; 2], usize)| {
            let [(a, from), (b, to)] = [way(&ends[0]), way(&ends[1])];
            let inward = from.iter().filter(|j| !to.contains(j));
            let outward = to.iter().rev().filter(|j| !from.contains(j));
            let origins = inward.chain(outward).map(|&j| all[j].origin);
            let points: Vec<Vector> = std::iter::once(a).chain(origins).chain([b]).collect();
            let ways = points
                .windows(2)
                .map(|pair| length(minus(pair[1], pair[0])));
            ways.sum::<f64>() / 2.0
        };
        self.rows.iter().map(size).collect()
    }

    /// Adds a row: place b relative to place a, along an axis of a.
    fn row(&self, at: &mut At, all: &[Moving], ends: &[Place; 2], direction: usize) {
        let [a, b] = ends.map(|(link, pose)| {
            let carrier = link.map_or(Moving::WORLD, |link| all[link]);
            let turned = product(&carrier.turned, &pose.rotation.0);
            let at = carrier.shifted(times(&carrier.turned, pose.translation.0));
            Moving { turned, ..at }
        });
        let e = [0, 1, 2].map(|i| a.turned[i][direction]);
        let apart = minus(b.origin, a.origin);
        let (lever, rate) = (cross(apart, e), minus(b.velocity, a.velocity));
        let mut row = vec![Dd::ZERO; self.len()];
        for (j, [_, shift]) in self.columns(all, ends[1].0, b.origin) {
            row[j] += dot(e, shift);
        }
        for (j, [turn, shift]) in self.columns(all, ends[0].0, a.origin) {
            row[j] -= dot(e, shift) + dot(lever, turn);
        }
        let second = dot(e, minus(b.acceleration, a.acceleration)) - dot(lever, a.alpha)
            + dot(cross(a.omega, e), minus(rate, cross(a.omega, apart)))
            - dot(e, cross(a.omega, rate));
        at.rows.push(row);
        at.gamma.push(-second);
        at.gamma_size.push(a.sizes[1] + b.sizes[1]);
        at.open.push(dot(e, apart));
    }
}

/// Returns the spec without its loops and effects.
fn opened(text: &str) -> String {
    let mut kept = true;
    let mut lines = vec![];
    for line in text.lines() {
        if !line.starts_with([' ', '#', '\t']) && !line.is_empty() {
            let left_out = ["loops:", "independent:", "effects:"];
            kept = !left_out.iter().any(|key| line.starts_with(key));
        }
        if kept {
            lines.push(line);
        }
    }
    lines.join("\n") + "\n"
}

fn fixed(value: Value) -> Dd {
    match value {
        Value::Fixed(x) => x,
        Value::Parameter(_) => panic!("a run-time parameter"),
    }
}

fn body(link: &bgdyn_codegen::mechanism::Link) -> Body {
    let (joint, inertial) = (&link.joint, &link.inertial);
    let turns = match joint.kind.motion {
        Motion::Rotation => true,
        Motion::Translation => false,
        _ => panic!("{}: a joint with one axis", joint.name),
    };
    let [xx, yy, zz, xy, xz, yz] = inertial.inertia.entries.map(fixed);
    let axes = inertial.inertia.axes.0;
    let entries = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    Body {
        parent: link.parent.map(|parent| parent.0),
        rotation: joint.origin.rotation.0,
        translation: joint.origin.translation.0,
        axis: joint.axis.0,
        turns,
        mass: fixed(inertial.mass),
        com: inertial.com.0.map(fixed),
        inertia: product(&product(&axes, &entries), &transposed(&axes)),
    }
}
