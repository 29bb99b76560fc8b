//! The report of an identification: one self-contained HTML file.

use bgdyn_identification::model::{JOINT_COLUMNS, Model, Unknown};
use bgdyn_identification::{Identification, deviations::UNSEEN};
use serde_json::{Value, json};

use super::json::number;
use crate::template::{PLOTS, STYLE, embedded, filled, head, rounded};

/// Largest number of rows of a plot: for more, rows are left out.
const ROWS: usize = 1500;

/// Returns the page.
pub(crate) fn page(name: &str, model: &Model<'_>, found: &Identification, summary: &str) -> String {
    let data = embedded(&data(name, model, found, summary).to_string());
    let head = head(name, STYLE);
    let parts = [
        ("@HEAD@", head.as_str()),
        ("@DATA@", &data),
        ("@PLOTS@", PLOTS),
        ("@SCRIPT@", include_str!("report.js")),
    ];
    filled(include_str!("page.html"), &parts)
}

fn data(name: &str, model: &Model<'_>, found: &Identification, summary: &str) -> Value {
    let base = found.base.iter().map(|p| {
        // Relative to the number, as far as it is seen at all.
        let share = (p.deviation / p.value.abs()).min(10.0);
        json!({ "name": p.name, "value": p.value, "file": p.file, "seen": p.seen,
            "deviation": p.deviation.is_finite().then_some(p.deviation), "share": share.is_finite().then_some(share) })
    });
    let columns = model.joints.iter().enumerate().flat_map(|(j, joint)| {
        (0..JOINT_COLUMNS.len()).filter_map(move |c| {
            let n = number(found, Unknown::Joint(c, j))?;
            Some(json!({ "name": format!("{}.{}", joint.name, JOINT_COLUMNS[c]), "file": n.file, "value": n.value, "deviation": n.deviation }))
        })
    });
    json!({
        "name": name, "summary": summary, "condition": found.condition, "cut": found.cut, "unseen": UNSEEN,
        "rows": found.rows, "last_third": found.judgement.last_third,
        "t": kept(&found.judgement.samples.time, 0, 1),
        "joints": joints(model, found), "base": base.collect::<Vec<_>>(), "columns": columns.collect::<Vec<_>>(),
    })
}

fn joints(model: &Model<'_>, found: &Identification) -> Vec<Value> {
    let judged = &found.judgement;
    let n = model.joints.len();
    let joint = |j: usize| {
        let of = |x: &[f64]| kept(x, j, n);
        let [file, squares, bodies] = judged.left.each_ref().map(|left| &left[j]);
        json!({
            "name": model.joints[j].name, "unit": if model.joints[j].linear { "N" } else { "N·m" },
            "measured": of(&judged.samples.tau), "file": of(&judged.predicted[0]), "bodies": of(&judged.predicted[2]),
            "v": of(&judged.samples.v), "effort": bodies.effort,
            "rms": [file.rms, squares.rms, bodies.rms],
            "by_velocity": bodies.by_velocity, "by_position": bodies.by_position, "correlation": bodies.correlation,
        })
    };
    (0..n).map(joint).collect()
}

/// Returns every k-th number of a joint, with five digits.
fn kept(x: &[f64], j: usize, n: usize) -> Vec<f64> {
    let own = x.iter().skip(j).step_by(n);
    let every = own.len().div_ceil(ROWS).max(1);
    own.step_by(every).map(|x| rounded(*x)).collect()
}
