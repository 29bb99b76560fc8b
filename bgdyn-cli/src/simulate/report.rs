//! What is told of a run: the table of its points, and a report for people.

use std::fmt::Write;

use bgdyn_codegen::system::System;

use super::record::{Column, Event, Record, state_columns};

/// Events that are told one by one; of more than these the number.
const EVENTS: usize = 40;

/// The points as a table with commas, the columns' units in its first line.
pub(crate) fn csv(columns: &[Column], record: &Record) -> String {
    let mut text = String::from("t [s]");
    for column in columns {
        let unit = if column.unit.is_empty() {
            "1"
        } else {
            column.unit
        };
        let _ = write!(text, ",{} [{unit}]", column.name);
    }
    text.push('\n');
    for row in &record.rows {
        let _ = write!(text, "{:?}", row.t);
        for value in &row.values {
            let _ = write!(text, ",{value:?}");
        }
        text.push('\n');
    }
    text
}

/// Steps, events, the last state and the energy's account.
pub(crate) fn report(system: &System, record: &Record) -> String {
    let mut text = format!("steps: {}", record.steps);
    if record.kinks > 0 {
        let _ = write!(text, ", kinks of laws passed: {}", record.kinks);
    }
    text.push('\n');
    text += &events(system, record);
    text += &state(system, record);
    text += &energy(system, record);
    text
}

fn events(system: &System, record: &Record) -> String {
    let mut text = format!("events: {}\n", record.events.len());
    for event in record.events.iter().take(EVENTS) {
        let _ = writeln!(text, "  t = {} s: {}", event.t, changes(system, event));
    }
    if let Some(more) = record.events.len().checked_sub(EVENTS).filter(|&n| n > 0) {
        let _ = writeln!(text, "  … and {more} more");
    }
    text
}

/// What an event changed: "`belt` is held".
pub(crate) fn changes(system: &System, event: &Event) -> String {
    let modes = system.scene.layout.modes.iter().enumerate();
    let changed = modes.filter(|&(i, _)| event.before[i] != event.after[i]);
    let told: Vec<String> = changed
        .map(|(i, mode)| match event.after[i] {
            0.0 => format!("`{}` is held", mode.name),
            way if event.before[i] == 0.0 => format!("`{}` breaks away, {way:+}", mode.name),
            way => format!("`{}` slips the other way, {way:+}", mode.name),
        })
        .collect();
    match told.is_empty() {
        true => "no mode changes".to_owned(),
        false => told.join(", "),
    }
}

/// Where the run ended: "slide = 0.1 m", part by part.
fn parts(system: &System, record: &Record) -> Vec<[String; 3]> {
    let columns = state_columns(system);
    let values = columns.into_iter().zip(record.y.iter());
    let state = values.map(|(c, x)| [c.name, format!("{x:?}"), c.unit.to_owned()]);
    let modes = system.scene.layout.modes.iter().zip(record.modes.iter());
    let modes = modes.map(|(m, x)| [format!("{}_mode", m.name), format!("{x}"), String::new()]);
    state.chain(modes).collect()
}

fn state(system: &System, record: &Record) -> String {
    let parts = parts(system, record);
    let width = parts.iter().map(|p| p[0].len()).max().unwrap_or(0);
    let mut text = format!("state at t = {} s:\n", record.t);
    for [name, value, unit] in parts {
        let _ = writeln!(
            text,
            "{}",
            format!("  {name:width$}  {value} {unit}").trim_end()
        );
    }
    text
}

/// Where a run ended, on one line.
pub(crate) fn place(system: &System, record: &Record) -> String {
    let parts = parts(system, record).into_iter();
    let told = parts.map(|[name, value, unit]| format!("{name} = {value} {unit}"));
    let told: Vec<String> = told.map(|part| part.trim_end().to_owned()).collect();
    told.join(", ")
}

fn energy(system: &System, record: &Record) -> String {
    let names = system.entries.iter().map(|entry| entry.name.as_str());
    let names: Vec<&str> = names.chain(["sum"]).collect();
    let width = names.iter().map(|n| n.len()).max().unwrap_or(0).max(9);
    let audit = &record.audit;
    let parts = [&audit.supplied, &audit.stored, &audit.dissipated];
    let mut text = format!(
        "{:width$} {:>14} {:>14} {:>14}\n",
        "energy, J", "supplied", "stored", "dissipated"
    );
    for (i, name) in names.iter().enumerate() {
        let [supplied, stored, dissipated] =
            parts.map(|x| number(x.get(i).copied().unwrap_or_else(|| x.sum())));
        let _ = writeln!(
            text,
            "{name:width$} {supplied:>14} {stored:>14} {dissipated:>14}"
        );
    }
    let _ = writeln!(
        text,
        "drift: {} J, stored + dissipated − supplied, {} of the energy that could move",
        number(audit.drift()),
        number(drift(record))
    );
    text
}

/// What the account lacks, of the energy that moved or could have (see [`Record::moved`]); 0 where it
/// lacks nothing.
pub(crate) fn drift(record: &Record) -> f64 {
    let drift = record.audit.drift().abs();
    if drift == 0.0 {
        0.0
    } else {
        drift / record.moved
    }
}

/// Six digits.
pub(crate) fn number(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        return "0".into();
    }
    if !(1e-3..1e6).contains(&size) {
        return format!("{x:.5e}");
    }
    let before = size.log10().floor() as i32;
    let decimals = usize::try_from(5 - before).unwrap_or(0);
    format!("{x:.decimals$}")
}
