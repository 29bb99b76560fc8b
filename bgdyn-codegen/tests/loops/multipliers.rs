//! Random loops of every type against the open tree with multipliers: M q̈ + h = P + Bᵀ λ, B q̈ = γ, solved here in
//! double-double. B and γ come from the Jacobians and accelerations of frames of the open tree.

use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::robot::{Robot, State, Way, close, cross, dot, full, largest, times};

const WAYS: [Way; 2] = [None, Some("subspaces")];

/// A loop of a random mechanism.
struct Loop {
    kind: &'static str,
    /// The axis, for types with one.
    axis: [Dd; 3],
}

fn number(text: &str) -> Dd {
    text.parse().expect("a number")
}

/// A random decimal with three digits, in thousandths.
fn thousandths(random: &mut Random, size: i64) -> i64 {
    random.below((2 * size + 1) as u64) as i64 - size
}

fn decimal(thousandths: i64) -> String {
    let sign = if thousandths < 0 { "-" } else { "" };
    let size = thousandths.abs();
    format!("{sign}{}.{:03}", size / 1000, size % 1000)
}

fn vector(v: [i64; 3]) -> String {
    format!("[{}]", v.map(decimal).join(", "))
}

/// A mechanism whose links' axes are parallel at zero, so that places with the sum of the origins coincide there.
struct Text {
    links: String,
    frames: String,
    loops: String,
    /// Origins of the links in the axes of the world, thousandths of a metre.
    origins: Vec<[i64; 3]>,
    all: Vec<Loop>,
}

impl Text {
    /// Two branches of `count` joints each on a body that floats, is fixed or turns about a ball.
    fn new(
        random: &mut Random,
        root: &str,
        count: usize,
        axes: impl Fn(&mut Random) -> [i64; 3],
    ) -> Self {
        let mut text = Text {
            links: format!(
                "  - name: body_0\n    joint: {{ name: root, type: {root} }}\n    mass: 1.7\n    com: [0.02, 0.01, -0.03]\n    \
                 inertia: {{ xx: 0.03, yy: 0.04, zz: 0.05, xy: 0.001 }}\n"
            ),
            frames: String::new(),
            loops: String::new(),
            origins: vec![[0; 3]],
            all: Vec::new(),
        };
        for branch in 0..2 {
            for i in 0..count {
                let n = text.origins.len();
                let parent = if i == 0 { 0 } else { n - 1 };
                let kind = if i == 2 && branch == 0 {
                    "prismatic"
                } else {
                    "continuous"
                };
                let step = [0; 3].map(|_| thousandths(random, 400));
                let com = vector([0; 3].map(|_| thousandths(random, 100)));
                let axis = vector(axes(random));
                text.links += &format!(
                    "  - name: body_{n}\n    parent: body_{parent}\n    joint: {{ name: j{n}, type: {kind}, axis: {axis}, \
                     origin: {{ xyz: {} }} }}\n    mass: 0.{}\n    com: {com}\n    inertia: {{ xx: 0.02, yy: 0.03, zz: 0.025, xz: 0.002 }}\n",
                    vector(step),
                    n + 3
                );
                let from = text.origins[parent];
                text.origins
                    .push(std::array::from_fn(|k| from[k] + step[k]));
            }
        }
        text
    }

    /// Connects places of two links that are apart by `apart` in the axes of the world at zero.
    fn connect(
        &mut self,
        random: &mut Random,
        kind: &'static str,
        links: [usize; 2],
        (axis, apart): ([i64; 3], [i64; 3]),
    ) {
        let k = self.all.len();
        let a = [0; 3].map(|_| thousandths(random, 200));
        let [from, to] = links.map(|i| self.origins[i]);
        let b: [i64; 3] = std::array::from_fn(|k| from[k] + a[k] + apart[k] - to[k]);
        let [a, b] = [a, b].map(vector);
        for (end, link, at) in [("a", links[0], &a), ("b", links[1], &b)] {
            self.frames +=
                &format!("  - {{ name: {end}{k}, link: body_{link}, origin: {{ xyz: {at} }} }}\n");
        }
        let more = match kind {
            "hinge" | "slider" => format!("    axis: {}\n", vector(axis)),
            // 3, 4, 12: 13
            "distance" => "    length: 0.13\n".to_owned(),
            _ => String::new(),
        };
        self.loops += &format!(
            "  - name: loop_{k}\n    type: {kind}\n    a: {{ frame: a{k} }}\n    b: {{ frame: b{k} }}\n{more}"
        );
        let axis = axis.map(|x| number(&decimal(x)));
        let length = dot(&axis, &axis).sqrt();
        self.all.push(Loop {
            kind,
            axis: axis.map(|x| x / length),
        });
    }

    fn open(&self) -> String {
        format!(
            "format: 1\nname: looped\ngravity: [0.3, -0.4, -9.7]\nlinks:\n{}frames:\n{}",
            self.links, self.frames
        )
    }

    fn closed(&self) -> String {
        format!("{}loops:\n{}", self.open(), self.loops)
    }
}

/// Position, rotation, Jacobian and J̇ v of a frame of the open tree.
struct FrameMotion {
    rotation: [[Dd; 3]; 3],
    origin: [Dd; 3],
    /// Angular part first.
    jacobian: Vec<Vec<Dd>>,
    bias: Vec<Dd>,
    velocity: Vec<Dd>,
}

impl FrameMotion {
    fn new(tree: &Robot, name: &str, state: &State<Dd>) -> Self {
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

    fn direction(&self, k: usize) -> [Dd; 3] {
        std::array::from_fn(|i| self.rotation[i][k])
    }

    /// Returns a vector of the frame's axes in the world's.
    fn turned(&self, v: [Dd; 3]) -> [Dd; 3] {
        std::array::from_fn(|i| dot(&self.rotation[i], &v))
    }
}

fn minus(a: &[Dd], b: &[Dd]) -> Vec<Dd> {
    a.iter().zip(b).map(|(&x, &y)| x - y).collect()
}

/// Returns rows of B and γ: the motion of b relative to a along directions that turn with a.
fn rows(one: &Loop, a: &FrameMotion, b: &FrameMotion) -> Vec<(Vec<Dd>, Dd)> {
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

/// Solves a system by elimination with complete pivoting; pivots below 1e-20 are those of dependent rows.
fn solve(mut a: Vec<Vec<Dd>>, b: &[Dd]) -> Vec<Dd> {
    let n = b.len();
    a.iter_mut().zip(b).for_each(|(row, &x)| row.push(x));
    let (mut rows, mut columns, mut found): (Vec<usize>, Vec<usize>, Vec<(usize, usize)>) =
        ((0..n).collect(), (0..n).collect(), vec![]);
    while !rows.is_empty() {
        let size = |&(i, j): &(usize, usize)| a[i][j].to_f64().abs();
        let places = rows
            .iter()
            .flat_map(|&i| columns.iter().map(move |&j| (i, j)));
        let (i, j) = places
            .max_by(|x, y| size(x).total_cmp(&size(y)))
            .expect("a place");
        if size(&(i, j)) < 1e-20 {
            break;
        }
        let pivot = a[i].clone();
        for (k, row) in a.iter_mut().enumerate() {
            let factor = row[j] / pivot[j];
            if k != i {
                row.iter_mut()
                    .zip(&pivot)
                    .for_each(|(x, &y)| *x -= factor * y);
            }
        }
        rows.retain(|&row| row != i);
        columns.retain(|&column| column != j);
        found.push((i, j));
    }
    let mut x = vec![Dd::ZERO; n];
    for (i, j) in found {
        x[j] = a[i][n] / a[i][j];
    }
    x
}

/// Compares at closed positions with random velocities and efforts.
fn compare(text: &Text, what: &str) {
    let (tree, robot) = (Robot::read(&text.open()), Robot::read(&text.closed()));
    let closure = robot.mechanism.closure().expect("loops").clone();
    assert_eq!(robot.nv() + closure.rows.len(), tree.nv(), "{what}");
    for k in 0..3 {
        let mut random = Random(40 + k as u64);
        let mut state = robot.state(k as u64);
        for p in closure.positions.iter().flatten() {
            state.q[p.0] = closure.samples[5 * k + 1][p.0];
        }
        let value = |method| -> Vec<Dd> { state.value(&robot.function(None, method)) };
        let rates = value(Method::TreeVelocity);
        let efforts: Vec<Dd> = closure
            .independents
            .iter()
            .map(|_| Dd::from_f64(20.0 * random.signed()))
            .collect();
        let mut all = vec![Dd::ZERO; tree.nv()];
        closure
            .independents
            .iter()
            .zip(&efforts)
            .for_each(|(j, &p)| all[j.0] = p);
        let of_tree = State {
            q: state.q.clone(),
            v: rates.clone(),
            a: vec![Dd::ZERO; tree.nv()],
            u: all.clone(),
        };
        // The rows, with B q̇ = 0.
        let mut b: Vec<(Vec<Dd>, Dd)> = Vec::new();
        for (l, one) in text.all.iter().enumerate() {
            let [a, other] =
                ["a", "b"].map(|end| FrameMotion::new(&tree, &format!("{end}{l}"), &of_tree));
            b.extend(rows(one, &a, &other));
        }
        for (row, _) in &b {
            let off = dot(row, &rates).to_f64().abs();
            assert!(off < 1e-24 * largest(&rates), "{what}: a rate of {off:e}");
        }
        // M q̈ − Bᵀ λ = P − h, B q̈ = γ
        let (n, m) = (tree.nv(), b.len());
        let mass = full(&of_tree.value(&tree.function(None, Method::MassMatrix)), n);
        let bias: Vec<Dd> = of_tree.value(&tree.function(None, Method::Bias));
        let mut system = vec![vec![Dd::ZERO; n + m]; n + m];
        let mut side = minus(&all, &bias);
        for i in 0..n {
            system[i][..n].copy_from_slice(&mass[i]);
        }
        for (r, (row, gamma)) in b.iter().enumerate() {
            for j in 0..n {
                system[n + r][j] = row[j];
                system[j][n + r] = -row[j];
            }
            side.push(*gamma);
        }
        let solution = solve(system, &side);
        let (accelerations, lambda) = solution.split_at(n);
        let expected: Vec<Dd> = closure
            .independents
            .iter()
            .map(|j| accelerations[j.0])
            .collect();
        let size = largest(accelerations);
        state.u = efforts.clone();
        for way in WAYS {
            let found: Vec<Dd> = state.value(&robot.function(way, Method::ForwardDynamics));
            close(
                &found,
                &expected,
                1e-22,
                size,
                &format!("{what}, {way:?}: accelerations"),
            );
            let moving = State {
                a: expected.clone(),
                ..state.clone()
            };
            let found: Vec<Dd> = moving.value(&robot.function(way, Method::InverseDynamics));
            close(
                &found,
                &efforts,
                1e-22,
                largest(&bias).max(size),
                &format!("{what}, {way:?}: efforts"),
            );
            let found: Vec<Dd> = moving.value(&robot.function(way, Method::TreeAcceleration));
            close(
                &found,
                accelerations,
                1e-22,
                size,
                &format!("{what}, {way:?}: the tree's accelerations"),
            );
            // Bᵀ λ, whatever the axes of the rows.
            let own: Vec<Dd> = moving.value(&robot.function(way, Method::Multipliers));
            let jacobian: Vec<Dd> = moving.value(&robot.function(way, Method::ConstraintJacobian));
            let own_rows: Vec<&[Dd]> = jacobian.chunks(n).collect();
            let sum = |rows: &[&[Dd]], of: &[Dd], j: usize| {
                rows.iter()
                    .zip(of)
                    .fold(Dd::ZERO, |sum, (row, &x)| sum + row[j] * x)
            };
            let other_rows: Vec<&[Dd]> = b.iter().map(|(row, _)| row.as_slice()).collect();
            let found: Vec<Dd> = (0..n).map(|j| sum(&own_rows, &own, j)).collect();
            let wanted: Vec<Dd> = (0..n).map(|j| sum(&other_rows, lambda, j)).collect();
            close(
                &found,
                &wanted,
                1e-21,
                largest(&bias).max(largest(&all)),
                &format!("{what}, {way:?}: efforts of the loops"),
            );
        }
        // M_u = Sᵀ M S
        let map: Vec<Dd> = state.value(&robot.function(None, Method::VelocityMap));
        let columns: Vec<Vec<Dd>> = (0..robot.nv())
            .map(|k| map.iter().skip(k).step_by(robot.nv()).copied().collect())
            .collect();
        let found = full(
            &state.value(&robot.function(None, Method::MassMatrix)),
            robot.nv(),
        );
        for (k, column) in columns.iter().enumerate() {
            let moved = times(&mass, column);
            let wanted: Vec<Dd> = columns.iter().map(|other| dot(other, &moved)).collect();
            close(
                &found[k],
                &wanted,
                1e-23,
                1.0,
                &format!("{what}: mass matrix"),
            );
        }
    }
}

fn noisy(random: &mut Random) -> [i64; 3] {
    let axis = [0; 3].map(|_| thousandths(random, 999));
    if axis.iter().all(|x| x.abs() < 50) {
        [0, 0, 1000]
    } else {
        axis
    }
}

#[test]
fn points_and_rods_move_as_with_multipliers() {
    for (seed, root) in ["fixed", "floating", "spherical"].into_iter().enumerate() {
        let mut random = Random(100 + seed as u64);
        let mut text = Text::new(&mut random, root, 4, noisy);
        text.connect(&mut random, "point", [4, 8], ([0, 0, 1000], [0; 3]));
        text.connect(
            &mut random,
            "distance",
            [3, 6],
            ([0, 0, 1000], [30, 40, 120]),
        );
        compare(&text, &format!("point and rod, {root}"));
    }
}

#[test]
fn hinges_sliders_welds_and_universal_joints_move_as_with_multipliers() {
    for (seed, kind) in ["hinge", "slider", "weld", "universal"]
        .into_iter()
        .enumerate()
    {
        let mut random = Random(200 + seed as u64);
        let mut text = Text::new(&mut random, "spherical", 4, noisy);
        let axis = noisy(&mut random);
        // A slider may be displaced along its axis.
        let apart = if kind == "slider" {
            axis.map(|x| x / 1000 * 100)
        } else {
            [0; 3]
        };
        text.connect(&mut random, kind, [4, 8], (axis, apart));
        compare(&text, kind);
    }
}

/// All axes parallel to one direction that is no axis of any frame: three rows of a hinge hold everywhere.
#[test]
fn planar_loops_in_any_direction_move_as_with_multipliers() {
    for (seed, root) in ["fixed", "floating"].into_iter().enumerate() {
        let mut random = Random(300 + seed as u64);
        let mut text = Text::new(&mut random, root, 3, |_| [0, 0, 1000]);
        // The slide has to lie in the plane.
        text.links = text.links.replacen(
            "type: prismatic, axis: [0.000, 0.000, 1.000]",
            "type: prismatic, axis: [0.600, 0.800, 0.000]",
            1,
        );
        text.connect(&mut random, "hinge", [3, 6], ([0, 0, 1000], [0; 3]));
        let robot = Robot::read(&text.closed());
        let closure = robot.mechanism.closure().expect("loops");
        assert_eq!((closure.rows.len(), closure.dropped.len()), (2, 3));
        compare(&text, &format!("planar, {root}"));
    }
}

/// Two loops in series: the second one needs the first one's joints, and is solved after it.
#[test]
fn loops_in_series_are_solved_one_after_the_other() {
    let mut random = Random(400);
    let mut text = Text::new(&mut random, "fixed", 4, |_| [0, 0, 1000]);
    text.links = text.links.replacen(
        "type: prismatic, axis: [0.000, 0.000, 1.000]",
        "type: prismatic, axis: [0.600, 0.800, 0.000]",
        1,
    );
    text.connect(&mut random, "hinge", [2, 5], ([0, 0, 1000], [0; 3]));
    text.connect(&mut random, "hinge", [4, 8], ([0, 0, 1000], [0; 3]));
    let robot = Robot::read(&text.closed());
    let closure = robot.mechanism.closure().expect("loops");
    assert!(closure.blocks.len() >= 2, "{:?}", closure.blocks);
    compare(&text, "in series");
}
