//! A run of a scene, as `bgdyn simulate` makes it.

use bgdyn_cli::simulate::{
    POINTS, Way, Words, columns, csv, drift_warning, early_end, estimate, page, prepared,
    record_from, report, summary, too_many_steps,
};
use bgdyn_cli::spec_file::SpecFile;
use bgdyn_codegen::tape::Tape;
use serde_json::{Value, json};

use crate::answer::scene;

/// Runs a scene with its own settings, and once more, finer, to estimate the error.
///
/// The answer has the report, the warnings, the reason of an early end, the table and the page that replays the run.
pub(crate) fn run(file: &SpecFile, watch: &mut dyn FnMut(f64)) -> Result<Value, String> {
    if !file.is_scene() {
        return Err("What is run is a scene: a file with `scene: 1` that names a mechanism and its effects.".into());
    }
    let system = scene(file)?;
    let way = Way {
        integration: system.scene.integration,
        points: POINTS,
        audited: true,
    };
    if let Some(message) = too_many_steps(&way.integration) {
        return Err(message);
    }
    let system = system.with_overrides(&[]).map_err(|faults| {
        let each = faults.0.iter().map(|fault| fault.message.clone());
        format!(
            "The scene cannot start so: {}",
            each.collect::<Vec<_>>().join("; ")
        )
    })?;
    let plant = prepared(&Tape, &system, way.integration.method);
    // A finer run has about twice the steps.
    let run = record_from(plant.clone(), &way, &mut |share| watch(share / 3.0));
    let columns = columns(&system);
    let mut text = report(&system, &run);
    let mut warnings: Vec<String> = drift_warning(&run).into_iter().collect();
    let failure = early_end(&system, &run);
    if failure.is_none() {
        let mut finer = |share: f64| watch((1.0 + 2.0 * share) / 3.0);
        let estimate = estimate(&plant, &way, &columns, &run, &mut finer);
        text += &estimate.in_report();
        warnings.extend(estimate.warning);
    }
    let words = Words {
        name: file.stem.clone(),
        method: summary(&file.stem, &way.integration),
        report: text,
    };
    Ok(json!({
        "summary": words.method,
        "report": words.report,
        "warnings": warnings,
        "failure": failure,
        "table": csv(&columns, &run),
        "page": page(&system, &columns, &run, &words),
    }))
}
