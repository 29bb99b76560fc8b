//! `bgdyn eval`: evaluates a method at given states.

mod arguments;
mod closed;
mod scene;
mod states;

use anyhow::Result;
use bgdyn_codegen::bond_graph::{BondGraph, Coordinate};
use bgdyn_codegen::engine::{Callable, Status};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::mechanism::{LinkId, Mechanism, Motion};
use bgdyn_codegen::method::{Argument, Entries, Method, PARAMETER_NAMES, Shape};
use bgdyn_codegen::plan::operational_pivot_names;
use bgdyn_runtime::Cause;
use serde_json::{Value, json};

pub(crate) use self::arguments::Eval;

use self::closed::{closed, not_actuated, singular_loop};
use self::states::{Failure, finite, parameters, plain, singular, states};
use crate::spec_file::SpecFile;
use crate::usage::Usage;

/// Largest deviation of a quaternion's length from 1.
const LENGTH: f64 = 1e-6;

impl Eval {
    pub(crate) fn run(self) -> Result<()> {
        let options = self.choice.options()?;
        let file = SpecFile::open(&self.file)?;
        if file.is_scene() {
            return self.scene(&file.scene()?, &options);
        }
        let mechanism = file.mechanism()?;
        let graph = bgdyn_codegen::bond_graph::build(&mechanism);
        let method = Method::named(&graph, &self.method).map_err(Usage)?;
        let parameters = parameters(mechanism.parameters(), &self.parameters)?;
        let states = states(&self.states)?;
        let function = bgdyn_codegen::selection::function(&mechanism, method, &options)
            .ok_or_else(|| Usage(format!("this formulation does not know `{}`", self.method)))?;
        let prepared = self.engine.engine()?.prepare(&function);
        let call = MethodCall {
            mechanism: &mechanism,
            graph: &graph,
            method,
            prepared: &*prepared,
            parameters: &parameters,
        };
        let value = |state: &Value| evaluate(&call, state);
        self.report(vec![], &states, value)?;
        self.engine.tell(&*prepared);
        Ok(())
    }
}

fn field(argument: Argument) -> &'static str {
    match argument {
        Argument::Tau | Argument::TreeTau | Argument::ActuatedTau => "tau_in",
        other => other.name(),
    }
}

/// Returns the names of the parameters of the bodies of regressors.
fn body_parameters(graph: &BondGraph) -> Vec<String> {
    let bodies = graph.moving_links().into_iter();
    let of = |link: LinkId| {
        let body = &graph.frames[link.0].name;
        PARAMETER_NAMES.map(|name| format!("{body}.{name}"))
    };
    bodies.flat_map(of).collect()
}

/// A method of a mechanism.
struct MethodCall<'a> {
    mechanism: &'a Mechanism,
    graph: &'a BondGraph,
    method: Method,
    prepared: &'a dyn Callable,
    parameters: &'a [f64],
}

fn evaluate(call: &MethodCall<'_>, state: &Value) -> Result<Value, Failure> {
    let (mechanism, graph, method) = (call.mechanism, call.graph, call.method);
    let names = |of: &[Coordinate]| of.iter().map(|c| c.name.clone()).collect::<Vec<String>>();
    let own = names(&graph.coordinates);
    // The velocities of the open tree, for mechanisms with loops.
    let closed = graph.closed.as_deref();
    let of_tree = closed.map_or_else(Vec::new, |closed| names(&closed.tree.coordinates));
    let rates = match method.of_tree() {
        true => &of_tree,
        false => &own,
    };
    let drives = mechanism.actuated_names();
    let mut inputs = Inputs {
        parameters: call.parameters.to_vec(),
        ..Inputs::default()
    };
    for &argument in method.arguments() {
        let values = match argument {
            // `tau` may be the effort of the state's own motion: `tau_in` has priority.
            Argument::Q => positions(mechanism, state)?,
            Argument::ActuatedTau => {
                let given = state.get("tau_in").map_or("tau", |_| "tau_in");
                vector(&drives, state, given)?
            }
            Argument::Tau | Argument::TreeTau if state.get("tau_in").is_none() => {
                vector(rates, state, "tau")?
            }
            Argument::BodyParameters => vector(&body_parameters(graph), state, "pi")?,
            // Adjoints have the same field.
            // The third direction may be called `da` for both dynamics.
            Argument::AlongTau if state.get("dtau").is_none() => vector(rates, state, "da")?,
            Argument::Direction if state.get("s").is_none() => vector(rates, state, "l")?,
            _ => vector(rates, state, field(argument))?,
        };
        match argument {
            Argument::Q => inputs.q = values,
            Argument::V | Argument::TreeV => inputs.v = values,
            Argument::A | Argument::ReferenceA => inputs.a = values,
            Argument::ReferenceV => inputs.x = values,
            Argument::Direction | Argument::BodyParameters => inputs.u = values,
            Argument::AlongQ | Argument::Cotangent => inputs.x = values,
            Argument::AlongV => inputs.modes = values,
            Argument::AlongA => inputs.u = values,
            Argument::AlongTau => inputs.a = values,
            Argument::Tau | Argument::TreeTau | Argument::ActuatedTau => inputs.u = values,
            _ => return Err(plain("only a scene's function has this argument".into())),
        }
    }
    let (values, status) = call.prepared.value(&(&inputs).into());
    if let Status::Refused(joint) = status {
        let results = match method {
            Method::ActuatedInverse(number) => number,
            _ => rates.len(),
        };
        let loops = mechanism.closure().map_or(0, |closure| closure.loops.len());
        let (cause, index) = Cause::of_pivot(joint, results);
        return Err(match cause {
            Cause::Pivot => singular(&rates[index]),
            Cause::Posture => {
                let direction = operational_pivot_names(closed, graph)[index];
                plain(format!("the direction `{direction}` {cause}"))
            }
            Cause::Actuators => not_actuated(&own[index - results - loops]),
            _ => singular_loop(mechanism.closure(), index - results, cause),
        });
    }
    if let Status::NotFinite(_) = status {
        return Err(plain(
            "the result is not finite: the input is too large".into(),
        ));
    }
    Ok(shaped(method.shape(), (own.len(), of_tree.len()), &values))
}

/// Returns the positions. A quaternion whose length differs from 1 by up to [`LENGTH`] is scaled to
/// length 1; other lengths are refused, unless the joint accepts any length.
fn positions(mechanism: &Mechanism, state: &Value) -> Result<Vec<f64>, Failure> {
    let names = mechanism.position_names();
    let mut q = vector(&names, state, "q")?;
    for joint in mechanism.compound_joints() {
        let Motion::Compound(motion) = joint.kind.motion else {
            continue;
        };
        let (Some(first), false) = (motion.quaternion(), joint.degrees.any_length) else {
            continue;
        };
        let at = joint.degrees.positions[first].0;
        let own = &mut q[at..at + 4];
        let length = own.iter().map(|x| x * x).sum::<f64>().sqrt();
        if (length - 1.0).abs() > LENGTH {
            let message = format!(
                "the quaternion of `{}` (x, y, z, w in `q[{at}..{}]`) has length {length}, not 1",
                joint.name,
                at + 4
            );
            return Err(Failure {
                joint: Some(joint.name.clone()),
                message,
            });
        }
        own.iter_mut().for_each(|x| *x /= length);
    }
    match mechanism.closure() {
        None => Ok(q),
        Some(closure) => closed(closure, &q),
    }
}

/// Returns a state's array of numbers, one for each name.
fn vector(names: &[String], state: &Value, array: &str) -> Result<Vec<f64>, Failure> {
    let Some(Value::Array(values)) = state.get(array) else {
        return Err(plain(format!("no array `{array}`")));
    };
    if values.len() != names.len() {
        return Err(plain(format!(
            "`{array}` has {} components instead of {}",
            values.len(),
            names.len()
        )));
    }
    let mut numbers = Vec::new();
    for (j, value) in values.iter().enumerate() {
        match finite(value) {
            Some(x) => numbers.push(x),
            None => {
                let message = format!("`{array}[{j}]` is not a finite number");
                return Err(Failure {
                    joint: Some(names[j].clone()),
                    message,
                });
            }
        }
    }
    Ok(numbers)
}

/// Returns forces and moments.
fn wrenches(values: &[f64]) -> Value {
    let each = values.chunks(6).map(|values| {
        let (force, moment) = values.split_at(3);
        json!({ "force": force, "moment": moment })
    });
    json!(each.collect::<Vec<_>>())
}

/// Returns a rotation, row by row, and a point.
fn pose(values: &[f64]) -> Value {
    let (rotation, translation) = values.split_at(9);
    let rows: Vec<&[f64]> = rotation.chunks(3).collect();
    json!({ "rotation": rows, "translation": translation })
}

fn shaped(shape: Shape, (nv, nt): (usize, usize), values: &[f64]) -> Value {
    let rows = |values: &[f64], columns: usize| {
        json!(
            values
                .chunks(columns.max(1))
                .map(<[f64]>::to_vec)
                .collect::<Vec<_>>()
        )
    };
    let squares = |values: &[f64]| -> Vec<Value> {
        values
            .chunks((nv * nv).max(1))
            .map(|square| rows(square, nv))
            .collect()
    };
    let slopes = |values: &[f64]| {
        let (by_q, others) = values.split_at(nv * nt);
        let mut all = vec![rows(by_q, nt)];
        all.extend(squares(others));
        json!(all)
    };
    match shape {
        Shape::Scalar => json!(values[0]),
        Shape::Vector | Shape::CheckedVector | Shape::Spatial | Shape::Drives(_) => json!(values),
        Shape::CheckedActuated(_) => json!(values),
        Shape::Parts | Shape::CheckedParts => json!(values),
        Shape::Bundle | Shape::CheckedBundle => json!(values),
        Shape::Symmetric => {
            let entry = |i: usize, j: usize| values[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
            let row = |i: usize| (0..nv).map(|j| entry(i, j)).collect::<Vec<_>>();
            json!((0..nv).map(row).collect::<Vec<_>>())
        }
        Shape::TreeVector | Shape::RowVector | Shape::CheckedTree => json!(values),
        Shape::CheckedTreeAndRows => {
            let (accelerations, multipliers) = values.split_at(nt);
            json!({ "accelerations": accelerations, "multipliers": multipliers })
        }
        Shape::CheckedWrenches => wrenches(&values[nv..]),
        Shape::LinkWrenches => wrenches(values),
        Shape::Square | Shape::Jacobian | Shape::TreeMatrix => rows(values, nv),
        Shape::VectorTriple => rows(values, nv),
        Shape::Checked(entries) => {
            let all = entries.spread(&values[nv..], nv);
            match entries {
                Entries::Joints | Entries::VectorTriple => rows(&all, nv),
                Entries::Task | Entries::TaskColumns => rows(&all, 6),
                Entries::TaskVector => json!(all),
                Entries::Symmetric(columns) | Entries::Columns(columns) => rows(&all, columns),
                Entries::ParameterColumns(_) => rows(&all, all.len() / nv.max(1)),
            }
        }
        Shape::Point => json!(values),
        Shape::PointJacobian | Shape::Rows(_) => rows(values, nv),
        Shape::Numbers(_) => json!(values),
        Shape::RowMatrix => rows(values, nt),
        Shape::ParameterColumns(_) => rows(values, values.len() / nv.max(1)),
        Shape::ParameterVector(_) => json!(values),
        Shape::SquarePair | Shape::FourSquares => json!(squares(values)),
        Shape::FourCubes => {
            let cubes = values.chunks((nv * nv * nv).max(1));
            json!(cubes.map(squares).collect::<Vec<_>>())
        }
        Shape::CheckedSquares => json!(squares(&values[nv..])),
        Shape::SlopesByTree => slopes(values),
        Shape::CheckedSlopesByTree => slopes(&values[nv..]),
        Shape::Pose => pose(values),
        Shape::Poses(_) => {
            let each = values.chunks(Shape::Pose.len(nv)).map(pose);
            json!(each.collect::<Vec<_>>())
        }
    }
}
