//! The Pareto front: rows that no other row dominates in error and time.

use crate::row::Row;
use crate::study::Study;

/// The cheapest row for an error.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The required error.
    pub target: f64,
    /// The row that reaches it in the least time.
    pub row: Row,
}

/// Returns the rows of the full scene that no other row dominates in error and time, from the largest
/// error to the smallest.
pub fn front(study: &Study) -> Vec<Row> {
    let mut rows: Vec<(&Row, f64, f64)> = of_scene(study);
    rows.sort_by(|a, b| (a.2, a.1).partial_cmp(&(b.2, b.1)).expect("numbers"));
    let mut front: Vec<Row> = Vec::new();
    let mut least = f64::INFINITY;
    for (row, error, _) in rows {
        if error < least {
            least = error;
            front.push(row.clone());
        }
    }
    front
}

/// Returns rows with error and time, of the scene with all effects and its default equations, in
/// velocities or momenta.
fn of_scene(study: &Study) -> Vec<(&Row, f64, f64)> {
    let usual = |r: &&Row| ["cheapest", "canonical"].contains(&r.formulation.as_str());
    let full = study
        .rows
        .iter()
        .filter(|r| r.effects == "all" && r.holds());
    let full = full.filter(usual);
    full.filter_map(|r| Some((r, r.error?, r.ns?))).collect()
}

/// Returns, for each decade of the error, the cheapest row that reaches it.
pub fn targets(study: &Study) -> Vec<Choice> {
    let front = front(study);
    let decades = (-14..=0).rev().map(|k| 10_f64.powi(k));
    let chosen = decades.filter_map(|target| {
        // On the front the time increases as the error decreases: the first row is the cheapest.
        let row = front
            .iter()
            .find(|r| r.error.is_some_and(|e| e <= target))?;
        let row = row.clone();
        Some(Choice { target, row })
    });
    let mut found: Vec<Choice> = Vec::new();
    for choice in chosen {
        // One line for each row, with the smallest error that it reaches.
        match found.last_mut() {
            Some(last) if last.row == choice.row => *last = choice,
            _ => found.push(choice),
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::configuration::StepControl;
    use crate::row::Status;
    use crate::study::StudyInfo;

    fn study(points: &[(&str, f64, f64)]) -> Study {
        let row = |&(method, error, ns): &(&str, f64, f64)| Row {
            scene: "made_up".into(),
            effects: "all".into(),
            method: method.into(),
            step_control: StepControl::Step(1e-3),
            scalar: "f64".into(),
            formulation: "cheapest".into(),
            error: Some(error),
            ns: Some(ns),
            status: Status::Ok,
        };
        Study {
            facts: StudyInfo {
                scene: "made_up".into(),
                description: String::new(),
                output: "tip".into(),
                unit: "m".into(),
                end: 1.0,
                samples: 10,
                kinked: false,
                size: 1.0,
                floor: 1e-15,
                reference_error: 1e-20,
            },
            rows: points.iter().map(row).collect(),
            costs: Vec::new(),
        }
    }

    #[test]
    fn what_another_beats_is_not_on_the_front() {
        let mut study = study(&[
            ("a", 1e-3, 10.0),
            ("b", 1e-6, 20.0),
            ("beaten", 1e-5, 30.0),
            ("c", 1e-9, 40.0),
            ("equal", 1e-9, 40.0),
            ("coarse", 1e-2, 11.0),
        ]);
        let mut failed = study.rows[0].clone();
        failed.status = Status::Failed("unstable".into());
        failed.ns = Some(1.0);
        study.rows.push(failed);
        let names = |rows: Vec<Row>| rows.into_iter().map(|r| r.method).collect::<Vec<_>>();
        assert_eq!(names(front(&study)), ["a", "b", "c"]);
        let targets = targets(&study);
        let found: Vec<(f64, &str)> = targets
            .iter()
            .map(|c| (c.target, c.row.method.as_str()))
            .collect();
        assert_eq!(found, [(1e-3, "a"), (1e-6, "b"), (1e-9, "c")]);
    }
}
