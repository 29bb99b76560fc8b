//! The functions of rigid contacts pass: in trees, with joints of several degrees, loops and wheels; with an error they do
//! not.

use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::{Method, SceneFunction};
use bgdyn_codegen::read_scene;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::verify::{check_scene, explain};

use super::{files, scene, text};

const ROLES: [SceneFunction; 3] = [
    SceneFunction::RigidContactStates,
    SceneFunction::RigidContactMaps,
    SceneFunction::RigidContactBiases,
];

fn functions(system: &SceneEquations) -> Vec<Function> {
    ROLES.map(|role| system.function(role)).into()
}

#[test]
fn every_scene_with_rigid_contacts_passes() {
    let mut passed = 0;
    let ending = ".scene.yaml";
    for path in files("specs/contact", ending)
        .iter()
        .chain(&files("tests/rigid_contact", ending))
    {
        let load = |mechanism: &str| Ok(text(&beside(path, mechanism)));
        let (system, _) = read_scene(&text(path), &stem(path), load).expect("a scene");
        if system.scene.layout.rigid_contacts.is_empty() {
            continue;
        }
        assert!(ROLES.iter().all(|role| system.roles().contains(role)));
        let found = check_scene(&system, &functions(&system));
        assert!(found.is_empty(), "{}: {}", path.display(), explain(&found));
        passed += 1;
    }
    assert!(passed >= 16, "{passed}");
}

const FOUR_BAR: &str = "\
format: 1
links:
  - { name: crank, mass: 1, com: [0.05, 0, 0], joint: { name: crank, type: revolute, axis: z } }
  - { name: coupler, parent: crank, mass: 1, com: [0.2, 0, 0], joint: { name: knee, type: revolute, axis: z, origin: { xyz: [0.1, 0, 0] } } }
  - { name: rocker, mass: 1, com: [0.15, 0, 0], joint: { name: rocker, type: revolute, axis: z, origin: { xyz: [0.4, 0, 0] } } }
  - { name: hand, parent: rocker, mass: 1, com: [0.1, 0, 0.1], joint: { name: wrist, type: revolute, axis: y, origin: { xyz: [0.3, 0, 0] } } }
loops:
  - { name: pin, type: hinge, a: { link: coupler, origin: { xyz: [0.4, 0, 0] } }, b: { link: rocker, origin: { xyz: [0.3, 0, 0] } }, branch: left }
planes:
  wall: { normal: [1, 0.2, 0.3], offset: -2 m }
contacts:
  nail: { link: hand, at: [0.2, 0, 0.02], radius: 10 mm, on: wall }
  pearl: { link: hand, at: [0.4, 0, 0.3], radius: 20 mm, with: crank, with_at: [0.1, 0, 0], with_radius: 30 mm }
";

const ROBOT: &str = "\
format: 1
links:
  - { name: cart, mass: 10, inertia: { xx: 0.3, yy: 0.3, zz: 0.395 }, joint: { name: base, type: planar, origin: { xyz: [0, 0, 0.1] } } }
  - { name: right_wheel, parent: cart, mass: 1, inertia: { solid: box, size: [0.2, 0.05, 0.2] }, joint: { name: right, type: continuous, axis: y, origin: { xyz: [0, -0.25, 0] } } }
  - { name: left_wheel, parent: cart, mass: 1, inertia: { solid: box, size: [0.2, 0.05, 0.2] }, joint: { name: left, type: continuous, axis: y, origin: { xyz: [0, 0.25, 0] } } }
  - { name: arm, parent: cart, mass: 1, com: [0.2, 0, 0], inertia: { solid: box, size: [0.4, 0.1, 0.1] }, joint: { name: shoulder, type: spherical, origin: { xyz: [0.2, 0, 0.3] } } }
constraints:
  right_contact: { type: rolling, link: right_wheel, axis: y, radius: 0.1 }
  left_contact: { type: rolling, link: left_wheel, axis: y, radius: 0.1, rows: [longitudinal] }
independent: [right, left]
planes:
  wall: { normal: -x, offset: -3 m }
contacts:
  bumper: { link: cart, at: [0.3, 0.1, 0], radius: 10 mm, on: wall }
  fist: { link: arm, at: [0.4, 0, 0], radius: 50 mm, on: wall }
";

/// Returns the scene of a mechanism whose contacts are all rigid.
fn rigid(mechanism: &str) -> SceneEquations {
    let effects = "[inertia, velocity_products, gravity, touch: { type: rigid_contact, contacts: all, friction: 0.5 }]";
    scene(
        &format!("scene: 1\nmechanism: m.yaml\neffects: {effects}\n"),
        mechanism,
    )
}

#[test]
fn loops_and_wheels_pass() {
    for mechanism in [FOUR_BAR, ROBOT] {
        let system = rigid(mechanism);
        let found = check_scene(&system, &functions(&system));
        assert!(found.is_empty(), "{}", explain(&found));
    }
}

/// Each number of the biases that is not constant, with its sign changed.
#[test]
fn a_turned_sign_is_found_in_every_bias() {
    for mechanism in [FOUR_BAR, ROBOT] {
        let system = rigid(mechanism);
        let right = functions(&system);
        let role = Method::Scene(SceneFunction::RigidContactBiases);
        let at = right.iter().position(|f| f.method == role);
        let at = at.expect("generated");
        let outputs = &right[at].blocks.last().expect("a block").outputs;
        let varying = |k: &usize| right[at].graph.constant_of(outputs[*k]).is_none();
        let varying: Vec<usize> = (0..outputs.len()).filter(varying).collect();
        assert!(varying.len() >= 4, "{varying:?} of {}", outputs.len());
        for k in varying {
            let mut wrong = right.clone();
            let outputs = &mut wrong[at].blocks.last_mut().expect("a block").outputs;
            outputs[k].negative = !outputs[k].negative;
            let found = check_scene(&system, &wrong);
            assert_eq!(found.len(), 1, "{k}: {found:?}");
            assert_eq!(found[0].function, "rigid_contact_biases");
        }
    }
}
