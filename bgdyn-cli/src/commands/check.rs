//! `bgdyn check`: reports all faults of a spec, or that it has none.

use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow};
use bgdyn_codegen::fault::{Fault, Location, Severity};
use bgdyn_codegen::mechanism::{Coupling, Joint, Mechanism, Parameter, Snapped};
use bgdyn_codegen::scene::{Solved, StepControl, Variable};
use bgdyn_codegen::system::{ContactTime, SceneEquations};
use clap::Args;
use serde_json::{Value, json};

use crate::output::{print, tell};
use crate::simulate::report::short;
use crate::spec_file::{SpecFile, shown};

/// Fewer steps than this in an impact do not resolve it.
const LEAST_STEPS: f64 = 5.0;

/// Check specs; report every fault with its location
#[derive(Args)]
#[command(
    after_help = "Example:\n  bgdyn check specs/scara.yaml\n  bgdyn check specs/*.yaml --json\n  bgdyn check --loops specs/loops/four_bar.yaml\n\nExit 1 if any file has an error. --json prints one report, or a list of reports for several files."
)]
pub(crate) struct Check {
    /// Mechanisms and scenes; `-` is standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Print the findings as JSON
    #[arg(long)]
    json: bool,
    /// Print the ranks of loops, and the range of each independent joint in which they close
    #[arg(long)]
    loops: bool,
}

/// The findings of one file.
#[derive(Default)]
pub struct CheckedFile {
    /// Whether no fault refuses it.
    pub ok: bool,
    /// Lines for stdout without `--json`: sizes, names, what follows what.
    pub lines: Vec<String>,
    /// Text for stderr without `--json`.
    message: String,
    /// Text for stderr in both cases.
    tally: Option<String>,
    /// Whether that text names the file.
    names_its_file: bool,
    /// As JSON: `model` or `scene`, and its description.
    model: Option<(&'static str, Value)>,
    findings: Vec<Value>,
}

impl CheckedFile {
    /// Returns the report of `bgdyn check --json`; `file` is the file's name in it.
    pub fn report(self, file: &str) -> Value {
        let (kind, model) = self.model.unwrap_or(("model", Value::Null));
        let mut report = json!({ "file": file, "ok": self.ok, "findings": self.findings });
        report[kind] = model;
        report
    }
}

impl Check {
    pub(crate) fn run(self) -> Result<()> {
        let several = self.files.len() > 1;
        let (mut sound, mut reports) = (true, Vec::new());
        for path in &self.files {
            let found = check(path, self.loops);
            sound &= found.ok;
            if !self.json {
                tell(&found.message);
                for line in &found.lines {
                    print(&format!("{line}\n"))?;
                }
            }
            if let Some(tally) = &found.tally {
                tell(&match several && !found.names_its_file {
                    true => format!("{} has {tally}\n", shown(path)),
                    false => format!("{tally}\n"),
                });
            }
            if self.json {
                reports.push(found.report(&shown(path)));
            }
        }
        if self.json {
            let report = match several {
                true => Value::Array(reports),
                false => reports.swap_remove(0),
            };
            print(&format!("{report:#}\n"))?;
        }
        match sound {
            true => Ok(()),
            false => Err(anyhow!("")),
        }
    }
}

fn check(path: &Path, loops: bool) -> CheckedFile {
    let spec = match SpecFile::read_any(path) {
        Ok(spec) => spec,
        Err(error) => {
            let error = format!("{error:#}");
            let fault = Fault::new(&Location::file(), "unreadable", error.clone());
            return CheckedFile {
                message: format!("bgdyn: {error}\n"),
                findings: vec![finding(&fault)],
                ..CheckedFile::default()
            };
        }
    };
    if let Some(fault) = spec.urdf() {
        return CheckedFile {
            message: format!("bgdyn: {}\n", fault.headline(&shown(path))),
            findings: vec![finding(&fault)],
            ..CheckedFile::default()
        };
    }
    checked(&spec, loops)
}

/// Checks the text of a mechanism or a scene; with `loops` the ranges in which its loops close are found.
pub fn checked(spec: &SpecFile, loops: bool) -> CheckedFile {
    match spec.is_scene() {
        true => scene(spec, loops),
        false => mechanism(spec, loops),
    }
}

fn mechanism(spec: &SpecFile, loops: bool) -> CheckedFile {
    let (mechanism, faults) = spec.read();
    let mut found = CheckedFile {
        ok: mechanism.is_some(),
        message: spec.render(&faults),
        tally: mechanism.is_none().then(|| faults.tally()),
        model: Some((
            "model",
            mechanism.as_ref().map_or(Value::Null, |m| model(m, loops)),
        )),
        findings: faults.0.iter().map(finding).collect(),
        ..CheckedFile::default()
    };
    if let Some(m) = mechanism {
        let names = m.joint_names().join(", ");
        let sizes = format!("NQ {}, NV {}", m.nq(), m.nv());
        found
            .lines
            .push(format!("ok: {}, {sizes}: {names}", m.name()));
        found
            .lines
            .extend(m.followers().map(|follower| follows(&m, follower)));
        found.lines.extend(closure_lines(&m, loops));
        let prescribed = m.prescribed_names().join(", ");
        let line = format!("prescribed: {prescribed}");
        found.lines.extend((!prescribed.is_empty()).then_some(line));
        let snapped = m.snapped().map(snapped_words);
        found
            .lines
            .extend(snapped.map(|words| format!("snapped: {words}")));
    }
    found
}

fn scene(spec: &SpecFile, loops: bool) -> CheckedFile {
    let null = Some(("scene", Value::Null));
    let (system, faults) = match spec.read_scene() {
        Ok(read) => read,
        Err(refusal) => {
            let findings = spec.findings(&refusal);
            let (message, why) = spec.refusal(refusal);
            return CheckedFile {
                message,
                tally: Some(why),
                names_its_file: true,
                model: null,
                findings: findings
                    .into_iter()
                    .map(|(file, fault)| {
                        let mut found = finding(&fault);
                        if let Some(file) = file {
                            found["file"] = file.into();
                        }
                        found
                    })
                    .collect(),
                ..CheckedFile::default()
            };
        }
    };
    let layout = &system.scene.layout;
    let ok = format!(
        "ok: {}, NQ {}, NV {}, NX {}, modes {}, inputs {}",
        system.scene.name,
        layout.nq(),
        layout.nv(),
        layout.nx(),
        layout.modes.len(),
        layout.inputs.len()
    );
    let contact_times = system.contact_times();
    let solved = system.scene.solved();
    let solved = solved.iter().map(|s| format!("solved: {}", words(s)));
    CheckedFile {
        ok: true,
        lines: std::iter::once(ok)
            .chain(closure_lines(&system.scene.mechanism, loops))
            .chain(solved)
            .chain(contact_line(&system, &contact_times))
            .collect(),
        message: spec.render(&faults),
        tally: None,
        model: Some(("scene", scene_model(&system, &contact_times, loops))),
        findings: faults.0.iter().map(finding).collect(),
        names_its_file: false,
    }
}

/// Describes the changes by snapping, on one line.
pub(crate) fn snapped_words(snapped: &Snapped) -> String {
    let Snapped {
        count,
        most,
        location,
    } = snapped;
    let path = &location.path;
    let what = match count {
        1 => format!("1 direction, {most:.1e} rad off (`{path}`)"),
        _ => format!("{count} directions, the farthest {most:.1e} rad off (`{path}`)"),
    };
    format!("{what}; made exact, `snap: 0` at the top keeps the directions as written")
}

/// Describes a solved algebraic loop: `elbow_motor: without inductance: …`.
fn words(solved: &Solved) -> String {
    let elements = solved.elements.join(", ");
    let nodes = match solved.nodes.as_slice() {
        [] => String::new(),
        nodes => format!(" (through {})", nodes.join(", ")),
    };
    format!("{elements}{nodes}: {}", solved.how)
}

fn scene_model(system: &SceneEquations, times: &[ContactTime], loops: bool) -> Value {
    let scene = &system.scene;
    let layout = &scene.layout;
    let names = |parts: &[Variable]| parts.iter().map(|p| p.name.clone()).collect::<Vec<_>>();
    let coordinates: Vec<&str> = layout.coordinates.iter().map(|c| c.name.as_str()).collect();
    let effects: Vec<&str> = scene.elements.iter().map(|e| e.name.as_str()).collect();
    let solved: Vec<Value> = scene
        .solved()
        .iter()
        .map(|s| json!({ "elements": s.elements, "nodes": s.nodes, "how": s.how }))
        .collect();
    let mut model = json!({
        "name": scene.name,
        "nq": layout.nq(),
        "nv": layout.nv(),
        "nx": layout.nx(),
        "coordinates": coordinates,
        "states": names(&layout.states),
        "modes": names(&layout.modes),
        "inputs": names(&layout.inputs),
        "effects": effects,
        "solved": solved,
        "closure": closure(&scene.mechanism, loops),
    });
    let contact_times: Vec<Value> = times
        .iter()
        .map(|t| json!({ "name": t.name, "mass": t.mass, "seconds": t.seconds }))
        .collect();
    if !contact_times.is_empty() {
        model["contact_times"] = contact_times.into();
    }
    model
}

/// Returns the line about the duration of impacts at compliant contacts beside the step.
fn contact_line(system: &SceneEquations, times: &[ContactTime]) -> Option<String> {
    let by_time = |a: &&ContactTime, b: &&ContactTime| a.seconds.total_cmp(&b.seconds);
    let (shortest, longest) = (times.iter().min_by(by_time)?, times.iter().max_by(by_time)?);
    let duration = |time: &ContactTime| {
        let ms = short(1e3 * time.seconds);
        format!("{ms} ms at `{}` ({} kg)", time.name, short(time.mass))
    };
    let durations = match shortest.name == longest.name {
        true => duration(shortest),
        false => format!("{} to {}", duration(shortest), duration(longest)),
    };
    let steps = match system.scene.integration.step_control {
        StepControl::Tolerance(_) => "the tolerance chooses the steps".to_owned(),
        StepControl::Step(h) => {
            let ratio = shortest.seconds / h;
            let words = if ratio < LEAST_STEPS {
                ": too few, take shorter steps, a tolerance or a softer contact"
            } else {
                ""
            };
            format!("{} steps in the shortest{words}", short(ratio))
        }
    };
    Some(format!(
        "compliant contacts: an impact at 1 m/s lasts {durations}; {steps}"
    ))
}

/// Returns the lines about loops; with `ranges` those of `--loops`.
fn closure_lines(mechanism: &Mechanism, ranges: bool) -> Vec<String> {
    let mut lines = super::loops::lines(mechanism);
    if ranges {
        lines.extend(super::loop_ranges::lines(mechanism));
    }
    lines
}

/// Returns the same as JSON.
fn closure(mechanism: &Mechanism, ranges: bool) -> Value {
    let mut model = super::loops::model(mechanism);
    if ranges {
        super::loop_ranges::add(mechanism, &mut model);
    }
    model
}

fn model(mechanism: &Mechanism, loops: bool) -> Value {
    let parameter = |p: &Parameter| {
        json!({
            "name": p.name,
            "meaning": p.meaning,
            "default": p.default.to_f64(),
            "unit": p.unit,
        })
    };
    let parameters: Vec<Value> = mechanism.parameters().iter().map(parameter).collect();
    let mut model = json!({
        "name": mechanism.name(),
        "nq": mechanism.nq(),
        "nv": mechanism.nv(),
        "coordinates": mechanism.joint_names(),
        "positions": mechanism.position_names(),
        "parameters": parameters,
        "snapped": mechanism.snapped().map(|s| json!({ "count": s.count, "most": s.most, "path": s.location.path })),
    });
    if mechanism.closure().is_some() || !mechanism.parallel_loops().is_empty() {
        model["closure"] = closure(mechanism, loops);
    }
    model
}

fn finding(fault: &Fault) -> Value {
    json!({
        "severity": match fault.severity {
            Severity::Fault => "fault",
            Severity::Warning => "warning",
        },
        "line": fault.position.line,
        "column": fault.position.column,
        "path": fault.path,
        "rule": fault.rule,
        "message": fault.message,
        "help": fault.help,
    })
}

/// Returns "follows: tip = 0.5 · knuckle + 0.1", or "follows: velocity of tip = 0.5 · knuckle" where only the
/// velocity follows.
fn follows(mechanism: &Mechanism, (joint, coupling, _): (&Joint, &Coupling, bool)) -> String {
    let leaders = mechanism.leaders(coupling);
    let terms = coupling.velocities.iter().zip(&leaders);
    let terms = terms.map(|(leader, name)| format!("{} · {name}", leader.ratio.to_f64()));
    let sum = terms.collect::<Vec<_>>().join(" + ");
    let offset = match coupling.offset.to_f64() {
        0.0 => String::new(),
        offset => format!(" + {offset}"),
    };
    match coupling.of_positions() {
        true => format!("follows: {} = {sum}{offset}", joint.name),
        false => format!("follows: velocity of {} = {sum}", joint.name),
    }
}
