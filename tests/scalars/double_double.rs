//! Compiled code in double-double, against `f64` and against the evaluator.

use bgdyn::Dynamics;
use bgdyn::nalgebra::SVector;
use bgdyn::runtime::Dd;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::{Method, Shape};
use bgdyn_codegen::model::Model;

use crate::models::puma560::Puma560;
use crate::models::scara4::Scara4;
use crate::models::{Random, State, results, widen};
use crate::rounded::Rounded;

fn generated(robot: &str) -> Model {
    let root = env!("CARGO_MANIFEST_DIR");
    let path = format!("{root}/tests/golden/specs/{robot}.yaml");
    let text = std::fs::read_to_string(path).expect("the spec is there");
    let (mechanism, _) = bgdyn_codegen::read(&text, Some(robot));
    Model::new(mechanism.expect("a valid spec"), &Default::default()).expect("nothing unknown")
}

fn near(what: &str, found: &[Dd], wanted: &[Dd], relative: f64) {
    assert_eq!(found.len(), wanted.len(), "{what}");
    let size = wanted.iter().map(|x| x.abs().to_f64()).fold(1.0, f64::max);
    for (x, y) in found.iter().zip(wanted) {
        let error = (*x - *y).abs().to_f64();
        assert!(
            error <= relative * size,
            "{what}: off by {error:e} of {size:e}"
        );
    }
}

/// What the evaluator makes of a method; a symmetric matrix in full.
fn evaluated<const N: usize>(model: &Model, method: &str, state: &State<Dd, N>) -> Vec<Dd> {
    let method = Method::named(&[], method).expect("a method");
    let function = model.function(method).expect("it is generated");
    let [q, v, a] = state.map(|x| x.as_slice().iter().map(|&x| Rounded(x)).collect::<Vec<_>>());
    let inputs = Inputs {
        q,
        v,
        a: a.clone(),
        u: a,
        x: vec![],
        modes: vec![],
        parameters: vec![],
        passed: vec![],
    };
    let (values, refused) = function.evaluate(inputs);
    assert_eq!(refused, None);
    let at = |i: usize| values[i].0;
    if function.shape() == Shape::Symmetric {
        let entry = |(i, j): (usize, usize)| at(i.max(j) * (i.max(j) + 1) / 2 + i.min(j));
        (0..N * N).map(|k| entry((k / N, k % N))).collect()
    } else {
        (0..values.len()).map(at).collect()
    }
}

fn agrees<const N: usize>(
    robot: &str,
    plain: &impl Dynamics<f64, N, N>,
    double: &impl Dynamics<Dd, N, N>,
) {
    let model = generated(robot);
    let mut random = Random(43);
    for _ in 0..50 {
        let narrow: State<f64, N> = [random.vector(3.0), random.vector(2.0), random.vector(5.0)];
        let state: State<Dd, N> = widen(&narrow);
        let [q, v, tau] = &state;
        let found = results(double, &state);
        for ((name, found), (_, wanted)) in found.iter().zip(results(plain, &narrow)) {
            let wanted: Vec<Dd> = wanted.into_iter().map(Dd::from_f64).collect();
            near(&format!("{robot} {name}"), found, &wanted, 1e-12);
            if Method::named(&[], name).is_ok() {
                let wanted = evaluated(&model, name, &state);
                near(&format!("{robot} {name}"), found, &wanted, 1e-26);
            }
        }
        let accelerations: SVector<Dd, N> = double.forward_dynamics(q, v, tau).expect("regular");
        let wanted = evaluated(&model, "forward_dynamics", &state);
        let what = format!("{robot} forward_dynamics");
        near(&what, accelerations.as_slice(), &wanted, 1e-26);
        let [q, v, tau] = &narrow;
        let wanted = plain.forward_dynamics(q, v, tau).expect("regular");
        let wanted = wanted.map(Dd::from_f64);
        near(&what, accelerations.as_slice(), wanted.as_slice(), 1e-12);
    }
}

#[test]
fn double_double_extends_double_precision_and_equals_the_evaluator() {
    agrees::<6>("puma560", &Puma560::<f64>::default(), &Puma560::default());
    agrees::<4>("scara4", &Scara4::<f64>::default(), &Scara4::default());
}
