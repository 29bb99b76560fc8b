//! Measures the compile-time cost of a model, for each spec of `specs/` and the chains of 32 and 64 links:
//! time of the macro, time of the compiler for its output, code size, the compiler's peak memory. Each is
//! a release build of a separate crate with Cargo's default settings, in which the macro itself is not
//! optimised.
//!
//! `cargo bench -p benches --bench compile_time -- panda` measures one; all take six minutes, and with
//! `--docs` they are written to `docs/compile_time.md`. Three crates are compared: with the macro, with
//! its text, and with neither; the shortest of three builds counts for each.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;
use std::{env, fs};

use bgdyn_codegen::build_script::Build;
use bgdyn_codegen::files::stem;

/// The methods of a controller, all in one build.
const METHODS: [&str; 5] = [
    "inverse_dynamics",
    "mass_matrix",
    "forward_dynamics",
    "bias",
    "gravity",
];
/// The methods of the chains.
const LONG: [&str; 3] = ["inverse_dynamics", "mass_matrix", "forward_dynamics"];
/// Number of builds of each crate.
const BUILDS: usize = 3;

/// A build of the scratch crate.
#[derive(Clone, Copy)]
struct Built {
    /// s
    time: f64,
    /// Bytes of code and constants.
    size: f64,
    /// Peak memory in kB, if it is known.
    peak: Option<f64>,
}

/// The crate that is built repeatedly.
struct Scratch {
    folder: PathBuf,
}

fn main() -> ExitCode {
    let wanted: Vec<String> = env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    let docs = env::args().any(|a| a == "--docs");
    match measure(&wanted).and_then(|table| if docs { write(&table) } else { Ok(()) }) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Returns the root folder of the repository.
fn root() -> Result<PathBuf, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    fs::canonicalize(root).map_err(|e| e.to_string())
}

/// Writes `docs/compile_time.md`.
fn write(table: &str) -> Result<(), String> {
    let said = |program: &str, arguments: &[&str]| {
        let done = Command::new(program).args(arguments).output().ok()?;
        let text = String::from_utf8_lossy(&done.stdout);
        Some(text.lines().next()?.trim().to_string())
    };
    let model = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = model
        .lines()
        .find_map(|l| l.strip_prefix("model name")?.split_once(':'));
    let machine = model.map_or(env::consts::ARCH, |(_, name)| name.trim());
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let compiler = said("rustc", &["--version"]).unwrap_or_default();
    let date = said("date", &["+%F"]).unwrap_or_default();
    let commit = said("git", &["rev-parse", "--short", "HEAD"]).unwrap_or_default();
    let text = format!(
        "# What a model costs while compiling\n\n\
         {machine}, {cores} cores; {compiler}; {date}, commit `{commit}`. Written by\n\n\
         ```sh\ncargo bench -p benches --bench compile_time -- --docs\n```\n\n\
         A release build of a crate that calls every method once, as Cargo makes it for a user who sets nothing: the \
         macro itself unoptimised. \"Macro\" is what the crate takes longer to build than with the generated text in \
         the macro's place, \"compiler\" what that one takes longer than an empty program; the shortest of three \
         builds each. Code is that of the program less the empty one's, memory what the build has at its peak. The \
         methods are {five}, of the chains {three}.\n\n{table}",
        five = METHODS.join(", "),
        three = LONG.join(", "),
    );
    fs::write(root()?.join("docs/compile_time.md"), text).map_err(|e| e.to_string())
}

/// Returns the table, after printing it row by row.
fn measure(wanted: &[String]) -> Result<String, String> {
    let root = root()?;
    let scratch = Scratch::new(&root)?;
    let empty = scratch.built("fn main() {}\n")?;
    let mut table = String::new();
    let mut row = |line: String| {
        println!("{line}");
        table += &line;
        table.push('\n');
    };
    row("| mechanism | methods | macro, s | compiler, s | code, kB | peak memory, MB |".into());
    row("|---|---|---|---|---|---|".into());
    for (spec, methods) in specs(&root)? {
        let name = stem(&spec);
        if !wanted.is_empty() && !wanted.contains(&name) {
            continue;
        }
        let list = methods.join(", ");
        let use_it = user(&name, methods);
        let expanded = Build::new(&spec).methods(methods.iter().copied());
        let text = expanded.source().map_err(|e| e.to_string())?.text;
        let text = scratch.built(&format!("{text}\n{use_it}"))?;
        let call = format!(
            "bgdyn::bgdyn!({:?}, methods = [{list}]);",
            spec.display().to_string()
        );
        let whole = scratch.built(&format!("{call}\n{use_it}"))?;
        let peak = whole
            .peak
            .map_or("?".into(), |kb| format!("{:.0}", kb / 1024.0));
        row(format!(
            "| `{name}` | {} | {:.2} | {:.2} | {:.1} | {peak} |",
            methods.len(),
            whole.time - text.time,
            text.time - empty.time,
            (text.size - empty.size) / 1024.0,
        ));
    }
    Ok(table)
}

/// Returns the specs with the selected methods.
fn specs(root: &Path) -> Result<Vec<(PathBuf, &'static [&'static str])>, String> {
    let entries = fs::read_dir(root.join("specs")).map_err(|e| e.to_string())?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "yaml"));
    paths.sort();
    let short = paths.into_iter().map(|path| (path, &METHODS[..]));
    let long =
        ["chain32", "chain64"].map(|name| root.join(format!("tests/golden/specs/{name}.yaml")));
    Ok(short.chain(long.map(|path| (path, &LONG[..]))).collect())
}

/// Returns a program that calls every method with values unknown to the compiler.
fn user(module: &str, methods: &[&str]) -> String {
    let model = bgdyn_codegen::emit::struct_ident(module);
    let call = |method: &&str| {
        let arguments = match *method {
            "inverse_dynamics" | "forward_dynamics" => "&q, &q, &q",
            "bias" => "&q, &q",
            _ => "&q",
        };
        format!("    black_box(m.{method}({arguments}));\n")
    };
    let calls: String = methods.iter().map(call).collect();
    format!(
        "use std::hint::black_box;\nfn main() {{\n    let m = black_box({module}::{model}::<f64>::default());\n    \
         let q = black_box(bgdyn::nalgebra::SVector::<f64, {{ {module}::NV }}>::zeros());\n{calls}}}\n"
    )
}

impl Scratch {
    /// Creates the crate, with its dependencies built.
    fn new(root: &Path) -> Result<Self, String> {
        let folder = root.join("target/compile_time");
        fs::create_dir_all(folder.join("src")).map_err(|e| e.to_string())?;
        let manifest = format!(
            "[package]\nname = \"compile_time\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n\
             [dependencies]\nbgdyn = {{ path = {:?} }}\n\n[workspace]\n",
            root.display().to_string()
        );
        fs::write(folder.join("Cargo.toml"), manifest).map_err(|e| e.to_string())?;
        // The same versions as here.
        fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).map_err(|e| e.to_string())?;
        Ok(Scratch { folder })
    }

    /// Builds this program and returns the shortest time of several builds.
    fn built(&self, program: &str) -> Result<Built, String> {
        let mut best: Option<Built> = None;
        for k in 0..=BUILDS {
            // A different text each time, otherwise nothing would be built. The first build may include
            // the libraries.
            let text = format!("{program}\n// {k}\n");
            fs::write(self.folder.join("src/main.rs"), text).map_err(|e| e.to_string())?;
            let built = self.build()?;
            if k > 0 && best.is_none_or(|best| built.time < best.time) {
                best = Some(built);
            }
        }
        best.ok_or_else(|| "nothing built".into())
    }

    fn build(&self) -> Result<Built, String> {
        let cargo = env::var_os("CARGO").unwrap_or("cargo".into());
        let timed = Path::new("/usr/bin/time").exists();
        let mut build = match timed {
            true => {
                let mut time = Command::new("/usr/bin/time");
                time.args(["-f", "peak %M"]).arg(&cargo);
                time
            }
            false => Command::new(&cargo),
        };
        build
            .args(["build", "--release", "--quiet"])
            .current_dir(&self.folder);
        build.env("CARGO_TARGET_DIR", self.folder.join("target"));
        build.env("CARGO_INCREMENTAL", "0");
        let start = Instant::now();
        let done = build.output().map_err(|e| e.to_string())?;
        let time = start.elapsed().as_secs_f64();
        let said = String::from_utf8_lossy(&done.stderr);
        if !done.status.success() {
            return Err(said.into_owned());
        }
        let program = self.folder.join("target/release/compile_time");
        Ok(Built {
            time,
            size: code(&program)?,
            peak: said
                .lines()
                .find_map(|line| line.strip_prefix("peak ")?.parse().ok()),
        })
    }
}

/// Returns the bytes of a program's code and constants, according to `size`; those of the file if there is
/// no `size`.
fn code(program: &Path) -> Result<f64, String> {
    let asked = Command::new("size").arg(program).output();
    let text = asked.map(|done| String::from_utf8_lossy(&done.stdout).into_owned());
    let first = text
        .ok()
        .and_then(|text| text.lines().nth(1)?.split_whitespace().next()?.parse().ok());
    match first {
        Some(bytes) => Ok(bytes),
        None => fs::metadata(program)
            .map(|data| data.len() as f64)
            .map_err(|e| e.to_string()),
    }
}
