//! `bgdyn eval`: a method's value at given states, through the evaluator.

mod scene;

use std::path::PathBuf;

use anyhow::{Result, anyhow, bail};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::mechanism::{Mechanism, Parameter};
use bgdyn_codegen::method::{Argument, Method, Shape};
use clap::Args;
use serde::Serialize;
use serde_json::{Value, json};

use crate::output::print;
use crate::quantity::value_in;
use crate::spec_file::{Choice, SpecFile, read_text, shown};
use crate::usage::Usage;

/// Evaluate a method at the states of a file, without a compiler
#[derive(Args)]
#[command(
    after_help = "Example:\n  bgdyn eval specs/scara.yaml inverse_dynamics --states states.json\n  bgdyn eval arm.yaml gravity --states states.json --parameter payload=2.5\n  bgdyn eval specs/scenes/stick_slip.scene.yaml derivative --states states.json\n\nstates.json: {\"states\": [{\"q\": [...], \"v\": [...], \"a\": [...], \"tau_in\": [...]}, ...]}\nof a scene:  {\"states\": [{\"y\": [...] or {\"shoulder\": 0.3, ...}, \"modes\", \"input\" or \"given\", \"acceleration\", \"t\"}, ...]}"
)]
pub(crate) struct Eval {
    /// The spec or the scene
    file: PathBuf,
    /// The method, as the generated code names it: of a scene `derivative`, `power`, …
    method: String,
    /// The states: fields a method does not need are ignored
    #[arg(long, value_name = "STATES.json")]
    states: PathBuf,
    #[command(flatten)]
    choice: Choice,
    /// Set a run-time parameter: `payload=500 g`; the spec's value otherwise. May be repeated
    #[arg(long = "parameter", value_name = "NAME=VALUE")]
    parameters: Vec<String>,
}

/// What is printed.
#[derive(Serialize)]
struct Report<'a> {
    function: &'a str,
    /// What the parts of a scene's results are called.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    names: Vec<String>,
    /// One value per state; null where it failed.
    results: Vec<Value>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<Refused>,
}

/// A state without a result.
#[derive(Serialize)]
struct Refused {
    state: usize,
    #[serde(flatten)]
    failure: Failure,
}

/// Why a state has no result.
#[derive(Serialize)]
struct Failure {
    joint: Option<String>,
    message: String,
}

impl Eval {
    pub(crate) fn run(self) -> Result<()> {
        let options = self.choice.options()?;
        let file = SpecFile::open(&self.file)?;
        if file.is_scene() {
            return self.scene(&file.scene()?, &options);
        }
        let mechanism = file.mechanism()?;
        let graph = bgdyn_codegen::bond_graph::build(&mechanism);
        let method = Method::named(&graph.sites, &self.method).map_err(Usage)?;
        let parameters = parameters(mechanism.parameters(), &self.parameters)?;
        let states = states(&self.states)?;
        let function = bgdyn_codegen::pipeline::function(&mechanism, method, &options)
            .ok_or_else(|| Usage(format!("this formulation does not know `{}`", self.method)))?;
        let value = |state: &Value| evaluate(&mechanism, &function, &parameters, state);
        self.report(vec![], &states, value)
    }

    /// Prints the value at each state.
    fn report(
        &self,
        names: Vec<String>,
        states: &[Value],
        value: impl Fn(&Value) -> Result<Value, Failure>,
    ) -> Result<()> {
        let mut report = Report {
            function: &self.method,
            names,
            results: Vec::new(),
            errors: Vec::new(),
        };
        for (i, state) in states.iter().enumerate() {
            let value = value(state).unwrap_or_else(|failure| {
                report.errors.push(Refused { state: i, failure });
                Value::Null
            });
            report.results.push(value);
        }
        print(&(serde_json::to_string(&report)? + "\n"))?;
        match report.errors.len() {
            0 => Ok(()),
            failed => bail!("{failed} of {} states failed", states.len()),
        }
    }
}

/// The spec's values of the run-time parameters, but for those set as `NAME=VALUE`.
fn parameters(all: &[Parameter], set: &[String]) -> Result<Vec<f64>, Usage> {
    let mut values: Vec<f64> = all.iter().map(|p| p.default.to_f64()).collect();
    let mut done: Vec<&str> = Vec::new();
    for text in set {
        let (name, value) = text
            .split_once('=')
            .ok_or_else(|| Usage(format!("`--parameter {text}`: write NAME=VALUE")))?;
        let found = all.iter().position(|p| p.name == name).ok_or_else(|| {
            let known: Vec<&str> = all.iter().map(|p| p.name.as_str()).collect();
            Usage(match known.as_slice() {
                [] => format!("no parameter `{name}`: the spec has none"),
                known => format!("no parameter `{name}`; there are {}", known.join(", ")),
            })
        })?;
        if done.contains(&name) {
            return Err(Usage(format!("the parameter `{name}` is set twice")));
        }
        done.push(name);
        let wrong = |what: String| Usage(format!("`--parameter {text}`: {what}"));
        values[found] = value_in(value, all[found].unit).map_err(wrong)?.to_f64();
    }
    Ok(values)
}

fn states(path: &std::path::Path) -> Result<Vec<Value>> {
    let text = read_text(path)?;
    let file: Value = serde_json::from_str(&without_bare_words(&text)).map_err(|e| {
        anyhow!(
            "{}:{}:{}: this is not JSON: {e}",
            shown(path),
            e.line(),
            e.column()
        )
    })?;
    match file.get("states") {
        Some(Value::Array(states)) => Ok(states.clone()),
        _ => bail!("{}:1:1: this has no array `states`", shown(path)),
    }
}

/// `NaN` and `Infinity`, as some programs write them, become `null`: no number either, but JSON.
fn without_bare_words(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    let mut quoted = false;
    while let Some(c) = rest.chars().next() {
        let word = ["-Infinity", "Infinity", "NaN"]
            .into_iter()
            .find(|w| rest.starts_with(w));
        if let (false, Some(word)) = (quoted, word) {
            out.push_str("null");
            rest = &rest[word.len()..];
            continue;
        }
        if c == '\\' && quoted {
            let two = rest.char_indices().nth(2).map_or(rest.len(), |(i, _)| i);
            out.push_str(&rest[..two]);
            rest = &rest[two..];
            continue;
        }
        quoted ^= c == '"';
        out.push(c);
        rest = &rest[c.len_utf8()..];
    }
    out
}

/// The field of a state that holds an argument.
fn field(argument: Argument) -> &'static str {
    match argument {
        Argument::Tau => "tau_in",
        other => other.name(),
    }
}

fn evaluate(
    mechanism: &Mechanism,
    function: &Function,
    parameters: &[f64],
    state: &Value,
) -> Result<Value, Failure> {
    let mut inputs = Inputs {
        parameters: parameters.to_vec(),
        ..Inputs::default()
    };
    for &argument in function.method.arguments() {
        let values = match argument {
            // `tau` may be the effort of the state's own motion: `tau_in` comes first.
            Argument::Tau if state.get("tau_in").is_none() => vector(mechanism, state, "tau")?,
            _ => vector(mechanism, state, field(argument))?,
        };
        match argument {
            Argument::Q => inputs.q = values,
            Argument::V => inputs.v = values,
            Argument::A => inputs.a = values,
            Argument::Tau => inputs.u = values,
            _ => return Err(plain("only a scene's function has this argument".into())),
        }
    }
    let (values, refused) = function.evaluate::<f64>(inputs);
    if let Some(joint) = refused {
        let joint = bgdyn_codegen::mechanism::CoordinateId(joint);
        return Err(singular(&mechanism.joint(joint).name));
    }
    if values.iter().any(|x| !x.is_finite()) {
        return Err(plain(
            "the result is not finite: the input is too large".into(),
        ));
    }
    Ok(shaped(function.shape(), mechanism.nv(), &values))
}

/// A failure that no joint is to blame for.
fn plain(message: String) -> Failure {
    Failure {
        joint: None,
        message,
    }
}

/// A finite number; one beyond the range of f64 reads as infinite.
fn finite(value: &Value) -> Option<f64> {
    let number = value.as_number()?.to_string().parse().ok();
    number.filter(|x: &f64| x.is_finite())
}

/// Joint `name` has no inertia left.
fn singular(name: &str) -> Failure {
    Failure {
        joint: Some(name.to_owned()),
        message: format!("singular mass matrix: joint `{name}` has no inertia left to accelerate"),
    }
}

fn vector(mechanism: &Mechanism, state: &Value, name: &str) -> Result<Vec<f64>, Failure> {
    let Some(Value::Array(values)) = state.get(name) else {
        return Err(plain(format!("no array `{name}`")));
    };
    if values.len() != mechanism.nv() {
        let n = mechanism.nv();
        return Err(plain(format!(
            "`{name}` has {} components instead of {n}",
            values.len()
        )));
    }
    let mut numbers = Vec::new();
    for (j, value) in values.iter().enumerate() {
        match finite(value) {
            Some(x) => numbers.push(x),
            None => {
                let joint = mechanism
                    .joint(bgdyn_codegen::mechanism::CoordinateId(j))
                    .name
                    .clone();
                let message = format!("`{name}[{j}]` is not a finite number");
                return Err(Failure {
                    joint: Some(joint),
                    message,
                });
            }
        }
    }
    Ok(numbers)
}

fn shaped(shape: Shape, nv: usize, values: &[f64]) -> Value {
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
    match shape {
        Shape::Scalar => json!(values[0]),
        Shape::Vector | Shape::CheckedVector | Shape::Spatial => json!(values),
        Shape::Parts | Shape::CheckedParts => json!(values),
        Shape::Symmetric => {
            let entry = |i: usize, j: usize| values[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
            let row = |i: usize| (0..nv).map(|j| entry(i, j)).collect::<Vec<_>>();
            json!((0..nv).map(row).collect::<Vec<_>>())
        }
        Shape::Square | Shape::Jacobian => rows(values, nv),
        Shape::SquarePair => json!(squares(values)),
        Shape::CheckedSquares => json!(squares(&values[nv..])),
        Shape::Pose => json!({
            "rotation": rows(&values[..9], 3),
            "translation": values[9..].to_vec(),
        }),
    }
}
