//! Checks that methods converge with their stated order.

use std::collections::BTreeMap;

use crate::configuration::StepControl;
use crate::row::Row;
use crate::study::{Facts, Study};
use crate::test_case::order;

/// What a method's errors say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finding {
    /// They fall as the order says. Of a controlled method the number is the power of the tolerance.
    Converges(f64),
    /// They fall too slowly, or not at all.
    DoesNot(f64),
    /// They fall too slowly, at steps at which the classical Runge–Kutta method is not stable: there the
    /// order of implicit methods falls as well (Prothero, Robinson 1974).
    Stiff(f64),
    /// They fall as the laws' kinks let them: more slowly than the order says.
    Kinked(f64),
    /// Too few of them lie between the size of the motion and rounding.
    TooFew,
}

/// What is found of a method on a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The scene.
    pub scene: String,
    /// The method, as scenes name it.
    pub method: String,
    /// The scalar.
    pub scalar: String,
    /// How the equations are written.
    pub formulation: String,
    /// The method's order.
    pub order: u32,
    /// Whether it goes by a tolerance.
    pub controlled: bool,
    /// What is found.
    pub finding: Finding,
    /// Its least error.
    pub best: Option<f64>,
}

/// Errors above this part of the motion do not fall as the order says yet.
const COARSE: f64 = 0.05;
/// Rounding begins to show in errors below this multiple of the floor.
const ROUGH: f64 = 8.0;
/// The part of its order that a method has to show.
const SHARE: f64 = 0.75;
/// The least power of the tolerance that an error has to follow.
const FOLLOWS: f64 = 0.5;
/// Errors below this part of the motion are as good as none.
const EXACT: f64 = 1e-11;
/// A last error below this multiple of the tolerance, as a part of the motion, keeps to it.
const KEEPS: f64 = 100.0;
/// The least order that a method shows where laws have kinks.
const KINKED: f64 = 0.5;
/// Steps of a fit.
const WINDOW: usize = 3;

/// A verdict on each method, scalar and formulation of a study's full scene.
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

/// The longest step at which the classical Runge–Kutta method follows the motion; 0 where none does.
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

/// What the errors of one method say, from the coarsest to the finest.
fn finding(rows: &[&Row], facts: &Facts, order: u32, stable: f64) -> Finding {
    let epsilon = match rows[0].scalar.as_str() {
        "f32" => f64::from(f32::EPSILON) / f64::EPSILON,
        _ => 1.0,
    };
    let rounding = ROUGH * epsilon * facts.floor;
    let held = rows.iter().filter(|r| r.holds());
    let mut points: Vec<(StepControl, f64)> = held
        .filter_map(|r| Some((r.step_control, r.error?)))
        .collect();
    // The scene's own step control, which comes last, is no part of the sequence.
    let sequence = points
        .windows(2)
        .take_while(|p| p[1].0.value() < p[0].0.value());
    points.truncate(sequence.count() + 1);
    let reached = points
        .iter()
        .any(|p| p.1 <= rounding || p.1 < EXACT * facts.size);
    let fine = points.iter().filter(|p| p.1 < COARSE * facts.size);
    // The floor itself says nothing of an order, and neither does what lies beyond it.
    let fine = fine.take_while(|p| p.1 > rounding);
    let logs: Vec<(f64, f64)> = fine.map(|(x, e)| (x.value().ln(), e.ln())).collect();
    if let Some((StepControl::Tolerance(_), _)) = points.first() {
        return match logs.len() {
            0..=2 if reached => Finding::Converges(slope(&logs).unwrap_or(1.0)),
            0..=2 => Finding::TooFew,
            _ => match (judged(slope(&logs), FOLLOWS), points.last()) {
                // Errors that keep to the tolerance need not follow it: steps end at the samples.
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
    // Of those that show the order the finest: coarser ones may fall into stability.
    let shown = slopes.clone().rfind(|p| *p >= least);
    match shown.or_else(|| slopes.reduce(f64::max)) {
        Some(best) => match judged(Some(best), least) {
            Finding::DoesNot(p) if beyond => Finding::Stiff(p),
            Finding::DoesNot(p) if facts.kinked && p > KINKED => Finding::Kinked(p),
            finding => finding,
        },
        None => Finding::TooFew,
    }
}

fn judged(slope: Option<f64>, least: f64) -> Finding {
    match slope {
        Some(slope) if slope >= least => Finding::Converges(slope),
        Some(slope) => Finding::DoesNot(slope),
        None => Finding::TooFew,
    }
}

/// The slope of the straight line nearest to these points by least squares.
fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x0, y0) = (mean(|p| p.0), mean(|p| p.1));
    let spread: f64 = points.iter().map(|p| (p.0 - x0).powi(2)).sum();
    let joint: f64 = points.iter().map(|p| (p.0 - x0) * (p.1 - y0)).sum();
    (points.len() > 1).then(|| joint / spread)
}

impl Verdict {
    /// Whether a method that should converge does not.
    pub fn is_failure(&self) -> bool {
        matches!(self.finding, Finding::DoesNot(_))
    }

    /// In a few words: "order 3.98 of 4".
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
