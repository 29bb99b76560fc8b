//! Operations of mechanisms with loops: those of the page `docs/loops.md`.

use bgdyn_codegen::expr::Operations;
use bgdyn_codegen::method::Method;

use super::references::{file, spec};
use super::robot::Robot;

/// Specs, with their names on the page.
const MECHANISMS: [(&str, &str); 5] = [
    ("four_bar", "four-bar"),
    ("slider_crank", "slider-crank"),
    ("five_bar", "five-bar"),
    ("delta_robot", "Delta robot, arms independent"),
    ("stewart_platform", "Stewart platform, platform independent"),
];

#[test]
fn the_page_has_the_counts() {
    let page = file(["docs", "loops.md"]);
    let methods = [
        Method::InverseDynamics,
        Method::MassMatrix,
        Method::ForwardDynamics,
    ];
    let words = |o: Operations| format!("{} / {} + {}÷", o.mul, o.add, o.div);
    for (name, title) in MECHANISMS {
        let robot = Robot::read(&spec(name));
        let counts = methods.map(|method| words(robot.function(None, method).operations()));
        let row = format!("| {title} | {} |", counts.join(" | "));
        assert!(page.contains(&row), "docs/loops.md has no row {row}");
    }
}
