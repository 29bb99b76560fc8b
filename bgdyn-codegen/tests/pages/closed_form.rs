//! Tests closed-form equations: the printed text is parsed and compared with the recursion, and must have
//! textbook form; `docs/equations.md` shows it.
//!
//! After an intended change: `BGDYN_WRITE=1 cargo test -p bgdyn-codegen --test pages closed_form`.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use crate::common::parameters::{parametrised, values};
use crate::common::printed::{Printed, evaluate};
use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, State, assert_close, natural_effort};
use bgdyn_codegen::closed_form::{LIMIT, NoClosedForm, closed_form, latex, text};
use bgdyn_codegen::files::stem;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

/// Number of digits that preserves an `f64`.
const ALL: usize = 17;

/// Relative to an upper bound of all terms: the letters' values are parsed in `f64`.
const TOLERANCE: f64 = 1e-12;

/// The specs that are too long for a closed form.
const LONG: [&str; 5] = ["panda", "puma560", "stanford", "torso", "ur5"];

fn root(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

fn spec(name: &str) -> Robot {
    let path = root(&format!("specs/{name}.yaml"));
    let text = fs::read_to_string(&path).expect("a spec");
    Robot::read(&text, Some(name))
}

fn names() -> Vec<String> {
    let entries = fs::read_dir(root("specs")).expect("a folder");
    let mut paths: Vec<PathBuf> = entries.map(|e| e.expect("an entry").path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "yaml"));
    paths.sort();
    paths.iter().map(|path| stem(path)).collect()
}

/// The printed equations give the efforts of the recursion in some states.
fn check(what: &str, robot: &Robot, printed: &Printed, rng: &mut Rng) {
    let recursion = robot.chosen(Method::InverseDynamics);
    for _ in 0..20 {
        let mut state = State::random(rng, &robot.motions());
        state.parameters = values(&robot.mechanism, rng);
        let parameters = robot.mechanism.parameters().iter();
        let set: BTreeMap<String, f64> = parameters
            .zip(&state.parameters)
            .map(|(p, &x)| (p.name.clone(), x))
            .collect();
        let read = printed.efforts(&state, &set);
        let known: Vec<f64> = state
            .value::<Dd>(&recursion)
            .iter()
            .map(|x| x.to_f64())
            .collect();
        let tolerance = TOLERANCE * natural_effort(robot, &state);
        assert_close(&read, &known, tolerance, || what.to_owned());
    }
    let letters = &mut printed.letters.clone();
    for (name, sum, value) in &printed.constants {
        let defined = evaluate(sum, letters);
        let off = (defined - value).abs();
        assert!(off <= 1e-13 * value.abs(), "{what}: {name} is {defined}");
        letters.insert(name.clone(), *value);
    }
}

#[test]
fn what_is_printed_is_the_inverse_dynamics() {
    let mut rng = Rng::new(1);
    for name in names() {
        let robot = spec(&name);
        let form = match closed_form(&robot.mechanism, LIMIT) {
            Ok(form) => form,
            Err(refused) => {
                assert!(LONG.contains(&name.as_str()), "{name}: {refused}");
                continue;
            }
        };
        assert!(!LONG.contains(&name.as_str()), "{name} is short");
        let printed = Printed::read(&text(&form, ALL));
        assert_eq!(printed.efforts.len(), robot.nv(), "{name}");
        check(&name, &robot, &printed, &mut rng);
    }
}

/// Random trees with all structural features; half of them with run-time parameters.
#[test]
fn random_mechanisms() {
    let mut written = 0;
    for seed in 0..60 {
        let mut rng = Rng::new(seed);
        let mut draft = Draft::random(&mut rng, 2);
        if seed % 2 == 1 {
            draft = parametrised(&draft, &mut rng);
        }
        let yaml = draft.yaml();
        let robot = Robot::read(&yaml, None);
        let Ok(form) = closed_form(&robot.mechanism, LIMIT) else {
            continue;
        };
        written += 1;
        let text = text(&form, ALL);
        let what = format!("seed {seed}\n{yaml}\n{text}");
        check(&what, &robot, &Printed::read(&text), &mut rng);
        balanced(&latex(&form, 6));
    }
    assert!(written > 40, "{written}");
}

fn shown(name: &str) -> String {
    let form = closed_form(&spec(name).mechanism, LIMIT).expect("a short one");
    text(&form, 6)
}

#[test]
fn cart_and_pole() {
    insta::assert_snapshot!(shown("cart_pole"));
}

#[test]
fn double_pendulum() {
    insta::assert_snapshot!(shown("double_pendulum"));
}

#[test]
fn two_link_arm() {
    insta::assert_snapshot!(shown("elastic_arm"));
}

#[test]
fn scara() {
    insta::assert_snapshot!(shown("scara"));
}

#[test]
fn two_link_arm_in_latex() {
    let form = closed_form(&spec("elastic_arm").mechanism, LIMIT).expect("a short one");
    let written = latex(&form, 6);
    balanced(&written);
    insta::assert_snapshot!(written);
}

/// Braces, parentheses and environments are closed in the order in which they are opened.
fn balanced(latex: &str) {
    let (mut open, mut rest) = (Vec::new(), latex);
    let pairs = [
        ("\\begin{align*}", "\\end{align*}"),
        ("\\left(", "\\right)"),
        ("(", ")"),
        ("{", "}"),
    ];
    while !rest.is_empty() {
        let begun = pairs.iter().find(|(begin, _)| rest.starts_with(begin));
        let ended = pairs.iter().find(|(_, end)| rest.starts_with(end));
        let step = match (begun, ended) {
            (Some(pair), _) => {
                open.push(pair);
                pair.0.len()
            }
            (_, Some(pair)) => {
                assert_eq!(open.pop(), Some(pair), "before {rest}\n{latex}");
                pair.1.len()
            }
            _ => rest.chars().next().map_or(0, char::len_utf8),
        };
        rest = &rest[step..];
    }
    assert_eq!(open, Vec::<&(&str, &str)>::new(), "{latex}");
    assert!(latex.contains("\\begin{align*}\nP_{1} &= "), "{latex}");
}

#[test]
fn a_long_mechanism_is_refused() {
    let panda = spec("panda");
    let refused = closed_form(&panda.mechanism, LIMIT).expect_err("too long to be read");
    let soon = matches!(
        refused,
        NoClosedForm::LongSum { .. } | NoClosedForm::ManyProducts { .. }
    );
    assert!(soon, "{refused}");
    let arm = spec("elastic_arm");
    let form = closed_form(&arm.mechanism, LIMIT).expect("a short one");
    let terms = match closed_form(&arm.mechanism, 5) {
        Err(NoClosedForm::TooLong { terms }) => terms,
        other => panic!("{other:?}"),
    };
    assert!(closed_form(&arm.mechanism, terms).is_ok());
    assert_eq!(text(&form, 6), shown("elastic_arm"));
}

/// The parameter is a symbol of its own, wherever it occurs.
#[test]
fn run_time_parameters_keep_their_names() {
    let yaml = fs::read_to_string(root("specs/cart_pole.yaml")).expect("a spec");
    let yaml = yaml.replace("mass: 0.1 kg", "mass: { parameter: bob, value: 0.1 kg }");
    let robot = Robot::read(&yaml, Some("cart_pole"));
    let form = closed_form(&robot.mechanism, LIMIT).expect("a short one");
    insta::assert_snapshot!(text(&form, 6));
}

/// Returns the page with each block under a comment `<!-- NAME -->` regenerated.
fn renewed(page: &str) -> String {
    let mut pieces = page.split("<!-- ");
    let mut made = pieces.next().expect("a beginning").to_owned();
    for piece in pieces {
        let (name, rest) = piece.split_once(" -->\n```text\n").expect("a block");
        let (_, after) = rest.split_once("```\n").expect("the block's end");
        let block = shown(name);
        write!(made, "<!-- {name} -->\n```text\n{block}```\n{after}").expect("a string");
    }
    made
}

#[test]
fn the_page_holds_what_is_printed() {
    let path = root("docs/equations.md");
    let page = fs::read_to_string(&path).expect("docs/equations.md");
    let made = renewed(&page);
    assert_eq!(made.matches("<!-- ").count(), 3, "three examples");
    if std::env::var_os("BGDYN_WRITE").is_some() {
        fs::write(&path, &made).expect("the page is written");
        return;
    }
    assert!(page == made, "docs/equations.md is not up to date:\n{made}");
}
