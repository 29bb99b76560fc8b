//! How positions change with velocities, and how they close: C against the functions of the runtime.

use bgdyn_codegen::bond_graph;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::mechanism::closure::{PolygonForm, closing_polygons};
use bgdyn_codegen::method::Method;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::read;

use crate::c_program::{CCall, CProgram, compile, compilers_for, run};
use crate::closed_mechanisms::paths;
use crate::runtime_positions::{Reference, Vector, vector};
use crate::same_bits::{files, model, name, text_of};
use crate::values::{CNumber, close_to, state};

/// States of each mechanism.
const STATES: usize = 48;

/// What C must give: the number that it returns, and the positions.
type Answer<T> = (i128, Vector<T>);

/// Compares all functions of positions, in every bit; returns how many positions closed and how many were refused.
fn check<T: CNumber>(name: &str, model: &Model) -> [usize; 2] {
    let closed = model.bond_graph.closed.as_deref();
    let (nq, nv) = (model.mechanism.nq(), model.mechanism.nv());
    let closes = model.function(Method::ClosingStep).is_some();
    let is_closed = closed.is_some();
    let call = |name: &str, arguments: &[&'static str], is_checked: bool| CCall {
        name: name.into(),
        arguments: arguments.to_vec(),
        reads_parameters: is_closed && !matches!(name, "neutral" | "normalize" | "difference"),
        size: if name == "difference" { nv } else { nq },
        is_checked,
        is_struct: false,
    };
    let mut calls = vec![
        call("neutral", &[], false),
        call("normalize", &["q"], false),
        call("position_rates", &["q", "v"], false),
        call("integrate", &["q", "v"], closes),
    ];
    calls.extend(closes.then(|| call("close", &["q"], true)));
    calls.extend((nv > 0).then(|| call("difference", &["q", "q0"], false)));
    let samples = match closed {
        Some(closed) => closes || closed.closure.position_rows().is_empty(),
        None => nv > 0,
    };
    calls.extend(samples.then(|| call("sample", &["u"], false)));
    let mut random = Random(20_261_128);
    let mut states: Vec<Inputs<T>> = Vec::new();
    for k in 0..STATES {
        let reach = [1.0, 3.0][k % 2];
        let mut state = state::<T>(&mut random, model, reach);
        if k % 6 != 5 {
            close_to(&mut state, model, &mut random, [0.0, 0.02, 0.3][k % 3]);
        }
        let size = [0.01, 0.3, 1.0, 0.0][k % 4];
        state.v.iter_mut().for_each(|v| *v = *v * T::from_f64(size));
        let wild = [f64::NAN, f64::INFINITY].get(k.wrapping_sub(13)).copied();
        if let (Some(wild), Some(q)) = (wild, state.q.get_mut(k % nq.max(1))) {
            *q = T::from_f64(wild);
        }
        states.push(state);
    }
    // From another state, or from the same one.
    let starts = (0..STATES).map(|k| {
        states[if k % 5 == 0 { k } else { (k + 1) % STATES }]
            .q
            .clone()
    });
    let starts: Vec<Vec<T>> = starts.collect();
    let units = (0..STATES).map(|_| (0..nv).map(|_| T::from_f64(random.unit())).collect());
    let units: Vec<Vec<T>> = units.collect();
    let mut program = CProgram::of(model, calls);
    program.arrays.extend([("q0", nq), ("u", nv)]);
    let row = |((state, start), units): ((&Inputs<T>, &Vec<T>), &Vec<T>)| {
        let parts = [
            &state.q,
            &state.v,
            &state.a,
            &state.u,
            start,
            units,
            &state.parameters,
        ];
        parts.into_iter().flatten().copied().collect()
    };
    let rows: Vec<Vec<T>> = states.iter().zip(&starts).zip(&units).map(row).collect();
    let (files, mut counts) = (files(model, &[("float", T::NAME)]), [0, 0]);
    for compiler in compilers_for(&files) {
        let called = format!("{name}_positions");
        let compiled = compile::<T>(&compiler, &called, &files, &program);
        let all = states.iter().zip(&starts).zip(&units);
        for (((state, start), units), found) in all.zip(run(&compiled, &rows)) {
            let reference = Reference {
                model,
                parameters: state.parameters.clone(),
            };
            let (q, v) = (vector(&state.q), vector(&state.v));
            let (integrated, cause) = reference.integrate(&q, &v);
            let mut answers: Vec<Answer<T>> = vec![
                (0, reference.neutral()),
                (0, reference.normalize(&q)),
                (0, reference.position_rates(&q, &v)),
                (if closes { cause } else { 0 }, integrated),
            ];
            if let (true, Some(closed)) = (closes, closed) {
                let (closing, cause) = reference.close(closed, q, None);
                counts[usize::from(cause != 0)] += 1;
                answers.push((cause, closing.q));
            }
            answers.extend((nv > 0).then(|| (0, reference.difference(&q, &vector(start)))));
            answers.extend(samples.then(|| (0, reference.sample(&vector(units)))));
            let mut found = found.into_iter();
            for (call, (cause, q)) in program.calls.iter().zip(answers) {
                let what = format!("{compiler}: {name}: {}\n{state:?}", call.name);
                let status = found.next();
                let values: Vec<i128> = found.by_ref().take(call.size).collect();
                assert_eq!(status, Some(cause), "{what}");
                for (k, (word, q)) in values.into_iter().zip(q.iter()).enumerate() {
                    let found = T::of_bits(u64::try_from(word).expect("a word"));
                    assert!(
                        found.equals(*q),
                        "component {k}: {found:?} for {q:?}, {what}"
                    );
                }
            }
            assert_eq!(found.next(), None);
        }
    }
    counts
}

/// Joints with several velocities, with quaternions of length 1 and of any length; helices.
#[test]
fn trees() {
    for path in [
        "tests/golden/joints/planar_base_ur5.yaml",
        "tests/golden/joints/satellite_arm6.yaml",
        "tests/golden/joints/helical_universal_test.yaml",
        "tests/golden/joints/spherical_chain3.yaml",
        "tests/golden/joints/quadrotor_arm.yaml",
        "tests/free_joints/boom.yaml",
        "tests/free_joints/any_length.yaml",
        "tests/free_joints/coupled.yaml",
        "specs/scara.yaml",
    ] {
        let model = model_of_positions(path);
        check::<f64>(&name(path), &model);
        check::<f32>(&name(path), &model);
    }
}

/// Returns a model with the functions that positions are computed by, as far as the mechanism has them.
fn model_of_positions(path: &str) -> Model {
    let (text, stem) = text_of(path);
    let (mechanism, _) = read(&text, Some(&stem));
    let graph = bond_graph::build(&mechanism.expect("a sound spec"));
    let read = [Method::ClosingStep, Method::TreeVelocity, Method::Gravity];
    let possible = Method::possible_of(&graph).into_iter();
    let methods = possible.filter(|method| read.contains(method));
    let options = Options {
        methods: Some(
            methods
                .map(|method| method.name_in(graph.closed.as_deref(), &graph.sites))
                .collect(),
        ),
        ..Options::default()
    };
    model(path, &options)
}

/// Positions that close, and positions that do not; in closed form and by Newton's method. Followers.
#[test]
fn closed_mechanisms() {
    let (mut counts, mut forms) = ([0, 0], [0; 3]);
    for path in paths() {
        let model = model_of_positions(&path);
        let closed = model.bond_graph.closed.as_deref();
        for polygon in closed.iter().flat_map(|c| closing_polygons(&c.closure).0) {
            forms[match polygon.form {
                PolygonForm::Triangle { .. } => 0,
                PolygonForm::Slider { .. } => 1,
                PolygonForm::Cylinder { .. } => 2,
            }] += 1;
        }
        for found in [
            check::<f64>(&name(&path), &model),
            check::<f32>(&name(&path), &model),
        ] {
            counts = [counts[0] + found[0], counts[1] + found[1]];
        }
    }
    assert!(counts[0] > 500 && counts[1] > 50, "{counts:?}");
    assert!(forms.iter().all(|count| *count > 0), "{forms:?}");
}
