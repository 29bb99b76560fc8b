//! `bgdyn import`: URDF, MJCF, SDF, tables of Denavit–Hartenberg parameters, options, joints that move freely.

mod free;
mod mjcf;
mod mjcf_corners;
mod mjcf_loops;
mod mjcf_report;
mod options;
mod sdf;
mod sdf_corners;
mod sdf_writer;
mod table;
mod urdf;

use bgdyn_cli::import::{Import, import};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::selection::function;

/// Returns the import of a valid file.
fn made(text: &str) -> Import {
    import(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Returns why a file is refused.
fn refused(text: &str) -> String {
    match import(text) {
        Ok(made) => panic!("imported:\n{}", made.yaml),
        Err(error) => error.to_string(),
    }
}

/// Replaces a text that must be there.
fn changed(text: &str, old: &str, new: &str) -> String {
    assert!(text.contains(old), "{old}");
    text.replacen(old, new, 1)
}

/// Returns the mechanism of a valid text.
fn mechanism(yaml: &str) -> Mechanism {
    let (mechanism, faults) = bgdyn_codegen::read(yaml, Some("arm"));
    mechanism.unwrap_or_else(|| panic!("{}\n{yaml}", faults.render("arm.yaml", yaml)))
}

/// Returns the number of effects that a file declares.
fn effects(yaml: &str) -> usize {
    let (machine, faults) = bgdyn_codegen::read_machine(yaml, Some("arm"));
    let machine = machine.unwrap_or_else(|| panic!("{}\n{yaml}", faults.render("arm.yaml", yaml)));
    machine.effects.len()
}

/// Returns a method's value at a state.
fn value(mechanism: &Mechanism, method: Method, [q, v, a]: [&[f64]; 3]) -> Vec<f64> {
    let function = function(mechanism, method, &Options::default()).expect("the method");
    let inputs = Inputs {
        q: q.to_vec(),
        v: v.to_vec(),
        a: a.to_vec(),
        ..Inputs::default()
    };
    function.evaluate(inputs).0
}

/// Returns the pose of a site: rotation in the method's order, and origin.
fn pose(mechanism: &Mechanism, place: &str, q: &[f64]) -> Vec<f64> {
    let graph = bgdyn_codegen::bond_graph::build(mechanism);
    let method = Method::named(&graph, &format!("pose_{place}")).expect("the place");
    value(mechanism, method, [q, &[], &[]])
}

fn near(a: &[f64], b: &[f64], bar: f64) {
    assert_eq!(a.len(), b.len());
    let size = a
        .iter()
        .chain(b)
        .fold(1.0, |size: f64, x| size.max(x.abs()));
    for (x, y) in a.iter().zip(b) {
        assert!((x - y).abs() <= bar * size, "{a:?}\n{b:?}");
    }
}

/// Returns numbers in −1 … 1.
fn many(random: &mut Random, count: usize) -> Vec<f64> {
    (0..count).map(|_| random.signed()).collect()
}
