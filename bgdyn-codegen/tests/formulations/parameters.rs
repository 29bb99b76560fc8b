//! Tests run-time parameters with the evaluator: their cost, their effect at zero, and their use in long
//! functions and refused specs.

use crate::common::rng::Rng;
use crate::common::{Robot, State, largest};
use bgdyn_codegen::SpecText;
use bgdyn_codegen::emit::OutputOptions;
use bgdyn_codegen::interface::Interface;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::pipeline::generate_module;

/// A spec of the project, with more links.
fn with(spec: &str, more: &str) -> (String, String) {
    let root = env!("CARGO_MANIFEST_DIR");
    let text = std::fs::read_to_string(format!("{root}/../{spec}")).expect("the spec");
    let (links, frames) = match text.find("frames:") {
        Some(at) => text.split_at(at),
        None => (text.as_str(), ""),
    };
    (text.clone(), format!("{links}\n{more}\n{frames}"))
}

/// Returns a part fixed to a link, with its mass as a parameter and, if `whole`, its centre of mass.
fn part(link: &str, whole: bool) -> String {
    let com = if whole {
        "[{ parameter: x, value: 0 }, { parameter: y, value: 0 }, { parameter: z, value: 0 }]"
    } else {
        "[0, 0, 0]"
    };
    let place = "{ type: fixed, origin: { xyz: [0, 0, 60 mm] } }";
    format!(
        "  - name: part\n    parent: {link}\n    joint: {place}\n    \
         mass: {{ parameter: payload, value: 0 }}\n    com: {com}\n"
    )
}

/// With a parameter at 0.0 the result is that of the mechanism without it, to four units of rounding.
#[test]
fn a_payload_of_nothing_changes_nothing() {
    for spec in ["specs/puma560.yaml", "specs/scara.yaml"] {
        for whole in [false, true] {
            let (without, with) = with(spec, &part("flange", whole));
            let (without, with) = (
                Robot::read(&without, Some("m")),
                Robot::read(&with, Some("m")),
            );
            for method in Method::OF_TRAIT {
                let (f, g) = (
                    without.whole("recursion", method),
                    with.whole("recursion", method),
                );
                let mut rng = Rng::new(5);
                let (mut worst, mut size) = (0.0_f64, 0.0_f64);
                for _ in 0..50 {
                    let mut s = State::random(&mut rng, &without.motions());
                    let x: Vec<f64> = s.value(&f);
                    s.parameters = vec![0.0; with.mechanism.parameters().len()];
                    let y: Vec<f64> = s.value(&g);
                    let off: Vec<f64> = x.iter().zip(&y).map(|(x, y)| x - y).collect();
                    (worst, size) = (worst.max(largest(&off)), size.max(largest(&x)));
                }
                let allowed = 4.0 * f64::EPSILON * size;
                assert!(
                    worst <= allowed,
                    "{spec} {method:?}: {worst:e}, {allowed:e}"
                );
            }
        }
    }
}

/// The cost of a payload is that of changing the tip, not one per joint.
#[test]
fn a_payload_is_cheap() {
    let count = |text: &str, method| {
        let robot = Robot::read(text, Some("m"));
        robot.function("recursion", method).operations().total()
    };
    for spec in ["specs/puma560.yaml", "specs/scara.yaml"] {
        let (without, mass) = with(spec, &part("flange", false));
        let (_, whole) = with(spec, &part("flange", true));
        for method in [Method::InverseDynamics, Method::ForwardDynamics] {
            let plain = count(&without, method);
            let (mass, whole) = (count(&mass, method), count(&whole, method));
            println!("{spec} {method:?}: {plain}, payload mass {mass}, payload {whole}");
            assert!(
                mass <= plain + plain / 6,
                "{spec} {method:?}: {plain}, {mass}"
            );
            assert!(
                whole <= plain + plain / 2,
                "{spec} {method:?}: {plain}, {whole}"
            );
        }
    }
}

#[test]
fn blocks_read_parameters_as_fields() {
    let (_, text) = with("tests/golden/specs/chain32.yaml", &part("l_j32", true));
    let robot = Robot::read(&text, Some("chain32"));
    let method = Method::InverseDynamics;
    let cut = robot.function("recursion", method);
    assert!(cut.blocks.len() > 1, "{} blocks", cut.blocks.len());
    let mut s = State::random(&mut Rng::new(8), &robot.motions());
    s.parameters = vec![1.5, 0.1, -0.2, 0.05];
    let (x, y): (Vec<f64>, Vec<f64>) = (s.value(&cut), s.value(&robot.chosen(method)));
    assert_eq!(x, y);
    let place = OutputOptions::source_text("chain32.yaml".into());
    let spec = SpecText::mechanism(&text, "chain32");
    let module = generate_module(&spec, &Default::default(), &place).expect("a sound spec");
    let module = module.0.to_string();
    let mut functions = module.split("fn ");
    let block = |f: &str| f.starts_with("inverse_dynamics_block_") && f.contains("self . payload");
    assert!(functions.any(block), "no block reads the payload");
}

#[test]
fn what_a_method_does_not_read_is_said() {
    let (_, text) = with("specs/scara.yaml", &part("flange", false));
    let place = OutputOptions::source_text("scara.yaml".into());
    let spec = SpecText::mechanism(&text, "scara");
    let module = generate_module(&spec, &Default::default(), &place).expect("a sound spec");
    let module = module.0.to_string();
    let field = "Run-time parameter: mass of link `part`, kg. Default 0.0.";
    assert!(module.contains(field));
    assert!(
        module.contains("the parameter `payload`."),
        "poses do not read it"
    );
    assert!(
        !module.contains("PhantomData"),
        "a struct literal can be written"
    );
}

#[test]
fn a_refused_spec_keeps_its_parameters() {
    let text = "\
links:
  - name: arm # parameter: none
    mass: { parameter: payload, value: heavy }
    com: [{parameter: \"x\", value: 0}, { parameter: y, value: 0 }, {parameter: x, value: 0}]
    inertia:
      zz:
        parameter: spin
        value: 1
      xx: { parameter: Bad }
";
    let parameters = ["payload", "x", "y", "spin"];
    let readable = Interface::guess(text, "arm").expect("an interface");
    assert_eq!(readable.parameters, parameters);
    let torn = Interface::guess(&format!("{text}  ]"), "arm").expect("an interface");
    assert_eq!(torn.parameters, parameters);
}
