//! Counts the instructions of a call of each method of each robot of `specs/` with callgrind, in code for
//! x86-64-v3, and compares them with the recorded counts for this compiler:
//! `VERSION.csv` beside this program.
//!
//! `cargo run --release -p instructions` counts and compares, and exits with 1 if a call takes
//! over 2 % more, or if this compiler has no file: `-- --write` records the counts. Counts are exact: the
//! same on every machine under any load. Without valgrind or on other systems than x86-64 Linux it prints
//! so and counts nothing; with `CI_STRICT=1` that is a failure.

mod counts;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::{env, fs};

use counts::CALLS;

const TARGET: &str = "x86_64-unknown-linux-gnu";
const FLAGS: &str = "-C target-cpu=x86-64-v3";

fn main() -> ExitCode {
    match count(env::args().any(|a| a == "--write")) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Counts and compares, or records. Returns whether no count is too much worse.
fn count(write: bool) -> Result<bool, String> {
    if cfg!(not(all(target_arch = "x86_64", target_os = "linux"))) || !is_there("valgrind") {
        println!(
            "SKIPPED: counts of instructions: that takes valgrind and x86-64 Linux; install valgrind"
        );
        return Ok(env::var_os("CI_STRICT").is_none_or(|strict| strict != "1"));
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("{}.csv", compiler()?));
    if !write && !file.is_file() {
        return Err(format!(
            "{}: this compiler has no counts on file; record them by `cargo run --release -p instructions -- --write`",
            file.display()
        ));
    }
    let found = measured(&program()?)?;
    if found.is_empty() {
        return Err("the profile names no probe".into());
    }
    if write {
        fs::write(&file, counts::file(&found)).map_err(shown(&file))?;
        println!("recorded {} counts in {}", found.len(), file.display());
        return Ok(true);
    }
    let known = counts::of_file(&fs::read_to_string(&file).map_err(shown(&file))?)?;
    let (text, worse) = counts::compared(&known, &found);
    print!("{text}");
    println!(
        "{} counts; at most {} % above those in {}: {}",
        found.len(),
        100.0 * counts::WORSE,
        file.display(),
        if worse { "no" } else { "yes" }
    );
    Ok(!worse)
}

fn is_there(program: &str) -> bool {
    let asked = Command::new(program).arg("--version").output();
    asked.is_ok_and(|done| done.status.success())
}

fn shown(path: &Path) -> impl Fn(std::io::Error) -> String + '_ {
    move |e| format!("{}: {e}", path.display())
}

/// Returns the output of a command.
fn printed(command: &mut Command) -> Result<String, String> {
    let done = command.output().map_err(|e| format!("{command:?}: {e}"))?;
    if !done.status.success() {
        let said = String::from_utf8_lossy(&done.stderr);
        return Err(format!("{command:?} failed:\n{said}"));
    }
    Ok(String::from_utf8_lossy(&done.stdout).into_owned())
}

/// Returns the compiler's version: `1.95.0`.
fn compiler() -> Result<String, String> {
    let rustc = env::var_os("RUSTC").unwrap_or("rustc".into());
    let text = printed(Command::new(rustc).arg("--version"))?;
    let version = text.split_whitespace().nth(1);
    version.map(str::to_owned).ok_or(text)
}

/// Returns the probes, built for x86-64-v3, with names for the profile.
fn program() -> Result<PathBuf, String> {
    let cargo = env::var_os("CARGO").unwrap_or("cargo".into());
    let mut build = Command::new(cargo);
    build.args(["build", "--release", "-p", "probes"]);
    build.args(["--target", TARGET, "--message-format=json"]);
    build.current_dir(env!("CARGO_MANIFEST_DIR"));
    build
        .env("RUSTFLAGS", FLAGS)
        .env_remove("CARGO_ENCODED_RUSTFLAGS");
    let messages = printed(&mut build)?;
    let named = |line: &str| {
        let path = line.split_once("\"executable\":\"")?.1.split('"').next()?;
        Some(PathBuf::from(path))
    };
    let found = messages.lines().filter_map(named).next_back();
    found.ok_or_else(|| "cargo names no program".into())
}

/// Returns the probe in which valgrind found an instruction that it does not support: version 3.19
/// supports moves between registers in only one of their two encodings.
fn stopped_in(said: &str) -> Option<String> {
    let place = said.split_once("unhandled instruction")?.1;
    let mut names = place
        .split("probes::")
        .skip(1)
        .filter_map(|rest| rest.split([' ', '(']).next());
    let name = names.find(|name| name.matches("::").count() == 2)?;
    Some(name.to_owned())
}

/// Runs the probes under callgrind, without those that it cannot run.
fn measured(program: &Path) -> Result<counts::Counts, String> {
    let profile = program.with_extension("callgrind");
    let mut left_out: Vec<String> = Vec::new();
    loop {
        let mut run = Command::new("valgrind");
        run.args(["--tool=callgrind", "--dump-line=no"]);
        run.arg(format!("--callgrind-out-file={}", profile.display()));
        match printed(run.arg(program).arg(CALLS.to_string()).args(&left_out)) {
            Ok(_) => break,
            Err(said) => match stopped_in(&said).filter(|probe| !left_out.contains(probe)) {
                Some(probe) => {
                    println!(
                        "{probe}: left out, this valgrind does not know one of its instructions"
                    );
                    left_out.push(probe);
                }
                None => return Err(said),
            },
        }
    }
    let mut annotate = Command::new("callgrind_annotate");
    annotate.args(["--inclusive=yes", "--threshold=100", "--auto=no"]);
    let text = printed(annotate.arg(&profile))?;
    Ok(counts::of_profile(&text, CALLS))
}
