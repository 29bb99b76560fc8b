//! A row of `accuracy.csv`, written and read.

use std::fmt::Write;

use crate::configuration::StepControl;

/// Whether a row's numbers hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// Error and time were measured.
    Ok,
    /// The error was measured; the time is an estimate from the weighted count of operations.
    Estimated,
    /// There is no motion to speak of, with the reason.
    Failed(String),
}

/// What came of one run of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The scene's name.
    pub scene: String,
    /// The effects: `all`, `all but friction`, `gravity+inertia`, `none`.
    pub effects: String,
    /// The method of integration.
    pub method: String,
    /// The step, s, or the tolerance.
    pub step_control: StepControl,
    /// The scalar: `f64`, `f32`.
    pub scalar: String,
    /// How the equations are written.
    pub formulation: String,
    /// Largest distance from the reference, in the measured output's unit; for fewer effects the
    /// change of the motion.
    pub error: Option<f64>,
    /// Time of compiled code per simulated millisecond, ns.
    pub ns: Option<f64>,
    /// Whether that holds.
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

/// Rows as CSV, with a header.
pub fn csv<'a>(rows: impl IntoIterator<Item = &'a Row>) -> String {
    let mut text = COLUMNS.join(",") + "\n";
    for row in rows {
        text += &row.line();
        text.push('\n');
    }
    text
}

impl Row {
    /// Whether error and time are there.
    pub fn holds(&self) -> bool {
        !matches!(self.status, Status::Failed(_))
    }

    /// One line of CSV.
    pub(crate) fn line(&self) -> String {
        let number = |x: Option<f64>, digits: usize| match x {
            Some(x) => format!("{x:.digits$e}"),
            None => String::new(),
        };
        let status = match &self.status {
            Status::Ok => "ok".into(),
            Status::Estimated => "estimated".into(),
            Status::Failed(why) => format!("failed: {why}"),
        };
        let mut line = String::new();
        for text in [&self.scene, &self.effects, &self.method] {
            let _ = write!(line, "{},", quoted(text));
        }
        let _ = write!(line, "{},", self.step_control);
        let _ = write!(line, "{},{},", self.scalar, quoted(&self.formulation));
        let (error, ns) = (number(self.error, 3), number(self.ns, 3));
        line + &format!("{error},{ns},{}", quoted(&status))
    }

    /// The row of a line of CSV; `None` where it is none.
    pub(crate) fn of_line(line: &str) -> Option<Row> {
        let fields = fields(line);
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

/// A field of CSV (RFC 4180).
pub(crate) fn quoted(text: &str) -> String {
    match text.contains([',', '"', '\n']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.into(),
    }
}

/// The fields of a line of CSV.
pub(crate) fn fields(line: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let (mut inside, mut characters) = (false, line.chars().peekable());
    while let Some(c) = characters.next() {
        let last = fields.last_mut().expect("one field at least");
        match c {
            '"' if inside && characters.peek() == Some(&'"') => {
                characters.next();
                last.push('"');
            }
            '"' => inside = !inside,
            ',' if !inside => fields.push(String::new()),
            c => last.push(c),
        }
    }
    fields
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let text = csv([&row()]);
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
    fn lines_are_read_as_they_were_written() {
        let failed = Row {
            step_control: StepControl::Tolerance(1e-6),
            error: None,
            ns: None,
            status: Status::Failed("no accelerations (\"turn\", 3) at 0 s".into()),
            ..row()
        };
        for row in [row(), failed] {
            assert_eq!(Row::of_line(&row.line()), Some(row));
        }
        assert_eq!(Row::of_line("arm,all,rk4"), None);
    }
}
