//! The example `c_controller`: its table is that of the same loop by the evaluator, in Rust.

use std::path::Path;
use std::process::Command;

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::model::Model;

use crate::c_program::{compilers, write};
use crate::same_bits::{files, model, selected};

const STEPS: usize = 1000;
const PERIOD: f64 = 1e-3;
const PARTS: usize = 4;
const W: f64 = 16.0;
const FROM: [f64; 4] = [0.4, -1.1, 0.03, 0.0];
const TO: [f64; 4] = [-0.5, 1.2, 0.12, 1.5];
const OFF: [f64; 4] = [0.03, -0.05, 0.004, 0.08];

type Vector = [f64; 4];

fn sum(a: Vector, factor: f64, b: Vector) -> Vector {
    std::array::from_fn(|i| a[i] + factor * b[i])
}

/// Returns the path at a fraction of its time, with its first and second derivatives.
fn path(x: f64) -> [Vector; 3] {
    let along = |rate: f64| std::array::from_fn(|i| rate * (TO[i] - FROM[i]));
    let seconds = STEPS as f64 * PERIOD;
    let (x2, x3) = (x * x, x * x * x);
    [
        sum(FROM, 1.0, along(10.0 * x3 - 15.0 * x3 * x + 6.0 * x3 * x2)),
        along((30.0 * x2 - 60.0 * x3 + 30.0 * x2 * x2) / seconds),
        along((60.0 * x - 180.0 * x2 + 120.0 * x3) / (seconds * seconds)),
    ]
}

/// Returns the errors every 100 steps.
fn errors(inverse: &Function, forward: &Function) -> Vec<Vector> {
    let evaluate = |function: &Function, [q, v, a, u]: [Vector; 4]| -> Vector {
        let [q, v, a, u] = [q, v, a, u].map(|x| x.to_vec());
        let (values, refused) = function.evaluate(Inputs {
            q,
            v,
            a,
            u,
            ..Inputs::default()
        });
        assert_eq!(refused, None);
        std::array::from_fn(|i| values[i])
    };
    let zero = [0.0; 4];
    let (mut q, mut v) = (sum(FROM, -1.0, OFF), zero);
    let mut errors = Vec::new();
    for k in 0..=STEPS {
        let [q_path, v_path, a_path] = path(k as f64 / STEPS as f64);
        let (e, rate) = (sum(q_path, -1.0, q), sum(v_path, -1.0, v));
        if k % 100 == 0 {
            errors.push(e);
        }
        let a = sum(sum(a_path, 2.0 * W, rate), W * W, e);
        let tau = evaluate(inverse, [q, v, a, zero]);
        let h = PERIOD / PARTS as f64;
        for _ in 0..PARTS {
            let a = evaluate(forward, [q, v, zero, tau]);
            let (q1, v1) = (sum(q, h, v), sum(v, h, a));
            let a1 = evaluate(forward, [q1, v1, zero, tau]);
            (q, v) = (
                sum(sum(q, 0.5 * h, v), 0.5 * h, v1),
                sum(sum(v, 0.5 * h, a), 0.5 * h, a1),
            );
        }
    }
    errors
}

fn named<'a>(model: &'a Model, name: &str) -> &'a Function {
    let found = model.functions.iter().find(|f| f.name() == name);
    found.expect("a method of the model")
}

#[test]
fn the_controller_in_c_is_the_evaluators() {
    let names = ["inverse_dynamics", "forward_dynamics"];
    let model = model("specs/scara.yaml", &selected(&names));
    let [inverse, forward] = names.map(|name| named(&model, name));
    let expected = errors(inverse, forward);
    let main = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/c_controller/main.c");
    for compiler in compilers() {
        let folder = write(&format!("controller_{compiler}"), &files(&model, &[]));
        let mut compile = Command::new(&compiler);
        compile
            .current_dir(&folder)
            .args(["-std=c99", "-O2", "-ffp-contract=off", "-I."]);
        let status = compile
            .arg(&main)
            .args(["scara.c", "-o", "program", "-lm"])
            .status();
        assert!(status.expect("it runs").success(), "{compiler}");
        let output = Command::new(folder.join("program"))
            .output()
            .expect("it runs");
        let text = String::from_utf8(output.stdout).expect("text");
        assert!(output.status.success(), "{compiler}: {text}");
        let rows: Vec<Vec<f64>> = text.lines().filter_map(row).collect();
        assert_eq!(rows.len(), expected.len(), "{compiler}: {text}");
        for (row, expected) in rows.iter().zip(&expected) {
            for (i, (&found, expected)) in row[1..=4].iter().zip(expected).enumerate() {
                // Seven digits are printed; sums in another order differ in the last of sixteen.
                let allowed = 1e-6 * expected.abs() + 1e-12;
                assert!(
                    (found - expected).abs() <= allowed,
                    "{compiler}, joint {i}: {row:?}"
                );
            }
        }
    }
}

/// Returns the numbers of a row of the table; `None` for other lines.
fn row(line: &str) -> Option<Vec<f64>> {
    let numbers = line.split_whitespace().map(str::parse);
    let numbers: Result<Vec<f64>, _> = numbers.collect();
    numbers.ok().filter(|numbers| numbers.len() == 6)
}
