//! Mechanisms of the tests beside the golden ones.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::robot::{Robot, golden_text};

/// The golden mechanisms.
pub const GOLDEN: [&str; 7] = [
    "quadrotor_arm",
    "satellite_arm6",
    "anymal_floating",
    "spherical_chain3",
    "planar_base_ur5",
    "helical_universal_test",
    "mimic_gripper",
];

/// Every joint type once, with skew axes, general tensors, a gravity along no axis, and a follower.
pub const ZOO: &str = "\
format: 1
name: zoo
gravity: [1.3, -2.1, -9.3]
links:
  - name: sledge
    joint: { name: drive, type: planar, origin: { xyz: [0.2, -0.1, 0.4], rpy: [0.4, -0.7, 1.1] } }
    mass: 5
    com: [0.1, 0.04, -0.02]
    inertia: { xx: 0.2, yy: 0.25, zz: 0.3, xy: 0.01, xz: -0.02, yz: 0.03 }
  - name: nut
    parent: sledge
    joint: { name: feed, type: helical, axis: [2, -1, 2], lead: -70 mm, origin: { xyz: [0.3, 0.1, 0.2], rpy: [0.2, 0.5, -0.3] } }
    mass: 1.1
    com: [0.02, 0.05, 0.07]
    inertia: { xx: 0.02, yy: 0.015, zz: 0.025, xy: 0.001, xz: 0.002, yz: -0.003 }
  - name: bob
    parent: nut
    joint: { name: ball, type: spherical, origin: { xyz: [0.1, -0.2, 0.3], rpy: [0.6, 0.1, -0.4] } }
    mass: 0.7
    com: [0.1, 0.03, -0.3]
    inertia: { xx: 0.03, yy: 0.028, zz: 0.01, xy: 0.002, xz: -0.001, yz: 0.003 }
  - name: flag
    parent: bob
    joint: { name: wave, type: continuous, axis: [0, 0.6, 0.8], origin: { xyz: [0, 0.1, -0.2] }, mimic: { joint: feed, ratio: -1.7, offset: 0.3 } }
    mass: 0.3
    com: [0.2, 0.01, 0.05]
    inertia: { xx: 0.002, yy: 0.006, zz: 0.007, xz: 0.0004 }
";

/// As [`ZOO`], with the remaining types.
pub const TOWER: &str = "\
format: 1
name: tower
gravity: [-0.7, 0.4, -9.6]
links:
  - name: quill
    joint: { name: post, type: cylindrical, axis: [1, 2, 5], origin: { xyz: [0.2, 0.3, 0.1], rpy: [0.3, -0.2, 0.7] } }
    mass: 2
    com: [0.1, 0.06, 0.2]
    inertia: { xx: 0.05, yy: 0.06, zz: 0.04, xy: 0.003, xz: -0.002, yz: 0.004 }
  - name: yoke
    parent: quill
    joint: { name: hooke, type: universal, axis: [3, 1, 0], axis2: [-1, 2, 0.5], origin: { xyz: [0.2, 0, 0.3], rpy: [0, 0.4, 0.2] } }
    mass: 0.9
    com: [0.02, 0.1, 0.2]
    inertia: { xx: 0.02, yy: 0.018, zz: 0.01, xy: 0.001, xz: 0.002, yz: -0.001 }
  - name: kite
    parent: yoke
    joint: { name: free, type: floating, origin: { xyz: [0.5, -0.2, 0.1], rpy: [0.2, 0.3, -0.8] } }
    mass: 0.8
    com: [0.01, 0.03, -0.02]
    inertia: { xx: 0.01, yy: 0.012, zz: 0.02, xy: 0.001, xz: -0.002, yz: 0.0015 }
";

/// Followers that hurt: one inboard of its leader, across branches, before its leader in the file, a chain
/// of three in reverse order, a screw behind a slide, a slide behind a screw.
pub const LOOPS: &str = "\
format: 1
name: loops
gravity: [0.5, -1.5, -9.4]
links:
  - name: third
    parent: second
    joint: { name: bend_third, type: revolute, axis: [1, 0, 1], origin: { xyz: [0.2, 0.01, 0] }, mimic: { joint: bend_second, ratio: -1.5, offset: 20 deg } }
    mass: 0.3
    com: [0.1, 0.02, 0.01]
    inertia: { xx: 0.001, yy: 0.002, zz: 0.0021, xy: 0.0001 }
  - name: second
    parent: first
    joint: { name: bend_second, type: revolute, axis: y, origin: { xyz: [0.3, 0, 0.02] }, mimic: { joint: bend, ratio: 0.8, offset: -0.1 } }
    mass: 0.5
    com: [0.12, 0.01, -0.02]
    inertia: { xx: 0.002, yy: 0.004, zz: 0.0045, xz: 0.0003 }
  - name: lift
    joint: { name: rise, type: prismatic, axis: [0, 1, 3], mimic: { joint: bend, ratio: 30 mm/rad, offset: -2 cm } }
    mass: 2.5
    com: [0.03, 0.02, 0.1]
    inertia: { xx: 0.03, yy: 0.04, zz: 0.02, yz: 0.002 }
  - name: first
    parent: lift
    joint: { name: bend, type: revolute, axis: [0.2, 1, 0], origin: { xyz: [0.1, 0, 0.4], rpy: [0.3, 0, 0.5] } }
    mass: 0.9
    com: [0.15, -0.02, 0.03]
    inertia: { xx: 0.004, yy: 0.011, zz: 0.012, xy: 0.0006 }
  - name: ram
    parent: lift
    joint: { name: push, type: prismatic, axis: [1, 0, -1], origin: { xyz: [-0.2, 0.1, 0], rpy: [0, 0.2, 0] } }
    mass: 0.6
    com: [0.05, 0.02, 0.04]
    inertia: { xx: 0.002, yy: 0.003, zz: 0.0025 }
  - name: whirl
    parent: third
    joint: { name: drill, type: helical, axis: [1, 1, 0], lead: 40 mm, origin: { xyz: [0.1, 0.05, 0] }, mimic: { joint: push, ratio: -12 rad/m, offset: 0.4 } }
    mass: 0.2
    com: [0.03, 0.04, 0.01]
    inertia: { xx: 0.0004, yy: 0.0005, zz: 0.0006, xy: 0.00003 }
  - name: worm
    joint: { name: spin, type: helical, axis: -z, lead: 3 mm/rad, origin: { xyz: [1, 0, 0] } }
    mass: 0.4
    com: [0.02, 0.01, 0.03]
    inertia: { xx: 0.0007, yy: 0.0008, zz: 0.0009 }
  - name: rider
    parent: ram
    joint: { name: ride, type: prismatic, axis: y, mimic: { joint: spin, ratio: -0.5 mm/rad, offset: 3 mm } }
    mass: 0.25
    com: [0.02, 0.03, 0.01]
    inertia: { xx: 0.0003, yy: 0.0002, zz: 0.0004 }
";

/// Returns every mechanism by name. Each call starts with another one: tests that run side by side would otherwise
/// wait for the same functions.
pub fn all() -> Vec<(&'static str, String)> {
    static CALLS: AtomicUsize = AtomicUsize::new(0);
    let mut specs: Vec<(&str, String)> = GOLDEN
        .iter()
        .map(|&name| (name, golden_text(&format!("{name}.yaml"))))
        .collect();
    specs.push(("zoo", ZOO.into()));
    specs.push(("tower", TOWER.into()));
    specs.push(("loops", LOOPS.into()));
    let first = 3 * CALLS.fetch_add(1, Ordering::Relaxed) % specs.len();
    specs.rotate_left(first);
    specs
}

/// Returns the mechanisms for which tests of every method are fast.
pub fn robots() -> Vec<(&'static str, Robot)> {
    let all = all().into_iter();
    all.map(|(name, text)| (name, Robot::read(&text))).collect()
}

/// Returns a spec with its links in another order; `order` gets the names and parents.
pub fn reordered(text: &str, order: impl Fn(&[(String, Option<String>)]) -> Vec<usize>) -> String {
    let (head, rest) = text.split_once("links:\n").expect("links");
    let (links, tail) = match rest.find("frames:\n") {
        Some(at) => rest.split_at(at),
        None => (rest, ""),
    };
    let blocks: Vec<String> = links
        .split("  - name: ")
        .skip(1)
        .map(|block| format!("  - name: {block}"))
        .collect();
    let of = |block: &String| {
        let value = |key: &str| {
            let line = block
                .lines()
                .find_map(|line| line.trim_start().strip_prefix(key));
            line.map(|value| value.trim().to_owned())
        };
        (value("- name:").expect("a name"), value("parent:"))
    };
    let tree: Vec<(String, Option<String>)> = blocks.iter().map(of).collect();
    let order = order(&tree);
    let mut seen = order.clone();
    seen.sort_unstable();
    assert_eq!(seen, (0..blocks.len()).collect::<Vec<_>>(), "a permutation");
    let links: String = order.iter().map(|&i| blocks[i].as_str()).collect();
    format!("{head}links:\n{links}{tail}")
}
