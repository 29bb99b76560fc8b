//! Writes the report of a study: one self-contained HTML page, and the same in Markdown.

use std::fmt::Write;

use crate::figures::{figures, way};
use crate::format::{escaped, short, time};
use crate::order_check::verdicts;
use crate::pareto::targets;
use crate::study::{Study, StudyInfo};

/// The machine on which times were measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// Name of the processor in the system.
    pub processor: String,
    /// Output of `rustc --version`.
    pub compiler: String,
    /// The date.
    pub date: String,
    /// The compiler flags.
    pub flags: String,
}

impl Machine {
    /// Returns what the system says of this machine.
    pub fn here() -> Machine {
        let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let model = info.lines().find_map(|l| l.strip_prefix("model name"));
        let model = model.map(|m| m.trim_start_matches([' ', '\t', ':']).to_owned());
        let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let version = std::process::Command::new(compiler)
            .arg("--version")
            .output();
        let version = version.ok().filter(|o| o.status.success());
        let version = version.map(|o| String::from_utf8_lossy(&o.stdout).trim().to_owned());
        let flags = std::env::var("RUSTFLAGS").unwrap_or_default();
        let flags = format!("profile release {flags}");
        Machine {
            processor: model.unwrap_or_else(|| std::env::consts::ARCH.into()),
            compiler: version.unwrap_or_else(|| "unknown rustc".into()),
            date: today(),
            flags: flags.trim().into(),
        }
    }

    fn line(&self) -> String {
        let Machine {
            processor,
            compiler,
            date,
            flags,
        } = self;
        format!("{processor}; {compiler}; {flags}; {date}")
    }
}

/// Returns the date in UTC, `2026-01-31` (days to a date: Fliegel and Van Flandern 1968).
fn today() -> String {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    let days = now.map_or(0, |d| d.as_secs() / 86_400) as i64;
    let l = days + 2_440_588 + 68_569;
    let n = 4 * l / 146_097;
    let l = l - (146_097 * n + 3) / 4;
    let i = 4000 * (l + 1) / 1_461_001;
    let l = l - 1461 * i / 4 + 31;
    let j = 80 * l / 2447;
    let (day, l) = (l - 2447 * j / 80, j / 11);
    let (month, year) = (j + 2 - 12 * l, 100 * (n - 49) + i + l);
    format!("{year}-{month:02}-{day:02}")
}

/// The definition of the error, the same in both reports.
const ERROR: &str = "The error of a run is the largest distance of the scene's measured output from the reference over equally spaced sample times. The reference is made by extrapolation of order 12; what it is off by is taken from a second one with a tolerance a hundred times as large.";
const VARIED: &str = "One factor is varied at a time, from all effects in f64 by the cheapest formulation: the method with its step or tolerance, the scalar, the way the equations are written, the effects. Steps are halved, tolerances divided by ten, until the error is rounding or falls no more.";
const POINTS: &str = "Leaving out `inertia` can make a scene dearer: its links are point masses then. Where they come to lie on a joint's axis, this joint has next to no inertia, and the mass matrix loses digits. The generator sees that in sampled states and solves by articulated bodies, which keep the digits and take more operations. A joint that has no inertia in any state has no acceleration: `derivative` refuses the state, the time shown is that of the refusal, and no steps are given.";
const TIMES: &str = "Times are of compiled code, runs of the whole scene with what the method needs, medians of five rounds in which every run is timed in turn, in each round the best of three measurements. Integrators call the scene's functions through a pointer. Times of one call of `derivative` are measured in the same way, in 25 rounds, at the start of the run, without a pointer.";
const GUESSES: &str = "Times are estimates from the weighted count of operations: no cargo, or no crates, to compile the scene with. Nothing of the evaluator's own speed is in them.";

/// Describes the subject of a study, in a sentence.
fn about(facts: &StudyInfo) -> String {
    format!(
        "{}. Measured: `{}`, in {}, at {} times up to {} s; it moves by {} {}. The reference is off by {} {}; rounding in f64 begins at {} {}.",
        facts.description.trim_end_matches('.'),
        facts.output,
        facts.unit,
        facts.samples,
        short(facts.end),
        short(facts.size),
        facts.unit,
        short(facts.reference_error),
        facts.unit,
        short(facts.floor),
        facts.unit,
    )
}

/// Returns the front as rows of a table: error, configuration, time.
fn front_rows(study: &Study) -> Vec<[String; 3]> {
    let facts = &study.facts;
    let mark = if study.is_measured() { "" } else { "~" };
    let row = |choice: &crate::pareto::Choice| {
        let ns = choice.row.ns.unwrap_or(f64::NAN);
        let formulation = match choice.row.formulation.as_str() {
            "cheapest" | "canonical" => String::new(),
            name => format!(" ({name})"),
        };
        [
            format!("{:.0e} {} at {}", choice.target, facts.unit, facts.output),
            format!("{}{formulation}", way(&choice.row)),
            format!("{mark}{} per simulated ms", time(ns)),
        ]
    };
    targets(study).iter().map(row).collect()
}

/// Returns the verdicts as rows of a table: integrator, scalar, equations, words.
fn verdict_rows(study: &Study) -> Vec<([String; 4], bool)> {
    let row = |v: crate::Verdict| {
        let words = v.words();
        let alarming = v.is_failure();
        ([v.method, v.scalar, v.formulation, words], alarming)
    };
    verdicts(study).into_iter().map(row).collect()
}

const STYLE: &str = "body{font:16px/1.5 sans-serif;color:#282828;max-width:1040px;margin:2em auto;padding:0 1em}h1{font-size:1.7em}h2{margin-top:2.2em;border-top:2px solid #282828;padding-top:.6em}h3{font-size:1.05em;margin-bottom:.3em}table{border-collapse:collapse;margin:.6em 0}th,td{text-align:left;padding:.2em 1.2em .2em 0;border-bottom:1px solid #e3e3e3}th{font-weight:600}.alarm{color:#c2410c}.faint{color:#777}svg{max-width:100%;height:auto}nav a{margin-right:1em}:root{color-scheme:light dark}@media (prefers-color-scheme: dark){body{background:#161616;color:#bfbfbf}h2{border-color:#bfbfbf}th,td{border-color:#333}a{color:#689de5}.alarm{color:#dc6410}.faint{color:#838383}}";

/// Returns the report as one HTML file without external resources.
pub fn page(studies: &[Study], machine: &Machine) -> String {
    let mut text = format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\"><title>What accuracy costs in time</title><style>{STYLE}</style></head><body>\n<h1>What accuracy costs in time</h1>\n"
    );
    let measured = studies.iter().all(Study::is_measured);
    for paragraph in [
        ERROR,
        VARIED,
        POINTS,
        if measured { TIMES } else { GUESSES },
    ] {
        writeln!(text, "<p>{}</p>", escaped(paragraph)).expect("text");
    }
    writeln!(text, "<p class=\"faint\">{}</p>", escaped(&machine.line())).expect("text");
    text += "<nav>";
    for study in studies {
        let scene = &study.facts.scene;
        write!(text, "<a href=\"#{scene}\">{scene}</a> ").expect("text");
    }
    text += "</nav>\n";
    for study in studies {
        section(&mut text, study);
    }
    text + "</body></html>\n"
}

/// Writes one scene's section of the page.
fn section(text: &mut String, study: &Study) {
    let scene = &study.facts.scene;
    let about = escaped(&about(&study.facts));
    writeln!(text, "<h2 id=\"{scene}\">{scene}</h2>\n<p>{about}</p>").expect("text");
    let figures = figures(study);
    let (numerical, model): (Vec<_>, Vec<_>) = figures
        .iter()
        .partition(|f| !f.name.ends_with("_effects.svg") && !f.name.ends_with("_stages.svg"));
    *text += "<h3>What numerical accuracy costs</h3>\n<table><tr><th>error</th><th>cheapest way</th><th>time</th></tr>\n";
    for row in front_rows(study) {
        let [a, b, c] = row.map(|cell| escaped(&cell));
        writeln!(text, "<tr><td>{a}</td><td>{b}</td><td>{c}</td></tr>").expect("text");
    }
    *text += "</table>\n";
    for figure in numerical {
        let caption = escaped(&figure.caption);
        writeln!(text, "<p class=\"faint\">{caption}</p>\n{}", figure.svg).expect("text");
    }
    if !model.is_empty() {
        *text += "<h3>What model accuracy costs</h3>\n";
    }
    for figure in model {
        let caption = escaped(&figure.caption);
        writeln!(text, "<p class=\"faint\">{caption}</p>\n{}", figure.svg).expect("text");
    }
    *text += "<h3>How errors fall</h3>\n<table><tr><th>method</th><th>scalar</th><th>equations</th><th>found</th></tr>\n";
    for (row, alarming) in verdict_rows(study) {
        let [a, b, c, d] = row.map(|cell| escaped(&cell));
        let class = if alarming { " class=\"alarm\"" } else { "" };
        writeln!(
            text,
            "<tr{class}><td>{a}</td><td>{b}</td><td>{c}</td><td>{d}</td></tr>"
        )
        .expect("text");
    }
    *text += "</table>\n";
}

/// Returns the report in Markdown, with the figures as files beside it. `again` is the command that
/// creates it.
pub fn readme(studies: &[Study], machine: &Machine, again: &str) -> String {
    let measured = studies.iter().all(Study::is_measured);
    let times = if measured { TIMES } else { GUESSES };
    let mut text = format!(
        "# What accuracy costs in time\n\n{ERROR}\n\n{VARIED}\n\n{POINTS}\n\n{times}\n\nMeasured on {}. Made again by:\n\n```sh\n{again}\n```\n\nAll rows are in `accuracy.csv`, what each effect costs is in `costs.csv`, the same report with everything on one page is `report.html`.\n",
        machine.line()
    );
    for study in studies {
        let scene = &study.facts.scene;
        write!(text, "\n## {scene}\n\n{}\n", about(&study.facts)).expect("text");
        text += "\n| error | cheapest way | time |\n|---|---|---|\n";
        for [a, b, c] in front_rows(study) {
            writeln!(text, "| {a} | {b} | {c} |").expect("text");
        }
        for figure in figures(study) {
            write!(
                text,
                "\n{}\n\n![{scene}]({})\n",
                figure.caption, figure.name
            )
            .expect("text");
        }
        text += "\n| method | scalar | equations | found |\n|---|---|---|---|\n";
        for ([a, b, c, d], _) in verdict_rows(study) {
            writeln!(text, "| {a} | {b} | {c} | {d} |").expect("text");
        }
    }
    text
}
