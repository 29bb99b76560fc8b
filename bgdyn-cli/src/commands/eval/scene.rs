//! `bgdyn eval` on scenes: evaluates their functions at given states.
//!
//! A state's vectors are arrays in the order of the generated names, or objects by name; missing values
//! are those of the scene's start, or 0 without one.

use anyhow::Result;
use bgdyn_codegen::engine::{Callable, Status};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::options::Preference;
use bgdyn_codegen::scene::QuasiJoint;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::{Cause, Dd};
use serde_json::{Value, json};

use super::arguments::Eval;
use super::closed::{closed, singular_loop};
use super::states::{Failure, finite, parameters, plain, singular, states};
use crate::usage::Usage;

impl Eval {
    /// Evaluates a function of a scene.
    pub(super) fn scene(&self, system: &SceneEquations, options: &Options) -> Result<()> {
        if options.formulation.is_some() || options.prefer != Preference::Operations {
            let message = "`--formulation` and `--prefer` are of mechanisms: a scene has one way to each of its functions";
            return Err(Usage(message.into()).into());
        }
        let mut roles = system.roles_with(true, true);
        if system.has_input_jacobian() {
            roles.push(SceneFunction::InputJacobian);
        }
        let role = roles.iter().copied().find(|r| r.name() == self.method);
        let role = role.ok_or_else(|| {
            let known: Vec<&str> = roles.iter().map(|r| r.name()).collect();
            let (method, known) = (&self.method, known.join(", "));
            Usage(format!(
                "this scene has no function `{method}`; it has {known}"
            ))
        })?;
        let parameters = parameters(&system.scene.parameters, &self.parameters)?;
        let states = states(&self.states)?;
        let engine = self.engine.engine()?;
        let prepare = |role| engine.prepare(&system.function(role));
        let call = SceneCall {
            system,
            role,
            parameters,
            function: prepare(role),
            inputs: roles
                .contains(&SceneFunction::Inputs)
                .then(|| prepare(SceneFunction::Inputs)),
            names: SceneNames::of(system),
        };
        self.report(call.result_names(), &states, |state| call.value(state))?;
        self.engine.tell(&*call.function);
        Ok(())
    }
}

/// The names of a scene's numbers.
struct SceneNames {
    state: Vec<String>,
    modes: Vec<String>,
    inputs: Vec<String>,
    coordinates: Vec<String>,
}

impl SceneNames {
    fn of(system: &SceneEquations) -> Self {
        let layout = &system.scene.layout;
        let modes = layout.modes.iter().map(|m| format!("{}_mode", m.name));
        let coordinates = layout.coordinates.iter().map(|c| c.name.clone());
        SceneNames {
            state: layout.state_names().map(str::to_owned).collect(),
            modes: modes.collect(),
            inputs: layout.inputs.iter().map(|i| i.name.clone()).collect(),
            coordinates: coordinates.collect(),
        }
    }
}

/// A function of a scene, and the names of its arguments.
struct SceneCall<'a> {
    system: &'a SceneEquations,
    role: SceneFunction,
    parameters: Vec<f64>,
    function: Box<dyn Callable>,
    /// The inputs that the scene drives, if it has inputs.
    inputs: Option<Box<dyn Callable>>,
    names: SceneNames,
}

impl SceneCall<'_> {
    /// Returns the names of the result's parts.
    fn result_names(&self) -> Vec<String> {
        let (layout, names) = (&self.system.scene.layout, &self.names);
        let parts = |parts: &[bgdyn_codegen::scene::Variable]| {
            parts.iter().map(|p| p.name.clone()).collect::<Vec<_>>()
        };
        let named = |named: &[bgdyn_codegen::system::Named]| {
            named.iter().map(|n| n.name.clone()).collect::<Vec<_>>()
        };
        match self.role {
            SceneFunction::Derivative | SceneFunction::Jacobian | SceneFunction::InputJacobian => {
                names.state.clone()
            }
            SceneFunction::ToCanonical
            | SceneFunction::FromCanonical
            | SceneFunction::CanonicalRates => names.state.clone(),
            SceneFunction::Inverse => names.coordinates.clone(),
            SceneFunction::Inputs => names.inputs.clone(),
            SceneFunction::Events => parts(&layout.events),
            SceneFunction::Contacts => parts(&layout.modes),
            SceneFunction::RigidContactStates
            | SceneFunction::RigidContactMaps
            | SceneFunction::RigidContactBiases => layout.rigid_contacts.clone(),
            SceneFunction::Power | SceneFunction::Energy => named(&self.system.entries),
            SceneFunction::Outputs => named(&self.system.outputs),
            SceneFunction::PositionRates | SceneFunction::ClosingStep => {
                layout.positions.iter().map(|p| p.name.clone()).collect()
            }
        }
    }

    fn value(&self, state: &Value) -> Result<Value, Failure> {
        let at = self.arguments(state)?;
        let (values, status) = self.function.value(&(&at).into());
        match status {
            Status::Done => Ok(self.shaped(&at, &values)),
            Status::Refused(j) => {
                let layout = &self.system.scene.layout;
                let rates = layout.nv() + layout.nx();
                let closure = self.system.scene.mechanism.closure();
                Err(match Cause::of_pivot(j, rates) {
                    (Cause::Pivot, j) => singular(&self.names.coordinates[j]),
                    (cause, i) => singular_loop(closure, i - rates, cause),
                })
            }
            Status::NotFinite(_) => Err(plain(
                "the result is not finite: the input is too large, or outside of what the scene can be in".into(),
            )),
        }
    }

    fn arguments(&self, state: &Value) -> Result<Inputs<f64>, Failure> {
        let layout = &self.system.scene.layout;
        let (nq, nv) = (layout.nq(), layout.nv());
        let start = &self.system.initial;
        let numbers = |x: &[bgdyn_runtime::Dd]| x.iter().map(|x| x.to_f64()).collect::<Vec<_>>();
        let begin = [&start.q, &start.v, &start.x].map(|x| numbers(x)).concat();
        let canonical = matches!(
            self.role,
            SceneFunction::FromCanonical | SceneFunction::CanonicalRates
        );
        let key = if canonical { "z" } else { "y" };
        if canonical && state.get(key).is_none() {
            return Err(plain(
                "no `z`: the state with momenta in place of velocities".into(),
            ));
        }
        let mut y = vector(state, key, &self.names.state, begin)?;
        self.unit_quaternions(&mut y[..nq])?;
        let closure = self.system.scene.mechanism.closure();
        if let Some(closure) = closure.filter(|_| self.role != SceneFunction::ClosingStep) {
            let q = closed(closure, &y[..closure.start.len()])?;
            y[..q.len()].copy_from_slice(&q);
        }
        let modes = vector(state, "modes", &self.names.modes, numbers(&start.modes))?;
        let a = vec![0.0; nv];
        let t = match state.get("t") {
            None => 0.0,
            Some(t) => finite(t).ok_or_else(|| plain("`t` is not a finite number".into()))?,
        };
        let mut at = Inputs {
            q: y[..nq].to_vec(),
            v: y[nq..nq + nv].to_vec(),
            a: vector(state, "acceleration", &self.names.coordinates, a)?,
            x: y[nq + nv..].to_vec(),
            modes,
            parameters: self.parameters.clone(),
            t: Some(t),
            ..Inputs::default()
        };
        let none = vec![0.0; layout.inputs.len()];
        at.u = vector(state, "given", &self.names.inputs, none)?;
        // These functions compute the driven inputs themselves.
        let driving = matches!(
            self.role,
            SceneFunction::Inputs | SceneFunction::Jacobian | SceneFunction::CanonicalRates
        );
        if driving {
            return Ok(at);
        }
        if state.get("input").is_some() {
            let none = vec![0.0; layout.inputs.len()];
            at.u = vector(state, "input", &self.names.inputs, none)?;
        } else if let (false, Some(inputs)) = (canonical, &self.inputs) {
            at.u = inputs.value(&(&at).into()).0;
        }
        Ok(at)
    }

    /// Divides quaternions by their length.
    ///
    /// # Errors
    /// A quaternion that is no orientation, with its length.
    fn unit_quaternions(&self, q: &mut [f64]) -> Result<(), Failure> {
        let layout = &self.system.scene.layout;
        if layout.quasi_joints.is_empty() {
            return Ok(());
        }
        let mut positions: Vec<Dd> = q.iter().map(|&x| Dd::from_f64(x)).collect();
        let wrong = layout.unit_quaternions(&mut positions);
        let message = |(joint, length): (&QuasiJoint, f64)| joint.wrong_length(length);
        let messages: Vec<String> = wrong.into_iter().map(message).collect();
        if !messages.is_empty() {
            return Err(plain(messages.join("; ")));
        }
        for (q, unit) in q.iter_mut().zip(positions) {
            *q = unit.to_f64();
        }
        Ok(())
    }

    /// Returns the result in printed form.
    fn shaped(&self, at: &Inputs<f64>, values: &[f64]) -> Value {
        let rows = |n: usize| json!(values.chunks(n).collect::<Vec<_>>());
        match self.role {
            SceneFunction::Derivative => {
                let layout = &self.system.scene.layout;
                let (own, coupled) = values.split_at(layout.nv() + layout.nx());
                let mut coupled = coupled.iter().copied();
                let rates = layout.positions.iter().map(|p| match p.coordinate {
                    Some(j) => at.v[j],
                    None => coupled.next().unwrap_or(f64::NAN),
                });
                json!(rates.chain(own.iter().copied()).collect::<Vec<f64>>())
            }
            SceneFunction::ToCanonical | SceneFunction::FromCanonical => {
                json!([&at.q[..], values, &at.x[..]].concat())
            }
            SceneFunction::Power | SceneFunction::RigidContactBiases => rows(3),
            SceneFunction::Contacts => rows(4),
            SceneFunction::RigidContactStates => rows(6),
            SceneFunction::RigidContactMaps => rows(6 * self.system.scene.layout.nv()),
            SceneFunction::Jacobian => self.jacobian(values),
            SceneFunction::InputJacobian => self.input_jacobian(values),
            _ => json!(values),
        }
    }

    /// Returns ∂ẏ/∂u row by row.
    fn input_jacobian(&self, values: &[f64]) -> Value {
        let layout = &self.system.scene.layout;
        let (own, inputs) = (layout.nv() + layout.nx(), layout.inputs.len());
        let rows = own + layout.coupled().len();
        let row = |at: usize| -> Vec<f64> { (0..inputs).map(|k| values[k * rows + at]).collect() };
        let mut coupled = own..;
        let of_positions = layout
            .positions
            .iter()
            .map(|position| match position.coordinate {
                Some(_) => vec![0.0; inputs],
                None => row(coupled.next().unwrap_or_default()),
            });
        let positions: Vec<Vec<f64>> = of_positions.collect();
        json!(
            positions
                .into_iter()
                .chain((0..own).map(row))
                .collect::<Vec<_>>()
        )
    }

    /// Returns ∂ẏ/∂y row by row, and ∂ẏ/∂t.
    fn jacobian(&self, values: &[f64]) -> Value {
        let n = self.names.state.len();
        let rows = self.system.scene.layout.jacobian_rows(values);
        json!({
            "along_state": rows.iter().map(|row| &row[..n]).collect::<Vec<_>>(),
            "along_time": rows.iter().map(|row| row[n]).collect::<Vec<_>>(),
        })
    }
}

/// Returns the numbers of an array, or of an object by name; `usual` are the defaults.
fn vector(
    state: &Value,
    key: &str,
    names: &[String],
    usual: Vec<f64>,
) -> Result<Vec<f64>, Failure> {
    let number = |name: &str, value: &Value| {
        finite(value).ok_or_else(|| plain(format!("`{key}`: `{name}` is not a finite number")))
    };
    match state.get(key) {
        None => Ok(usual),
        Some(Value::Array(values)) if values.len() == names.len() => {
            let named = names.iter().zip(values);
            named.map(|(name, value)| number(name, value)).collect()
        }
        Some(Value::Array(values)) => {
            let (found, wanted) = (values.len(), names.len());
            Err(plain(format!(
                "`{key}` has {found} components instead of {wanted}: {}",
                names.join(", ")
            )))
        }
        Some(Value::Object(parts)) => {
            let mut all = usual;
            for (name, value) in parts {
                let i = names.iter().position(|n| n == name).ok_or_else(|| {
                    let known = names.join(", ");
                    plain(format!("`{key}` has no part `{name}`; there are {known}"))
                })?;
                all[i] = number(name, value)?;
            }
            Ok(all)
        }
        Some(_) => Err(plain(format!("`{key}` is neither an array nor an object"))),
    }
}
