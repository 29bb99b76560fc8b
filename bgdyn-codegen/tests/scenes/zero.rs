//! Checks that omitted effects cost nothing: the module is that of a mechanism that never had them.

use bgdyn_codegen::effect::EFFECTS;
use bgdyn_codegen::emit::{OutputOptions, scene_module};
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::selection::scene_functions;
use bgdyn_codegen::system::SceneEquations;

use super::common::{scene, state};
use super::written::{ALL, TENSOR, WRITTEN, mechanism, names};

fn text(system: &SceneEquations) -> String {
    let place = OutputOptions::source_text("scene.yaml".into());
    let functions = scene_functions(system, &Options::default());
    scene_module(system, &functions, &place).to_string()
}

#[test]
fn an_effect_that_is_not_called_for_leaves_no_trace() {
    for effect in EFFECTS.iter().filter(|e| !e.built_in()) {
        let keyword = effect.keyword();
        let written = WRITTEN.iter().find(|(k, _)| *k == keyword);
        let (_, written) = written.unwrap_or_else(|| panic!("no example of `{keyword}`"));
        let declared = format!("effects:\n  extra: {written}\n");
        let (with, without) = (mechanism("", TENSOR, &declared), mechanism("", TENSOR, ""));
        assert_eq!(
            text(&scene(ALL, &with)),
            text(&scene(ALL, &without)),
            "{keyword}"
        );
        // If included, it exists.
        let all = format!("velocity_products, {}]", names(written));
        let called = text(&scene(&ALL.replace("velocity_products]", &all), &with));
        assert_ne!(called, text(&scene(ALL, &without)), "{keyword}");
    }
}

#[test]
fn what_every_mechanism_has_leaves_no_trace_either() {
    let lumped = ALL.replace("inertia, ", "");
    let (with, without) = (mechanism("", TENSOR, ""), mechanism("", "", ""));
    assert_eq!(
        text(&scene(&lumped, &with)),
        text(&scene(&lumped, &without))
    );
    let weightless = ALL.replace("gravity, ", "");
    let none = mechanism("gravity: [0, 0, 0]", TENSOR, "");
    assert_eq!(
        text(&scene(&weightless, &with)),
        text(&scene(&weightless, &none))
    );
    // Without velocity products velocities are read only for the rates of the positions.
    let quasi_static = scene(&ALL.replace(", velocity_products", ""), &with);
    let body = quasi_static.function(SceneFunction::Derivative);
    let reads = bgdyn_codegen::expr::reachable(&body.graph, &body.blocks[0].outputs);
    let leaf = |i: usize| body.graph.node(bgdyn_codegen::expr::NodeId::at(i));
    let velocities = (0..reads.len()).filter(|&i| {
        use bgdyn_codegen::expr::{Leaf, Node};
        reads[i] && matches!(leaf(i), Node::Leaf(Leaf::Velocity(_)))
    });
    assert_eq!(velocities.count(), 0);
}

/// Effects that only add an effort with a constant factor of zero are removed; with a run-time parameter
/// at zero they change only the last digits.
#[test]
fn a_strength_of_zero_changes_nothing() {
    let plain = scene(ALL, &mechanism("", TENSOR, ""));
    let derivative = plain.function(SceneFunction::Derivative);
    for (kind, key, written) in [
        (
            "viscous",
            "damping",
            "{ type: viscous, joint: turn, damping: VALUE }",
        ),
        (
            "spring",
            "stiffness",
            "{ type: spring, joint: slide, stiffness: VALUE }",
        ),
        (
            "damper",
            "damping",
            "{ type: damper, between: [anchor, tip], damping: VALUE }",
        ),
        (
            "coulomb_smooth",
            "kinetic",
            "{ type: coulomb_smooth, joint: turn, kinetic: VALUE, width: 0.1 }",
        ),
    ] {
        let called = |value: &str| {
            let declared = format!("effects:\n  extra: {}\n", written.replace("VALUE", value));
            let text = ALL.replace("velocity_products]", "velocity_products, extra]");
            scene(&text, &mechanism("", TENSOR, &declared))
        };
        let zero = called("0").function(SceneFunction::Derivative);
        let open = called("{ parameter: strength, value: 0 }");
        let parametric = open.function(SceneFunction::Derivative);
        for seed in 0..50 {
            let exact = state(&open, &mut Random(seed), true);
            let inputs = bgdyn_codegen::expr::Inputs {
                q: exact.q.iter().map(|x| x.to_f64()).collect(),
                v: exact.v.iter().map(|x| x.to_f64()).collect(),
                u: exact.u.iter().map(|x| x.to_f64()).collect(),
                parameters: vec![0.0],
                t: Some(0.0),
                ..Default::default()
            };
            let wanted: Vec<f64> = derivative.evaluate(inputs.clone()).0;
            let found: Vec<f64> = zero.evaluate(inputs.clone()).0;
            assert_eq!(found, wanted, "{kind} with {key} 0");
            let found: Vec<f64> = parametric.evaluate(inputs).0;
            for (x, y) in found.iter().zip(&wanted) {
                let size = wanted.iter().fold(0.0_f64, |m, w| m.max(w.abs()));
                assert!(
                    (x - y).abs() <= 4.0 * f64::EPSILON * size,
                    "{kind}: {x} and {y}"
                );
            }
        }
    }
}

/// The Jacobian and the canonical form exist if an integrator needs them, or if they are selected;
/// otherwise they leave no trace.
#[test]
fn what_no_method_needs_is_not_there() {
    let mechanism = mechanism("", TENSOR, "");
    let run_by = |method: &str| {
        let run = format!("integration: {{ method: {method} }}\n");
        text(&scene(&(ALL.to_owned() + &run), &mechanism))
    };
    let plain = text(&scene(ALL, &mechanism));
    for trace in ["jacobian", "Slope", "anonical"] {
        assert!(!plain.contains(trace), "{trace}");
    }
    for method in ["rk4", "semi_implicit_euler", "dopri5", "dop853"] {
        assert_eq!(run_by(method), plain, "{method}");
    }
    for method in ["midpoint", "gauss2", "gauss3", "rodas4"] {
        let text = run_by(method);
        assert!(
            text.contains("Slope") && !text.contains("anonical"),
            "{method}"
        );
    }
    for method in ["canonical_midpoint", "canonical_gauss2", "canonical_gauss3"] {
        let text = run_by(method);
        assert!(
            text.contains("Canonical") && !text.contains("Slope"),
            "{method}"
        );
    }
    let system = scene(ALL, &mechanism);
    let options = Options {
        jacobian: true,
        canonical: true,
        ..Options::default()
    };
    let place = OutputOptions::source_text("scene.yaml".into());
    let asked = scene_module(&system, &scene_functions(&system, &options), &place).to_string();
    assert!(asked.contains("Slope") && asked.contains("Canonical"));
}
