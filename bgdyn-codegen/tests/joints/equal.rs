//! Joints of several degrees against the same mechanism with plain joints.

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::robot::{Robot, State, close};

use super::same_motion::*;

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
