//! The motion in words.

use bgdyn_identification::fault::short;

use super::Planned;

fn percent(x: f64) -> String {
    format!("{:.1} %", 100.0 * x)
}

/// What limits a joint.
const WHAT: [&str; 4] = ["position", "speed", "acceleration", "effort"];

/// Returns what the motion uses, what it shows, and what was chosen.
pub(crate) fn summary(plan: &Planned<'_>) -> String {
    let found = plan.found;
    let harmonics = found.motion.joints.first().map_or(0, |s| s.sine.len());
    let mut lines = vec![format!(
        "motion: {} s, {harmonics} harmonics of {} Hz, {} base parameters",
        short(found.motion.period()),
        short(1.0 / found.motion.period()),
        found.base.len()
    )];
    lines.extend(plan.weakness());
    lines.extend((0..plan.model.joints.len()).map(|j| used(plan, j)));
    for (keep, distance) in plan.keeps.iter().zip(&found.distances) {
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
    let value = |i: usize| found.log_det[i].map_or("−∞".into(), short);
    lines.push(format!(
        "log det: {}, {}, {}; {} steps",
        value(0),
        value(1),
        value(2),
        found.steps()
    ));
    lines.extend(plan.remarks.iter().map(|text| format!("  {text}")));
    lines.join("\n") + "\n"
}

/// Returns what the motion uses of a joint's limits.
fn used(plan: &Planned<'_>, j: usize) -> String {
    let joint = &plan.model.joints[j];
    let [q, ..] = plan.found.extremes[j];
    let shares = plan.found.shares[j];
    let used: Vec<String> = WHAT
        .iter()
        .zip(shares)
        .filter(|(what, _)| **what != "effort" || plan.limits[j].effort.is_some())
        .map(|(what, share)| format!("{what} {}", percent(share)))
        .collect();
    format!(
        "  {}: {} … {} {}; of the limits less the margin: {}; nearest: {}",
        joint.name,
        short(q[0]),
        short(q[1]),
        if joint.linear { "m" } else { "rad" },
        used.join(", "),
        nearest(shares)
    )
}

/// Returns the limit of which most is used.
pub(super) fn nearest(shares: [f64; 4]) -> &'static str {
    let most = (0..WHAT.len()).max_by(|a, b| shares[*a].total_cmp(&shares[*b]));
    WHAT[most.unwrap_or(0)]
}
