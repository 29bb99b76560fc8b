//! Contacts of mechanisms with loops, wheels and joints that follow: the power of their forces is that of their energies,
//! so that gap, velocities and efforts belong together.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::random::Random;
use bgdyn_runtime::Dd;

use super::common::scene;

const FOUR_BAR: &str = "
format: 1
links:
  - { name: crank, mass: 1, com: [0.05, 0, 0], joint: { name: crank, type: revolute, axis: z } }
  - { name: coupler, parent: crank, mass: 1, com: [0.2, 0, 0], joint: { name: knee, type: revolute, axis: z, origin: { xyz: [0.1, 0, 0] } } }
  - { name: rocker, mass: 1, com: [0.15, 0, 0], joint: { name: rocker, type: revolute, axis: z, origin: { xyz: [0.4, 0, 0] } } }
  - { name: hand, parent: rocker, mass: 1, com: [0.1, 0, 0.1], joint: { name: wrist, type: revolute, axis: y, origin: { xyz: [0.3, 0, 0] } } }
loops:
  - { name: pin, type: hinge, a: { link: coupler, origin: { xyz: [0.4, 0, 0] } }, b: { link: rocker, origin: { xyz: [0.3, 0, 0] } }, branch: left }
planes:
  wall: { normal: [1, 0.2, -0.1], offset: 2 m }
  table: { link: crank, normal: [0.1, -1, 0.3], offset: 2 m }
contacts:
  middle: { link: coupler, at: [0.2, 0.05, 0], radius: 20 mm, on: wall }
  nail: { link: hand, at: [0.2, 0, 0.1], on: table }
  knock: { link: hand, at: [0.1, 0, 0], radius: 0.8, with: coupler, with_at: [0.1, 0, 0], with_radius: 0.7 }
";

const CART: &str = "
format: 1
links:
  - { name: cart, mass: 10, com: [0.06, 0, 0], joint: { name: base, type: planar, origin: { xyz: [0, 0, 100 mm] } }, inertia: { xx: 0.3, yy: 0.3, zz: 0.4 } }
  - { name: right_wheel, parent: cart, mass: 0.5, joint: { name: right, type: continuous, axis: y, origin: { xyz: [0, -250 mm, 0] } }, inertia: { xx: 0.003, yy: 0.005, zz: 0.003 } }
  - { name: left_wheel, parent: cart, mass: 0.5, joint: { name: left, type: continuous, axis: y, origin: { xyz: [0, 250 mm, 0] } }, inertia: { xx: 0.003, yy: 0.005, zz: 0.003 } }
constraints:
  right_contact: { type: rolling, link: right_wheel, axis: y, radius: 100 mm }
  left_contact: { type: rolling, link: left_wheel, axis: y, radius: 100 mm, rows: [longitudinal] }
independent: [right, left]
planes:
  wall: { normal: [1, 0.2, 0], offset: 30 m }
contacts:
  bumper: { link: cart, size: [0.6, 0.4, 0.1], on: wall }
  hub: { link: left_wheel, at: [0.02, 0.05, 0.03], radius: 30 mm, on: wall }
";

const FOLLOWERS: &str = "
format: 1
links:
  - { name: arm, mass: 1, com: [0.1, 0, 0.05], joint: { name: lift, type: revolute, axis: y } }
  - { name: left, parent: arm, mass: 0.2, com: [0.02, 0, 0], joint: { name: grip, type: prismatic, axis: y, origin: { xyz: [0.3, 0, 0] } } }
  - { name: right, parent: arm, mass: 0.2, com: [0.02, 0, 0], joint: { name: other, type: prismatic, axis: -y, origin: { xyz: [0.3, 0, 0] }, mimic: { joint: grip, ratio: 1.5 } } }
planes:
  wall: { normal: [1, 0.2, -0.1], offset: 2 m }
contacts:
  tip: { link: right, at: [0.1, 0, 0.02], radius: 20 mm, on: wall }
  pads: { link: left, radius: 0.8, with: right, with_radius: 0.9 }
";

/// Asserts that power adds up in states with these positions and random velocities, and that every contact takes a part.
/// `planes` are contacts with planes, `spheres` those of two spheres.
fn power_adds_up(
    (mechanism, planes, spheres): (&str, &str, Option<&str>),
    positions: impl Fn(&mut Random, usize) -> Vec<Dd>,
) {
    const LAW: &str = "type: compliant_contact, stiffness: 40, damping: 0.2, kinetic: 0.3, static: 0.4, stribeck_speed: 0.5";
    for law in [
        "width: 0.1",
        "bristles: 3, bristle_damping: 0.1, release: 0.01",
    ] {
        let mut text = format!(
            "scene: 1\nmechanism: m.yaml\neffects:\n  - gravity\n  - inertia\n  - velocity_products\n  - touch: {{ {LAW}, contacts: [{planes}], {law} }}\n"
        );
        if let Some(contact) = spheres {
            text += &format!("  - touch_round: {{ {LAW}, contact: {contact}, width: 0.2 }}\n");
        }
        let system = scene(&text, mechanism);
        let power = system.function(SceneFunction::Power);
        let layout = &system.scene.layout;
        let mut random = Random(7);
        for _ in 0..5 {
            let mut numbers =
                |n: usize| -> Vec<Dd> { (0..n).map(|_| Dd::from_f64(random.signed())).collect() };
            let (v, x, u) = (
                numbers(layout.nv()),
                numbers(layout.nx()),
                numbers(layout.inputs.len()),
            );
            let q = positions(&mut random, layout.nq());
            let inputs = Inputs {
                q,
                v,
                a: vec![],
                x,
                u,
                modes: vec![],
                parameters: vec![],
                t: Some(Dd::ZERO),
                passed: vec![],
            };
            let (values, refused) = power.evaluate(inputs);
            assert!(refused.is_none());
            let (mut sum, mut largest) = (Dd::ZERO, 1e-30_f64);
            for (entry, named) in values.chunks(3).zip(&system.entries) {
                sum = sum + entry[0] - entry[1] - entry[2];
                let size = entry.iter().map(|x| x.to_f64().abs());
                let size = size.fold(0.0, f64::max);
                assert!(size > 0.0 || !named.name.starts_with("touch"), "{named:?}");
                largest = largest.max(size);
            }
            assert!(
                sum.to_f64().abs() < 1e-20 * largest,
                "{law}: {sum:?} of {largest}"
            );
        }
    }
}

/// Returns closed positions of the mechanism.
fn closed(mechanism: &str) -> Vec<Vec<Dd>> {
    let (read, _) = bgdyn_codegen::read(mechanism, Some("m"));
    let machine = read.expect("a sound mechanism");
    let closure = machine.closure().expect("loops or wheels");
    closure.samples.clone()
}

fn one_of(samples: &[Vec<Dd>], random: &mut Random) -> Vec<Dd> {
    let k = (random.signed().abs() * samples.len() as f64) as usize;
    samples[k.min(samples.len() - 1)].clone()
}

#[test]
fn power_adds_up_with_loops() {
    let samples = closed(FOUR_BAR);
    power_adds_up((FOUR_BAR, "middle, nail", Some("knock")), |random, _| {
        one_of(&samples, random)
    });
}

#[test]
fn power_adds_up_with_wheels() {
    let samples = closed(CART);
    power_adds_up((CART, "bumper, hub", None), |random, _| {
        one_of(&samples, random)
    });
}

#[test]
fn power_adds_up_with_joints_that_follow() {
    power_adds_up((FOLLOWERS, "tip", Some("pads")), |random, n| {
        (0..n)
            .map(|_| Dd::from_f64(0.1 * random.signed()))
            .collect()
    });
}
