//! Checks that integrators converge with their stated order.

use std::collections::BTreeMap;

use crate::configuration::StepControl;
use crate::row::Row;
use crate::study::{Study, StudyInfo};
use crate::test_case::order;

/// The conclusion from an integrator's errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finding {
    /// The errors fall with the stated order. For step control the number is the power of the tolerance.
    Converges(f64),
    /// The errors fall too slowly, or not at all.
    DoesNot(f64),
    /// The errors fall too slowly, at steps for which the classical Runge–Kutta method is unstable: there
    /// the order of implicit methods is reduced (Prothero, Robinson 1974).
    Stiff(f64),
    /// The errors fall more slowly than the order because of the laws' kinks.
    Kinked(f64),
    /// Too few errors are between the size of the motion and rounding.
    TooFew,
}

/// The conclusion about an integrator on a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The scene.
    pub scene: String,
    /// The integrator, by its name in scenes.
    pub method: String,
    /// The scalar.
    pub scalar: String,
    /// The equations: `cheapest`, or a formulation's name.
    pub formulation: String,
    /// The integrator's order.
    pub order: u32,
    /// Whether it has step control.
    pub controlled: bool,
    /// The conclusion.
    pub finding: Finding,
    /// Its least error.
    pub best: Option<f64>,
}

/// Errors above this fraction of the motion are not in the asymptotic range yet.
const COARSE: f64 = 0.05;
/// Errors below this multiple of the floor contain rounding.
const ROUGH: f64 = 8.0;
/// The fraction of its order that an integrator must reach.
const SHARE: f64 = 0.75;
/// The least power of the tolerance that an error must reach.
const FOLLOWS: f64 = 0.5;
/// Errors below this fraction of the motion count as zero.
const EXACT: f64 = 1e-11;
/// A last error below this multiple of the tolerance, relative to the motion, satisfies the tolerance.
const KEEPS: f64 = 100.0;
/// The least order that an integrator must reach if laws have kinks.
const KINKED: f64 = 0.5;
/// Number of steps in a fit.
const WINDOW: usize = 3;

/// Returns a verdict on each integrator, scalar and formulation of a study's full scene.
pub fn verdicts(study: &Study) -> Vec<Verdict> {
    let mut groups: BTreeMap<[&str; 3], Vec<&Row>> = BTreeMap::new();
    let mut names: Vec<[&str; 3]> = Vec::new();
    for row in study.rows.iter().filter(|r| r.effects == "all") {
        let name = [&row.method, &row.scalar, &row.formulation].map(String::as_str);
        if !names.contains(&name) {
            names.push(name);
        }
        groups.entry(name).or_default().push(row);
    }
    let verdict = |name: &[&str; 3]| {
        let rows = &groups[name];
        let [method, scalar, formulation] = name.map(str::to_owned);
        let (order, controlled) = order(&method).unwrap_or((1, false));
        let errors = rows.iter().filter(|r| r.holds()).filter_map(|r| r.error);
        Verdict {
            finding: finding(rows, &study.facts, order, stable_step(study)),
            best: errors.reduce(f64::min),
            scene: study.facts.scene.clone(),
            method,
            scalar,
            formulation,
            order,
            controlled,
        }
    };
    names.iter().map(verdict).collect()
}

/// Returns the longest step at which the classical Runge–Kutta method follows the motion; 0 if it never
/// does.
fn stable_step(study: &Study) -> f64 {
    let rows = study
        .rows
        .iter()
        .filter(|r| r.effects == "all" && r.holds());
    let rows = rows.filter(|r| r.method == "rk4" && r.scalar == "f64");
    let follows = |r: &&Row| r.error.is_some_and(|e| e < COARSE * study.facts.size);
    rows.filter(follows)
        .map(|r| r.step_control.value())
        .fold(0.0, f64::max)
}

/// Returns the conclusion from the errors of one integrator, from the coarsest to the finest.
fn finding(rows: &[&Row], facts: &StudyInfo, order: u32, stable: f64) -> Finding {
    let epsilon = match rows[0].scalar.as_str() {
        "f32" => f64::from(f32::EPSILON) / f64::EPSILON,
        _ => 1.0,
    };
    let rounding = ROUGH * epsilon * facts.floor;
    let held = rows.iter().filter(|r| r.holds());
    let mut points: Vec<(StepControl, f64)> = held
        .filter_map(|r| Some((r.step_control, r.error?)))
        .collect();
    // The scene's own step control, the last one, does not belong to the sequence.
    let sequence = points
        .windows(2)
        .take_while(|p| p[1].0.value() < p[0].0.value());
    points.truncate(sequence.count() + 1);
    let reached = points
        .iter()
        .any(|p| p.1 <= rounding || p.1 < EXACT * facts.size);
    let fine = points.iter().filter(|p| p.1 < COARSE * facts.size);
    // Errors at the floor or below it give no information about the order.
    let fine = fine.take_while(|p| p.1 > rounding);
    let logs: Vec<(f64, f64)> = fine.map(|(x, e)| (x.value().ln(), e.ln())).collect();
    if let Some((StepControl::Tolerance(_), _)) = points.first() {
        return match logs.len() {
            0..=2 if reached => Finding::Converges(slope(&logs).unwrap_or(1.0)),
            0..=2 => Finding::TooFew,
            _ => match (judge(slope(&logs), FOLLOWS), points.last()) {
                // Errors within the tolerance need not be proportional to it: steps end at the samples.
                (Finding::DoesNot(p), Some((step_control, error)))
                    if *error < KEEPS * step_control.value() * facts.size =>
                {
                    Finding::Converges(p)
                }
                (finding, _) => finding,
            },
        };
    }
    let slopes = logs.windows(WINDOW).filter_map(slope);
    let beyond = logs.windows(WINDOW).all(|w| w[0].0 > stable.ln());
    let least = SHARE * f64::from(order);
    // Of the fits with the order choose the finest: coarser ones may be at the stability limit.
    let shown = slopes.clone().rfind(|p| *p >= least);
    match shown.or_else(|| slopes.reduce(f64::max)) {
        Some(best) => match judge(Some(best), least) {
            Finding::DoesNot(p) if beyond => Finding::Stiff(p),
            Finding::DoesNot(p) if facts.kinked && p > KINKED => Finding::Kinked(p),
            finding => finding,
        },
        None => Finding::TooFew,
    }
}

fn judge(slope: Option<f64>, least: f64) -> Finding {
    match slope {
        Some(slope) if slope >= least => Finding::Converges(slope),
        Some(slope) => Finding::DoesNot(slope),
        None => Finding::TooFew,
    }
}

/// Returns the slope of the least-squares line through these points.
fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x0, y0) = (mean(|p| p.0), mean(|p| p.1));
    let spread: f64 = points.iter().map(|p| (p.0 - x0).powi(2)).sum();
    let joint: f64 = points.iter().map(|p| (p.0 - x0) * (p.1 - y0)).sum();
    (points.len() > 1).then(|| joint / spread)
}

impl Verdict {
    /// Returns whether an integrator that should converge does not.
    pub fn is_failure(&self) -> bool {
        matches!(self.finding, Finding::DoesNot(_))
    }

    /// Returns a few words: "order 3.98 of 4".
    pub fn words(&self) -> String {
        let Verdict {
            order, controlled, ..
        } = self;
        match (self.finding, controlled) {
            (Finding::Converges(p), true) if p < FOLLOWS => "error keeps to the tolerance".into(),
            (Finding::Converges(p), true) => format!("error follows tolerance^{p:.2}"),
            (Finding::Converges(p), false) => format!("order {p:.1} of {order}"),
            (Finding::DoesNot(p), true) => format!("error follows tolerance^{p:.2} only"),
            (Finding::DoesNot(p), false) => format!("does not converge: order {p:.1} of {order}"),
            (Finding::Stiff(p), _) => format!("order {p:.1} of {order} at stiff steps"),
            (Finding::Kinked(p), _) => format!("order {p:.1} of {order} at kinks"),
            (Finding::TooFew, _) => "too few steps to judge".into(),
        }
    }
}
