//! Axes that are almost along an axis of a parent without an axis of its own: the origin of the joint must
//! not move to a far point, where inertia about it has no digits left.

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::robot::{Robot, Way, largest};

/// How far the axis is from z.
const OFF: [f64; 6] = [1e-15, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3];

const RECURSIONS: [Way; 4] = [
    None,
    Some("recursion"),
    Some("recursion_own"),
    Some("articulated_base"),
];

/// An arm on a base with several velocities.
fn arm(base: &str, off: f64) -> String {
    format!(
        "\
format: 1
name: arm
snap: 0
links:
  - name: base
    joint: {{ name: free, type: {base} }}
    mass: 3
    com: [0.02, -0.01, 0.03]
    inertia: {{ xx: 0.04, yy: 0.05, zz: 0.06, xy: 0.001 }}
  - name: upper
    parent: base
    joint: {{ name: shoulder, type: revolute, axis: [{off:e}, 0, 1], origin: {{ xyz: [0.3, 0.2, 0.1] }} }}
    mass: 1
    com: [0.15, 0.01, 0.02]
    inertia: {{ xx: 0.005, yy: 0.02, zz: 0.02 }}
  - name: fore
    parent: upper
    joint: {{ name: elbow, type: revolute, axis: y, origin: {{ xyz: [0.3, 0, 0.05] }} }}
    mass: 0.5
    com: [0.12, 0, 0.02]
    inertia: {{ xx: 0.001, yy: 0.004, zz: 0.004 }}
"
    )
}

#[test]
fn origins_stay_near_their_parents() {
    for base in ["floating", "spherical", "planar"] {
        for off in OFF {
            let robot = Robot::read(&arm(base, off));
            for method in [
                Method::InverseDynamics,
                Method::MassMatrix,
                Method::KineticEnergy,
                Method::PotentialEnergy,
                Method::ForwardDynamics,
            ] {
                let state = robot.state(5).rounded();
                let exact = robot.state(5);
                let literal = exact.value(&robot.function(Some("literal"), method));
                for way in RECURSIONS {
                    let articulated = way == Some("articulated_base");
                    if articulated && method != Method::ForwardDynamics {
                        continue;
                    }
                    let found = state.value(&robot.function(way, method));
                    let size = largest(&literal);
                    for (k, (&x, &y)) in found.iter().zip(&literal).enumerate() {
                        let error = (Dd::from_f64(x) - y).abs().to_f64() / size;
                        assert!(
                            error < 1e-12,
                            "{base}, axis off by {off:e}, {method:?} by {way:?}: entry {k} is off by {error:e}"
                        );
                    }
                }
            }
        }
    }
}
