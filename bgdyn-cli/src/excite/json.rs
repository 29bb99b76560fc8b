//! The motion as JSON.

use serde_json::{Value, json};

use super::Planned;

/// Returns the motion as JSON, in SI units.
pub(crate) fn json(plan: &Planned<'_>) -> Value {
    let found = plan.found;
    let joints = plan.model.joints.iter().enumerate().map(|(j, joint)| {
        let series = &found.motion.joints[j];
        let [q, v, a] = found.extremes[j];
        let [position, speed, acceleration, effort] = found.shares[j];
        let l = &plan.limits[j];
        json!({
            "name": joint.name, "centre": series.centre, "sine": series.sine, "cosine": series.cosine,
            "limits": { "position": l.position, "speed": l.speed, "acceleration": l.acceleration, "effort": l.effort },
            "extremes": { "position": q, "velocity": v, "acceleration": a },
            "used": { "position": position, "speed": speed, "acceleration": acceleration,
                "effort": l.effort.map(|_| effort) },
            "sigma": found.sigma[j],
        })
    });
    let planes = plan.keeps.iter().zip(&found.distances);
    let planes = planes.map(|(keep, distance)| json!({ "keep": keep.name, "distance": distance }));
    let stage = |i: usize| {
        let [weighted, plain] = found.condition[i].map(|x| x.is_finite().then_some(x));
        json!({ "condition": weighted, "condition_without_weights": plain, "log_det": found.log_det[i] })
    };
    json!({
        "series": "q = centre + sum over k of (sine_k sin(k w t) - cosine_k cos(k w t))/(k w)",
        "period": found.motion.period(), "frequency": found.motion.frequency,
        "joints": joints.collect::<Vec<_>>(), "keep": planes.collect::<Vec<_>>(),
        "base": found.base, "rows": found.rows, "steps": found.steps(),
        "margin": plan.margin, "remarks": plan.remarks, "weak": plan.weakness(),
        "first": stage(0), "best_start": stage(1), "motion": stage(2),
    })
}
