//! The independent velocities that are chosen are regular at the start.

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::robot::{Robot, State, largest};

/// Two balls of different size on the ground.
const BALLS: &str = "format: 1
name: balls
links:
  - name: small
    joint: { name: s, type: floating, origin: { xyz: [0.3, 0, 0.1] } }
    mass: 1
    inertia: { xx: 0.1, yy: 0.1, zz: 0.1 }
  - name: large
    joint: { name: l, type: floating, origin: { xyz: [0, 0, 0.2] } }
    mass: 1
    inertia: { xx: 0.1, yy: 0.1, zz: 0.1 }
constraints:
  first: { type: rolling, link: small, radius: 0.1 }
  second: { type: rolling, link: large, radius: 0.2 }
";

/// At the neutral attitude the displacement along x and the rotation about y follow each other.
#[test]
fn balls_have_independent_velocities_at_their_start() {
    let robot = Robot::read(BALLS);
    let closure = robot.mechanism.closure().expect("contacts");
    let map = closure
        .velocity_map(&closure.start)
        .expect("a regular start");
    assert!(map.iter().all(|row| largest(row) < 10.0), "{map:?}");
    let names = robot.mechanism.joint_names();
    assert_eq!(names, ["s_rx", "s_ry", "s_rz", "l_rx", "l_ry", "l_rz"]);
    // τ = (I + m r²) ω̇ about y, of both balls.
    let of = |x: f64| vec![Dd::from_f64(x); robot.nv()];
    let state = State {
        q: closure.start.clone(),
        v: of(0.0),
        a: of(0.0),
        u: of(1.0),
    };
    let found: Vec<Dd> = state.value(&robot.function(None, Method::ForwardDynamics));
    for (j, inertia) in [(1, 0.11), (4, 0.14)] {
        let off = found[j].to_f64() - 1.0 / inertia;
        assert!(off.abs() < 1e-12, "{found:?}");
    }
}

/// A choice of the file stays, also where it is singular at the start.
#[test]
fn independent_velocities_of_the_file_stay() {
    let text = format!("{BALLS}independent: [s_x, s_y, s_rx, l_x, l_y, l_rx]\n");
    let robot = Robot::read(&text);
    let closure = robot.mechanism.closure().expect("contacts");
    assert!(closure.velocity_map(&closure.start).is_none());
    assert_eq!(robot.mechanism.joint_names()[0], "s_x");
}
