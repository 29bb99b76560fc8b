//! Operations of mechanisms with wheels and knife edges: those of the page `docs/rolling.md`.

use bgdyn_codegen::expr::Operations;
use bgdyn_codegen::method::Method;

use super::files::{file, spec};
use super::robot::Robot;

/// Specs, with their names on the page.
const MECHANISMS: [(&str, &str); 3] = [
    ("chaplygin_sleigh", "Chaplygin sleigh"),
    (
        "differential_drive",
        "differential drive, wheels independent",
    ),
    ("snakeboard", "snakeboard, speed ahead independent"),
];

#[test]
fn the_page_has_the_counts() {
    let page = file("docs", "rolling.md");
    let methods = [
        Method::InverseDynamics,
        Method::MassMatrix,
        Method::ForwardDynamics,
    ];
    let words = |o: Operations| match o.div {
        0 => format!("{} / {}", o.mul, o.add),
        _ => format!("{} / {} + {}÷", o.mul, o.add, o.div),
    };
    for (name, title) in MECHANISMS {
        let robot = Robot::read(&spec(name));
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
