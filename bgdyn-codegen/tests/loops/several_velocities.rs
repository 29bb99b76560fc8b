//! Loops through spherical, planar and floating joints against the open tree with multipliers.

use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::selection::model;
use bgdyn_codegen::verify::check_model;
use bgdyn_codegen::{formulation, method};

use super::multipliers::compare;
use super::random_loops::Text;
use super::references::{file, spec};
use super::robot::{Robot, Way};

#[test]
fn loops_through_balls_planes_and_free_bodies_move_as_with_multipliers() {
    for (seed, (kind, joints)) in [
        ("point", &[(2, "spherical")][..]),
        ("hinge", &[(2, "spherical")]),
        ("slider", &[(6, "spherical")]),
        ("weld", &[(1, "planar")]),
        ("universal", &[(8, "spherical"), (3, "planar")]),
        ("hinge", &[(7, "floating")]),
        ("weld", &[(4, "spherical"), (6, "spherical")]),
    ]
    .into_iter()
    .enumerate()
    {
        for root in ["fixed", "floating"] {
            let mut random = Random(2000 + seed as u64);
            let mut text = Text::of_type(&mut random, root, kind);
            for &(number, joint) in joints {
                text = text.with_joint(number, joint);
            }
            compare(&text, &format!("{kind}, {joints:?}, {root}"));
        }
    }
}

/// The generator's own check accepts every method, derivatives and those on request.
#[test]
fn every_method_is_accepted() {
    let table = file(["tests/closed_loops", "held_table.yaml"]);
    let table = table.replacen("format: 1", "format: 1\nname: held_table", 1);
    for text in [spec("spatial_slider_crank"), table] {
        let ways: [Way; 3] = [None, Some("subspaces"), Some("literal")];
        for way in ways {
            let options = Options {
                derivatives: true,
                formulation: way.map(|name| formulation::by_name(name).expect("a formulation")),
                ..Options::default()
            };
            let accept = |options: &Options| {
                let model = model(Robot::read(&text).mechanism, options).expect("a model");
                assert_eq!(check_model(&model), [], "{way:?}");
                model.functions.len()
            };
            assert!(accept(&options) > 20);
            let asked = method::Method::ON_REQUEST.map(|method| method.name(&[]));
            let asked = asked.into_iter().chain(["joint_reactions".to_owned()]);
            let asked = Options {
                methods: Some(asked.collect()),
                derivatives: false,
                ..options
            };
            assert_eq!(accept(&asked), 5);
        }
    }
}

/// Drives at joints in such loops, the velocities of a ball among them: each velocity by its name.
#[test]
fn drives_may_be_at_velocities_of_balls() {
    let text = spec("spatial_slider_crank");
    let driven = format!("{text}actuated: [slider_position, rod_ball_rx]\n");
    let options = Options::default();
    let model = model(Robot::read(&driven).mechanism, &options).expect("a model");
    assert_eq!(check_model(&model), []);
    assert!(
        model
            .functions
            .iter()
            .any(|f| f.name == "reduced_inverse_dynamics")
    );
}

/// With the crank or the slide locked the rod still turns about itself, and nothing else moves.
#[test]
fn scenes_lock_joints_of_loops_through_balls() {
    let text = spec("spatial_slider_crank").replace("name: spatial_slider_crank\n", "");
    for lock in ["crank_angle: 0.3", "slider_position: 0.45"] {
        let scene = format!(
            "scene: 1\nmechanism: own.yaml\neffects: [gravity, inertia, velocity_products]\nlock: {{ {lock} }}\n"
        );
        let read = bgdyn_codegen::read_scene(&scene, "scene", |_| Ok(text.clone()));
        let (system, _) = read.unwrap_or_else(|refusal| panic!("{lock}: {refusal:?}"));
        let closure = system.scene.mechanism.closure().expect("a loop");
        assert_eq!(closure.independents.len(), 1, "{lock}");
        let map = closure
            .velocity_map(&system.initial.q)
            .expect("a regular start");
        let moving = map.iter().filter(|row| row[0].to_f64().abs() > 1e-20);
        assert_eq!(moving.count(), 1, "{lock}: {map:?}");
        assert!(!system.function(SceneFunction::Derivative).blocks.is_empty());
    }
}
