//! `bgdyn ops`: prints the operation counts of generated functions.

use std::path::PathBuf;

use anyhow::Result;
use bgdyn_codegen::conditioning::rounding_error::{RoundingError, rounding_error};
use bgdyn_codegen::expr::Operations;
use bgdyn_codegen::formulation::FORMULATIONS;
use bgdyn_codegen::function::{Considered, Function};
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection::{function, scene_functions};
use bgdyn_codegen::system::SceneEquations;
use clap::Args;
use serde::{Serialize, Serializer};

use crate::output::print;
use crate::spec_file::{GeneratorArgs, SpecFile, unknown};
use crate::usage::Usage;

/// Count the operations of each generated function
#[derive(Args)]
#[command(after_help = "Example:\n  bgdyn ops specs/puma560.yaml --explain")]
pub(crate) struct Ops {
    /// The spec
    file: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Show the chosen formulation, its cost part by part, and the cost of the other plans and
    /// formulations
    #[arg(long)]
    explain: bool,
    /// For a scene: the cost of each effect, added one at a time and removed one at a time
    #[arg(long)]
    per_effect: bool,
    /// The version or path of the bgdyn crate that the timing program is built with
    #[arg(long, value_name = "PATH|VERSION", default_value = env!("CARGO_PKG_VERSION"))]
    bgdyn: String,
    #[command(flatten)]
    asked: GeneratorArgs,
}

impl Ops {
    pub(crate) fn run(self) -> Result<()> {
        let options = self.asked.options()?;
        let spec = SpecFile::open(&self.file)?;
        if spec.is_scene() {
            return self.scene(&spec.scene()?, &options);
        }
        if self.per_effect {
            let message = "`--per-effect` is for scenes: a file with `scene: 1`";
            return Err(Usage(message.into()).into());
        }
        let mechanism = spec.mechanism()?;
        let model =
            bgdyn_codegen::selection::model(mechanism.clone(), &options).map_err(unknown)?;
        let explained = self.explain.then(|| explained(&mechanism, &model));
        let bundles = model.bundles.iter().map(|bundle| bundle.function.clone());
        let functions: Vec<Function> = model.functions.iter().cloned().chain(bundles).collect();
        self.report(&functions, explained)
    }

    fn report(&self, functions: &[Function], explained: Option<Explained>) -> Result<()> {
        if !self.json {
            let words = explained.map(|all| all.0.into_iter().map(|(_, text)| text).collect());
            let words: Vec<String> = words.unwrap_or_default();
            return print(&(table(functions) + &words.concat()));
        }
        print(&(report(functions, explained)? + "\n"))
    }

    fn scene(&self, system: &SceneEquations, options: &Options) -> Result<()> {
        options.check_scene(&system.graph).map_err(unknown)?;
        if self.explain {
            let message = "`--explain` is for mechanisms; of a scene see `--per-effect`";
            return Err(Usage(message.into()).into());
        }
        if self.per_effect {
            return super::per_effect::report(system, self.json, &self.bgdyn);
        }
        self.report(&scene_functions(system, options), None)
    }
}

/// Returns the report of `bgdyn ops --json`, without explanations.
///
/// # Errors
/// Never: names and numbers can be written.
pub fn counts(functions: &[Function]) -> Result<String> {
    report(functions, None)
}

fn report(functions: &[Function], explained: Option<Explained>) -> Result<String> {
    Ok(serde_json::to_string_pretty(&OpsReport {
        functions: FunctionCounts(functions),
        explained,
    })?)
}

#[derive(Serialize)]
struct OpsReport<'a> {
    functions: FunctionCounts<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    explained: Option<Explained>,
}

/// The explanation of each function, by its name, in the module's order.
struct Explained(Vec<(String, String)>);

/// Serialises lists of lines, because strings of JSON show no line breaks.
impl Serialize for Explained {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
        serializer.collect_map(self.0.iter().map(|(name, text)| (name, lines(text))))
    }
}

/// One entry per generated function, in the module's order.
struct FunctionCounts<'a>(&'a [Function]);

impl Serialize for FunctionCounts<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|f| (f.name(), Counts::of(f))))
    }
}

#[derive(Serialize)]
struct Counts {
    mul: usize,
    add: usize,
    div: usize,
    sqrt: usize,
    sincos: usize,
    other: usize,
}

impl Counts {
    fn of(function: &Function) -> Self {
        let Operations {
            mul,
            add,
            div,
            sqrt,
            sincos,
            other,
        } = function.operations();
        Counts {
            mul,
            add,
            div,
            sqrt,
            sincos,
            other,
        }
    }
}

fn table(functions: &[Function]) -> String {
    let mut text = format!(
        "{:<30} {:>6} {:>6} {:>5} {:>5} {:>7} {:>6} {:>7}\n",
        "function", "mul", "add", "div", "sqrt", "sincos", "other", "mul+add"
    );
    for f in functions {
        let o = f.operations();
        text += &format!(
            "{:<30} {:>6} {:>6} {:>5} {:>5} {:>7} {:>6} {:>7}\n",
            f.name(),
            o.mul,
            o.add,
            o.div,
            o.sqrt,
            o.sincos,
            o.other,
            o.total()
        );
    }
    text
}

/// Explains each function: the choice, the cost of the alternatives, and the digits that each loses.
fn explained(mechanism: &Mechanism, model: &Model) -> Explained {
    let one = |f: &Function| (f.name().to_string(), explain(mechanism, model, f));
    Explained(model.functions.iter().map(one).collect())
}

fn explain(mechanism: &Mechanism, model: &Model, f: &Function) -> String {
    let lost = summary(rounding_error(f, &model.bond_graph));
    let mut text = format!("{}: {}; {lost}\n", f.name(), f.formulation);
    text += &format!("  cost {}\n", f.cost());
    text += &list("plans before factoring; the first is used", &f.plans);
    text += &list("rejected", &f.rejected);
    text += "  formulations\n";
    let serving = FORMULATIONS
        .iter()
        .filter(|one| one.knows(f.method) && one.serves(&model.bond_graph));
    for formulation in serving {
        let asked = Options {
            formulation: Some(*formulation),
            ..Options::default()
        };
        if let Some(other) = function(mechanism, f.method, &asked) {
            text += &format!(
                "    {:<16} {}; {}  ({})\n",
                formulation.name(),
                other.cost(),
                summary(rounding_error(&other, &model.bond_graph)),
                formulation.summary()
            );
        }
    }
    text
}

/// Lists candidates with their cost, one per line.
fn list(title: &str, all: &[Considered]) -> String {
    if all.is_empty() {
        return String::new();
    }
    let lines = all
        .iter()
        .map(|one| format!("    {}: {}\n", one.what, one.cost));
    format!("  {title}\n{}", lines.collect::<String>())
}

/// Describes a rounding error in words.
fn summary(error: Option<RoundingError>) -> String {
    match error {
        Some(RoundingError { failures: 0, ulps }) => {
            format!("error in f64 up to {ulps:.1} roundings of the largest component")
        }
        Some(RoundingError { failures, .. }) => {
            format!("no answer in f64 in {failures} of the states tried that have one")
        }
        None => "refused in every state tried".into(),
    }
}
