//! The page of a motion: one self-contained HTML file.

use serde_json::{Value, json};

use super::text::nearest;
use super::{Planned, summary};
use crate::template::{PLOTS, STYLE, embedded, filled, head, rounded};

/// Rows of a plot.
const ROWS: usize = 400;

/// Returns the page; `efforts` are those of the file's numbers at a time.
pub(crate) fn page(name: &str, plan: &Planned<'_>, efforts: &dyn Fn(f64) -> Vec<f64>) -> String {
    let data = data(name, plan, efforts);
    let data = embedded(&data.to_string());
    let head = head(name, STYLE);
    let parts = [
        ("@HEAD@", head.as_str()),
        ("@DATA@", &data),
        ("@PLOTS@", PLOTS),
        ("@SCRIPT@", include_str!("motion.js")),
    ];
    filled(include_str!("page.html"), &parts)
}

fn data(name: &str, plan: &Planned<'_>, efforts: &dyn Fn(f64) -> Vec<f64>) -> Value {
    let found = plan.found;
    let period = found.motion.period();
    let times: Vec<f64> = (0..=ROWS)
        .map(|i| i as f64 * period / ROWS as f64)
        .collect();
    let states: Vec<_> = times.iter().map(|t| found.motion.at(*t)).collect();
    let tau: Vec<Vec<f64>> = times.iter().map(|t| efforts(*t)).collect();
    let joints = plan.model.joints.iter().enumerate().map(|(j, joint)| {
        let l = &plan.limits[j];
        json!({
            "name": joint.name, "units": if joint.linear { ["m", "m/s", "m/s²", "N"] } else { ["rad", "rad/s", "rad/s²", "N·m"] },
            "q": states.iter().map(|s| rounded(s.q[j])).collect::<Vec<_>>(),
            "v": states.iter().map(|s| rounded(s.v[j])).collect::<Vec<_>>(),
            "a": states.iter().map(|s| rounded(s.a[j])).collect::<Vec<_>>(),
            "tau": tau.iter().map(|tau| rounded(tau[j])).collect::<Vec<_>>(),
            "range": l.position, "speed": l.speed, "acceleration": l.acceleration, "effort": l.effort,
            "used": found.shares[j], "nearest": nearest(found.shares[j]),
        })
    });
    let finite = |x: f64| x.is_finite().then_some(x);
    json!({
        "name": name, "summary": summary(plan), "weak": plan.weakness(), "period": period, "rows": found.rows, "base": found.base.len(),
        "t": times.iter().map(|t| rounded(*t)).collect::<Vec<_>>(), "joints": joints.collect::<Vec<_>>(),
        "condition": found.condition.map(|pair| pair.map(finite)), "log_det": found.log_det,
        "ascents": found.ascents,
    })
}
