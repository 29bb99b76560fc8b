//! Generates the arms in Rust and in C, and compiles the C by gcc and by clang, whichever runs here.
//!
//! `models.rs` contains the Rust modules, `c.rs` the declarations of the C functions, `arms.rs` a call of the macro
//! `arms!` with all of them, which the benchmark defines.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs};

use bgdyn_codegen::backend::{BackendInput, GivenOptions, backend_named};
use bgdyn_codegen::build_script::Build;
use bgdyn_codegen::emit::struct_ident;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection;

const ARMS: [&str; 4] = ["scara", "puma560", "panda", "ur5"];

/// The timed methods, their arguments, and the matrices and vectors in their results.
const METHODS: [(&str, &str, &str); 5] = [
    ("inverse_dynamics", "q v a", "N"),
    ("mass_matrix", "q", "N * N"),
    ("forward_dynamics", "q v tau", "N"),
    ("inverse_dynamics_derivatives", "q v a", "2 * N * N"),
    ("forward_dynamics_derivatives", "q v tau", "3 * N * N"),
];

/// The flags of both compilers; for the processor of this machine if Rust is compiled for it.
const FLAGS: [&str; 5] = [
    "-std=c99",
    "-O3",
    "-ffp-contract=off",
    "-fno-math-errno",
    "-fPIC",
];

fn main() {
    let specs = PathBuf::from(variable("CARGO_MANIFEST_DIR")).join("../../specs");
    let out = PathBuf::from(variable("OUT_DIR"));
    println!("cargo::rerun-if-changed={}", specs.display());
    println!("cargo::rerun-if-changed=build.rs");
    let compilers = compilers();
    let (mut models, mut functions, mut arms) = (String::new(), String::new(), String::new());
    for arm in ARMS {
        let path = specs.join(format!("{arm}.yaml"));
        let build = Build::new(&path).methods(METHODS.map(|m| m.0));
        let written = build.derivatives(true).write();
        written.unwrap_or_else(|error| panic!("{error}"));
        let include = format!("include!(concat!(env!(\"OUT_DIR\"), \"/{arm}.rs\"));");
        writeln!(models, "{include}").unwrap();
        let model = model(&path, arm);
        write!(arms, "{arm} {} {path:?} [", struct_ident(arm)).unwrap();
        for (compiler, command) in &compilers {
            compile(&model, compiler, command, &out);
            functions += &declarations(&model, compiler);
            let names = METHODS.map(|(method, ..)| format!("{compiler}_{arm}_{method}"));
            write!(arms, "({compiler:?} {}) ", names.join(" ")).unwrap();
        }
        writeln!(arms, "],").unwrap();
    }
    let commands: Vec<String> = compilers
        .iter()
        .map(|(_, command)| version(command))
        .collect();
    writeln!(
        models,
        "/// The compilers of C.\npub const COMPILERS: &[&str] = &{commands:?};"
    )
    .unwrap();
    fs::write(out.join("models.rs"), models).unwrap();
    fs::write(out.join("c.rs"), functions).unwrap();
    fs::write(out.join("arms.rs"), format!("arms! {{\n{arms}}}\n")).unwrap();
}

fn variable(name: &str) -> String {
    env::var(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Returns gcc and clang, as far as they run here: their name and their command. A clang of a distribution may have its
/// version in its name; the newest one is taken.
fn compilers() -> Vec<(&'static str, String)> {
    let of_version = (13..50).rev().map(|version| format!("clang-{version}"));
    let clang = ["clang".to_string()]
        .into_iter()
        .chain(of_version)
        .find(|c| runs(c));
    let gcc = Some("gcc".to_string()).filter(|c| runs(c));
    let found = [("gcc", gcc), ("clang", clang)].into_iter();
    found
        .filter_map(|(name, command)| Some((name, command?)))
        .collect()
}

fn runs(command: &str) -> bool {
    let mut process = Command::new(command);
    let process = process
        .arg("--version")
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    process.status().is_ok_and(|status| status.success())
}

fn version(command: &str) -> String {
    let said = Command::new(command)
        .arg("--version")
        .output()
        .expect("it runs");
    let said = String::from_utf8_lossy(&said.stdout).into_owned();
    said.lines().next().unwrap_or_default().to_string()
}

fn model(path: &Path, arm: &str) -> Model {
    let text = fs::read_to_string(path).expect("a spec");
    let (mechanism, faults) = bgdyn_codegen::read(&text, Some(arm));
    let mechanism = mechanism.unwrap_or_else(|| panic!("{}", faults.render(arm, &text)));
    let options = Options {
        methods: Some(METHODS.map(|m| m.0.to_string()).to_vec()),
        derivatives: true,
        ..Options::default()
    };
    selection::model(mechanism, &options).expect("methods that exist")
}

/// Writes the C files of a model, compiles them, and links the library. All names begin with that of the compiler.
fn compile(model: &Model, compiler: &str, command: &str, out: &Path) {
    let backend = backend_named("c").expect("a backend");
    let arm = model.mechanism.name();
    let library = format!("{compiler}_{arm}");
    let prefix = ("prefix".to_string(), library.clone());
    let given = GivenOptions::new("specs".into(), "c", backend.options(), [prefix]);
    let files = backend.files(&BackendInput::Mechanism(model), &given.expect("its option"));
    let folder = out.join(&library);
    fs::create_dir_all(&folder).unwrap();
    for file in files.expect("an arm that C can have") {
        fs::write(folder.join(file.name), file.text).unwrap();
    }
    let has_fma = variable("CARGO_CFG_TARGET_FEATURE")
        .split(',')
        .any(|f| f == "fma");
    let mut process = Command::new(command);
    process.current_dir(&folder).args(FLAGS);
    process.args(has_fma.then_some("-march=native"));
    // clang would collect neighbouring results to store them at once; for gcc a pragma in the file turns that off.
    process.args((compiler == "clang").then_some("-fno-slp-vectorize"));
    run(process.args(["-c", &format!("{arm}.c"), "-o", "arm.o"]));
    let archive = out.join(format!("lib{library}.a"));
    run(Command::new("ar")
        .arg("crs")
        .arg(&archive)
        .arg(folder.join("arm.o")));
    println!("cargo::rustc-link-search={}", out.display());
    println!("cargo::rustc-link-lib=static={library}");
}

fn run(process: &mut Command) {
    let done = process
        .status()
        .unwrap_or_else(|error| panic!("{process:?}: {error}"));
    assert!(done.success(), "{process:?}");
}

/// Returns the declarations of a model's functions.
fn declarations(model: &Model, compiler: &str) -> String {
    let (arm, n) = (model.mechanism.name(), model.mechanism.nv());
    let mut text = "unsafe extern \"C\" {\n".to_string();
    for (method, arguments, size) in METHODS {
        let arguments = arguments
            .split(' ')
            .map(|name| format!("{name}: &[f64; {n}]"));
        let arguments: Vec<String> = arguments.collect();
        let size = size.replace('N', &n.to_string());
        let status = if method.starts_with("forward") {
            " -> i32"
        } else {
            ""
        };
        writeln!(
            text,
            "    /// `{method}` of `{arm}` by {compiler}.\n    \
             pub safe fn {compiler}_{arm}_{method}({}, result: &mut [f64; {size}]){status};",
            arguments.join(", ")
        )
        .unwrap();
    }
    text + "}\n"
}
