//! Every backend of the list: its name, its options, its files.

use std::collections::BTreeSet;

use bgdyn_codegen::backend::{
    BACKENDS, Backend, BackendError, BackendInput, GivenOptions, backend_named,
};
use bgdyn_codegen::expr::Node;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::plan::{BlockPlan, BlockStep, FunctionPlan, Tail, matrix_destinations};
use bgdyn_codegen::{read, selection};

const SCARA: &str = include_str!("../../../specs/scara.yaml");

fn scara() -> Model {
    let (mechanism, _) = read(SCARA, Some("scara"));
    let options = Options {
        derivatives: true,
        ..Options::default()
    };
    selection::model(mechanism.expect("sound"), &options).expect("known names")
}

fn given(backend: &dyn Backend, pairs: &[(&str, &str)]) -> Result<GivenOptions, BackendError> {
    let pairs = pairs
        .iter()
        .map(|(name, value)| (name.to_string(), value.to_string()));
    let (name, options) = (backend.name(), backend.options());
    GivenOptions::new("scara.yaml".into(), name, options, pairs)
}

#[test]
fn names_are_unique_and_found() {
    let names: BTreeSet<&str> = BACKENDS.iter().map(|backend| backend.name()).collect();
    assert_eq!(names.len(), BACKENDS.len());
    for backend in BACKENDS {
        let found = backend_named(backend.name()).expect("its own name");
        assert_eq!(found.name(), backend.name());
        let summaries = backend.options().iter().map(|option| option.summary);
        for summary in summaries.chain([backend.summary()]) {
            assert!(!summary.is_empty() && !summary.ends_with('.'), "{summary}");
        }
        let options: BTreeSet<&str> = backend.options().iter().map(|option| option.name).collect();
        assert_eq!(options.len(), backend.options().len());
    }
    let error = backend_named("fortran").err().expect("no such backend");
    assert!(
        BACKENDS
            .iter()
            .all(|backend| error.contains(backend.name())),
        "{error}"
    );
}

#[test]
fn unknown_options_are_refused() {
    for backend in BACKENDS {
        let error = given(backend, &[("colour", "blue")]).expect_err("no such option");
        assert!(matches!(error, BackendError::Option(_)));
        assert!(error.to_string().contains("colour"), "{error}");
    }
    for (backend, name, value) in [
        ("c", "float", "half"),
        ("c", "sincos", "table"),
        ("c", "prefix", "Arm"),
        ("rust", "module", "Arm"),
        ("rust", "plain", "perhaps"),
    ] {
        let backend = backend_named(backend).expect("a backend");
        let given = given(backend, &[(name, value)]).expect("a name that exists");
        let error = backend.files(&BackendInput::Mechanism(&scara()), &given);
        let error = error.expect_err("a value that does not exist").to_string();
        assert!(error.contains(value), "{error}");
    }
}

#[test]
fn every_backend_writes_every_function() {
    let model = scara();
    for backend in BACKENDS {
        let given = given(backend, &[]).expect("no options");
        let files = backend
            .files(&BackendInput::Mechanism(&model), &given)
            .expect("files");
        assert!(!files.is_empty());
        for file in &files {
            assert!(
                !file.name.contains('/') && file.text.ends_with('\n'),
                "{}",
                file.name
            );
            let lines = file.text.lines();
            assert!(
                lines.into_iter().all(|line| line.trim_end() == line),
                "{}",
                file.name
            );
            for function in &model.functions {
                assert!(
                    file.text.contains(function.name()),
                    "{}: {}",
                    file.name,
                    function.name()
                );
            }
        }
        assert_eq!(
            files,
            backend
                .files(&BackendInput::Mechanism(&model), &given)
                .expect("files")
        );
    }
}

/// Every step of a plan comes after the steps that compute what it reads, and every output is stored once.
#[test]
fn plans_compute_before_they_read() {
    let model = scara();
    for backend in BACKENDS {
        for function in &model.functions {
            let destinations = matrix_destinations(function.shape(), model.mechanism.nv());
            let plan = FunctionPlan::new(function, destinations, &backend.limits());
            plan.blocks
                .iter()
                .for_each(|block| check(block, function.name()));
            if let Tail::Columns(loops) = &plan.tail {
                loops
                    .iter()
                    .for_each(|plan| check(&plan.column, function.name()));
            }
        }
    }
}

fn check(block: &BlockPlan<'_>, what: &str) {
    let mut known = vec![false; block.graph.len()];
    for id in block.nodes() {
        let is_free = matches!(
            block.graph.node(id),
            Node::Leaf(_) | Node::Constant(_) | Node::Angle(..)
        );
        known[id.index()] = is_free;
    }
    let mut stored = vec![0; block.outputs.len()];
    for step in &block.steps {
        match step {
            BlockStep::Constant(_) | BlockStep::Begin(_) => {}
            BlockStep::Value(id) => {
                read_by(block, id.index(), &known, what);
                assert!(
                    !std::mem::replace(&mut known[id.index()], true),
                    "{what}: twice"
                );
            }
            BlockStep::Sines(angles) => {
                for pair in angles {
                    let found = pair.sine.iter().chain(&pair.cosine);
                    found.for_each(|id| known[id.index()] = true);
                }
            }
            BlockStep::Store(output) => {
                let node = block.outputs[*output].node.index();
                assert!(
                    known[node] || block.inline[node],
                    "{what}: stored too early"
                );
                stored[*output] += 1;
            }
        }
    }
    if block.begins() {
        for (output, count) in block.outputs.iter().zip(stored) {
            let is_constant = matches!(block.graph.node(output.node), Node::Constant(_));
            assert_eq!(count, usize::from(!is_constant), "{what}: stores");
        }
    }
}

/// Fails if the operation reads a value that is not known, with what is inline in it.
fn read_by(block: &BlockPlan<'_>, place: usize, known: &[bool], what: &str) {
    let node = block.graph.node(bgdyn_codegen::expr::NodeId::at(place));
    node.for_each_operand(|operand| match block.inline[operand.index()] {
        true => read_by(block, operand.index(), known, what),
        false => assert!(
            known[operand.index()],
            "{what}: {operand:?} is read too early"
        ),
    });
}
