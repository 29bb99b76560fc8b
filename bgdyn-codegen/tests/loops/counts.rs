//! Operations of mechanisms with loops: those of the page `docs/loops.md`.

use bgdyn_codegen::expr::Operations;
use bgdyn_codegen::method::{Method, SceneFunction};
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection;

use super::actuated::parallel_robots;
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

/// Multiplications, additions, divisions, and roots if there are any.
fn words(o: Operations) -> String {
    let roots = match o.sqrt {
        0 => String::new(),
        n => format!(" + {n}√"),
    };
    format!("{} / {} + {}÷{roots}", o.mul, o.add, o.div)
}

/// Returns the row of the page with the counts of these methods.
fn row<const N: usize>(title: &str, robot: &Robot, methods: [Method; N]) -> String {
    let counts = methods.map(|method| words(robot.function(None, method).operations()));
    format!("| {title} | {} |", counts.join(" | "))
}

fn assert_on_page(rows: impl Iterator<Item = String>) {
    let page = file(["docs", "loops.md"]);
    let missing: Vec<String> = rows.filter(|row| !page.contains(row)).collect();
    let missing = missing.join("\n");
    assert!(missing.is_empty(), "docs/loops.md has no rows\n{missing}");
}

#[test]
fn the_page_has_the_counts() {
    let methods = [
        Method::InverseDynamics,
        Method::MassMatrix,
        Method::ForwardDynamics,
    ];
    let rows = MECHANISMS.map(|(name, title)| row(title, &Robot::read(&spec(name)), methods));
    assert_on_page(rows.into_iter());
}

/// Multiplications and additions of all methods that are generated without options, together: a new choice among forms
/// shows here for methods that no page counts.
const TOTALS: [(&str, usize); 15] = [
    ("andrews", 2453),
    ("bricard", 6358),
    ("delta_robot", 9386),
    ("excavator", 3390),
    ("five_bar", 1219),
    ("four_bar", 669),
    ("parallel_rods", 46),
    ("parallelograms", 1369),
    ("rssr", 2846),
    ("six_bar", 2189),
    ("slider_crank", 398),
    ("slider_crank_near_singular", 380),
    ("spatial_slider_crank", 2751),
    ("spherical_four_bar", 718),
    ("stewart_platform", 30084),
];

#[test]
fn totals_of_all_methods_do_not_grow() {
    let total = |name: &str| {
        let (mechanism, _) = bgdyn_codegen::read(&spec(name), Some(name));
        let mechanism = mechanism.unwrap_or_else(|| panic!("{name}: faults"));
        let model = selection::model(mechanism, &Options::default());
        let functions = model.expect("no name is asked for").functions;
        let counts = functions.iter().map(|function| function.operations());
        counts.map(|o| o.mul + o.add).sum::<usize>()
    };
    let found = TOTALS.map(|(name, _)| (name, total(name)));
    assert_eq!(found, TOTALS);
}

/// The methods that are generated if they are asked for.
#[test]
fn the_page_has_the_counts_of_methods_on_request() {
    let methods = [
        Method::ConstrainedDynamics,
        Method::ProjectVelocity,
        Method::Reactions,
        Method::JointReactions,
    ];
    let rows = MECHANISMS.map(|(name, title)| {
        let title = title.split(',').next().unwrap_or(title);
        row(title, &Robot::read(&spec(name)), methods)
    });
    assert_on_page(rows.into_iter());
}

/// The rates of a scene under its weights: accelerations, and the rates of all positions from the same S.
#[test]
fn rates_of_scenes_share_the_velocity_map_with_forward_dynamics() {
    for (name, counts) in [
        ("slider_crank", [36, 21, 2]),
        ("five_bar", [88, 55, 3]),
        ("four_bar", [51, 27, 2]),
    ] {
        let text = format!(
            "scene: 1\nmechanism: {name}.yaml\neffects: [gravity, inertia, velocity_products]\n"
        );
        let mechanism = spec(name);
        let read = bgdyn_codegen::read_scene(&text, "scene", |_| Ok(mechanism.clone()));
        let (system, _) = read.unwrap_or_else(|refusal| panic!("{name}: {refusal:?}"));
        let derivative = system.function(SceneFunction::Derivative).operations();
        let found = [derivative.mul, derivative.add, derivative.div];
        assert_eq!(found, counts, "{name}");
    }
}

/// Inverse and forward dynamics of the drives of parallel robots, in the positions of their platforms.
#[test]
fn the_page_has_the_counts_of_actuated_joints() {
    let rows = parallel_robots().into_iter().map(|(name, text, _)| {
        let robot = Robot::read(&text);
        let closed = robot.graph.closed.as_deref().expect("loops");
        let [inverse, forward] = Method::of_actuated(closed)[..] else {
            panic!("{name}: enough joints");
        };
        let title = match name {
            "delta_robot" => "Delta robot, platform independent, arms actuated",
            _ => "Stewart platform, platform independent, legs actuated",
        };
        row(title, &robot, [Method::InverseDynamics, inverse, forward])
    });
    assert_on_page(rows);
}
