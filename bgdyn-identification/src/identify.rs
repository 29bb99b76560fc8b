//! Runs the steps from a log to numbers with their deviations.

use crate::base::base;
use crate::even::{EvenLog, even};
use crate::fault::LogFault;
use crate::log::{Log, quality, unsound};
use crate::model::Model;
use crate::options::Options;
use crate::prepare::prepare;
use crate::problem::Problem;
use crate::result::Identification;
use crate::spectrum::default_cut;
use crate::suspect::suspect;

/// The share of a motion that judges, if there is no other motion.
const LAST: f64 = 1.0 / 3.0;

/// Identifies a model from a log; judges it on `test`, or on the last third of the log. Tells step and share to
/// `progress`.
///
/// # Errors
/// All faults that the log shows at this step.
pub fn identify(
    model: &Model<'_>,
    log: &Log,
    test: Option<&Log>,
    options: &Options,
    progress: &mut dyn FnMut(&'static str, f64),
) -> Result<Identification, Vec<LogFault>> {
    let quality = quality(log, &model.joints);
    let faults = unsound(log, &quality, &model.joints);
    if !faults.is_empty() {
        return Err(faults);
    }
    let whole = even(log);
    let cut = options.cut.unwrap_or_else(|| default_cut(&whole));
    if cut >= 0.45 / whole.step {
        let message = format!("a cut of {cut} Hz for {} rows per second", 1.0 / whole.step);
        return Err(vec![
            LogFault::whole("cut-too-high", message)
                .with_help("choose --cut below 0.4 of the rate"),
        ]);
    }
    let (train, judged) = parts(&whole, test);
    let samples = prepare(model, &train, cut, &mut |share| progress("rows", share));
    let base = base(model);
    let faults = suspect(model, &samples, &quality, base.kept.len());
    if !faults.is_empty() {
        return Err(faults);
    }
    let judged = prepare(model, &judged, cut, &mut |share| {
        progress("rows of the other motion", share)
    });
    let problem = Problem::new(model, samples, base, options);
    progress("bodies", 0.0);
    let mut found = problem.solve(model, options)?;
    found.quality = quality;
    found.spikes = whole.spikes;
    found.cut = cut;
    found.judgement = problem.judge(model, &found, judged, test.is_none());
    Ok(found)
}

/// Returns the part that is identified from, and the one that judges.
fn parts(whole: &EvenLog, test: Option<&Log>) -> (EvenLog, EvenLog) {
    match test {
        Some(test) => (whole.clone(), even(test)),
        None => {
            let at = ((1.0 - LAST) * whole.len() as f64) as usize;
            (whole.part(0..at), whole.part(at..whole.len()))
        }
    }
}
