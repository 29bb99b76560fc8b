//! The motion in words.

use bgdyn_identification::Model;
use bgdyn_identification::excite::{Excitation, JointLimits, Keep};
use bgdyn_runtime::Digits;

/// Returns a number with four digits.
pub(super) fn short(x: f64) -> String {
    Digits::new(x, 4).to_string()
}

fn percent(x: f64) -> String {
    format!("{:.1} %", 100.0 * x)
}

/// What limits a joint.
const WHAT: [&str; 4] = ["position", "speed", "acceleration", "effort"];

/// Returns what the motion uses, what it shows, and what was chosen.
pub(crate) fn summary(
    model: &Model<'_>,
    limits: &[JointLimits],
    keeps: &[Keep],
    found: &Excitation,
    chosen: &[String],
) -> String {
    let harmonics = found.motion.joints.first().map_or(0, |s| s.sine.len());
    let mut lines = vec![format!(
        "motion: {} s, {harmonics} harmonics of {} Hz, {} base parameters",
        short(found.motion.period()),
        short(1.0 / found.motion.period()),
        found.base.len()
    )];
    for (j, joint) in model.joints.iter().enumerate() {
        let [q, ..] = found.extremes[j];
        let shares = found.shares[j];
        let used: Vec<String> = WHAT
            .iter()
            .zip(shares)
            .filter(|(what, _)| **what != "effort" || limits[j].effort.is_some())
            .map(|(what, share)| format!("{what} {}", percent(share)))
            .collect();
        lines.push(format!(
            "  {}: {} … {} {}; of the limits: {}; nearest: {}",
            joint.name,
            short(q[0]),
            short(q[1]),
            if joint.linear { "m" } else { "rad" },
            used.join(", "),
            nearest(shares)
        ));
    }
    for (keep, distance) in keeps.iter().zip(&found.distances) {
        lines.push(format!(
            "  {}: at least {} m from the plane",
            keep.name,
            short(*distance)
        ));
    }
    let stage = |i: usize| {
        let [weighted, plain] = found.condition[i];
        format!("{} ({} without weights)", short(weighted), short(plain))
    };
    lines.push(format!(
        "condition number: first random motion {}, best of them {}, this motion {}",
        stage(0),
        stage(1),
        stage(2)
    ));
    let steps: usize = found
        .ascents
        .iter()
        .map(|a| a.len().saturating_sub(1))
        .sum();
    let value = |i: usize| found.log_det[i].map_or("−∞".into(), short);
    lines.push(format!(
        "log det: {}, {}, {}; {steps} steps",
        value(0),
        value(1),
        value(2)
    ));
    lines.extend(chosen.iter().map(|text| format!("  {text}")));
    lines.join("\n") + "\n"
}

/// Returns the limit of which most is used.
pub(super) fn nearest(shares: [f64; 4]) -> &'static str {
    let most = (0..WHAT.len()).max_by(|a, b| shares[*a].total_cmp(&shares[*b]));
    WHAT[most.unwrap_or(0)]
}
