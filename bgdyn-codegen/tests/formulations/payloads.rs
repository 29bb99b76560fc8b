//! Tests regressors of payloads: equal to those of the links that carry them, at frames in any place and on joints of
//! every type; refusals; counts of operations.

use bgdyn_codegen::bond_graph::SiteId;
use bgdyn_codegen::method::{Method, PayloadRegressor};

use crate::checked::{
    checked_methods, counted, every_turned_sign_is_refused, of_folder, quick_loops,
};
use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, golden};

/// Returns the methods of all payloads; of large mechanisms those at the last frame.
fn methods(robot: &Robot) -> Vec<Method> {
    let all = Method::possible_of(robot.graph).into_iter();
    let of_payload = all.filter(|method| matches!(method, Method::Payload(_)));
    let last = of_payload.clone().filter_map(Method::site).max();
    let is_small = robot.nv() <= 4;
    of_payload
        .filter(|method| is_small || method.site() == last)
        .collect()
}

fn passes(robot: &Robot, what: &str) {
    checked_methods(robot, &methods(robot), what);
}

#[test]
fn payloads_on_random_trees_equal_equation_6() {
    let mut rng = Rng::new(337);
    for _ in 0..24 {
        let text = Draft::random(&mut rng, 6).yaml();
        passes(&Robot::read(&text, None), &text);
    }
}

/// Frames beside the joints' axes, on links that are fixed to others.
#[test]
fn payloads_on_every_spec_equal_equation_6() {
    for folder in ["specs", "specs/constraints", "tests/golden/joints"] {
        for (name, text) in of_folder(folder) {
            let robot = Robot::read(&text, Some(&name));
            if robot.nv() <= 8 {
                passes(&robot, &name);
                let given = text.replacen("format: 1\n", "format: 1\nbase: given\n", 1);
                if folder == "specs" && !text.contains("base:") {
                    passes(&Robot::read(&given, Some(&name)), &given);
                }
            }
        }
    }
}

#[test]
fn every_turned_sign_is_found() {
    let robot = golden::robot("scara4");
    let model = checked_methods(&robot, &methods(&robot), "scara4");
    every_turned_sign_is_refused(&model, |_, _| true);
}

#[test]
fn what_carries_no_payload_says_why() {
    let (name, text) = quick_loops().swap_remove(0);
    let robot = Robot::read(&text, Some(&name));
    let site = &robot.graph.sites.last().expect("a site").name;
    let found = Method::named(robot.graph, &format!("payload_regressor_{site}"));
    let why = found.expect_err("no method");
    assert!(why.contains("has no regressors"), "{why}");
}

/// Multiplications and additions by robot, at the last link: the regressor, the step.
const COUNTS: [(&str, [usize; 2]); 6] = [
    ("scara_rrpr", [57, 56]),
    ("stanford_gen", [376, 284]),
    ("puma_gen", [439, 342]),
    ("ur5_gen", [410, 330]),
    ("panda_gen", [698, 429]),
    ("iiwa_gen", [602, 372]),
];

#[test]
fn counts_do_not_grow() {
    let found = COUNTS.map(|(name, _)| {
        let robot = golden::robot(name);
        let last = SiteId(robot.graph.sites.len() - 1);
        let methods = PayloadRegressor::of_site(last).map(Method::Payload);
        (name, counted(&robot, methods))
    });
    assert_eq!(found, COUNTS);
}
