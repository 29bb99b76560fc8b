//! Operations of mechanisms with wheels and knife edges: those of the page `docs/rolling.md`.

use bgdyn_codegen::expr::Operations;
use bgdyn_codegen::method::Method;

use super::files::{file, spec};
use super::robot::Robot;

/// Specs, with their names on the page.
const MECHANISMS: [(&str, &str); 6] = [
    ("chaplygin_sleigh", "Chaplygin sleigh"),
    (
        "differential_drive",
        "differential drive, wheels independent",
    ),
    ("snakeboard", "snakeboard, speed ahead independent"),
    ("rolling_disc", "disc, a floating body"),
    ("whipple_bicycle", "bicycle, two rolling wheels"),
    ("rattleback", "rattleback, a floating body"),
];

/// The disc in yaw, lean and spin.
const ANGLES: &str = "format: 1
name: disc
links:
  - name: heading
    joint: { name: ground, type: planar }
  - name: rise
    parent: heading
    joint: { name: height, type: prismatic, axis: z }
  - name: tilt
    parent: rise
    joint: { name: lean, type: continuous, axis: x }
  - name: coin
    parent: tilt
    joint: { name: spin, type: continuous, axis: y }
    mass: 1
    inertia: { xx: 0.0625, yy: 0.125, zz: 0.0625 }
constraints:
  rim: { type: rolling, link: coin, axis: y, radius: 500 mm }
independent: [ground_turn, lean, spin]
";

#[test]
fn the_page_has_the_counts() {
    let page = file("docs", "rolling.md");
    let methods = [
        Method::InverseDynamics,
        Method::MassMatrix,
        Method::ForwardDynamics,
    ];
    let words = |o: Operations| {
        let more = |n: usize, sign: &str| match n {
            0 => String::new(),
            _ => format!(" + {n}{sign}"),
        };
        format!(
            "{} / {}{}{}",
            o.mul,
            o.add,
            more(o.div, "÷"),
            more(o.sqrt, "√")
        )
    };
    let specs = MECHANISMS.map(|(name, title)| (spec(name), title));
    for (text, title) in specs
        .into_iter()
        .chain([(ANGLES.into(), "disc, yaw, lean and spin")])
    {
        let robot = Robot::read(&text);
        let counts = methods.map(|method| words(robot.function(None, method).operations()));
        let row = format!("| {title} | {} |", counts.join(" | "));
        assert!(page.contains(&row), "docs/rolling.md has no row {row}");
    }
}

/// The angle of a wheel about its axle, and the place of the cart, enter no function of the dynamics.
#[test]
fn sines_are_those_of_steering_only() {
    for (name, sines) in [
        ("chaplygin_sleigh", 0),
        ("differential_drive", 0),
        ("snakeboard", 1),
    ] {
        let robot = Robot::read(&spec(name));
        for method in [Method::InverseDynamics, Method::ForwardDynamics] {
            let operations = robot.function(None, method).operations();
            assert_eq!((operations.sincos, operations.sqrt), (sines, 0), "{name}");
        }
    }
}
