//! The result as JSON.

use bgdyn_identification::model::{JOINT_COLUMNS, Model, PARAMETER_NAMES, Unknown};
use bgdyn_identification::{Identification, Identified};
use serde_json::{Value, json};

/// Returns the result as JSON, in SI units.
pub(crate) fn json(model: &Model<'_>, found: &Identification) -> Value {
    let quality = &found.quality;
    let joints = model.joints.iter().enumerate().map(|(j, joint)| {
        let channel = &quality.joints[j];
        let left = |k: usize| found.judgement.left[k][j].rms;
        let bodies = &found.judgement.left[2][j];
        let sticking = found.sticking.iter().find(|s| s.joint == j);
        json!({
            "name": joint.name, "range": channel.range, "rest": channel.rest, "step": channel.step,
            "spikes": found.spikes[j], "sigma": found.sigma[j], "effort": bodies.effort,
            "rms": { "file": left(0), "least_squares": left(1), "bodies": left(2) },
            "by_velocity": bodies.by_velocity, "by_position": bodies.by_position,
            "correlation": bodies.correlation,
            "sticking": sticking.map(|s| json!({ "below": s.below, "factor": s.factor })),
        })
    });
    let base = found.base.iter().map(|p| {
        let deviation = p.deviation.is_finite().then_some(p.deviation);
        json!({ "name": p.name, "file": p.file, "value": p.value, "deviation": deviation, "seen": p.seen })
    });
    let links = model.links.iter().enumerate().map(|(l, link)| {
        let numbers = PARAMETER_NAMES.iter().enumerate().map(|(k, name)| {
            let value = number(found, Unknown::Link(l, k));
            json!({ "name": name, "file": link.file[k], "value": value.map_or(link.file[k], |n| n.value),
                "deviation": value.map(|n| n.deviation), "from_log": value.map(|n| n.from_log) })
        });
        json!({ "name": link.name, "identified": link.free, "smallest_eigenvalue": found.eigenvalues[l],
            "parameters": numbers.collect::<Vec<_>>() })
    });
    let columns = model.joints.iter().enumerate().flat_map(|(j, joint)| {
        (0..JOINT_COLUMNS.len()).filter_map(move |c| {
            let n = number(found, Unknown::Joint(c, j))?;
            Some(json!({ "joint": joint.name, "name": JOINT_COLUMNS[c], "file": n.file, "value": n.value, "deviation": n.deviation }))
        })
    });
    let map: Vec<Vec<f64>> = found
        .map
        .map
        .row_iter()
        .map(|r| r.iter().copied().collect())
        .collect();
    let free: Vec<String> = found.map.free.iter().map(|u| model.name(*u)).collect();
    json!({
        "log": { "rows": quality.rows, "rate": quality.rate, "jitter": quality.jitter, "lost": quality.lost },
        "cut": found.cut, "rows": found.rows, "condition": found.condition, "newton_steps": found.steps,
        "judged_on": if found.judgement.last_third { "last third" } else { "test" },
        "joints": joints.collect::<Vec<_>>(), "base": base.collect::<Vec<_>>(),
        "base_map": { "columns": free, "rows": map },
        "links": links.collect::<Vec<_>>(), "columns": columns.collect::<Vec<_>>(),
    })
}

/// Returns a number that was identified.
pub(super) fn number(found: &Identification, unknown: Unknown) -> Option<&Identified> {
    found.numbers.iter().find(|n| n.unknown == unknown)
}
