//! `bgdyn accuracy`: error against time of a scene's variants.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use bgdyn_accuracy::generate::{check_contacts, variants};
use bgdyn_accuracy::{Effort, Study, costs_csv, rows_csv, study, targets, verdicts};
#[cfg(feature = "plot")]
use bgdyn_accuracy::{Machine, figures, page};
use bgdyn_codegen::engine::Engine;
use bgdyn_codegen::format::Dimension;
use bgdyn_codegen::system::SceneEquations;
use clap::Args;

use crate::cargo_project::CargoProject;
use crate::engine::EngineChoice;
use crate::output::{print, tell};
use crate::quantity::positive;
use crate::spec_file::SpecFile;

/// Measure error against computing time of a scene, by method, step, scalar, formulation and effects
///
/// The scene is compiled with your cargo, in a crate that is kept, and timed. If that fails, times are
/// estimated from the operations, and marked as estimates.
#[derive(Args)]
#[command(
    after_help = "Example:\n  bgdyn accuracy specs/scenes/stick_slip.scene.yaml --out accuracy --bgdyn .\n\nWrites accuracy.csv, costs.csv, figures (SVG) and report.html. Exit 1 if a method does not converge as it should."
)]
pub(crate) struct Accuracy {
    /// The scene
    file: PathBuf,
    /// Output folder; created if it does not exist
    #[arg(long, value_name = "DIR", default_value = "accuracy")]
    out: PathBuf,
    /// End time of the runs, such as `2 s`
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    end: Option<String>,
    /// Use fewer steps and samples
    #[arg(long)]
    quick: bool,
    /// The version or path of the bgdyn crate that the timing program is built with
    #[arg(long, value_name = "PATH|VERSION", default_value = env!("CARGO_PKG_VERSION"))]
    bgdyn: String,
    #[command(flatten)]
    engine: EngineChoice,
}

/// Prefix of the program's output for the reason why the scene cannot be studied.
const REFUSED: &str = "refused: ";

impl Accuracy {
    pub(crate) fn run(self) -> Result<()> {
        let file = SpecFile::open(&self.file)?;
        if !file.is_scene() {
            let shown = self.file.display();
            bail!(
                "{shown} is a mechanism: what is compared are runs of a scene, a file with `scene: 1`"
            );
        }
        let end = positive("end", self.end.as_ref(), Dimension::Time)?;
        let system = file.scene()?;
        check_contacts(&system).map_err(|e| anyhow!(e))?;
        let study = self.study(&system, end)?;
        write(&study, &self.out)?;
        print(&summary(&study, &self.out))?;
        let wrong = verdicts(&study).into_iter().filter(|v| v.is_failure());
        let wrong: Vec<String> = wrong
            .map(|v| format!("{} in {}: {}", v.method, v.scalar, v.words()))
            .collect();
        match wrong.is_empty() {
            true => Ok(()),
            false => bail!("methods that should converge do not: {}", wrong.join("; ")),
        }
    }

    /// Runs the study with compiled code, or without a compiler if there is no cargo.
    fn study(&self, system: &SceneEquations, end: Option<f64>) -> Result<Study> {
        let program = match self.compiled(system, end) {
            Ok(text) => text,
            Err(why) => {
                let engine = self.engine.engine()?;
                tell(&format!(
                    "bgdyn: times are estimated from operations: {why:#}\nbgdyn: the scene is computed by {}\n",
                    engine.name()
                ));
                return evaluated(&*engine, system, end);
            }
        };
        if let Some(why) = program.strip_prefix(REFUSED) {
            bail!("{}", why.trim_end());
        }
        let studies = Study::read(&program).context("the program's output is no study")?;
        studies
            .into_iter()
            .next()
            .context("the program gave no study")
    }

    /// Returns the output of the program that studies the compiled scene.
    fn compiled(&self, system: &SceneEquations, end: Option<f64>) -> Result<String> {
        let project = CargoProject::new("accuracy", &self.bgdyn, &["bgdyn-accuracy"])?;
        let text = variants(system, end).map_err(|e| anyhow!(e))?;
        project.write("src/scene.rs", &text)?;
        let name = &system.scene.name;
        let effort = if self.quick { "QUICK" } else { "FULL" };
        let main = format!(
            "//! Written by `bgdyn accuracy`.\ninclude!(\"scene.rs\");\n\nfn main() {{\n    match bgdyn_accuracy::study(&{name}::test_case(), &bgdyn_accuracy::Effort::{effort}) {{\n        Ok(study) => print!(\"{{}}\", study.write()),\n        Err(why) => print!(\"{REFUSED}{{why}}\"),\n    }}\n}}\n"
        );
        project.write("src/main.rs", &main)?;
        project.run()
    }
}

/// Runs the study without a compiler, by an engine.
fn evaluated(engine: &dyn Engine, system: &SceneEquations, end: Option<f64>) -> Result<Study> {
    let test_case = crate::accuracy::test_case(engine, system, end)
        .ok_or_else(|| anyhow!("the scene `{}` has nothing to measure", system.scene.name))?;
    // Functions that are not compiled are slow.
    study(&test_case, &Effort::QUICK).map_err(|e| anyhow!("{e}"))
}

/// Writes table, figures and page.
fn write(study: &Study, out: &Path) -> Result<()> {
    std::fs::create_dir_all(out)
        .with_context(|| format!("the folder {} cannot be made", out.display()))?;
    let put = |name: &str, text: &str| {
        let path = out.join(name);
        std::fs::write(&path, text).with_context(|| format!("{} cannot be written", path.display()))
    };
    put("accuracy.csv", &rows_csv(&study.rows))?;
    let scene = study.facts.scene.as_str();
    let costs = study.costs.iter().map(|cost| (scene, cost));
    put("costs.csv", &costs_csv(costs))?;
    #[cfg(feature = "plot")]
    {
        for figure in figures(study) {
            put(&figure.name, &figure.svg)?;
        }
        let page = page(std::slice::from_ref(study), &Machine::here());
        put("report.html", &page)?;
    }
    Ok(())
}

/// Lists the cheapest variants, and the files with the rest.
fn summary(study: &Study, out: &Path) -> String {
    let facts = &study.facts;
    let mark = if study.is_measured() { "" } else { "~" };
    let mut text = String::new();
    for choice in targets(study) {
        let row = &choice.row;
        let ns = row.ns.unwrap_or(f64::NAN);
        text += &format!(
            "{:.0e} {} at {}: {} at {} in {}, {mark}{ns:.0} ns per simulated ms\n",
            choice.target, facts.unit, facts.output, row.method, row.step_control, row.scalar
        );
    }
    let main = match cfg!(feature = "plot") {
        true => "report.html",
        false => "accuracy.csv",
    };
    text + &format!("written: {}\n", out.join(main).display())
}
