//! Prints a run: the table of its points, and a summary.

use std::fmt::Write;
use std::iter::once;

use bgdyn_codegen::scene::{Integration, StepControl};
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::{Digits, ImpactLaw};

use crate::table;

use super::run_table::{Column, Event, Record, state_columns};

/// Largest number of events that are listed; for more only their number is printed.
const EVENTS: usize = 40;

/// Returns "stick_slip: rk4 in steps of 0.001 s, to t = 5 s".
pub fn summary(name: &str, integration: &Integration) -> String {
    let Integration {
        method,
        step_control,
        end,
        impacts,
    } = integration;
    let step_control = match step_control {
        StepControl::Step(h) => format!("in steps of {} s", short(*h)),
        StepControl::Tolerance(t) => format!("with the tolerance {}", short(*t)),
    };
    let end = short(*end);
    let law = match impacts {
        ImpactLaw::Newton => "",
        ImpactLaw::Poisson => ", impacts by Poisson's law",
    };
    format!(
        "{name}: {} {step_control}, to t = {end} s{law}",
        method.name()
    )
}

/// Returns the points as comma-separated values, with the columns' units in the first line.
pub fn csv(columns: &[Column], record: &Record) -> String {
    let heads = columns.iter().map(Column::head);
    let header = once("t [s]".to_owned()).chain(heads).collect();
    let rows = record.rows.iter().map(|row| {
        let numbers = once(&row.t).chain(&row.values);
        numbers.map(|x| format!("{x:?}")).collect()
    });
    table::write_csv(once(header).chain(rows))
}

/// Returns steps, events, the last state and the energy account.
pub fn report(system: &SceneEquations, record: &Record) -> String {
    let mut text = format!("steps: {}", record.steps);
    if record.kinks > 0 {
        let _ = write!(text, ", kinks of laws passed: {}", record.kinks);
    }
    text.push('\n');
    text += &contacts(record);
    text += &events(system, record);
    text += &state(system, record);
    text += &energy(system, record);
    text
}

/// Returns how well the rigid contacts were solved, on a line; empty without some.
fn contacts(record: &Record) -> String {
    let Some(quality) = record.contacts else {
        return String::new();
    };
    let mut text = format!(
        "rigid contacts: deepest overlap {} m, largest residual {} N s",
        short(quality.depth),
        short(quality.residual)
    );
    if quality.unsolved > 0 {
        let _ = write!(
            text,
            ", {} steps not solved to the tolerance",
            quality.unsolved
        );
    }
    if quality.by_poisson > 0 {
        let _ = write!(
            text,
            ", {} impacts by Poisson's law, as Newton's would have added energy",
            quality.by_poisson
        );
    }
    text.push('\n');
    text
}

/// Returns the mean forces of the rigid contacts as comma-separated values: in the step up to each row, along the
/// directions of the contact. `None` without rigid contacts.
pub fn contact_csv(system: &SceneEquations, record: &Record) -> Option<String> {
    let names = &system.scene.layout.rigid_contacts;
    if names.is_empty() {
        return None;
    }
    let ends = ["friction_x", "friction_y", "normal"];
    let heads = names
        .iter()
        .flat_map(|name| ends.map(|end| format!("{name}_{end} [N]")));
    let header = once("t [s]".to_owned()).chain(heads).collect();
    let rows = record.rows.iter().map(|row| {
        let numbers = once(&row.t).chain(row.contacts.as_flattened());
        numbers.map(|x| format!("{x:?}")).collect()
    });
    Some(table::write_csv(once(header).chain(rows)))
}

fn events(system: &SceneEquations, record: &Record) -> String {
    let mut text = format!("events: {}\n", record.events.len());
    for event in record.events.iter().take(EVENTS) {
        let _ = writeln!(
            text,
            "  t = {} s: {}",
            short(event.t),
            changes(system, event)
        );
    }
    if let Some(more) = record.events.len().checked_sub(EVENTS).filter(|&n| n > 0) {
        let _ = writeln!(text, "  … and {more} more");
    }
    text
}

/// Describes the change by an event: "`belt` is held".
pub fn changes(system: &SceneEquations, event: &Event) -> String {
    let modes = system.scene.layout.modes.iter().enumerate();
    let changed = modes.filter(|&(i, _)| event.before[i] != event.after[i]);
    let of_modes = changed.map(|(i, mode)| match event.after[i] {
        0.0 => format!("`{}` is held", mode.name),
        way if event.before[i] == 0.0 => format!("`{}` is released, {way:+}", mode.name),
        way => format!("`{}` slips the other way, {way:+}", mode.name),
    });
    let names = &system.scene.layout.rigid_contacts;
    let of_contacts = event.contacts.iter().map(|what| {
        let text = format!("`{}` {}", names[what.contact], what.text);
        match what.impulse > 0.0 {
            true => format!("{text}, {} N s", short(what.impulse)),
            false => text,
        }
    });
    let texts: Vec<String> = of_modes.chain(of_contacts).collect();
    match texts.is_empty() {
        true => "no mode changes".to_owned(),
        false => texts.join(", "),
    }
}

/// Returns the final state, part by part: "slide" and "0.1 m".
fn parts(system: &SceneEquations, record: &Record) -> Vec<[String; 2]> {
    let columns = state_columns(system);
    let values = columns.into_iter().zip(record.y.iter());
    let state = values.map(|(c, &x)| [c.name, quantity(x, c.unit)]);
    let modes = system.scene.layout.modes.iter().zip(record.modes.iter());
    let modes = modes.map(|(m, x)| [format!("{}_mode", m.name), format!("{x}")]);
    state.chain(modes).collect()
}

fn state(system: &SceneEquations, record: &Record) -> String {
    let parts = parts(system, record);
    let width = parts.iter().map(|p| p[0].len()).max().unwrap_or(0);
    let mut text = format!("state at t = {} s:\n", short(record.t));
    for [name, value] in parts {
        let _ = writeln!(text, "  {name:width$}  {value}");
    }
    text
}

/// Returns the final state, on one line.
pub(crate) fn place(system: &SceneEquations, record: &Record) -> String {
    let parts = parts(system, record).into_iter();
    let texts: Vec<String> = parts
        .map(|[name, value]| format!("{name} = {value}"))
        .collect();
    texts.join(", ")
}

fn energy(system: &SceneEquations, record: &Record) -> String {
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

/// Returns the energy drift relative to the energy that moved or could have moved (see [`Record::moved`]);
/// 0 without drift.
pub(crate) fn drift(record: &Record) -> f64 {
    let drift = record.audit.drift().abs();
    if drift == 0.0 {
        0.0
    } else {
        drift / record.moved
    }
}

/// Prints six digits, with a power of ten if the number is very large or very small.
pub(crate) fn number(x: f64) -> String {
    digits(x).with_zeros().to_string()
}

/// Prints at most six digits: as [`number`], without trailing zeros.
pub(crate) fn short(x: f64) -> String {
    digits(x).to_string()
}

fn digits(x: f64) -> Digits {
    Digits::new(x, 6).plain(-3..6)
}

/// Prints a quantity with its unit, for an angle also in degrees: `0.5 rad (28.6479°)`.
pub(crate) fn quantity(x: f64, unit: &str) -> String {
    let plain = format!("{} {unit}", short(x));
    match unit.strip_prefix("rad") {
        Some(per) if x.is_finite() => format!("{plain} ({}°{per})", short(x.to_degrees())),
        _ => plain.trim_end().to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_six_digits() {
        let written = [
            (0.0, "0", "0"),
            (0.1, "0.100000", "0.1"),
            (9.999_999e-4, "0.00100000", "0.001"),
            (9.999_9e-4, "9.99990e-4", "9.9999e-4"),
            (100_000.0, "100000", "100000"),
        ];
        for (x, all, less) in written {
            assert_eq!((number(x).as_str(), short(x).as_str()), (all, less));
        }
    }

    #[test]
    fn angles_are_told_in_degrees_too() {
        assert_eq!(quantity(0.5, "rad"), "0.5 rad (28.6479°)");
        assert_eq!(quantity(-1.0, "rad/s"), "-1 rad/s (-57.2958°/s)");
        assert_eq!(quantity(2.0, "m"), "2 m");
        assert_eq!(quantity(2.0, ""), "2");
    }
}
