//! `bgdyn ops`: operation counts of the generated functions.

use std::path::PathBuf;

use anyhow::Result;
use bgdyn_codegen::expr::Operations;
use bgdyn_codegen::formulation::FORMULATIONS;
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::model::{Model, Options};
use clap::Args;
use serde_json::{Map, Value, json};

use crate::spec_file::{SpecFile, options};

/// Count the operations of each generated function
#[derive(Args)]
#[command(after_help = "Example:\n  bgdyn ops specs/puma560.yaml --explain")]
pub(crate) struct Ops {
    /// The spec
    file: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Say which formulation was chosen, and what the others cost
    #[arg(long)]
    explain: bool,
    /// Use one formulation for every method
    #[arg(long, value_name = "NAME")]
    formulation: Option<String>,
    /// Count the first derivatives as well
    #[arg(long)]
    derivatives: bool,
}

impl Ops {
    pub(crate) fn run(self) -> Result<()> {
        let mut options = options(self.formulation.as_deref())?;
        options.derivatives = self.derivatives;
        let mechanism = SpecFile::open(&self.file)?.mechanism()?;
        let model = Model::new(mechanism.clone(), &options);
        if self.json {
            println!("{:#}", counts(&model));
        } else {
            print_table(&model);
        }
        if self.explain {
            explain(&mechanism, &model);
        }
        Ok(())
    }
}

fn counts(model: &Model) -> Value {
    let mut functions = Map::new();
    for f in &model.functions {
        let Operations {
            mul,
            add,
            div,
            sqrt,
            sincos,
            other,
        } = f.operations();
        let count = json!({ "mul": mul, "add": add, "div": div, "sqrt": sqrt, "sincos": sincos, "other": other });
        functions.insert(f.name().into(), count);
    }
    json!({ "functions": functions })
}

fn print_table(model: &Model) {
    println!(
        "{:<20} {:>6} {:>6} {:>5} {:>5} {:>7} {:>6} {:>7}",
        "function", "mul", "add", "div", "sqrt", "sincos", "other", "mul+add"
    );
    for f in &model.functions {
        let o = f.operations();
        println!(
            "{:<20} {:>6} {:>6} {:>5} {:>5} {:>7} {:>6} {:>7}",
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
}

/// Goes to stderr, so that it can stand beside `--json`.
fn explain(mechanism: &Mechanism, model: &Model) {
    for f in &model.functions {
        eprintln!("{}: {}", f.name(), f.formulation);
        for formulation in FORMULATIONS {
            let asked = Options {
                formulation: Some(formulation),
                ..Options::default()
            };
            if let Some(other) = count_with(mechanism, f.method, &asked) {
                eprintln!(
                    "  {:<12} {}  ({})",
                    formulation.name(),
                    other,
                    formulation.summary()
                );
            }
        }
    }
}

fn count_with(mechanism: &Mechanism, method: Method, options: &Options) -> Option<Operations> {
    bgdyn_codegen::model::function(mechanism, method, options).map(|f| f.operations())
}
