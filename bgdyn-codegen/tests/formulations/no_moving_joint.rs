//! Checks that a mechanism without a moving joint is accepted, and all its methods can be generated.

use bgdyn_codegen::emit::OutputOptions;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::pipeline::generate_module;
use bgdyn_codegen::{SpecText, read};

const TEXT: &str = "
format: 1
links:
  - name: bench
    mass: 3
    com: [0, 0, 2]
frames:
  - { name: vice, link: bench, origin: { xyz: [1, 0, 0] } }
";

#[test]
fn everything_is_generated() {
    let options = Options {
        derivatives: true,
        ..Options::default()
    };
    let place = OutputOptions::source_text("still.yaml".into());
    let spec = SpecText::mechanism(TEXT, "still");
    let (tokens, _) = generate_module(&spec, &options, &place).expect("no fault");
    assert!(tokens.to_string().contains("forward_dynamics_derivatives"));
    let (mechanism, _) = read(TEXT, Some("still"));
    let model = bgdyn_codegen::selection::model(mechanism.expect("no fault"), &options)
        .expect("nothing unknown");
    let energy = model.function(Method::PotentialEnergy).expect("a method");
    let (value, _) = energy.evaluate::<f64>(Default::default());
    assert!((value[0] - 3.0 * 9.81 * 2.0).abs() < 1e-12);
}

#[test]
fn second_derivatives_are_empty() {
    let names = ["inverse_dynamics_curvature", "inverse_dynamics_second"];
    let options = Options {
        methods: Some(names.map(String::from).to_vec()),
        ..Options::default()
    };
    let place = OutputOptions::source_text("still.yaml".into());
    let spec = SpecText::mechanism(TEXT, "still");
    let (tokens, _) = generate_module(&spec, &options, &place).expect("no fault");
    let text = tokens.to_string();
    assert!(names.iter().all(|name| text.contains(name)));
}
