//! Tests the long chains, and one with a branch: their code is cut into blocks that are separate
//! functions, and most of the mass matrix is a loop over tables.

#[path = "../numeric/counted.rs"]
mod counted;
#[path = "../numeric/golden_values.rs"]
mod golden_values;

use bgdyn::Dynamics;
use bgdyn::nalgebra::SVector;
use bgdyn::runtime::{Dd, Operations};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::formulation::by_name;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection::function;
use counted::{Counted, executed};
use golden_values::equals_golden;

bgdyn::bgdyn!("chain16.yaml", methods = [dynamics]);
bgdyn::bgdyn!("branched.yaml", methods = [dynamics]);
bgdyn::bgdyn!("../golden/specs/chain32.yaml", methods = [dynamics]);
bgdyn::bgdyn!("../golden/specs/chain64.yaml", methods = [dynamics]);

const CHAIN_16: &str = include_str!("chain16.yaml");
const BRANCHED: &str = include_str!("branched.yaml");
const CHAIN_32: &str = include_str!("../golden/specs/chain32.yaml");
const CHAIN_64: &str = include_str!("../golden/specs/chain64.yaml");

#[test]
fn chain_of_32() {
    let model = chain32::Chain32::default();
    equals_golden::<f64, _, 32>("chain32", &model, &chain32::JOINT_NAMES, 1.0, |x| x);
}

#[test]
fn chain_of_64() {
    let model = chain64::Chain64::default();
    equals_golden::<f64, _, 64>("chain64", &model, &chain64::JOINT_NAMES, 1.0, |x| x);
}

/// The file is the beginning of the longer one.
#[test]
fn chain_of_16_is_the_beginning_of_that_of_32() {
    let links = |text: &'static str| text.split_once("\nlinks:").expect("links").1.trim_end();
    assert!(links(CHAIN_32).starts_with(links(CHAIN_16)));
    assert_eq!(chain16::JOINT_NAMES, chain32::JOINT_NAMES[..16]);
}

/// Positions, velocities, and accelerations or efforts: the same on every machine.
fn state<const N: usize>(number: usize) -> [SVector<f64, N>; 3] {
    let angle =
        |j: usize, k: usize| (1.0 + (number * N + j) as f64 * 0.7391 + k as f64 * 2.3).sin();
    [3.0, 2.0, 5.0].map(|size| SVector::from_fn(|j, _| size * angle(j, size as usize)))
}

fn inputs<const N: usize>([q, v, a]: &[SVector<f64, N>; 3]) -> Inputs<f64> {
    let all = |x: &SVector<f64, N>| x.iter().copied().collect();
    Inputs {
        q: all(q),
        v: all(v),
        a: all(a),
        u: all(a),
        ..Inputs::default()
    }
}

fn generated(text: &str, method: Method, formulation: Option<&str>) -> Function {
    let mechanism = bgdyn_codegen::read(text, Some("chain"))
        .0
        .expect("a sound spec");
    let options = Options {
        formulation: formulation.map(|name| by_name(name).expect("a formulation")),
        ..Options::default()
    };
    function(&mechanism, method, &options).expect("a method of the trait")
}

/// Inverse dynamics, mass matrix and forward dynamics equal the evaluator's values, word by word.
fn equals_the_evaluator<M: Dynamics<f64, N, N>, const N: usize>(model: &M, text: &str) {
    let of = |method| generated(text, method, None);
    let (id, m, fd) = (
        of(Method::InverseDynamics),
        of(Method::MassMatrix),
        of(Method::ForwardDynamics),
    );
    for number in 0..20 {
        let state = state::<N>(number);
        let value = |f: &Function| f.evaluate(inputs(&state)).0;
        let [q, v, a] = &state;
        assert_eq!(model.inverse_dynamics(q, v, a).as_slice(), value(&id));
        let found = model.forward_dynamics(q, v, a).expect("M is regular");
        assert_eq!(found.as_slice(), value(&fd));
        let mass = model.mass_matrix(q);
        let triangle = (0..N).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let found: Vec<f64> = triangle.map(|place| mass[place]).collect();
        assert_eq!(found, value(&m));
        assert_eq!(mass, mass.transpose());
    }
}

#[test]
fn compiled_chains_equal_the_evaluator() {
    equals_the_evaluator(&branched::Branched::default(), BRANCHED);
    equals_the_evaluator(&chain16::Chain16::default(), CHAIN_16);
    equals_the_evaluator(&chain32::Chain32::default(), CHAIN_32);
    equals_the_evaluator(&chain64::Chain64::default(), CHAIN_64);
}

/// The compiled code for 16 links equals equation (6) in double-double.
#[test]
fn chain_of_16_equals_the_literal_sum() {
    let model = chain16::Chain16::<f64>::default();
    let of = |method| generated(CHAIN_16, method, Some("literal"));
    let (id, m) = (of(Method::InverseDynamics), of(Method::MassMatrix));
    for number in 0..5 {
        let [q, v, a] = state::<16>(number);
        let exact = |f: &Function, a: &SVector<f64, 16>| -> Vec<f64> {
            let given = inputs(&[q, v, *a]);
            let wide = |x: Vec<f64>| x.into_iter().map(Dd::from_f64).collect();
            let wide = Inputs {
                q: wide(given.q),
                v: wide(given.v),
                a: wide(given.a),
                ..Inputs::default()
            };
            f.evaluate::<Dd>(wide)
                .0
                .into_iter()
                .map(Dd::to_f64)
                .collect()
        };
        let close = |found: &[f64], wanted: &[f64]| {
            let size = wanted.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            for (x, y) in found.iter().zip(wanted) {
                assert!((x - y).abs() <= 1e-13 * size, "{x} instead of {y}");
            }
        };
        close(
            model.inverse_dynamics(&q, &v, &a).as_slice(),
            &exact(&id, &a),
        );
        let mass = model.mass_matrix(&q);
        let triangle = (0..16).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let found: Vec<f64> = triangle.map(|place| mass[place]).collect();
        close(&found, &exact(&m, &a));
        // M times the error of the accelerations is the error of the efforts.
        let answer = model.forward_dynamics(&q, &v, &a).expect("M is regular");
        let efforts = exact(&id, &answer);
        let size = (mass.abs() * answer.abs()).max();
        for (found, wanted) in efforts.iter().zip(&a) {
            assert!(
                (found - wanted).abs() <= 1e-13 * size,
                "{found} instead of {wanted}"
            );
        }
    }
}

/// The executed operations are those that are counted, also in loops.
fn executes_what_is_counted<M: Dynamics<Counted, N, N>, const N: usize>(
    model: &M,
    operations: &[(&str, Operations)],
) {
    let [q, v, a] = state::<N>(0).map(|x| x.map(Counted));
    let runs = [
        (
            "inverse_dynamics",
            executed(|| model.inverse_dynamics(&q, &v, &a)),
        ),
        ("mass_matrix", executed(|| model.mass_matrix(&q))),
    ];
    assert_eq!(runs.as_slice(), &operations[..2]);
    let run = executed(|| model.forward_dynamics(&q, &v, &a));
    assert_eq!(("forward_dynamics", run), operations[4]);
}

#[test]
fn compiled_chains_execute_what_is_counted() {
    executes_what_is_counted(&branched::Branched::default(), &branched::OPERATIONS);
    executes_what_is_counted(&chain16::Chain16::default(), &chain16::OPERATIONS);
    executes_what_is_counted(&chain32::Chain32::default(), &chain32::OPERATIONS);
    executes_what_is_counted(&chain64::Chain64::default(), &chain64::OPERATIONS);
}
