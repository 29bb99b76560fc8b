//! `bgdyn simulate`: runs a scene without a compiler and writes a table, plots and a page.

mod many;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use bgdyn_codegen::fault::{Fault, Faults};
use bgdyn_codegen::format::Dimension;
use bgdyn_codegen::scene::{Integration, IntegratorName, Scene, StepControl};
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::{ImpactLaw, MOST_EVENT_CONTACTS};
use clap::Args;

use self::many::{Batch, Many};
use crate::engine::EngineChoice;
use crate::output::{print, tell};
use crate::quantity::positive;
use crate::simulate::page::{self, Words};
use crate::simulate::progress::Progress;
use crate::simulate::report;
use crate::simulate::{
    Column, Evaluated, POINTS, Record, Way, batch_values, columns, drift_warning, early_end,
    estimate, prepared, record_from, too_many_steps,
};
use crate::spec_file::SpecFile;
use crate::usage::Usage;

/// Simulate a scene without a compiler: table, plots, replay page, events, energy balance
///
/// The run uses the scene's `integration` unless an option overrides it. It is repeated with half the
/// step or a tenth of the tolerance, to estimate the error of the result.
#[derive(Args)]
#[command(
    after_help = "Example:\n  bgdyn simulate specs/scenes/stick_slip.scene.yaml --out runs\n  bgdyn simulate arm.scene.yaml --method dopri5 --tolerance 1e-9 --end 2s --points 201\n  bgdyn simulate arm.scene.yaml --parameter payload=2.5 --initial shoulder=\"30 deg\"\n  bgdyn simulate arm.scene.yaml --sweep payload=0:5:21\n  bgdyn simulate arm.scene.yaml --random shoulder=-1:1 --random payload=0:5 --runs 500\n\nInputs that the scene does not drive are 0. Exit 1 if the run stops early; the files then contain it up to that point."
)]
pub(crate) struct Simulate {
    /// The scene
    file: PathBuf,
    /// Output folder; created if it does not exist
    #[arg(long, value_name = "DIR", default_value = ".")]
    out: PathBuf,
    /// Integration method, by its name in scenes
    #[arg(long, value_name = "NAME")]
    method: Option<String>,
    /// Fixed step, such as `1 ms`; s if no unit is given
    #[arg(
        long,
        value_name = "S",
        conflicts_with = "tolerance",
        allow_hyphen_values = true
    )]
    step: Option<String>,
    /// Error tolerance of a step, absolute and relative, in SI units
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    tolerance: Option<String>,
    /// End time of the run, such as `2 s`
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    end: Option<String>,
    /// Number of rows of the table from 0 to the end time; events add rows of their own
    #[arg(long, value_name = "N", default_value_t = POINTS)]
    points: usize,
    /// Set a run-time parameter, such as `payload=500 g` [default: the value in the file]. May be repeated
    #[arg(long = "parameter", value_name = "NAME=VALUE")]
    parameters: Vec<String>,
    /// Set an initial position, velocity (`NAME_rate`), state or mode, such as `shoulder=30 deg`; of a
    /// spherical or floating joint the pose: `free.xyz=0,0,1`, `free.rpy=0,0,90 deg`,
    /// `free.quaternion=0,0,0,1`. May be repeated
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    initial: Vec<String>,
    #[command(flatten)]
    engine: EngineChoice,
    #[command(flatten)]
    many: Many,
}

/// The numbers of the options, SI units.
struct NumericOptions {
    step: Option<f64>,
    tolerance: Option<f64>,
    end: Option<f64>,
}

impl Simulate {
    pub(crate) fn run(self) -> Result<()> {
        let file = SpecFile::open(&self.file)?;
        if !file.is_scene() {
            let shown = self.file.display();
            bail!(
                "{shown} is a mechanism: what is run is a scene, a file with `scene: 1` that names a mechanism and its effects"
            );
        }
        let numbers = self.numbers()?;
        let system = file.scene()?;
        let given = batch_values::parse_fixed(&system.scene, &self.parameters, &self.initial)?;
        let way = Way {
            integration: self.integration(&system.scene, &numbers)?,
            points: self.points,
            audited: true,
        };
        let engine = self.engine.engine()?;
        let plant = prepared(&*engine, &system, way.integration.method);
        let columns = columns(&system);
        if let Some(varied) = self.many.varied(&system.scene)? {
            let batch = Batch {
                name: &file.stem,
                out: &self.out,
                system: &system,
                plant: &plant,
                way,
                columns: &columns,
            };
            let summary = report::summary(&file.stem, &way.integration);
            print(&format!("{summary}\n"))?;
            self.many.run(&batch, &given, &varied)?;
            return print(&format!("computed by {}\n", plant.engine()));
        }
        let system = system
            .with_overrides(&given)
            .map_err(|f| start_refused(&f))?;
        let plant = plant.with_overrides(&system);
        let run = watched("run", &plant, &way);
        let files = self.write((&file.stem, &system), &columns, &run)?;
        print(&format!(
            "{}, by {}\n{files}\n",
            report::summary(&file.stem, &way.integration),
            plant.engine()
        ))?;
        let mut report = report::report(&system, &run);
        print(&report)?;
        warn(drift_warning(&run));
        if let Some(message) = early_end(&system, &run) {
            self.page(&file.stem, (&system, &way), &columns, &run, report)?;
            bail!("{message}");
        }
        let mut progress = Progress::new("once more, finer");
        let estimate = estimate(&plant, &way, &columns, &run, &mut |share| {
            progress.at(share)
        });
        drop(progress);
        print(&estimate.line)?;
        report += &estimate.in_report();
        warn(estimate.warning);
        self.page(&file.stem, (&system, &way), &columns, &run, report)
    }

    /// Writes the page that replays the run.
    fn page(
        &self,
        name: &str,
        (system, way): (&SceneEquations, &Way),
        columns: &[Column],
        run: &Record,
        report: String,
    ) -> Result<()> {
        let path = self.out.join(format!("{name}.html"));
        let words = Words {
            name: name.to_owned(),
            method: report::summary(name, &way.integration),
            report,
        };
        let text = page::page(system, columns, run, &words);
        std::fs::write(&path, text)
            .with_context(|| format!("{} cannot be written", path.display()))?;
        print(&format!("replay: {}\n", path.display()))
    }

    /// Returns the numbers of the options.
    fn numbers(&self) -> Result<NumericOptions, Usage> {
        use Dimension::{One, Time};
        if self.points < 2 {
            let message = format!("`--points {}`: the start and the end are 2", self.points);
            return Err(Usage(message));
        }
        Ok(NumericOptions {
            step: positive("step", self.step.as_ref(), Time)?,
            tolerance: positive("tolerance", self.tolerance.as_ref(), One)?,
            end: positive("end", self.end.as_ref(), Time)?,
        })
    }

    /// Returns the scene's settings of integration, changed by the options.
    fn integration(&self, scene: &Scene, given: &NumericOptions) -> Result<Integration, Usage> {
        let quasi_joint = scene.layout.quasi_joints.first();
        let contacts = scene.layout.rigid_contacts.len();
        let scene = scene.integration;
        let method = match &self.method {
            None => scene.method,
            Some(name) => IntegratorName::named(name).ok_or_else(|| {
                let all: Vec<&str> = IntegratorName::ALL.iter().map(|m| m.name()).collect();
                let all = all.join(", ");
                Usage(format!("there is no method `{name}`; there are {all}"))
            })?,
        };
        if let Some(joint) = quasi_joint.filter(|_| method.needs_canonical()) {
            let (name, natural) = (method.name(), method.on_velocities().name());
            return Err(Usage(format!(
                "`{name}` integrates momenta, and those of the joint `{}` are not canonical (their equations are Lie–Poisson): use `{natural}`",
                joint.name
            )));
        }
        if contacts > 0 && method.needs_canonical() {
            let (name, natural) = (method.name(), method.on_velocities().name());
            return Err(Usage(format!(
                "`{name}` integrates momenta, and impulses of rigid contacts are known for velocities only: use `{natural}`"
            )));
        }
        if contacts > MOST_EVENT_CONTACTS && !method.solves_contacts() {
            return Err(Usage(format!(
                "`{}` goes from event to event, and the scene has {contacts} rigid contacts: at most {MOST_EVENT_CONTACTS} are solved so; use `moreau`",
                method.name()
            )));
        }
        if scene.impacts != ImpactLaw::Newton && method.solves_contacts() {
            return Err(Usage(format!(
                "`{}` has Newton's law at impacts, and the scene's `impacts` is `{}`: use a method that goes from event to event, such as `dop853`",
                method.name(),
                scene.impacts.name()
            )));
        }
        let step_control = match (given.step, given.tolerance) {
            (Some(step), _) => StepControl::Step(step),
            (_, Some(tolerance)) => StepControl::Tolerance(tolerance),
            _ => scene.step_control,
        };
        if matches!(step_control, StepControl::Tolerance(_)) && !method.controls_its_error() {
            let name = method.name();
            let all = IntegratorName::ALL
                .iter()
                .filter(|m| m.controls_its_error());
            let all: Vec<&str> = all.map(|m| m.name()).collect();
            let all = all.join(", ");
            return Err(Usage(format!(
                "`{name}` does not go by a tolerance: give `--step`, or a method that does: {all}"
            )));
        }
        let integration = Integration {
            method,
            step_control,
            end: given.end.unwrap_or(scene.end),
            impacts: scene.impacts,
        };
        match too_many_steps(&integration) {
            Some(message) => Err(Usage(message)),
            None => Ok(integration),
        }
    }

    /// Writes table and plot; returns the message about them.
    fn write(
        &self,
        (name, system): (&str, &SceneEquations),
        columns: &[Column],
        run: &Record,
    ) -> Result<String> {
        let out = &self.out;
        let shown = |path: &Path| format!("{} cannot be written", path.display());
        std::fs::create_dir_all(out)
            .with_context(|| format!("the folder {} cannot be made", out.display()))?;
        let table = out.join(format!("{name}.csv"));
        std::fs::write(&table, report::csv(columns, run)).with_context(|| shown(&table))?;
        let mut written = format!("written: {} ({} rows)", table.display(), run.rows.len());
        if let Some(forces) = report::contact_csv(system, run) {
            let table = out.join(format!("{name}_contacts.csv"));
            std::fs::write(&table, forces).with_context(|| shown(&table))?;
            written += &format!(", {}", table.display());
        }
        #[cfg(feature = "plot")]
        let written = {
            let picture = out.join(format!("{name}.svg"));
            let svg = crate::simulate::plot::plot(name, columns, run);
            std::fs::write(&picture, svg).with_context(|| shown(&picture))?;
            format!("{written}, {}", picture.display())
        };
        Ok(written)
    }
}

/// Returns the error that a scene cannot start from the given state.
fn start_refused(faults: &Faults) -> anyhow::Error {
    let one = |f: &Fault| match &f.help {
        Some(help) => format!("{}: {help}", f.message),
        None => f.message.clone(),
    };
    let all: Vec<String> = faults.0.iter().map(one).collect();
    anyhow!("the scene cannot start so: {}", all.join("; "))
}

/// Runs a scene, with a display of the progress.
fn watched(what: &'static str, plant: &Evaluated<'_>, way: &Way) -> Record {
    let mut progress = Progress::new(what);
    record_from(plant.clone(), way, &mut |share| progress.at(share))
}

/// Prints a warning to stderr.
fn warn(warning: Option<String>) {
    if let Some(warning) = warning {
        tell(&format!("bgdyn: warning: {warning}\n"));
    }
}
