//! The result in words.

use bgdyn_identification::model::{JOINT_COLUMNS, Model, Unknown};
use bgdyn_identification::{Identification, fault::short, pseudo_inertia::to_centre};

use super::IdentifiedMachine;
use super::json::number;

/// Returns what the log is, how it was used, and what it does not say.
pub(crate) fn summary(machine: &IdentifiedMachine, found: &Identification) -> String {
    let model = machine.model();
    let quality = &found.quality;
    let mut lines = vec![format!(
        "log: {} rows at {} Hz, jitter {} %, {} rows lost, {} spikes replaced",
        quality.rows,
        short(quality.rate),
        short(100.0 * quality.jitter),
        quality.lost,
        found.spikes.iter().sum::<usize>()
    )];
    for channel in &quality.joints {
        let [low, high] = channel.range;
        let limits = match channel.limits {
            [Some(lower), Some(upper)] => format!(" of {} … {}", short(lower), short(upper)),
            _ => String::new(),
        };
        lines.push(format!(
            "  {}: {} … {}{limits}; at rest {} % of the time; smallest step {}",
            channel.name,
            short(low),
            short(high),
            short(100.0 * channel.rest),
            short(channel.step)
        ));
    }
    let seen = found.base.iter().filter(|p| p.seen).count();
    lines.push(format!(
        "least squares: cut {} Hz, {} equations, {} base parameters of {} numbers, condition {}, {seen} seen",
        short(found.cut), found.rows, found.base.len(), found.map.free.len(), short(found.condition)
    ));
    let smallest = found
        .eigenvalues
        .iter()
        .copied()
        .fold(f64::INFINITY, f64::min);
    lines.push(format!(
        "bodies: {} Newton steps, smallest eigenvalue of a pseudo-inertia {}",
        found.steps,
        short(smallest)
    ));
    for l in &found.impossible {
        lines.push(format!(
            "  no body can have the numbers of `{}` in the file: eigenvalues of its pseudo-inertia were raised to 1e-6 of their sum first",
            model.links[*l].name
        ));
    }
    for name in &machine.massless {
        lines.push(format!(
            "  `{name}` has neither mass nor tensor in the file and keeps none"
        ));
    }
    for unknown in &found.left_out {
        lines.push(format!(
            "  {} has no effect in this motion and keeps the file's number",
            model.name(*unknown)
        ));
    }
    for sticks in &found.sticking {
        let joint = &model.joints[sticks.joint];
        let unit = if joint.linear { "m/s" } else { "rad/s" };
        lines.push(format!(
            "  {}: rows slower than {} {unit} are {:.1} times as far off as fast ones. Dry friction that holds the joint takes any effort up to F; `--skip-below` leaves such rows out",
            joint.name,
            short(sticks.below),
            sticks.factor
        ));
    }
    let unseen: Vec<&str> = found
        .base
        .iter()
        .filter(|p| !p.seen)
        .map(|p| p.name.as_str())
        .collect();
    if !unseen.is_empty() {
        lines.push("not seen by this motion (deviation above 30 %): record one that does, such as that of `bgdyn excite SPEC --prior LOG`".into());
        lines.extend(unseen.iter().map(|name| format!("  {name}")));
    }
    lines.push(match found.judgement.last_third {
        true => "judged on the last third of the log, which was not identified from".into(),
        false => "judged on the other log".into(),
    });
    lines.join("\n") + "\n"
}

/// Returns tables of residuals and numbers.
pub(crate) fn table(model: &Model<'_>, found: &Identification) -> String {
    let mut rows = vec![
        [
            "joint",
            "effort",
            "file",
            "least squares",
            "bodies",
            "by velocity",
            "by position",
        ]
        .map(String::from)
        .to_vec(),
    ];
    for (j, joint) in model.joints.iter().enumerate() {
        let [file, squares, bodies] = found.judgement.left.each_ref().map(|l| &l[j]);
        rows.push(vec![
            joint.name.clone(),
            short(bodies.effort),
            short(file.rms),
            short(squares.rms),
            short(bodies.rms),
            format!("{:.0} %", 100.0 * bodies.by_velocity),
            format!("{:.0} %", 100.0 * bodies.by_position),
        ]);
    }
    let mut text =
        String::from("rms of the efforts, and of what each model leaves of them, N·m or N:\n")
            + &aligned(&rows);
    let mut rows = vec![
        ["number", "file", "found", "±", "from the log"]
            .map(String::from)
            .to_vec(),
    ];
    for (l, link) in model.links.iter().enumerate().filter(|(_, link)| link.free) {
        let was = to_centre(&link.file).0;
        if let Some(n) = number(found, Unknown::Link(l, 0)) {
            rows.push(vec![
                format!("{}.mass", link.name),
                short(was),
                short(n.value),
                short(n.deviation),
                format!("{:.0} %", 100.0 * n.from_log),
            ]);
        }
    }
    for (c, name) in JOINT_COLUMNS.iter().enumerate() {
        for (j, joint) in model.joints.iter().enumerate() {
            if let Some(n) = number(found, Unknown::Joint(c, j)) {
                rows.push(vec![
                    format!("{}.{name}", joint.name),
                    short(n.file),
                    short(n.value),
                    short(n.deviation),
                    String::new(),
                ]);
            }
        }
    }
    text += "\n";
    text + &aligned(&rows)
}

fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows[0].len();
    let widths: Vec<usize> = (0..columns)
        .map(|c| rows.iter().map(|r| r[c].chars().count()).max().unwrap_or(0))
        .collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).enumerate();
        let cells = cells.map(|(c, (cell, width))| {
            let pad = " ".repeat(width - cell.chars().count());
            if c == 0 {
                format!("{cell}{pad}")
            } else {
                format!("{pad}{cell}")
            }
        });
        cells.collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n"
    };
    rows.iter().map(line).collect()
}
