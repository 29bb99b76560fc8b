//! `bgdyn check`: whether a spec is sound, and if not, everything that is wrong with it.

use std::path::PathBuf;

use anyhow::{Result, anyhow};
use bgdyn_codegen::fault::{Fault, Severity};
use bgdyn_codegen::mechanism::{Mechanism, Parameter};
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
            tell(&format!("{} faults\n", faults.count()));
            return Err(anyhow!(""));
        };
        if !self.json {
            print(&format!("ok: {}, NQ {}, NV {}\n", m.name(), m.nq(), m.nv()))?;
        }
        Ok(())
    }
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
        "parameters": parameters,
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
