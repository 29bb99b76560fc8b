//! A row of `accuracy.csv`, with its conversion from and to text.

use crate::configuration::StepControl;
use crate::table::write_csv;

/// Whether a row has valid numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// Error and time were measured.
    Ok,
    /// The error was measured; the time is an estimate from the weighted count of operations.
    Estimated,
    /// The run failed, with the reason.
    Failed(String),
}

/// The result of one run of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The scene's name.
    pub scene: String,
    /// The effects: `all`, `all but friction`, `gravity+inertia`, `none`.
    pub effects: String,
    /// The integrator.
    pub method: String,
    /// The step, s, or the tolerance.
    pub step_control: StepControl,
    /// The scalar: `f64`, `f32`.
    pub scalar: String,
    /// The equations: `cheapest`, or a formulation's name.
    pub formulation: String,
    /// Largest distance from the reference, in the measured output's unit; for fewer effects the
    /// change of the motion.
    pub error: Option<f64>,
    /// Time of compiled code per simulated millisecond, ns.
    pub ns: Option<f64>,
    /// The validity of these numbers.
    pub status: Status,
}

/// The columns, in their order.
const COLUMNS: [&str; 9] = [
    "scene",
    "effects",
    "method",
    "step_or_tol",
    "scalar",
    "formulation",
    "error",
    "ns_per_simulated_ms",
    "status",
];

/// Returns rows as CSV, with a header.
pub fn rows_csv<'a>(rows: impl IntoIterator<Item = &'a Row>) -> String {
    let header = COLUMNS.map(str::to_owned).to_vec();
    let rows = rows.into_iter().map(|row| row.record().to_vec());
    write_csv(std::iter::once(header).chain(rows))
}

impl Row {
    /// Returns whether error and time exist.
    pub fn holds(&self) -> bool {
        !matches!(self.status, Status::Failed(_))
    }

    /// Returns its fields, in the order of the columns.
    pub(crate) fn record(&self) -> [String; 9] {
        let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.3e}"));
        let status = match &self.status {
            Status::Ok => "ok".into(),
            Status::Estimated => "estimated".into(),
            Status::Failed(why) => format!("failed: {why}"),
        };
        [
            self.scene.clone(),
            self.effects.clone(),
            self.method.clone(),
            self.step_control.to_string(),
            self.scalar.clone(),
            self.formulation.clone(),
            number(self.error),
            number(self.ns),
            status,
        ]
    }

    /// Parses a row from its fields; `None` if they are invalid.
    pub(crate) fn of_record(fields: Vec<String>) -> Option<Row> {
        let [
            scene,
            effects,
            method,
            step_control,
            scalar,
            formulation,
            error,
            ns,
            status,
        ] = <[String; 9]>::try_from(fields).ok()?;
        let optional = |text: &str| match text {
            "" => Some(None),
            _ => text.parse::<f64>().ok().map(Some),
        };
        Some(Row {
            step_control: match step_control.strip_suffix(" s") {
                Some(step) => StepControl::Step(step.parse().ok()?),
                None => StepControl::Tolerance(step_control.parse().ok()?),
            },
            error: optional(&error)?,
            ns: optional(&ns)?,
            status: match status.as_str() {
                "ok" => Status::Ok,
                "estimated" => Status::Estimated,
                _ => Status::Failed(status.strip_prefix("failed: ")?.into()),
            },
            scene,
            effects,
            method,
            scalar,
            formulation,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::records;

    fn row() -> Row {
        Row {
            scene: "arm".into(),
            effects: "all".into(),
            method: "rk4".into(),
            step_control: StepControl::Step(0.002),
            scalar: "f64".into(),
            formulation: "cheapest".into(),
            error: Some(1.25e-7),
            ns: Some(840.0),
            status: Status::Ok,
        }
    }

    #[test]
    fn columns_are_those_of_the_file() {
        let text = rows_csv([&row()]);
        let lines: Vec<&str> = text.lines().collect();
        let header =
            "scene,effects,method,step_or_tol,scalar,formulation,error,ns_per_simulated_ms,status";
        assert_eq!(lines[0], header);
        assert_eq!(
            lines[1],
            "arm,all,rk4,0.002 s,f64,cheapest,1.250e-7,8.400e2,ok"
        );
    }

    #[test]
    fn rows_are_read_as_they_were_written() {
        let failed = Row {
            step_control: StepControl::Tolerance(1e-6),
            error: None,
            ns: None,
            status: Status::Failed("no accelerations (\"turn\", 3),\nat 0 s".into()),
            ..row()
        };
        let rows = [row(), failed];
        let text = rows_csv(&rows);
        let read: Option<Vec<Row>> = records(&text).skip(1).map(Row::of_record).collect();
        assert_eq!(read.as_deref(), Some(&rows[..]));
        let short = ["arm", "all", "rk4"].map(str::to_owned).to_vec();
        assert_eq!(Row::of_record(short), None);
    }
}
