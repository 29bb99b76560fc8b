//! Tests the macro from the caller's side: programs that compile and run, and the errors of those that do not.
//!
//! After an intended change: `BGDYN_WRITE=1 cargo test -p ui`.

#[path = "../outside/mod.rs"]
mod outside;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use outside::Outside;
use serde_json::Value;

const FOLDER: &str = env!("CARGO_MANIFEST_DIR");

/// Returns the programs of a folder.
fn programs(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(Path::new(FOLDER).join(folder)).expect("a folder");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("a file").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "rs"));
    paths.sort();
    assert!(!paths.is_empty(), "{folder} is empty");
    paths
}

/// What the compiler made of a program.
#[derive(Default)]
struct Compiled {
    messages: String,
    errors: usize,
    executable: Option<PathBuf>,
}

/// Compiles all programs; returns what became of each.
fn compile(programs: &[PathBuf]) -> BTreeMap<PathBuf, Compiled> {
    let mut targets = String::new();
    for path in programs {
        let name = path.file_stem().expect("a name").to_string_lossy();
        writeln!(targets, "\n[[bin]]\nname = {name:?}\npath = {path:?}").expect("text");
    }
    let workspace = Path::new(FOLDER).ancestors().nth(2).expect("the workspace");
    let package = Outside::new(workspace, "callers", "bgdyn", &targets);
    // A file that a program looks for may be new: nothing of an earlier run is left.
    let cleaned = package
        .cargo(&["clean", "--quiet", "--package", "callers"])
        .output();
    cleaned.expect("cargo runs");
    let arguments = [
        "build",
        "--quiet",
        "--bins",
        "--keep-going",
        "--message-format=json",
    ];
    let output = package.cargo(&arguments).output().expect("cargo runs");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let mut all: BTreeMap<PathBuf, Compiled> = BTreeMap::new();
    for line in text.lines() {
        let line: Value = serde_json::from_str(line).expect("JSON");
        let Some(path) = line["target"]["src_path"].as_str() else {
            continue;
        };
        let compiled = all.entry(PathBuf::from(path)).or_default();
        if let Some(executable) = line["executable"].as_str() {
            compiled.executable = Some(executable.into());
        }
        if let Some(rendered) = line["message"]["rendered"].as_str() {
            compiled.messages += rendered;
            compiled.errors += usize::from(line["message"]["level"] == "error");
        }
    }
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(all.keys().any(|path| path.starts_with(FOLDER)), "{stderr}");
    all
}

/// Returns messages without what depends on the machine and without the compiler's closing words.
fn portable(messages: &str) -> String {
    let closing = [
        "error: aborting due to",
        "For more information about",
        "Some errors have detailed",
    ];
    let lines = messages
        .lines()
        .filter(|line| !closing.iter().any(|words| line.starts_with(words)));
    let text = lines
        .map(|line| line.trim_end().to_owned() + "\n")
        .collect::<String>();
    let text = text
        .replace('\\', "/")
        .replace(&format!("--> {FOLDER}/"), "--> ");
    let mut text = text.replace(FOLDER, "$DIR");
    while text.contains("\n\n\n") {
        text = text.replace("\n\n\n", "\n\n");
    }
    text.trim().to_owned() + "\n"
}

#[test]
fn callers() {
    let (passing, failing) = (programs("pass"), programs("fail"));
    let all = [&passing[..], &failing].concat();
    let mut compiled = compile(&all);
    let mut wrong = Vec::new();
    for path in passing {
        let found = compiled.remove(&path).unwrap_or_default();
        let Some(executable) = found.executable else {
            wrong.push(format!("{}:\n{}", path.display(), found.messages));
            continue;
        };
        let run = Command::new(executable).output().expect("it starts");
        if !run.status.success() {
            let stderr = String::from_utf8_lossy(&run.stderr);
            wrong.push(format!("{}: {}\n{stderr}", path.display(), run.status));
        }
    }
    for path in failing {
        let found = compiled.remove(&path).unwrap_or_default();
        let (file, messages) = (path.with_extension("stderr"), portable(&found.messages));
        if found.errors == 0 || found.executable.is_some() {
            wrong.push(format!("{} compiles", path.display()));
        } else if env::var_os("BGDYN_WRITE").is_some() {
            fs::write(&file, messages).expect("a file");
        } else if fs::read_to_string(&file).unwrap_or_default() != messages {
            wrong.push(format!(
                "{} differs from what the compiler says:\n{messages}",
                file.display()
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
