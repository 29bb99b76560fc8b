//! Reads the table, and finds every fault of it at once.

use std::io::Read;

use super::{ColumnNames, Log, Quantity};
use crate::fault::{LogFault, LogFaults};

/// Returns the factor from a unit to that of the quantity in SI, for a joint that slides or turns.
///
/// # Errors
/// Why the unit does not fit.
pub type UnitFactor<'a> = dyn Fn(&str, Quantity, bool) -> Result<f64, String> + 'a;

/// What is expected of a table.
pub struct Expected<'a> {
    /// Names of the joints, and whether they slide.
    pub joints: Vec<(String, bool)>,
    /// Names of the columns.
    pub names: ColumnNames,
    /// Units of a second row.
    pub unit: &'a UnitFactor<'a>,
}

/// A column that is read.
struct Column {
    /// Its index in the table.
    at: usize,
    quantity: Quantity,
    linear: bool,
    factor: f64,
}

/// Reads a table: a header, a row of units or none, numbers.
///
/// # Errors
/// All faults of the table.
pub fn read(table: impl Read, expected: &Expected<'_>) -> Result<Log, Vec<LogFault>> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(table);
    let mut records = reader.records();
    let header = match records.next() {
        Some(Ok(header)) => header,
        Some(Err(error)) => return Err(vec![unreadable(&error)]),
        None => {
            let fault = LogFault::at(1, 1, "empty-log", "the log is empty".into());
            return Err(vec![fault.with_help("its first row names the columns")]);
        }
    };
    let mut faults = LogFaults::default();
    let Some(columns) = columns(&header, expected, &mut faults) else {
        return Err(faults.into_vec());
    };
    let mut table = Table {
        columns,
        width: header.len(),
        rows: Vec::new(),
        lines: Vec::new(),
    };
    for (row, record) in records.enumerate() {
        match record {
            Ok(record) if row == 0 && table.is_units(&record) => {
                table.take_units(&record, expected, &mut faults);
            }
            Ok(record) => table.take(&record, &mut faults),
            Err(error) => faults.push(unreadable(&error)),
        }
    }
    let log = table.log();
    if log.time.len() < 2 && faults.is_empty() {
        let message = format!("the log has {} rows", log.time.len());
        faults.push(
            LogFault::whole("empty-log", message).with_help("record a motion of at least 5 s"),
        );
    }
    match faults.is_empty() {
        true => Ok(log),
        false => Err(faults.into_vec()),
    }
}

fn unreadable(error: &csv::Error) -> LogFault {
    let line = error.position().map_or(1, |p| p.line() as usize);
    LogFault::at(line, 1, "unreadable", error.to_string())
}

/// Returns the columns: time, positions, efforts.
fn columns(
    header: &csv::StringRecord,
    expected: &Expected<'_>,
    faults: &mut LogFaults,
) -> Option<Vec<Column>> {
    let line = header.position().map_or(1, |p| p.line() as usize);
    let mut columns = Vec::new();
    let mut find = |quantity: Quantity, name: &str, number: usize, linear: bool| {
        let names = expected.names.of_joint(quantity, name, number);
        let found: Vec<usize> = (0..header.len())
            .filter(|i| names.iter().any(|n| n == &header[*i]))
            .collect();
        match found[..] {
            [at] => columns.push(Column {
                at,
                quantity,
                linear,
                factor: 1.0,
            }),
            [] => {
                let whose = match quantity {
                    Quantity::Time => "the time".to_owned(),
                    Quantity::Position => format!("the position of joint `{name}`"),
                    Quantity::Effort => format!("the effort of joint `{name}`"),
                };
                let message = format!(
                    "no column with {whose}: `{}` was looked for",
                    names.join("`, `")
                );
                let has: Vec<&str> = header.iter().collect();
                let help = format!(
                    "the columns are {}; other names by --columns q=PATTERN,tau=PATTERN,time=NAME",
                    has.join(", ")
                );
                faults.push(LogFault::at(line, 1, "missing-column", message).with_help(help));
            }
            _ => {
                let message = format!(
                    "column {} and column {} are the same: `{}`",
                    found[0] + 1,
                    found[1] + 1,
                    &header[found[1]]
                );
                let fault = LogFault::at(line, found[1] + 1, "repeated-column", message);
                faults.push(fault.with_help("take one out"));
            }
        }
    };
    find(Quantity::Time, "", 0, false);
    for quantity in [Quantity::Position, Quantity::Effort] {
        for (j, (name, linear)) in expected.joints.iter().enumerate() {
            find(quantity, name, j + 1, *linear);
        }
    }
    faults.is_empty().then_some(columns)
}

struct Table {
    columns: Vec<Column>,
    width: usize,
    /// Each row's numbers, in the order of the columns.
    rows: Vec<Vec<f64>>,
    lines: Vec<usize>,
}

impl Table {
    /// Returns whether a row has no number in any column that is read.
    fn is_units(&self, record: &csv::StringRecord) -> bool {
        let texts = self.columns.iter().filter_map(|c| record.get(c.at));
        let mut number = texts.map(|text| text.parse::<f64>().is_ok());
        !number.any(|is| is)
    }

    fn take_units(
        &mut self,
        record: &csv::StringRecord,
        expected: &Expected<'_>,
        faults: &mut LogFaults,
    ) {
        let line = record.position().map_or(2, |p| p.line() as usize);
        for column in &mut self.columns {
            let text = record.get(column.at).unwrap_or("").trim_matches(['[', ']']);
            match (expected.unit)(text, column.quantity, column.linear) {
                Ok(factor) => column.factor = factor,
                Err(why) => {
                    let fault = LogFault::at(line, column.at + 1, "wrong-unit", why);
                    faults.push(fault.with_help(
                        "correct the row of units, or take it out: then numbers are in SI units",
                    ));
                }
            }
        }
    }

    fn take(&mut self, record: &csv::StringRecord, faults: &mut LogFaults) {
        let line = record.position().map_or(0, |p| p.line() as usize);
        if record.len() != self.width {
            let message = format!("{} values instead of {}", record.len(), self.width);
            let fault = LogFault::at(
                line,
                record.len().min(self.width) + 1,
                "wrong-count",
                message,
            );
            faults.push(fault.with_help("each row has one value for each name of the header"));
            return;
        }
        let mut row = Vec::with_capacity(self.columns.len());
        for column in &self.columns {
            let text = &record[column.at];
            match text.parse::<f64>() {
                Ok(x) if x.is_finite() => row.push(x * column.factor),
                _ => {
                    let message = format!("`{text}` is not a finite number");
                    let fault = LogFault::at(line, column.at + 1, "not-finite", message);
                    faults.push(
                        fault.with_help("take the row out: single lost rows are interpolated"),
                    );
                }
            }
        }
        if row.len() == self.columns.len() {
            self.check_time(row[0], line, faults);
            self.rows.push(row);
            self.lines.push(line);
        }
    }

    fn check_time(&self, time: f64, line: usize, faults: &mut LogFaults) {
        let Some(before) = self.rows.last().map(|row| row[0]) else {
            return;
        };
        if time <= before {
            let word = if time == before {
                "does not advance"
            } else {
                "runs back"
            };
            let message = format!("the time {word}: {time} s after {before} s");
            let fault = LogFault::at(line, self.columns[0].at + 1, "time-order", message);
            faults.push(fault.with_help(
                "sort the rows and take doubled ones out, or cut the log where the clock was set",
            ));
        }
    }

    fn log(self) -> Log {
        let joints = (self.columns.len() - 1) / 2;
        let column = |c: usize| self.rows.iter().map(|row| row[c]).collect::<Vec<f64>>();
        Log {
            time: column(0),
            q: (0..joints).map(|j| column(1 + j)).collect(),
            tau: (0..joints).map(|j| column(1 + joints + j)).collect(),
            lines: self.lines,
        }
    }
}
