//! The order of the links in a file does not matter.

use std::collections::HashSet;

use bgdyn_codegen::method::Method;

use super::robot::{Robot, State, close, times};
use super::specs::{self, reordered};

use super::same_motion::*;

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
