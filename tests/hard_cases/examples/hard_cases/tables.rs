//! Prints the tables as text.

use std::fmt::Write;

use hard_cases::{Outcome, Single};

/// The header of the printed table.
pub const HEADER: &str = "\
case                         bar  what                                             measured  allowed of asked";

/// Returns the table in Markdown.
pub fn outcomes(outcomes: &[Outcome]) -> String {
    let mut text = String::from(
        "| case | bar | what | measured | allowed | of the bar as asked | |\n|---|---|---|---|---|---|---|\n",
    );
    for o in outcomes {
        let verdict = if o.met() { "pass" } else { "**fail**" };
        let Outcome {
            case,
            bar,
            quantity,
            measured,
            allowed,
            asked,
            ..
        } = o;
        writeln!(
            text,
            "| {case} | {bar} | {quantity} | {measured:.1e} | {allowed:.1e} | {asked:.1e} | {verdict} |"
        )
        .expect("text takes it");
    }
    text
}

/// Returns errors in `f32` without a bar, in Markdown.
pub fn single_precision(rows: &[Single]) -> String {
    let mut text = String::from(
        "| chain | cond M | inverse dynamics, eps (‖M q̈‖ + ‖c‖ + ‖g‖) | forward dynamics, relative |\n|---|---|---|---|\n",
    );
    for Single {
        case,
        cond,
        inverse,
        forward,
    } in rows
    {
        let forward = forward.map_or("refused".into(), |error| format!("{error:.1e}"));
        writeln!(text, "| {case} | {cond:.0e} | {inverse:.1} | {forward} |")
            .expect("text takes it");
    }
    text
}
