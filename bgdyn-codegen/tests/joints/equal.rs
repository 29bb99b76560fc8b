//! Mechanisms written in two ways are equal: another order of the links, joints of several degrees as joints
//! of one degree each.

use std::collections::HashSet;

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::robot::{Robot, State, Way, close, full, largest, times};
use super::specs::{self, reordered};

pub const WAYS: [Way; 2] = [None, Some("literal")];
const EXACT: f64 = 1e-26;

/// A state of one mechanism in the coordinates of another: its q, v' = G v, a' = G a + γ.
pub struct Mapped {
    pub q: Vec<Dd>,
    pub g: Vec<Vec<Dd>>,
    pub gamma: Vec<Dd>,
}

fn transposed(m: &[Vec<Dd>], columns: usize) -> Vec<Vec<Dd>> {
    (0..columns)
        .map(|j| m.iter().map(|row| row[j]).collect())
        .collect()
}

/// A · B
fn product(a: &[Vec<Dd>], b: &[Vec<Dd>]) -> Vec<Vec<Dd>> {
    let columns = transposed(b, b.first().map_or(0, Vec::len));
    a.iter().map(|row| times(&columns, row)).collect()
}

fn plus(x: &[Dd], y: &[Dd]) -> Vec<Dd> {
    x.iter().zip(y).map(|(&x, &y)| x + y).collect()
}

fn rows(flat: &[Dd], n: usize) -> Vec<Vec<Dd>> {
    flat.chunks(n).map(<[Dd]>::to_vec).collect()
}

/// Asserts that `one` is `other` in the coordinates that `map` relates; `places` have the same names.
/// `constant`: G does not depend on q.
pub fn same(
    (one, other): (&Robot, &Robot),
    map: impl Fn(&State<Dd>) -> Mapped,
    constant: bool,
    places: &[&str],
    name: &str,
) {
    for way in WAYS {
        for seed in [21, 22] {
            let what = |part: &str| format!("{name}, {way:?}, seed {seed}: {part}");
            let s = one.state(seed);
            let (n, m) = (one.nv(), other.nv());
            let Mapped { q, g, gamma } = map(&s);
            let back = transposed(&g, n);
            let t = State {
                q,
                v: times(&g, &s.v),
                a: plus(&times(&g, &s.a), &gamma),
                u: vec![Dd::ZERO; m],
            };
            let own = |method| s.value(&one.function(way, method));
            let theirs = |method| t.value(&other.function(way, method));
            let mass = product(&back, &product(&full(&theirs(Method::MassMatrix), m), &g)).concat();
            close(
                &full(&own(Method::MassMatrix), n).concat(),
                &mass,
                EXACT,
                0.0,
                &what("M"),
            );
            let expected = times(&back, &theirs(Method::InverseDynamics));
            let efforts = own(Method::InverseDynamics);
            close(&efforts, &expected, EXACT, 0.0, &what("τ"));
            let size = largest(&efforts);
            let expected = times(&back, &theirs(Method::Gravity));
            close(
                &own(Method::Gravity),
                &expected,
                EXACT,
                size,
                &what("gravity"),
            );
            for method in [Method::KineticEnergy, Method::PotentialEnergy] {
                close(&own(method), &theirs(method), EXACT, 1.0, &what("energy"));
            }
            let unmoved = State {
                a: gamma.clone(),
                ..t.clone()
            };
            let bias = unmoved.value(&other.function(way, Method::InverseDynamics));
            close(
                &own(Method::Bias),
                &times(&back, &bias),
                EXACT,
                size,
                &what("bias"),
            );
            // Accelerations: those of `one` solve the equations of `other`.
            let accelerations = own(Method::ForwardDynamics);
            let moved = State {
                a: plus(&times(&g, &accelerations), &gamma),
                ..t.clone()
            };
            let driven = moved.value(&other.function(way, Method::InverseDynamics));
            close(
                &times(&back, &driven),
                &s.u,
                1e-20,
                largest(&bias),
                &what("q̈"),
            );
            if constant {
                let own = own(Method::InverseDynamicsDerivatives);
                let theirs = theirs(Method::InverseDynamicsDerivatives);
                for (part, k) in [("∂τ/∂q", 0), ("∂τ/∂v", 1)] {
                    let theirs = rows(&theirs[k * m * m..(k + 1) * m * m], m);
                    let expected = product(&back, &product(&theirs, &g)).concat();
                    let found = &own[k * n * n..(k + 1) * n * n];
                    close(found, &expected, EXACT, size, &what(part));
                }
            }
            for place in places {
                let of = |robot: &Robot, s: &State<Dd>| {
                    Method::of_site(robot.site(place)).map(|m| s.value(&robot.function(way, m)))
                };
                let [pose, velocity, jacobian, rate] = of(one, &s);
                let [their_pose, their_velocity, their_jacobian, their_rate] = of(other, &t);
                let size = 1.0 + largest(&their_velocity) + largest(&their_rate);
                close(&pose, &their_pose, EXACT, size, &what(place));
                close(&velocity, &their_velocity, EXACT, size, &what(place));
                let their_jacobian = rows(&their_jacobian, m);
                let expected = product(&their_jacobian, &g).concat();
                close(&jacobian, &expected, EXACT, size, &what(place));
                let expected = plus(&their_rate, &times(&their_jacobian, &gamma));
                close(&rate, &expected, EXACT, size, &what(place));
            }
        }
    }
}

/// The map of two mechanisms with the same names of positions and velocities.
fn by_names(one: &Robot, other: &Robot) -> impl Fn(&State<Dd>) -> Mapped + use<> {
    let places = |own: Vec<String>, theirs: Vec<String>| -> Vec<usize> {
        assert_eq!(own.len(), theirs.len(), "{own:?} against {theirs:?}");
        let place = |name: &String| own.iter().position(|n| n == name);
        let found = theirs
            .iter()
            .map(|name| place(name).unwrap_or_else(|| panic!("{name}?")));
        found.collect()
    };
    let (a, b) = (&one.mechanism, &other.mechanism);
    let positions = places(a.position_names(), b.position_names());
    let velocities = places(a.joint_names(), b.joint_names());
    move |s| {
        let n = velocities.len();
        let unit = |j: usize| {
            (0..n)
                .map(|k| if k == j { Dd::ONE } else { Dd::ZERO })
                .collect()
        };
        Mapped {
            q: positions.iter().map(|&p| s.q[p]).collect(),
            g: velocities.iter().map(|&j| unit(j)).collect(),
            gamma: vec![Dd::ZERO; n],
        }
    }
}

type Tree = [(String, Option<String>)];

fn depth(tree: &Tree, i: usize) -> usize {
    let parent = |i: usize| {
        let name = tree[i].1.as_ref()?;
        tree.iter().position(|(n, _)| n == name)
    };
    std::iter::successors(parent(i), |&p| parent(p)).count()
}

/// Level by level: a subtree is not an interval.
fn breadth_first(tree: &Tree) -> Vec<usize> {
    let mut order: Vec<usize> = (0..tree.len()).collect();
    order.sort_by_key(|&i| depth(tree, i));
    order
}

/// Level by level, each level in reverse: siblings' subtrees cross.
fn crossed(tree: &Tree) -> Vec<usize> {
    let mut order: Vec<usize> = (0..tree.len()).collect();
    let side = |i: usize| {
        if depth(tree, i).is_multiple_of(2) {
            i
        } else {
            tree.len() - i
        }
    };
    order.sort_by_key(|&i| (depth(tree, i), side(i)));
    order
}

/// Children before their parents.
fn reversed(tree: &Tree) -> Vec<usize> {
    (0..tree.len()).rev().collect()
}

fn depth_first(tree: &Tree) -> Vec<usize> {
    let mut order = Vec::new();
    let mut open: Vec<usize> = (0..tree.len())
        .rev()
        .filter(|&i| tree[i].1.is_none())
        .collect();
    while let Some(i) = open.pop() {
        order.push(i);
        let children = (0..tree.len())
            .rev()
            .filter(|&c| tree[c].1.as_ref() == Some(&tree[i].0));
        open.extend(children);
    }
    order
}

/// A floating base with two arms of several degrees, beside another root.
const SPIDER: &str = "\
format: 1
name: spider
gravity: [0.3, -0.8, -9.7]
links:
  - name: trunk
    joint: { name: free, type: floating, origin: { xyz: [0.1, 0.2, 0.3], rpy: [0.4, 0.5, -0.2] } }
    mass: 3
    com: [0.02, -0.03, 0.04]
    inertia: { xx: 0.1, yy: 0.12, zz: 0.15, xy: 0.01, xz: -0.02, yz: 0.005 }
  - name: hip_a
    parent: trunk
    joint: { name: ball_a, type: spherical, origin: { xyz: [0.2, 0.1, 0], rpy: [0, 0.3, 0.2] } }
    mass: 0.8
    com: [0.1, 0.02, 0.01]
    inertia: { xx: 0.004, yy: 0.01, zz: 0.009, xy: 0.0005 }
  - name: foot_a
    parent: hip_a
    joint: { name: knee_a, type: universal, axis: x, axis2: [1, 2, 0], origin: { xyz: [0.2, 0, 0.1] } }
    mass: 0.4
    com: [0.08, 0.01, -0.02]
    inertia: { xx: 0.001, yy: 0.003, zz: 0.0025, xz: 0.0002 }
  - name: hip_b
    parent: trunk
    joint: { name: screw_b, type: helical, axis: [0, 1, 1], lead: 30 mm, origin: { xyz: [-0.2, 0.1, 0.05] } }
    mass: 0.7
    com: [0.02, 0.1, 0.03]
    inertia: { xx: 0.006, yy: 0.003, zz: 0.007, yz: 0.0004 }
  - name: foot_b
    parent: hip_b
    joint: { name: slab_b, type: planar, origin: { xyz: [0.1, 0.2, 0], rpy: [0.5, 0, 0.3] } }
    mass: 0.5
    com: [0.03, 0.04, 0.02]
    inertia: { xx: 0.002, yy: 0.0022, zz: 0.003, xy: 0.0003 }
";

/// Compares all orders of the links of a mechanism with the one that goes depth first.
fn in_any_order(name: &str, text: &str, places: &[&str]) {
    let first = Robot::read(&reordered(text, depth_first));
    let mut different = 0;
    for (order, arranged) in [
        ("breadth first", breadth_first as fn(&Tree) -> Vec<usize>),
        ("crossed", crossed),
        ("reversed", reversed),
    ] {
        let other = Robot::read(&reordered(text, arranged));
        different += usize::from(other.mechanism.joint_names() != first.mechanism.joint_names());
        let map = by_names(&first, &other);
        same(
            (&first, &other),
            &map,
            true,
            places,
            &format!("{name}, {order}"),
        );
        coriolis(&first, &other, &format!("{name}, {order}"));
    }
    assert!(different >= 2, "{name}: {different} orders differ");
}

#[test]
fn the_order_of_links_does_not_matter() {
    in_any_order("spider", SPIDER, &["foot_a", "foot_b"]);
}

#[test]
fn the_order_of_followers_does_not_matter() {
    in_any_order("loops", specs::LOOPS, &["whirl", "rider"]);
}

#[test]
fn the_order_of_legs_does_not_matter() {
    let text = super::robot::golden_text("anymal_floating.yaml");
    in_any_order("anymal_floating", &text, &["l_rf_kfe"]);
}

#[test]
fn the_order_of_all_types_does_not_matter() {
    let text = super::robot::golden_text("helical_universal_test.yaml");
    let places = ["ball_tip", "gondola_floor", "buoy"];
    in_any_order("helical_universal_test", &text, &places);
}

/// C of two orders is the same matrix, permuted.
fn coriolis(one: &Robot, other: &Robot, name: &str) {
    let s = one.state(23);
    let Mapped { q, g, gamma } = by_names(one, other)(&s);
    let t = State {
        q,
        v: times(&g, &s.v),
        a: gamma.clone(),
        u: gamma,
    };
    let n = one.nv();
    let theirs = t.value(&other.function(None, Method::CoriolisMatrix));
    let expected = product(&transposed(&g, n), &product(&rows(&theirs, n), &g)).concat();
    let found = s.value(&one.function(None, Method::CoriolisMatrix));
    close(&found, &expected, EXACT, 0.0, name);
}

#[test]
fn the_orders_of_the_test_are_not_depth_first() {
    let tree: Vec<(String, Option<String>)> = ["a", "b", "c", "d", "e"]
        .iter()
        .zip([None, Some("a"), Some("b"), Some("a"), Some("d")])
        .map(|(name, parent)| (name.to_string(), parent.map(str::to_owned)))
        .collect();
    assert_eq!(depth_first(&tree), [0, 1, 2, 3, 4]);
    assert_eq!(breadth_first(&tree), [0, 1, 3, 2, 4]);
    let orders: HashSet<Vec<usize>> = [crossed(&tree), reversed(&tree)].into();
    assert_eq!(orders.len(), 2);
}

const BEYOND: &str = "
  - name: tool
    parent: link
    joint: { name: twist, type: revolute, axis: [1, 0, 3], origin: { xyz: [0.2, 0.1, -0.1], rpy: [0.3, 0.2, 0.1] } }
    mass: 0.5
    com: [0.1, 0.05, 0.02]
    inertia: { xx: 0.002, yy: 0.004, zz: 0.003, xy: 0.0004, xz: 0.0001, yz: -0.0002 }
";
const BODY: &str = "
    mass: 1.4
    com: [0.1, -0.04, 0.06]
    inertia: { xx: 0.03, yy: 0.04, zz: 0.05, xy: 0.002, xz: -0.003, yz: 0.004 }";
const ORIGIN: &str = "origin: { xyz: [0.3, 0.2, -0.1], rpy: [0.7, -0.4, 1.3] }";

/// A mechanism of a swing, these links between it and `link`, and a tool.
fn between(links: &str) -> Robot {
    Robot::read(&format!(
        "format: 1\nname: pair\ngravity: [2, -3, -9]\nlinks:\n  - name: swing\n    joint: {{ name: sway, type: revolute, \
         axis: [1, 2, 0] }}\n    mass: 2\n    com: [0.1, 0.2, 0.1]\n    inertia: {{ xx: 0.1, yy: 0.1, zz: 0.1 }}\n{links}{BEYOND}"
    ))
}

#[test]
fn universal_is_two_turns() {
    for (axis, axis2) in [
        ("x", "y"),
        ("[1, 0.2, 0]", "[0.3, 1, 0.5]"),
        ("[0, 0, -1]", "[1, 0, 1]"),
        // Almost parallel.
        ("z", "[0.001, 0, 1]"),
    ] {
        let one = between(&format!(
            "  - name: link\n    parent: swing\n    joint: {{ name: u, type: universal, axis: {axis}, axis2: {axis2}, {ORIGIN} }}{BODY}"
        ));
        let other = between(&format!(
            "  - name: cross\n    parent: swing\n    joint: {{ name: u_first, type: revolute, axis: {axis}, {ORIGIN} }}\n  \
             - name: link\n    parent: cross\n    joint: {{ name: u_second, type: revolute, axis: {axis2} }}{BODY}"
        ));
        let map = by_names(&one, &other);
        same(
            (&one, &other),
            map,
            true,
            &["link", "tool"],
            &format!("universal {axis}, {axis2}"),
        );
    }
}

#[test]
fn cylindrical_is_a_turn_and_a_slide() {
    for axis in ["-x", "[1, 2, -2]"] {
        let one = between(&format!(
            "  - name: link\n    parent: swing\n    joint: {{ name: c, type: cylindrical, axis: {axis}, {ORIGIN} }}{BODY}"
        ));
        let turn_first = format!(
            "  - name: sleeve\n    parent: swing\n    joint: {{ name: c_turn, type: revolute, axis: {axis}, {ORIGIN} }}\n  \
             - name: link\n    parent: sleeve\n    joint: {{ name: c_slide, type: prismatic, axis: {axis} }}{BODY}"
        );
        // About and along one axis: the order of the two does not matter.
        let slide_first = format!(
            "  - name: sleeve\n    parent: swing\n    joint: {{ name: c_slide, type: prismatic, axis: {axis}, {ORIGIN} }}\n  \
             - name: link\n    parent: sleeve\n    joint: {{ name: c_turn, type: revolute, axis: {axis} }}{BODY}"
        );
        for links in [turn_first, slide_first] {
            let other = between(&links);
            let map = by_names(&one, &other);
            same(
                (&one, &other),
                map,
                true,
                &["link", "tool"],
                &format!("cylindrical {axis}"),
            );
        }
    }
}

#[test]
fn helical_is_a_turn_with_a_slide_that_mimics_it() {
    for (lead, ratio) in [("250 mm", "250 mm/turn"), ("-0.03 m/rad", "-30 mm/rad")] {
        let one = between(&format!(
            "  - name: link\n    parent: swing\n    joint: {{ name: h, type: helical, axis: [2, 1, -2], lead: {lead}, {ORIGIN} }}{BODY}"
        ));
        let other = between(&format!(
            "  - name: sleeve\n    parent: swing\n    joint: {{ name: h, type: revolute, axis: [2, 1, -2], {ORIGIN} }}\n  \
             - name: link\n    parent: sleeve\n    joint: {{ name: travel, type: prismatic, axis: [2, 1, -2], \
             mimic: {{ joint: h, ratio: {ratio} }} }}{BODY}"
        ));
        let map = by_names(&one, &other);
        same(
            (&one, &other),
            map,
            true,
            &["link", "tool"],
            &format!("helical {lead}"),
        );
    }
}

/// v of the planar joint is in link axes: v' = N v, and γ = Ṅ v.
#[test]
fn planar_is_two_slides_and_a_turn() {
    let one = between(&format!(
        "  - name: link\n    parent: swing\n    joint: {{ name: p, type: planar, {ORIGIN} }}{BODY}"
    ));
    let other = between(&format!(
        "  - name: cross\n    parent: swing\n    joint: {{ name: p_x, type: prismatic, axis: x, {ORIGIN} }}\n  \
         - name: table\n    parent: cross\n    joint: {{ name: p_y, type: prismatic, axis: y }}\n  \
         - name: link\n    parent: table\n    joint: {{ name: p_turn, type: revolute, axis: z }}{BODY}"
    ));
    assert_eq!(one.mechanism.joint_names(), other.mechanism.joint_names());
    let at = one
        .mechanism
        .joint_names()
        .iter()
        .position(|n| n == "p_x")
        .expect("p_x");
    let map = |s: &State<Dd>| {
        let identity = by_names(&one, &other)(s);
        let (sin, cos) = s.q[at + 2].sin_cos();
        let Mapped {
            q,
            mut g,
            mut gamma,
        } = identity;
        g[at][at] = cos;
        g[at][at + 1] = -sin;
        g[at + 1][at] = sin;
        g[at + 1][at + 1] = cos;
        let (x, y, turn) = (s.v[at], s.v[at + 1], s.v[at + 2]);
        gamma[at] = -(sin * x + cos * y) * turn;
        gamma[at + 1] = (cos * x - sin * y) * turn;
        Mapped { q, g, gamma }
    };
    same((&one, &other), map, false, &["link", "tool"], "planar");
}

/// Three turns make the rotation of a quaternion; ω in link axes is linear in their rates.
#[test]
fn spherical_is_three_turns() {
    let one = between(&format!(
        "  - name: link\n    parent: swing\n    joint: {{ name: b, type: spherical, {ORIGIN} }}{BODY}"
    ));
    let other = between(&format!(
        "  - name: yaw_link\n    parent: swing\n    joint: {{ name: yaw, type: revolute, axis: z, {ORIGIN} }}\n  \
         - name: pitch_link\n    parent: yaw_link\n    joint: {{ name: pitch, type: revolute, axis: y }}\n  \
         - name: link\n    parent: pitch_link\n    joint: {{ name: roll, type: revolute, axis: x }}{BODY}"
    ));
    let half = Dd::from_f64(0.5);
    for (way, seed) in WAYS
        .into_iter()
        .flat_map(|way| [31, 32].map(|seed| (way, seed)))
    {
        let mut t = other.state(seed);
        let [yaw, pitch, roll] = [t.q[1], t.q[2], t.q[3]];
        let ((sy, cy), (sp, cp), (sr, cr)) = (
            (yaw * half).sin_cos(),
            (pitch * half).sin_cos(),
            (roll * half).sin_cos(),
        );
        let quaternion = [
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy,
        ];
        let ((sp, cp), (sr, cr)) = (pitch.sin_cos(), roll.sin_cos());
        // ω = E (yaw rate, pitch rate, roll rate), in link axes.
        let e = [
            [-sp, Dd::ZERO, Dd::ONE],
            [sr * cp, cr, Dd::ZERO],
            [cr * cp, -sr, Dd::ZERO],
        ];
        let (r, p) = (t.v[3], t.v[2]);
        let e_dot = [
            [-cp * p, Dd::ZERO, Dd::ZERO],
            [cr * cp * r - sr * sp * p, -sr * r, Dd::ZERO],
            [-sr * cp * r - cr * sp * p, -cr * r, Dd::ZERO],
        ];
        let of = |m: &[[Dd; 3]; 3], x: &[Dd]| m.map(|row| super::robot::dot(&row, x));
        let turning = of(&e, &t.v[1..4]);
        let (first, second) = (of(&e, &t.a[1..4]), of(&e_dot, &t.v[1..4]));
        let accelerating: [Dd; 3] = std::array::from_fn(|i| first[i] + second[i]);
        t.u = vec![Dd::ZERO; 5];
        let joined = |three: &[Dd], of: &[Dd]| [&of[..1], three, &of[4..]].concat();
        let s = State {
            q: joined(&quaternion, &t.q),
            v: joined(&turning, &t.v),
            a: joined(&accelerating, &t.a),
            u: vec![Dd::ZERO; 5],
        };
        let own = s.value(&one.function(way, Method::InverseDynamics));
        let theirs = t.value(&other.function(way, Method::InverseDynamics));
        // τ' = Eᵀ τ for the three.
        let back: Vec<Dd> = (0..3)
            .map(|j| super::robot::dot(&[e[0][j], e[1][j], e[2][j]], &own[1..4]))
            .collect();
        close(
            &joined(&back, &own),
            &theirs,
            EXACT,
            0.0,
            "spherical by three turns",
        );
    }
}
