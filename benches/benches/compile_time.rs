//! Measures the compile-time cost of a model, for each spec of `specs/` and the chains of 32 and 64 links:
//! time of the macro, time of the compiler for its output, code size, the compiler's peak memory. Each is
//! a release build of a separate crate with Cargo's default settings, in which the macro itself is not
//! optimised.
//!
//! `cargo bench -p benches --bench compile_time -- panda` measures one; all take six minutes, and with
//! `--docs` they are written to `docs/compile_time.md`. Three crates are compared: with the macro, with
//! its text, and with neither; the shortest of three builds counts for each.
//!
//! `-- PATH.yaml` measures the methods of the chains for a spec from elsewhere: the macro in a dev build, its
//! text in a release build. With `--docs` it is the last section of the page.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;
use std::{env, fs};

use benches::methods::CONTROLLER;
use bgdyn_codegen::build_script::Build;
use bgdyn_codegen::files::stem;

/// The methods of the chains.
const LONG: [&str; 3] = ["inverse_dynamics", "mass_matrix", "forward_dynamics"];
/// A profile of Cargo.
#[derive(Clone, Copy)]
struct Profile {
    name: &'static str,
    folder: &'static str,
}
const DEV: Profile = Profile {
    name: "dev",
    folder: "debug",
};
const RELEASE: Profile = Profile {
    name: "release",
    folder: "release",
};
/// The spec from elsewhere that the page has a section about.
const HUMANOID: &str = "g1";
/// A program without a model.
const EMPTY: &str = "fn main() {}\n";
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

impl Built {
    /// Returns the peak memory in MB as text.
    fn peak(&self) -> String {
        self.peak
            .map_or("?".into(), |kb| format!("{:.0}", kb / 1024.0))
    }
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
    let outcome = match wanted.iter().find(|a| a.ends_with(".yaml")) {
        Some(_) if wanted.len() > 1 => Err("one path, and nothing else".into()),
        Some(path) => measure_outside(Path::new(path), docs),
        None => measure(&wanted).and_then(|table| if docs { write(&table) } else { Ok(()) }),
    };
    match outcome {
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

/// Returns where and when it is measured: processor, cores, compiler, date, commit.
fn circumstances() -> String {
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
    format!("{machine}, {cores} cores; {compiler}; {date}, commit `{commit}`")
}

/// Returns `docs/compile_time.md` and its two parts: the specs of this repository, and the section of a spec
/// from elsewhere.
fn page() -> Result<(PathBuf, String, String), String> {
    let path = root()?.join("docs/compile_time.md");
    let text = fs::read_to_string(&path).map_err(|e| e.to_string())?;
    let (specs, outside) = text.split_once("\n## ").unwrap_or((&text, ""));
    let (specs, outside) = (specs.to_owned(), outside.to_owned());
    Ok((path, specs, outside))
}

/// Writes `docs/compile_time.md`; its last section is kept.
fn write(table: &str) -> Result<(), String> {
    let text = format!(
        "# What a model costs while compiling\n\n\
         {circumstances}. Written by\n\n\
         ```sh\ncargo bench -p benches --bench compile_time -- --docs\n```\n\n\
         A release build of a crate that calls every method once, as Cargo makes it for a user who sets nothing: the \
         macro itself unoptimised. \"Macro\" is what the crate takes longer to build than with the generated text in \
         the macro's place, \"compiler\" what that one takes longer than an empty program; the shortest of three \
         builds each. Code is that of the program less the empty one's, memory what the build has at its peak. The \
         methods are {five}, of the chains {three}.\n\n{table}",
        circumstances = circumstances(),
        five = CONTROLLER.join(", "),
        three = LONG.join(", "),
    );
    let (path, _, outside) = page()?;
    let outside = match &outside[..] {
        "" => String::new(),
        section => format!("\n## {section}"),
    };
    fs::write(path, text + &outside).map_err(|e| e.to_string())
}

/// Measures a spec from elsewhere, prints its row, and writes it to the page if that is asked.
fn measure_outside(spec: &Path, docs: bool) -> Result<(), String> {
    let spec = fs::canonicalize(spec).map_err(|e| format!("{}: {e}", spec.display()))?;
    let scratch = Scratch::new(&root()?)?;
    let [text, call] = programs(&spec, &LONG)?;
    let (dev_text, dev_whole) = (scratch.built(&text, DEV)?, scratch.built(&call, DEV)?);
    let (empty, text) = (
        scratch.built(EMPTY, RELEASE)?,
        scratch.built(&text, RELEASE)?,
    );
    let table = format!(
        "| mechanism | methods | macro, dev build, s | asked | compiler, release build, s | asked | code, kB | \
         peak memory, MB |\n|---|---|---|---|---|---|---|---|\n\
         | `{}` | {} | {:.2} | 8 | {:.2} | 60 | {:.1} | {} |\n",
        stem(&spec),
        LONG.len(),
        dev_whole.time - dev_text.time,
        text.time - empty.time,
        (text.size - empty.size) / 1024.0,
        text.peak(),
    );
    println!("{table}");
    if !docs {
        return Ok(());
    }
    if stem(&spec) != HUMANOID {
        return Err(format!("--docs writes the section about `{HUMANOID}.yaml`"));
    }
    let (path, specs, _) = page()?;
    let section = format!(
        "## A humanoid with a floating base\n\n{circumstances}. `g1.urdf` is `g1_29dof_rev_1_0.urdf` of the \
         Python package example-robot-data 6.0.0: a floating base and 29 joints, 35 velocities.\n\n\
         ```sh\n\
         bgdyn import g1.urdf --base floating -o {name}.yaml\n\
         cargo bench -p benches --bench compile_time -- {name}.yaml --docs\n\
         ```\n\n\
         As above, for {methods}. \"Macro\" is that of a dev build, \"compiler\", code and memory those of a \
         release build of the generated text; \"asked\" is what they may take, s.\n\n{table}",
        circumstances = circumstances(),
        name = stem(&spec),
        methods = LONG.join(", "),
    );
    fs::write(path, format!("{}\n\n{section}", specs.trim_end())).map_err(|e| e.to_string())
}

/// Returns two programs that call the methods of a spec: with the generated text, and with the macro.
fn programs(spec: &Path, methods: &[&str]) -> Result<[String; 2], String> {
    let use_it = user(&stem(spec), methods);
    let expanded = Build::new(spec).methods(methods.iter().copied());
    let text = expanded.source().map_err(|e| e.to_string())?.text;
    let call = format!(
        "bgdyn::bgdyn!({:?}, methods = [{}]);",
        spec.display().to_string(),
        methods.join(", ")
    );
    Ok([format!("{text}\n{use_it}"), format!("{call}\n{use_it}")])
}

/// Returns the table, after printing it row by row.
fn measure(wanted: &[String]) -> Result<String, String> {
    let root = root()?;
    let scratch = Scratch::new(&root)?;
    let empty = scratch.built(EMPTY, RELEASE)?;
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
        let [text, call] = programs(&spec, methods)?;
        let text = scratch.built(&text, RELEASE)?;
        let whole = scratch.built(&call, RELEASE)?;
        row(format!(
            "| `{name}` | {} | {:.2} | {:.2} | {:.1} | {} |",
            methods.len(),
            whole.time - text.time,
            text.time - empty.time,
            (text.size - empty.size) / 1024.0,
            whole.peak(),
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
    let short = paths.into_iter().map(|path| (path, &CONTROLLER[..]));
    let long =
        ["chain32", "chain64"].map(|name| root.join(format!("tests/golden/specs/{name}.yaml")));
    Ok(short.chain(long.map(|path| (path, &LONG[..]))).collect())
}

/// Returns a program that calls every method with values unknown to the compiler.
fn user(module: &str, methods: &[&str]) -> String {
    let model = bgdyn_codegen::emit::struct_ident(module);
    let call = |method: &&str| {
        let arguments = match *method {
            "inverse_dynamics" | "forward_dynamics" => "&q, &v, &v",
            "bias" => "&q, &v",
            _ => "&q",
        };
        format!("    black_box(m.{method}({arguments}));\n")
    };
    let calls: String = methods.iter().map(call).collect();
    format!(
        "use std::hint::black_box;\nfn main() {{\n    let m = black_box({module}::{model}::<f64>::default());\n    \
         let q = black_box(bgdyn::nalgebra::SVector::<f64, {{ {module}::NQ }}>::zeros());\n    \
         let v = black_box(bgdyn::nalgebra::SVector::<f64, {{ {module}::NV }}>::zeros());\n{calls}}}\n"
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
    fn built(&self, program: &str, profile: Profile) -> Result<Built, String> {
        let mut best: Option<Built> = None;
        for k in 0..=BUILDS {
            // A different text each time, otherwise nothing would be built. The first build may include
            // the libraries.
            let text = format!("{program}\n// {k}\n");
            fs::write(self.folder.join("src/main.rs"), text).map_err(|e| e.to_string())?;
            let built = self.build(profile)?;
            if k > 0 && best.is_none_or(|best| built.time < best.time) {
                best = Some(built);
            }
        }
        best.ok_or_else(|| "nothing built".into())
    }

    fn build(&self, profile: Profile) -> Result<Built, String> {
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
            .args(["build", "--quiet", "--profile", profile.name])
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
        let program = self.folder.join("target").join(profile.folder);
        let program = program.join("compile_time");
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
