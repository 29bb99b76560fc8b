//! Positions assembled from anywhere: C against the function of the runtime, in every bit.

use bgdyn_codegen::bond_graph::{self, joint_segments};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::{ASSEMBLE, Options};
use bgdyn_codegen::plan::AssemblyConditions;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::read;
use bgdyn_runtime::Cause;
use bgdyn_runtime::closure::{BranchBlock, Conditions, Mechanism, assemble};
use bgdyn_runtime::nalgebra::{SMatrix, SVector};

use crate::c_program::{CCall, CProgram, compile, compilers_for, run};
use crate::closed_mechanisms::paths;
use crate::runtime_positions::{ROOM, Reference, Vector, integrated, vector};
use crate::same_bits::{files, model, name, text_of};
use crate::values::{CNumber, close_to, state};

/// States of each mechanism.
const STATES: usize = 20;

/// Returns the conditions as the Rust module has them.
fn conditions<const NC: usize>(model: &Model) -> Conditions<NC> {
    let closed = model.bond_graph.closed.as_deref().expect("loops");
    let all = AssemblyConditions::new(&closed.closure);
    let block = |block: &bgdyn_codegen::plan::BranchConditions| BranchBlock {
        rows: block.rows.clone().leak(),
        columns: block.columns.clone().leak(),
        positive: block.positive,
        closes: block.closes,
    };
    let blocks: Vec<BranchBlock> = all.blocks.iter().map(block).collect();
    Conditions {
        rows: std::array::from_fn(|k| all.rows.get(k).copied().flatten()),
        blocks: blocks.leak(),
        joints: all.joints.leak(),
    }
}

/// Returns the assembled position, and the number that C returns.
fn assembled<T: CNumber, const NC: usize>(
    model: &Model,
    state: &Inputs<T>,
    conditions: &Conditions<NC>,
    is_free: &[bool; ROOM],
) -> (Vector<T>, i128) {
    let closed = model.bond_graph.closed.as_deref().expect("loops");
    let reference = Reference {
        model,
        parameters: state.parameters.clone(),
    };
    let joints = joint_segments(&closed.tree);
    let (rows, nt) = (closed.closure.rows.len(), closed.tree.coordinates.len());
    let nothing = vector(&[]);
    let of = Mechanism {
        residual: |q: &Vector<T>| {
            let all = reference.values(Method::ConstraintResidual, q, &nothing);
            SVector::<T, NC>::from_fn(|i, _| all.get(i).copied().unwrap_or_default())
        },
        jacobian: |q: &Vector<T>| {
            let all = reference.values(Method::ConstraintJacobian, q, &nothing);
            SMatrix::<T, NC, ROOM>::from_fn(|i, j| match i < rows && j < nt {
                true => all[i * nt + j],
                false => T::default(),
            })
        },
        moved: |q: &Vector<T>, v: &Vector<T>| integrated(&joints, q, v),
    };
    let ends = [vector(&state.q), reference.neutral()];
    let closing = assemble(ends, conditions, is_free, &of);
    let (nq, nr) = (model.mechanism.nq(), closed.closure.loops.len());
    let q = closing.q;
    let number = match closing.refused.map(|pivot| Cause::of_pivot(pivot, ROOM)) {
        None => -i128::from(q.iter().any(|x| !x.is_finite())),
        Some((Cause::NotAssembled, index)) => (index - ROOM + nq + 1) as i128,
        Some((Cause::Branch, index)) => (index - ROOM + nq + 1 + nq + nr) as i128,
        Some(other) => panic!("{other:?}"),
    };
    (q, number)
}

/// Compares assembly from states, and with some velocities free; adds to the counts of closed positions, of loops that
/// remain open, and of those on another branch.
fn check<T: CNumber, const NC: usize>(name: &str, model: &Model, counts: &mut [usize; 3]) {
    let closed = model.bond_graph.closed.as_deref().expect("loops");
    let (nq, nt) = (model.mechanism.nq(), closed.tree.coordinates.len());
    let nr = closed.closure.loops.len();
    let mut program = CProgram::of(
        model,
        vec![CCall {
            name: ASSEMBLE.into(),
            arguments: vec!["q", "is_free"],
            reads_parameters: true,
            size: nq,
            is_checked: true,
            is_struct: false,
        }],
    );
    program.arrays = vec![("q", nq), ("is_free", nt)];
    let dependents: Vec<usize> = closed.closure.dependents().map(|j| j.0).collect();
    let mut random = Random(20_261_129);
    let states = (0..STATES).map(|k| {
        let mut state = state::<T>(&mut random, model, [0.5, 2.0, 6.0][k % 3]);
        if k % 2 == 0 {
            close_to(&mut state, model, &mut random, [0.05, 0.5, 1.5][k % 3]);
        }
        if k == 7 {
            state.q[0] = T::from_f64(f64::NAN);
        }
        // All, the dependent ones, or some: with only the dependent ones free, guesses end on the other branch.
        let is_free: [bool; ROOM] = std::array::from_fn(|j| match k % 4 {
            0 => j < nt,
            1 | 2 => dependents.contains(&j),
            _ => j < nt && random.unit() < 0.7,
        });
        (state, is_free)
    });
    let states: Vec<(Inputs<T>, [bool; ROOM])> = states.collect();
    let rows = states.iter().map(|(state, is_free)| {
        let is_free = is_free[..nt].iter();
        let is_free = is_free.map(|one| T::from_f64(f64::from(u8::from(*one))));
        let q = state.q.iter().copied();
        q.chain(is_free)
            .chain(state.parameters.iter().copied())
            .collect()
    });
    let rows: Vec<Vec<T>> = rows.collect();
    let conditions = conditions::<NC>(model);
    let answers = states
        .iter()
        .map(|(state, is_free)| assembled(model, state, &conditions, is_free));
    let answers: Vec<(Vector<T>, i128)> = answers.collect();
    for (_, number) in &answers {
        counts[match number {
            0 => 0,
            _ if *number > (nq + nr) as i128 => 2,
            _ => 1,
        }] += 1;
    }
    let files = files(model, &[("float", T::NAME)]);
    for compiler in compilers_for(&files) {
        let compiled = compile::<T>(&compiler, &format!("{name}_assembled"), &files, &program);
        let found = run(&compiled, &rows);
        assert_eq!(found.len(), states.len());
        for ((found, (q, number)), (state, is_free)) in found.iter().zip(&answers).zip(&states) {
            let what = format!("{compiler}: {name}\n{state:?}\n{:?}", &is_free[..nt]);
            assert_eq!(found[0], *number, "{what}");
            assert_eq!(found.len(), nq + 1);
            for (k, word) in found[1..].iter().enumerate() {
                let found = T::of_bits(u64::try_from(*word).expect("a word"));
                assert!(found.equals(q[k]), "{k}: {found:?} for {:?}, {what}", q[k]);
            }
        }
    }
}

/// Loops and contacts of every kind; joints that may not move; guesses from which no position is found.
#[test]
fn from_anywhere() {
    let mut counts = [0; 3];
    for path in paths() {
        let (text, stem) = text_of(&path);
        let (mechanism, _) = read(&text, Some(&stem));
        let graph = bond_graph::build(&mechanism.expect("a sound spec"));
        let options = Options {
            methods: Some(vec![ASSEMBLE.into()]),
            ..Options::default()
        };
        if !options.assembles(&graph) {
            continue;
        }
        let (name, model) = (name(&path), model(&path, &options));
        let closed = model.bond_graph.closed.as_deref().expect("loops");
        match closed.closure.rows.len() {
            0..=4 => {
                check::<f64, 4>(&name, &model, &mut counts);
                check::<f32, 4>(&name, &model, &mut counts);
            }
            5..=12 => {
                check::<f64, 12>(&name, &model, &mut counts);
                check::<f32, 12>(&name, &model, &mut counts);
            }
            _ => {
                check::<f64, 40>(&name, &model, &mut counts);
                check::<f32, 40>(&name, &model, &mut counts);
            }
        }
    }
    assert!(
        counts[0] > 200 && counts[1] > 50 && counts[2] > 5,
        "{counts:?}"
    );
}
