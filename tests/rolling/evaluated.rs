//! Compiled code computes what the evaluator computes from the expressions.

use bgdyn::nalgebra::SVector;
use bgdyn_codegen::bond_graph::build;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;

use crate::laws::numbers;
use crate::snakeboard::{NQ, NV, Snakeboard};

fn model(text: &str) -> Model {
    let (mechanism, faults) = bgdyn_codegen::read(text, Some("snakeboard"));
    let mechanism = mechanism.unwrap_or_else(|| panic!("{}", faults.render("spec", text)));
    assert!(build(&mechanism).closed.is_some());
    let options = Options {
        derivatives: true,
        ..Options::default()
    };
    bgdyn_codegen::selection::model(mechanism, &options).expect("a model")
}

#[test]
fn compiled_code_computes_what_the_evaluator_does() {
    let text = include_str!("../../specs/constraints/snakeboard.yaml");
    let (model, compiled) = (model(text), Snakeboard::<f64>::default());
    let mut random = Random(31);
    for _ in 0..5 {
        let q: SVector<f64, NQ> = numbers(&mut random, 1.0);
        let [v, a, tau] = [2.0, 3.0, 5.0].map(|size| numbers::<f64, NV>(&mut random, size));
        let inputs = Inputs {
            q: q.iter().copied().collect(),
            v: v.iter().copied().collect(),
            a: a.iter().copied().collect(),
            u: tau.iter().copied().collect(),
            ..Inputs::default()
        };
        let evaluated = |name: &str| -> Vec<f64> {
            let mut all = model.functions.iter();
            let function = all.find(|f| f.name() == name).expect("a function");
            function.evaluate(inputs.clone()).0
        };
        let check = |name: &str, found: &[f64]| {
            let expected = evaluated(name);
            assert_eq!(found.len(), expected.len(), "{name}");
            let size = expected.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
            for (x, y) in found.iter().zip(&expected) {
                assert!(
                    (x - y).abs() <= 8.0 * f64::EPSILON * size,
                    "{name}: {x} {y}"
                );
            }
        };
        check(
            "inverse_dynamics",
            compiled.inverse_dynamics(&q, &v, &a).as_slice(),
        );
        check("bias", compiled.bias(&q, &v).as_slice());
        let accelerations = compiled.forward_dynamics(&q, &v, &tau).expect("regular");
        check("forward_dynamics", accelerations.as_slice());
        check("kinetic_energy", &[compiled.kinetic_energy(&q, &v)]);
        check("tree_velocity", compiled.tree_velocity(&q, &v).as_slice());
        check(
            "tree_acceleration",
            compiled.tree_acceleration(&q, &v, &a).as_slice(),
        );
        check("multipliers", compiled.multipliers(&q, &v, &a).as_slice());
        // Matrices are row by row in the evaluator.
        check(
            "velocity_map",
            compiled.velocity_map(&q).transpose().as_slice(),
        );
        let (by_q, by_v) = compiled.inverse_dynamics_derivatives(&q, &v, &a);
        let both = [by_q.transpose().as_slice(), by_v.transpose().as_slice()].concat();
        check("inverse_dynamics_derivatives", &both);
        let (by_q, by_v, by_tau) = compiled
            .forward_dynamics_derivatives(&q, &v, &tau)
            .expect("regular");
        let by_q = by_q.transpose();
        let [by_v, by_tau] = [by_v, by_tau].map(|m| m.transpose());
        let all = [
            accelerations.as_slice(),
            by_q.as_slice(),
            by_v.as_slice(),
            by_tau.as_slice(),
        ];
        check("forward_dynamics_derivatives", &all.concat());
        let rows = compiled.constraint_jacobian(&q).transpose();
        check("constraint_jacobian", rows.as_slice());
    }
}
