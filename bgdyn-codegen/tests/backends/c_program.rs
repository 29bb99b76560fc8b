//! Compiles generated C with a program that calls each function on states from its input.

use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use bgdyn_codegen::backend::GeneratedFile;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::Argument;
use bgdyn_codegen::model::Model;

use crate::values::CNumber;

/// The flags with which generated C must compile without a warning, and with which it has Rust's bits.
const FLAGS: [&str; 10] = [
    "-std=c99",
    "-O2",
    "-ffp-contract=off",
    "-Wall",
    "-Wextra",
    "-pedantic",
    "-Wconversion",
    "-Wshadow",
    "-Wdouble-promotion",
    "-Werror",
];

/// Returns the compilers of this machine among gcc and clang. A clang of a distribution may have its version in its
/// name; the newest one is taken.
pub fn compilers() -> Vec<String> {
    let of_version = (13..50).rev().map(|version| format!("clang-{version}"));
    let clang = ["clang".to_string()].into_iter().chain(of_version);
    let gcc = Some("gcc".to_string()).filter(|name| answers(name));
    let found: Vec<String> = gcc
        .into_iter()
        .chain(clang.into_iter().find(|name| answers(name)))
        .collect();
    if found.is_empty() {
        println!("skipped: neither gcc nor clang runs here");
    }
    found
}

/// Returns whether a compiler of this name runs here.
pub fn answers(name: &str) -> bool {
    let found = Command::new(name)
        .arg("--version")
        .stdout(Stdio::null())
        .status();
    found.is_ok_and(|status| status.success())
}

/// Writes the files to a folder of this name, and returns its path.
pub fn write(name: &str, files: &[GeneratedFile]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).expect("a folder");
    for file in files {
        fs::write(folder.join(&file.name), &file.text).expect("a file");
    }
    folder
}

/// Compiles the files with a program around them, in a folder of this name.
pub fn compile<T: CNumber>(
    compiler: &str,
    name: &str,
    files: &[GeneratedFile],
    model: &Model,
    sizes: &[usize],
) -> PathBuf {
    let folder = write(&format!("{name}_{compiler}_{}", T::NAME), files);
    let mechanism = model.mechanism.name();
    fs::write(folder.join("main.c"), main::<T>(model, sizes)).expect("a file");
    let output = Command::new(compiler)
        .current_dir(&folder)
        .args(FLAGS)
        .args([&format!("{mechanism}.c"), "main.c", "-o", "program", "-lm"])
        .output()
        .expect("the compiler runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{compiler}: {name}\n{said}");
    folder.join("program")
}

/// Returns what the program says of these states: for each the words of its functions, one after the other.
pub fn run<T: CNumber>(program: &Path, states: &[Inputs<T>]) -> Vec<Vec<i128>> {
    let mut input = String::new();
    for state in states {
        let parts = [&state.q, &state.v, &state.a, &state.u, &state.parameters];
        let all = parts.into_iter().flatten();
        all.for_each(|x| write!(input, "{:x} ", x.bits()).expect("text"));
        input.push('\n');
    }
    let mut process = Command::new(program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program runs");
    let mut pipe = process.stdin.take().expect("a pipe");
    let writer = std::thread::spawn(move || pipe.write_all(input.as_bytes()).expect("it reads"));
    let output = process.wait_with_output().expect("it ends");
    writer.join().expect("written");
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).expect("text");
    let word = |word: &str| i128::from_str_radix(word, 16).expect("a number");
    text.lines()
        .map(|line| line.split_whitespace().map(word).collect())
        .collect()
}

/// Returns the text of the program.
fn main<T: CNumber>(model: &Model, sizes: &[usize]) -> String {
    let (mechanism, real) = (model.mechanism.name(), T::NAME);
    let word = format!("uint{}_t", 8 * size_of::<T>());
    let (nq, nv) = (model.mechanism.nq(), model.mechanism.nv());
    let mut text = format!(
        "#include \"{mechanism}.h\"
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static int next({real} *x)
{{
    uint64_t bits;
    int found = scanf(\"%\" SCNx64, &bits) == 1;
    {word} word = found ? ({word})bits : 0;
    memcpy(x, &word, sizeof word);
    return found;
}}

static void print({real} x)
{{
    {word} word;
    memcpy(&word, &x, sizeof word);
    printf(\" %\" PRIx64, (uint64_t)word);
}}

int main(void)
{{
    {real} q[{nq}], v[{nv}], a[{nv}], tau[{nv}];
    while (next(&q[0])) {{
        for (int k = 1; k < {nq}; ++k) next(&q[k]);
        for (int k = 0; k < {nv}; ++k) next(&v[k]);
        for (int k = 0; k < {nv}; ++k) next(&a[k]);
        for (int k = 0; k < {nv}; ++k) next(&tau[k]);
"
    );
    let parameters = model.mechanism.parameters();
    if !parameters.is_empty() {
        let name = format!("struct {mechanism}_parameters");
        writeln!(
            text,
            "        {name} parameters = {mechanism}_parameters_default();"
        )
        .expect("text");
    }
    for parameter in parameters {
        writeln!(text, "        next(&parameters.{});", parameter.name).expect("text");
    }
    for (function, size) in model.functions.iter().zip(sizes) {
        let arguments = function
            .method
            .arguments()
            .iter()
            .map(|argument| match argument {
                Argument::Tau => "tau".to_string(),
                argument => argument.name().to_string(),
            });
        let parameters = (!parameters.is_empty()).then(|| "&parameters".to_string());
        let all: Vec<String> = parameters.into_iter().chain(arguments).collect();
        let call = format!(
            "{mechanism}_{}({}, result)",
            function.name(),
            all.join(", ")
        );
        let call = match function.shape().checked() {
            true => format!(
                "{real} result[{size}]; int status = {call}; printf(\" %s%x\", status < 0 ? \"-\" : \"\", status < 0 ? 1U : (unsigned)status);"
            ),
            false => format!("{real} result[{size}]; {call}; printf(\" 0\");"),
        };
        writeln!(
            text,
            "        {{ {call} for (int k = 0; k < {size}; ++k) print(result[k]); }}"
        )
        .expect("text");
    }
    text + "        printf(\"\\n\");\n    }\n    return 0;\n}\n"
}
