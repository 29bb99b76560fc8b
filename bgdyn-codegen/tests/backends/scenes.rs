//! Generated C of scenes has the bits of the evaluator, in every function that a scene can have.

use std::path::Path;

use bgdyn_codegen::backend::{BackendInput, GeneratedFile, GivenOptions, backend_named};
use bgdyn_codegen::expr::{Inputs, Node, NodeId};
use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::layout::StateLayout;
use bgdyn_codegen::method::{Argument, Method, SceneFunction};
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::read_scene;
use bgdyn_codegen::selection::scene_functions;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::ACTUATORS;
use bgdyn_runtime::closure::{Dependent, close_from};
use nalgebra::SVector;

use crate::c_program::{CCall, CProgram, compile, compilers_for, run};
use crate::values::CNumber;

/// States of each scene.
const STATES: usize = 48;

/// Room for the state of every scene with loops here.
const ROOM: usize = 64;

/// A scene with its functions.
struct SceneCase {
    system: SceneEquations,
    functions: Vec<Function>,
}

fn scene(path: &str, options: &Options) -> SceneCase {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
    let text = std::fs::read_to_string(&path).expect("a scene");
    let load = |mechanism: &str| {
        std::fs::read_to_string(beside(&path, mechanism)).map_err(|e| e.to_string())
    };
    let read = read_scene(&text, &stem(&path), load);
    let (system, _) = read.unwrap_or_else(|refusal| panic!("{}: {refusal:?}", path.display()));
    let functions = scene_functions(&system, options);
    SceneCase { system, functions }
}

fn files(case: &SceneCase, real: &str) -> Vec<GeneratedFile> {
    let backend = backend_named("c").expect("a backend");
    let pairs = [("float".to_string(), real.to_string())];
    let given = GivenOptions::new("a test".into(), "c", backend.options(), pairs);
    let input = BackendInput::Scene(&case.system, &case.functions);
    let files = backend.files(&input, &given.expect("options that exist"));
    files.expect("files")
}

/// Returns the numbers of a state in the order of Rust's vectors.
fn whole<T: CNumber>(inputs: &Inputs<T>) -> Vec<T> {
    [&inputs.q, &inputs.v, &inputs.x]
        .into_iter()
        .flatten()
        .copied()
        .collect()
}

/// Returns the number and the result that C must give, in the order of Rust's vectors.
fn expected<T: CNumber>(
    function: &Function,
    layout: &StateLayout,
    inputs: &Inputs<T>,
) -> (i128, Vec<T>) {
    let Method::Scene(role) = function.method else {
        panic!("a function of the scene")
    };
    let (values, refused) = function.evaluate(inputs.clone());
    let rates = layout.nv() + layout.nx();
    let checked = match role {
        SceneFunction::Derivative => rates,
        SceneFunction::FromCanonical => layout.nv(),
        SceneFunction::CanonicalRates | SceneFunction::Jacobian => values.len(),
        _ => 0,
    };
    let is_wild = values[..checked].iter().any(|x| !x.is_finite());
    let status = refused.map_or(-i128::from(is_wild), |pivot| {
        (pivot % ACTUATORS) as i128 + 1
    });
    // Rates of positions: of one with a velocity of its own the velocity, of the others outputs.
    let with_positions = |own: &dyn Fn(usize) -> T, column: &[T]| -> Vec<T> {
        let mut coupled = column[rates..].iter();
        let of_position = |position: Option<usize>| match position {
            Some(j) => own(j),
            None => *coupled.next().expect("an output"),
        };
        let positions = layout
            .positions
            .iter()
            .map(|p| p.coordinate)
            .map(of_position);
        let positions: Vec<T> = positions.collect();
        positions
            .into_iter()
            .chain(column[..rates].iter().copied())
            .collect()
    };
    let result = match role {
        SceneFunction::Derivative => with_positions(&|j| inputs.v[j], &values),
        SceneFunction::ToCanonical | SceneFunction::FromCanonical => {
            let parts = [&inputs.q, &values, &inputs.x];
            parts.into_iter().flatten().copied().collect()
        }
        SceneFunction::Jacobian => {
            let rows = rates
                + layout
                    .positions
                    .iter()
                    .filter(|p| p.coordinate.is_none())
                    .count();
            let column = |(k, column): (usize, &[T])| {
                let slope = |j: usize| T::from_f64(f64::from(u8::from(k == layout.nq() + j)));
                with_positions(&slope, column)
            };
            let columns: Vec<Vec<T>> = values.chunks(rows).enumerate().map(column).collect();
            let (along_time, along_state) = columns.split_last().expect("a column of time");
            let row = |i: usize| along_state.iter().map(move |column| column[i]);
            let entries = (0..along_time.len()).flat_map(row);
            entries.chain(along_time.iter().copied()).collect()
        }
        _ => values,
    };
    (status, result)
}

/// Returns the call of a function; `None` if its result is empty.
fn call(function: &Function, layout: &StateLayout, size: usize) -> Option<CCall> {
    let name = |argument: &Argument| match argument {
        Argument::Time => Some("t[0]"),
        Argument::Input => Some("input").filter(|_| !layout.inputs.is_empty()),
        Argument::Modes => Some("modes").filter(|_| !layout.modes.is_empty()),
        argument => Some(argument.name()),
    };
    let arguments = function.method.arguments().iter();
    (size > 0).then(|| CCall {
        name: function.name().into(),
        arguments: arguments.filter_map(name).collect(),
        reads_parameters: true,
        size,
        is_checked: function.shape().checked(),
        is_struct: false,
    })
}

/// Returns a state beside the start, with random modes, inputs and time.
fn state<T: CNumber>(random: &mut Random, case: &SceneCase, off: f64) -> Inputs<T> {
    let (layout, initial) = (&case.system.scene.layout, &case.system.initial);
    let mut beside = |all: &[bgdyn_runtime::Dd]| -> Vec<T> {
        let number = |x: &bgdyn_runtime::Dd| T::from_f64(x.to_f64() + off * random.signed());
        all.iter().map(number).collect()
    };
    let (q, v, x) = (beside(&initial.q), beside(&initial.v), beside(&initial.x));
    let mut some = |count: usize, size: f64| -> Vec<T> {
        (0..count)
            .map(|_| T::from_f64(size * random.signed()))
            .collect()
    };
    let (a, u, t) = (
        some(layout.nv(), 9.0),
        some(layout.inputs.len(), 5.0),
        some(1, 2.0),
    );
    let modes = (0..layout.modes.len()).map(|_| (3.0 * random.unit()).floor() - 1.0);
    let modes = modes.map(T::from_f64).collect();
    let parameters = case.system.scene.parameters.iter();
    let parameters =
        parameters.map(|p| T::from_f64(p.default.to_f64() * (1.0 + 0.1 * random.unit())));
    Inputs {
        q,
        v,
        x,
        a,
        u,
        modes,
        t: t.first().copied(),
        parameters: parameters.collect(),
        ..Inputs::default()
    }
}

fn program<T: CNumber>(case: &SceneCase, calls: Vec<CCall>) -> CProgram {
    let layout = &case.system.scene.layout;
    let (modes, n) = (layout.modes.len(), layout.nq() + layout.nv() + layout.nx());
    CProgram {
        file: case.system.scene.name.clone(),
        arrays: vec![
            ("state", n + modes),
            ("acceleration", layout.nv()),
            ("input", layout.inputs.len()),
            ("z", n),
            ("modes", modes),
            ("t", 1),
        ],
        parameters: case
            .system
            .scene
            .parameters
            .iter()
            .map(|p| p.name.clone())
            .collect(),
        calls,
    }
}

fn row<T: CNumber>(state: &Inputs<T>) -> Vec<T> {
    let moving = whole(state);
    let t: Vec<T> = state.t.into_iter().collect();
    let parts = [
        &moving,
        &state.modes,
        &state.a,
        &state.u,
        &moving,
        &state.modes,
        &t,
        &state.parameters,
    ];
    parts.into_iter().flatten().copied().collect()
}

/// Returns whether the evaluator's functions are not those of the C library: exponentials, logarithms, tangents.
fn is_of_library(function: &Function) -> bool {
    let mut nodes = (0..function.graph.len()).map(|i| function.graph.node(NodeId::at(i)));
    nodes.any(|node| matches!(node, Node::Exp(_) | Node::Ln(_) | Node::Tanh(_)))
}

/// Fails unless every function has the evaluator's bits in every entry; one with exponentials nearly.
fn check<T: CNumber>(path: &str, options: &Options) {
    if cfg!(target_feature = "fma") {
        println!("skipped: Rust fuses products and sums in this build, C is compiled without");
        return;
    }
    let case = scene(path, options);
    let layout = &case.system.scene.layout;
    let mut random = Random(20_261_129);
    let states: Vec<Inputs<T>> = (0..STATES)
        .map(|k| state(&mut random, &case, [0.0, 0.1, 1.0][k % 3]))
        .collect();
    let size = |f: &Function| expected(f, layout, &states[0]).1.len();
    let functions: Vec<&Function> = case.functions.iter().filter(|f| size(f) > 0).collect();
    let mut calls: Vec<CCall> = functions
        .iter()
        .filter_map(|f| call(f, layout, size(f)))
        .collect();
    let n = layout.nq() + layout.nv() + layout.nx();
    let step = |f: &&&Function| f.method == Method::Scene(SceneFunction::ClosingStep);
    let step = functions
        .iter()
        .find(step)
        .filter(|_| !layout.closing.is_empty());
    calls.extend(step.map(|_| CCall {
        name: "close".into(),
        arguments: vec!["state"],
        reads_parameters: true,
        size: n + layout.modes.len(),
        is_checked: true,
        is_struct: false,
    }));
    let program = program::<T>(&case, calls);
    let rows: Vec<Vec<T>> = states.iter().map(row).collect();
    let files = files(&case, T::NAME);
    let name = path.replace(['/', '.'], "_");
    for compiler in compilers_for(&files) {
        let compiled = compile::<T>(&compiler, &name, &files, &program);
        for (state, found) in states.iter().zip(run(&compiled, &rows)) {
            let mut answers: Vec<(i128, Vec<T>)> = functions
                .iter()
                .map(|f| expected(f, layout, state))
                .collect();
            answers.extend(step.map(|step| closed(step, layout, state)));
            let mut found = found.into_iter();
            for (call, (status, values)) in program.calls.iter().zip(answers) {
                let what = format!("{compiler}: {path}: {}\n{state:?}", call.name);
                assert_eq!(found.next(), Some(status), "{what}");
                let named = functions.iter().find(|f| f.name() == call.name);
                let near = match named.is_some_and(|f| is_of_library(f)) {
                    true => {
                        1e4 * T::ROUNDING * values.iter().fold(0.0, |size, x| x.size().max(size))
                    }
                    false => 0.0,
                };
                for (k, value) in values.into_iter().enumerate() {
                    let word = found.next().expect("an entry");
                    let found = T::of_bits(u64::try_from(word).expect("a word"));
                    let is_equal = found.equals(value) || (found - value).size() <= near;
                    assert!(is_equal, "entry {k}: {found:?} for {value:?}, {what}");
                }
            }
            assert_eq!(found.next(), None);
        }
    }
}

/// Returns the state with closed positions by the function of the runtime, around the evaluator's Newton steps.
fn closed<T: CNumber>(step: &Function, layout: &StateLayout, state: &Inputs<T>) -> (i128, Vec<T>) {
    let dependent = |&(position, closes): &(usize, usize)| Dependent {
        velocity: position,
        position,
        closes,
    };
    let dependents: Vec<Dependent> = layout.closing.iter().map(dependent).collect();
    let y: Vec<T> = whole(state);
    let (nq, first) = (layout.nq(), layout.nv() + layout.nx());
    let vector = |values: &[T]| -> SVector<T, ROOM> {
        let at = |k: usize, _| values.get(k).copied().unwrap_or(T::from_f64(0.0));
        SVector::from_fn(at)
    };
    let newton = |y: &SVector<T, ROOM>| {
        let inputs = Inputs {
            q: y.as_slice()[..nq].to_vec(),
            ..state.clone()
        };
        vector(&step.evaluate(inputs).0)
    };
    let closing = close_from(vector(&y), &dependents, first, newton);
    let moved = &closing.q.as_slice()[..y.len()];
    let is_wild = moved[..nq].iter().any(|x| !x.is_finite());
    let status = closing.refused.map_or(-i128::from(is_wild), |cause| {
        (cause % ACTUATORS) as i128 + 1
    });
    (status, moved.iter().chain(&state.modes).copied().collect())
}

/// Friction, drives, fluids, springs, contacts with the ground; loops, wheels, floating bases.
const SCENES: [&str; 12] = [
    "specs/scenes/scara_everything.scene.yaml",
    "specs/scenes/hydraulic_cylinder.scene.yaml",
    "specs/scenes/lugre_stick_slip.scene.yaml",
    "specs/scenes/motor_linear_stiff.scene.yaml",
    "specs/scenes/puma_drives.scene.yaml",
    "specs/scenes/series_elastic_arm.scene.yaml",
    "specs/scenes/stiff_spring_pendulum.scene.yaml",
    "specs/scenes/ur5_contact.scene.yaml",
    "specs/scenes/crane.scene.yaml",
    "tests/closed_loops/crank_run.scene.yaml",
    "tests/closed_loops/slider_stop.scene.yaml",
    "tests/rolling/bicycle_run.scene.yaml",
];

#[test]
fn scenes_in_double() {
    for path in SCENES {
        check::<f64>(path, &Options::default());
    }
}

#[test]
fn scenes_in_float() {
    for path in &SCENES {
        check::<f32>(path, &Options::default());
    }
}

/// Jacobians and canonical forms.
#[test]
fn slopes_and_momenta() {
    let options = Options {
        jacobian: true,
        canonical: true,
        ..Options::default()
    };
    for path in [
        "specs/scenes/scara_friction.scene.yaml",
        "specs/scenes/motor_linear_stiff.scene.yaml",
        "specs/scenes/cart_and_pole.scene.yaml",
    ] {
        check::<f64>(path, &options);
    }
    let options = Options {
        jacobian: true,
        ..Options::default()
    };
    check::<f64>("tests/closed_loops/crank_run.scene.yaml", &options);
}
