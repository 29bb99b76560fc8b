//! Tests regressors of payloads: equal to those of the links that carry them, at frames in any place and on joints of
//! every type; refusals; counts of operations.

use bgdyn_codegen::bond_graph::SiteId;
use bgdyn_codegen::method::{Method, PayloadRegressor};
use bgdyn_codegen::options::Options;

use crate::checked::{checked, every_turned_sign_is_refused, of_folder, quick_loops};
use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, golden};

/// Returns the options for the methods of all payloads; of large mechanisms for the last frame's.
fn options(robot: &Robot) -> Options {
    let sites = &robot.graph.sites;
    let all = Method::possible_of(robot.graph).into_iter();
    let last = all.clone().filter_map(Method::site).max();
    let of_payload = |method: &Method| {
        let small = robot.nv() <= 4 || method.site() == last;
        matches!(method, Method::Payload(_)) && small
    };
    let names = all.filter(of_payload).map(|method| method.name(sites));
    Options {
        methods: Some(names.collect()),
        ..Options::default()
    }
}

fn passes(robot: &Robot, what: &str) {
    checked(robot, &options(robot), what);
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
            }
        }
    }
}

#[test]
fn every_turned_sign_is_found() {
    let robot = golden::robot("scara4");
    let model = checked(&robot, &options(&robot), "scara4");
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
    let counted = COUNTS.map(|(name, _)| {
        let robot = golden::robot(name);
        let last = SiteId(robot.graph.sites.len() - 1);
        let counts = PayloadRegressor::of_site(last).map(|of| {
            let operations = robot.emitted(Method::Payload(of)).operations();
            operations.mul + operations.add
        });
        (name, counts)
    });
    assert_eq!(counted, COUNTS);
}
