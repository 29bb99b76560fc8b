//! How positions change with velocities, and how they close: C against the functions of the runtime.

use bgdyn_codegen::bond_graph::{self, ClosedTree, JointSegment, joint_segments};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::plan::{dependent_joint, independent_positions};
use bgdyn_codegen::random::Random;
use bgdyn_codegen::read;
use bgdyn_runtime::ACTUATORS;
use bgdyn_runtime::closure::{self, Dependent};
use bgdyn_runtime::manifold;
use bgdyn_runtime::nalgebra::SVector;

use crate::c_program::{CCall, CProgram, compile, compilers, numbers, run};
use crate::closed_mechanisms::paths;
use crate::same_bits::{files, model, name, text_of};
use crate::values::{CNumber, close_to, state};

/// Room for the positions and velocities of every mechanism here.
const ROOM: usize = 64;

/// States of each mechanism.
const STATES: usize = 48;

type Vector<T> = SVector<T, ROOM>;

/// A mechanism, with the arguments that its functions read beside positions and velocities.
struct Reference<'a, T> {
    model: &'a Model,
    parameters: Vec<T>,
}

impl<T: CNumber> Reference<'_, T> {
    fn function(&self, method: Method, q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
        let inputs = Inputs {
            q: q.as_slice().to_vec(),
            v: v.as_slice().to_vec(),
            parameters: self.parameters.clone(),
            ..Inputs::default()
        };
        let function = self.model.function(method).expect("a usual method");
        vector(&function.evaluate(inputs).0)
    }

    fn dependents(&self, closed: &ClosedTree) -> Vec<Dependent> {
        let all = closed.closure.closing();
        all.map(|j| dependent_joint(closed, j)).collect()
    }

    /// Returns the closed position, and the number of the cause if there is none.
    fn close(&self, closed: &ClosedTree, q: Vector<T>) -> (closure::Closing<Vector<T>>, i128) {
        let dependents = self.dependents(closed);
        let step = |q: &Vector<T>| self.function(Method::ClosingStep, q, &vector(&[]));
        let closing = match closed.closure.nonholonomic() {
            false => closure::close(q, &dependents, step),
            true => {
                let joints = joint_segments(&closed.tree);
                let moved = |q: &Vector<T>, v: &Vector<T>| integrated(&joints, q, v);
                closure::close_along(q, &dependents, step, moved)
            }
        };
        let nq = self.model.mechanism.nq();
        let cause = match closing.refused {
            Some(cause) => (cause % ACTUATORS - ROOM + nq + 1) as i128,
            None => -i128::from(closing.q.iter().any(|x| !x.is_finite())),
        };
        (closing, cause)
    }

    /// Returns the position after velocities, and the number of the cause if there is none.
    fn integrate(&self, q: &Vector<T>, dv: &Vector<T>) -> (Vector<T>, i128) {
        let Some(closed) = self.model.bond_graph.closed.as_deref() else {
            let joints = joint_segments(&self.model.bond_graph);
            return (integrated(&joints, q, dv), 0);
        };
        let joints = joint_segments(&closed.tree);
        let rates = |q: &Vector<T>| self.function(Method::TreeVelocity, q, dv);
        let moved = |q: &Vector<T>, v: &Vector<T>| integrated(&joints, q, v);
        let (found, others) = match closed.closure.nonholonomic() {
            false => (moved(q, &rates(q)), independent_positions(closed)),
            true => (closure::follow(q, rates, moved), Vec::new()),
        };
        if self.model.function(Method::ClosingStep).is_none() {
            return (found, 0);
        }
        let (closing, cause) = self.close(closed, found);
        let q = closing.or_nan(&self.dependents(closed), &others);
        let is_wild = q.iter().any(|x| !x.is_finite());
        (
            q,
            if cause > 0 {
                cause
            } else {
                -i128::from(is_wild)
            },
        )
    }

    fn position_rates(&self, q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
        match self.model.bond_graph.closed.as_deref() {
            None => rates(&joint_segments(&self.model.bond_graph), q, v),
            Some(closed) => {
                let moved = self.function(Method::TreeVelocity, q, v);
                rates(&joint_segments(&closed.tree), q, &moved)
            }
        }
    }

    fn neutral(&self) -> Vector<T> {
        if let Some(closed) = self.model.bond_graph.closed.as_deref() {
            let start = closed.closure.start.iter().map(|x| T::from_f64(x.hi()));
            return vector(&start.collect::<Vec<T>>());
        }
        let joints = joint_segments(&self.model.bond_graph);
        let nothing = vector(&[]);
        joint_by_joint(
            &joints,
            &nothing,
            &nothing,
            &|joint, q, _| match joint.manifold {
                "spherical" => manifold::spherical::neutral().to_vec(),
                "floating" => manifold::floating::neutral().to_vec(),
                _ => q.to_vec(),
            },
        )
    }

    fn normalize(&self, q: &Vector<T>) -> Vector<T> {
        let graph = &self.model.bond_graph;
        let joints = match graph.closed.as_deref() {
            None => joint_segments(graph),
            Some(closed) => joint_segments(&closed.tree),
        };
        joint_by_joint(&joints, q, &vector(&[]), &|joint, q, _| {
            normalized(joint, q)
        })
    }
}

fn vector<T: CNumber>(values: &[T]) -> Vector<T> {
    let mut all = Vector::repeat(T::from_f64(0.0));
    all.as_mut_slice()[..values.len()].copy_from_slice(values);
    all
}

fn array<T: Copy, const N: usize>(values: &[T]) -> [T; N] {
    values.try_into().expect("the joint's own components")
}

/// A function of a joint's own positions and velocities.
type OfJoint<T> = dyn Fn(&JointSegment, &[T], &[T]) -> Vec<T>;

/// Returns the positions of the joints from those of each, its velocities, and all velocities.
fn joint_by_joint<T: CNumber>(
    joints: &[JointSegment],
    q: &Vector<T>,
    v: &Vector<T>,
    of: &OfJoint<T>,
) -> Vector<T> {
    let (mut found, mut at) = (Vec::new(), 0);
    for joint in joints {
        let own = &q.as_slice()[found.len()..found.len() + joint.nq];
        let term = |&(j, ratio): &(usize, f64)| T::from_f64(ratio) * v[j];
        let led = joint.leaders.iter().map(term).reduce(|x, y| x + y);
        let moved = match led {
            Some(sum) => vec![sum],
            None => v.as_slice()[at..at + joint.nv].to_vec(),
        };
        found.extend(of(joint, own, &moved));
        at += joint.nv;
    }
    vector(&found)
}

fn normalized<T: CNumber>(joint: &JointSegment, q: &[T]) -> Vec<T> {
    match joint.manifold {
        "spherical" => manifold::spherical::normalize(array(q)).to_vec(),
        "floating" => manifold::floating::normalize(array(q)).to_vec(),
        _ => q.to_vec(),
    }
}

fn integrated<T: CNumber>(joints: &[JointSegment], q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
    joint_by_joint(joints, q, v, &|joint, q, d| {
        let unit = if joint.any_length {
            normalized(joint, q)
        } else {
            q.to_vec()
        };
        match joint.manifold {
            "spherical" => manifold::spherical::integrate(array(&unit), array(d)).to_vec(),
            "floating" => manifold::floating::integrate(array(&unit), array(d)).to_vec(),
            "planar" => manifold::planar::integrate(array(&unit), array(d)).to_vec(),
            _ => q.iter().zip(d).map(|(&q, &d)| q + d).collect(),
        }
    })
}

fn rates<T: CNumber>(joints: &[JointSegment], q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
    joint_by_joint(joints, q, v, &|joint, q, v| {
        let unit = if joint.any_length {
            normalized(joint, q)
        } else {
            q.to_vec()
        };
        match joint.manifold {
            "spherical" => manifold::spherical::position_rates(array(q), array(v)).to_vec(),
            "floating" => {
                let [turned, own] =
                    [&unit[..], q].map(|q| manifold::floating::position_rates(array(q), array(v)));
                turned[..3].iter().chain(&own[3..]).copied().collect()
            }
            "planar" => manifold::planar::position_rates(array(q), array(v)).to_vec(),
            _ => v.to_vec(),
        }
    })
}

/// What C must give: the number that it returns, and the positions.
type Answer<T> = (i128, Vector<T>);

/// Compares all functions of positions, in every bit; returns how many positions closed and how many were refused.
fn check<T: CNumber>(name: &str, model: &Model) -> [usize; 2] {
    let (closed, nq) = (model.bond_graph.closed.as_deref(), model.mechanism.nq());
    let closes = model.function(Method::ClosingStep).is_some();
    let is_closed = closed.is_some();
    let call = |name: &str, arguments: &[&'static str], is_checked: bool| CCall {
        name: name.into(),
        arguments: arguments.to_vec(),
        reads_parameters: is_closed && !matches!(name, "neutral" | "normalize"),
        size: nq,
        is_checked,
    };
    let mut calls = vec![
        call("neutral", &[], false),
        call("normalize", &["q"], false),
        call("position_rates", &["q", "v"], false),
        call("integrate", &["q", "v"], closes),
    ];
    calls.extend(closes.then(|| call("close", &["q"], true)));
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
        states.push(state);
    }
    let program = CProgram::of(model, calls);
    let rows: Vec<Vec<T>> = states.iter().map(numbers).collect();
    let (files, mut counts) = (files(model, &[("float", T::NAME)]), [0, 0]);
    for compiler in compilers() {
        let called = format!("{name}_positions");
        let compiled = compile::<T>(&compiler, &called, &files, &program);
        for (state, found) in states.iter().zip(run(&compiled, &rows)) {
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
                let (closing, cause) = reference.close(closed, q);
                counts[usize::from(cause != 0)] += 1;
                answers.push((cause, closing.q));
            }
            let mut found = found.into_iter();
            for (call, (cause, q)) in program.calls.iter().zip(answers) {
                let what = format!("{compiler}: {name}: {}\n{state:?}", call.name);
                let status = found.next();
                let values: Vec<i128> = found.by_ref().take(nq).collect();
                assert_eq!(status, Some(cause), "{what}");
                for (k, (word, q)) in values.into_iter().zip(q.iter()).enumerate() {
                    let found = T::of_bits(u64::try_from(word).expect("a word"));
                    assert!(
                        found.equals(*q),
                        "position {k}: {found:?} for {q:?}, {what}"
                    );
                }
            }
            assert_eq!(found.next(), None);
        }
    }
    counts
}

/// Joints with several velocities, with quaternions of length 1 and of any length; followers; helices.
#[test]
fn trees() {
    for path in [
        "specs/constraints/gear_pair.yaml",
        "specs/constraints/mimic_gripper.yaml",
        "specs/constraints/carousel.yaml",
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
        let model = model(path, &Options::default());
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

/// Positions that close, and positions that do not.
#[test]
fn closed_mechanisms() {
    let mut counts = [0, 0];
    for path in paths() {
        let model = model_of_positions(&path);
        for found in [
            check::<f64>(&name(&path), &model),
            check::<f32>(&name(&path), &model),
        ] {
            counts = [counts[0] + found[0], counts[1] + found[1]];
        }
    }
    assert!(counts[0] > 500 && counts[1] > 50, "{counts:?}");
}
