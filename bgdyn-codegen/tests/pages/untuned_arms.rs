//! Checks arms that were not used for tuning: inverse dynamics takes at least 15 % fewer operations than
//! the plain recursion in link axes with base parameters of `common/baseline.rs`.
//!
//! `docs/outside.md` contains the counts. After an intended change:
//! `BGDYN_WRITE=1 cargo test -p bgdyn-codegen --test pages untuned_arms`.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use crate::common::baseline::{Moment, Zero, inverse_dynamics, operations};
use crate::common::rng::Rng;
use crate::common::{Robot, State, assert_close, golden, natural_effort};
use bgdyn_codegen::expr::{Inputs, Operations, evaluate};
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

/// The required saving relative to the baseline.
const LESS: f64 = 0.15;

/// Of double-double results, relative to their natural size.
const EXACT: f64 = 1e-26;

/// Specs of `tests/outside`, with descriptions.
const ARMS: [(&str, &str); 9] = [
    ("rx90", "Stäubli RX-90"),
    ("kr6", "KUKA KR 6 R900"),
    ("kr6_symmetric", "the same, links symmetric about a plane"),
    ("offset_wrist", "6R, axes of the wrist do not meet"),
    ("general6r", "6R, general angles and lengths"),
    ("wam7", "Barrett WAM, 7R"),
    ("gantry_arm", "PPPRRR gantry"),
    ("column_arm", "PRRRRR column"),
    ("two_arms", "waist and two arms, 11R"),
];

/// Robots of the golden files with the counts of two other generators of the same recursion:
/// OpenSYMORO with base parameters, and a study made before this project.
const KNOWN: [(&str, usize, usize); 7] = [
    ("scara_rrpr", 71, 83),
    ("stanford_gen", 473, 470),
    ("puma_gen", 541, 566),
    ("puma_arm", 341, 366),
    ("ur5_gen", 536, 535),
    ("panda_gen", 649, 648),
    ("iiwa_gen", 614, 613),
];

fn total(o: &Operations) -> usize {
    o.mul + o.add
}

fn arm(name: &str) -> Robot {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/outside");
    let path = folder.join(name).with_extension("yaml");
    Robot::read(&fs::read_to_string(path).expect("a spec"), Some(name))
}

/// The baseline is inverse dynamics, in every form.
fn check(robot: &Robot, seed: u64) {
    let mut rng = Rng::new(seed);
    let state = State::random(&mut rng, &robot.motions());
    let literal = state.value(&robot.whole("literal", Method::InverseDynamics));
    let size = EXACT * natural_effort(robot, &state);
    for moment in [Moment::Tensor, Moment::PseudoInertia] {
        for zero in [Zero::Jxx, Zero::Jyy, Zero::Dzz] {
            let (graph, outputs) = inverse_dynamics(&robot.mechanism, moment, zero);
            let inputs: Inputs<Dd> = state.inputs();
            let found = evaluate(&graph, &outputs, &inputs, &mut None);
            let what = || format!("{}, {moment:?}, {zero:?}", robot.mechanism.name());
            assert_close(&found, &literal, size, what);
        }
    }
}

#[test]
fn the_baseline_is_inverse_dynamics() {
    for (k, (name, _)) in ARMS.iter().enumerate() {
        check(&arm(name), 40_000 + k as u64);
    }
    for (k, (name, ..)) in KNOWN.iter().enumerate() {
        check(&golden::robot(name), 41_000 + k as u64);
    }
}

#[test]
fn the_baseline_counts_what_others_count() {
    for (name, symbolic, study) in KNOWN {
        let found = total(&operations(&golden::robot(name).mechanism, Moment::Tensor)) as f64;
        let near = |other: usize, share: f64| (found / other as f64 - 1.0).abs() <= share;
        assert!(near(study, 0.02), "{name}: {found}, {study} in the study");
        // OpenSYMORO has a few more simplifications for parallel axes.
        assert!(
            near(symbolic, 0.18),
            "{name}: {found}, {symbolic} by OpenSYMORO"
        );
    }
}

#[test]
fn arms_outside_the_table() {
    let mut text = String::from(
        "# Arms outside the table\n\n\
         Arms that the generator was not tuned on, all with general tensors and centres of mass except \
         the one that says otherwise; their specs are in \
         [`bgdyn-codegen/tests/outside/`](../bgdyn-codegen/tests/outside). The baseline is Newton and \
         Euler's recursion in link axes with base parameters: numbers folded, products with 0 and 1 \
         left out, equal expressions shared, and nothing else. The test makes it by itself, finds it \
         equal to equation (6), and finds the counts of other generators of that recursion with it on \
         the robots of [the table](performance.md). Beside it stands the same with the moment as the \
         skew part of U·D, one of the steps beyond it. Multiplications and additions are counted as \
         there.\n\n\
         | arm | inverse dynamics | baseline | fewer | with U·D | fewer | mass matrix | forward dynamics | ∂τ/∂q, ∂τ/∂v |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for (name, what) in ARMS {
        let robot = arm(name);
        let made = |method| robot.function("recursion", method).operations();
        let inverse = made(Method::InverseDynamics);
        let mut row = format!(
            "| {what} | **{}** ({}/{}) |",
            total(&inverse),
            inverse.mul,
            inverse.add
        );
        for moment in [Moment::Tensor, Moment::PseudoInertia] {
            let plain = operations(&robot.mechanism, moment);
            let less = 1.0 - total(&inverse) as f64 / total(&plain) as f64;
            if moment == Moment::Tensor {
                assert!(less >= LESS, "{name}: {inverse}, baseline {plain}");
            }
            let (sum, m, a) = (total(&plain), plain.mul, plain.add);
            write!(row, " {sum} ({m}/{a}) | {:.1} % |", 100.0 * less).unwrap();
        }
        for method in [
            Method::MassMatrix,
            Method::ForwardDynamics,
            Method::InverseDynamicsDerivatives,
        ] {
            let function = robot.chosen(method).operations();
            write!(
                row,
                " {} ({}/{}) |",
                total(&function),
                function.mul,
                function.add
            )
            .unwrap();
        }
        writeln!(text, "{row}").unwrap();
    }
    text += "\nTo write this page again: `BGDYN_WRITE=1 cargo test -p bgdyn-codegen --test pages untuned_arms`; \
             without `BGDYN_WRITE` the test fails where the page is not up to date, or where less \
             than 15 % is saved against the baseline.\n";
    let page: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/outside.md");
    if std::env::var_os("BGDYN_WRITE").is_some() {
        fs::write(&page, &text).expect("the page is written");
    }
    let found = fs::read_to_string(&page).expect("docs/outside.md");
    assert!(found == text, "docs/outside.md is not up to date:\n{text}");
}
