//! `bgdyn check`: whether a spec is sound, and if not, everything that is wrong with it.

use std::path::PathBuf;

use anyhow::{Result, anyhow};
use bgdyn_codegen::fault::{Fault, Severity};
use bgdyn_codegen::mechanism::{LinkId, Mechanism, Parameter, Snapped};
use bgdyn_codegen::model::Refusal;
use bgdyn_codegen::scene::{Part, Solved};
use bgdyn_codegen::system::System;
use clap::Args;
use serde_json::{Value, json};

use crate::output::{print, tell};
use crate::spec_file::SpecFile;

/// Check a spec; report every fault with its place
#[derive(Args)]
#[command(after_help = "Example:\n  bgdyn check specs/scara.yaml")]
pub(crate) struct Check {
    /// The spec
    file: PathBuf,
    /// Print the findings as JSON
    #[arg(long)]
    json: bool,
}

impl Check {
    pub(crate) fn run(self) -> Result<()> {
        let spec = SpecFile::open(&self.file)?;
        if spec.is_scene() {
            return self.scene(&spec);
        }
        let (mechanism, faults) = spec.read();
        if self.json {
            let found: Vec<Value> = faults.0.iter().map(finding).collect();
            let model = mechanism.as_ref().map(model);
            let report = json!({ "ok": model.is_some(), "model": model, "findings": found });
            print(&format!("{report:#}\n"))?;
        } else {
            tell(&spec.render(&faults));
        }
        let Some(m) = mechanism else {
            tell(&format!("{}\n", faults.tally()));
            return Err(anyhow!(""));
        };
        if !self.json {
            let names = coordinates(&m).join(", ");
            let sizes = format!("NQ {}, NV {}", m.nq(), m.nv());
            print(&format!("ok: {}, {sizes}: {names}\n", m.name()))?;
            if let Some(snapped) = m.snapped() {
                print(&format!("snapped: {}\n", snapped_words(snapped)))?;
            }
        }
        Ok(())
    }
}

/// What snapping changed, on one line.
pub(crate) fn snapped_words(snapped: &Snapped) -> String {
    let Snapped { count, most, place } = snapped;
    let path = &place.path;
    let what = match count {
        1 => format!("1 direction, {most:.1e} rad off (`{path}`)"),
        _ => format!("{count} directions, the farthest {most:.1e} rad off (`{path}`)"),
    };
    format!("{what}; taken as exact, `snap: 0` at the top keeps what is written")
}

impl Check {
    fn scene(&self, spec: &SpecFile) -> Result<()> {
        let read = spec.read_scene();
        let (system, faults) = match read {
            Ok((system, warnings)) => (Some(system), warnings),
            Err(Refusal::Spec(faults)) if self.json => (None, faults),
            Err(refusal) => {
                let error = spec.refused(refusal);
                tell(&format!("{error}\n"));
                return Err(anyhow!(""));
            }
        };
        if self.json {
            let found: Vec<Value> = faults.0.iter().map(finding).collect();
            let model = system.as_ref().map(scene_model);
            let report = json!({ "ok": model.is_some(), "scene": model, "findings": found });
            print(&format!("{report:#}\n"))?;
        } else {
            tell(&spec.render(&faults));
        }
        let system = system.ok_or_else(|| anyhow!(""))?;
        if !self.json {
            let layout = &system.scene.layout;
            print(&format!(
                "ok: {}, NQ {}, NV {}, NX {}, modes {}, inputs {}\n",
                system.scene.name,
                layout.nq(),
                layout.nv(),
                layout.nx(),
                layout.modes.len(),
                layout.inputs.len()
            ))?;
            for solved in system.scene.solved() {
                print(&format!("solved: {}\n", words(&solved)))?;
            }
        }
        Ok(())
    }
}

/// `elbow_motor: without inductance: …`
fn words(solved: &Solved) -> String {
    let elements = solved.elements.join(", ");
    let nodes = match solved.nodes.as_slice() {
        [] => String::new(),
        nodes => format!(" (through {})", nodes.join(", ")),
    };
    format!("{elements}{nodes}: {}", solved.how)
}

fn scene_model(system: &System) -> Value {
    let scene = &system.scene;
    let layout = &scene.layout;
    let names = |parts: &[Part]| parts.iter().map(|p| p.name.clone()).collect::<Vec<_>>();
    let coordinates: Vec<&str> = layout.coordinates.iter().map(|c| c.name.as_str()).collect();
    let effects: Vec<&str> = scene.elements.iter().map(|e| e.name.as_str()).collect();
    let solved: Vec<Value> = scene
        .solved()
        .iter()
        .map(|s| json!({ "elements": s.elements, "nodes": s.nodes, "how": s.how }))
        .collect();
    json!({
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
    })
}

/// The coordinates' joints, in the order of q.
fn coordinates(mechanism: &Mechanism) -> Vec<&str> {
    let joint = |link: &LinkId| mechanism.links()[link.0].joint.name.as_str();
    mechanism.coordinates().iter().map(joint).collect()
}

fn model(mechanism: &Mechanism) -> Value {
    let parameter = |p: &Parameter| {
        json!({
            "name": p.name,
            "meaning": p.meaning,
            "default": p.default.to_f64(),
            "unit": p.unit,
        })
    };
    let parameters: Vec<Value> = mechanism.parameters().iter().map(parameter).collect();
    json!({
        "name": mechanism.name(),
        "nq": mechanism.nq(),
        "nv": mechanism.nv(),
        "coordinates": coordinates(mechanism),
        "parameters": parameters,
        "snapped": mechanism.snapped().map(|s| json!({ "count": s.count, "most": s.most, "path": s.place.path })),
    })
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
