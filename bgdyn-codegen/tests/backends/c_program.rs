//! Compiles generated C with a program that calls each function on states from its input.

use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use bgdyn_codegen::backend::GeneratedFile;
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::{Argument, Method};
use bgdyn_codegen::model::Model;

use crate::values::CNumber;

/// The flags with which generated C must compile without a warning, and with which it has Rust's bits.
const FLAGS: [&str; 10] = [
    "-std=c99",
    "-ffp-contract=off",
    "-Wall",
    "-Wextra",
    "-pedantic",
    "-Wconversion",
    "-Wshadow",
    "-Wdouble-promotion",
    "-Wfloat-conversion",
    "-Werror",
];

/// Bytes of a C file that is long: compiled by one compiler and not optimised, because that takes minutes otherwise. The
/// others are optimised by `-O1`. With [`everything`] no file is long, and all are optimised by `-O2`.
const LONG: usize = 60_000;

/// Returns whether the long test asks for everything, optimised.
pub fn everything() -> bool {
    std::env::var_os("BGDYN_EVERYTHING").is_some()
}

fn is_long(bytes: usize) -> bool {
    bytes > LONG && !everything()
}

/// Returns the compilers for these files: all of the machine, or the first one for long ones.
pub fn compilers_for(files: &[GeneratedFile]) -> Vec<String> {
    let mut found = compilers();
    if files.iter().any(|file| is_long(file.text.len())) {
        found.truncate(1);
    }
    found
}

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
    program: &CProgram,
) -> PathBuf {
    let folder = write(&format!("{name}_{compiler}_{}", T::NAME), files);
    build(compiler, &folder, &program.file, &program.text::<T>(), &[])
}

/// Compiles the file of this name in a folder with the text of a program around it, with these flags beside the usual
/// ones.
pub fn build(compiler: &str, folder: &Path, file: &str, main: &str, flags: &[&str]) -> PathBuf {
    fs::write(folder.join("main.c"), main).expect("a file");
    let size = fs::metadata(folder.join(format!("{file}.c")))
        .expect("a file")
        .len();
    let level = match everything() {
        true => "-O2",
        false if is_long(size as usize) => "-O0",
        false => "-O1",
    };
    let output = Command::new(compiler)
        .current_dir(folder)
        .arg(level)
        .args(FLAGS)
        .args(flags)
        .args([&format!("{file}.c"), "main.c", "-o", "program", "-lm"])
        .output()
        .expect("the compiler runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "{compiler}: {}\n{said}",
        folder.display()
    );
    is_header_of_cpp(folder, file);
    folder.join("program")
}

/// Fails unless the header is C++ as well.
fn is_header_of_cpp(folder: &Path, mechanism: &str) {
    let text = format!("#include \"{mechanism}.h\"\nint main() {{ return 0; }}\n");
    fs::write(folder.join("main.cpp"), text).expect("a file");
    let mut command = Command::new("g++");
    let flags = [
        "-std=c++17",
        "-Wall",
        "-Wextra",
        "-pedantic",
        "-Werror",
        "-fsyntax-only",
        "main.cpp",
    ];
    if let Ok(output) = command.current_dir(folder).args(flags).output() {
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{mechanism}.h in C++\n{said}");
    }
}

/// A call of a generated function in the program.
pub struct CCall {
    /// Its name without the prefix.
    pub name: String,
    /// Its arguments: `q`, `v`, `a` or `tau`, after the run-time parameters if `reads_parameters`.
    pub arguments: Vec<&'static str>,
    /// Whether it takes the run-time parameters, if there are any.
    pub reads_parameters: bool,
    /// The number of elements of its result.
    pub size: usize,
    /// Whether it returns a number.
    pub is_checked: bool,
    /// Whether its result is a struct of arrays, with its name.
    pub is_struct: bool,
}

impl CCall {
    /// Returns the call of a model's function with a result of this size; C has no empty arrays.
    pub fn of(function: &Function, [nq, nv]: [usize; 2], size: usize) -> Self {
        let name = |argument: &Argument| match argument {
            Argument::Q => Some("q").filter(|_| nq > 0),
            Argument::V => Some("v").filter(|_| nv > 0),
            Argument::A => Some("a").filter(|_| nv > 0),
            Argument::Tau => Some("tau").filter(|_| nv > 0),
            Argument::TreeV => Some("v"),
            Argument::ReferenceV => Some("v_r").filter(|_| nv > 0),
            Argument::ReferenceA => Some("a").filter(|_| nv > 0),
            Argument::Direction | Argument::AlongA => Some("tau").filter(|_| nv > 0),
            Argument::AlongTau => Some("a").filter(|_| nv > 0),
            Argument::AlongQ | Argument::Cotangent => Some("v_r").filter(|_| nv > 0),
            Argument::AlongV => Some("modes").filter(|_| nv > 0),
            _ => Some("tau"),
        };
        CCall {
            name: function.name().into(),
            arguments: function
                .method
                .arguments()
                .iter()
                .filter_map(name)
                .collect(),
            reads_parameters: true,
            size,
            is_checked: function.shape().checked(),
            is_struct: false,
        }
    }

    /// Returns the call of a function whose result is a struct of arrays.
    pub fn in_struct(self) -> Self {
        CCall {
            is_struct: true,
            ..self
        }
    }
}

/// Returns what the program says of these states, each the numbers of its arrays and then the run-time parameters: for
/// each the words of its functions, one after the other.
pub fn run<T: CNumber>(program: &Path, states: &[Vec<T>]) -> Vec<Vec<i128>> {
    let mut input = String::new();
    for state in states {
        input += "0 ";
        let mut all = state.iter();
        all.try_for_each(|x| write!(input, "{:x} ", x.bits()))
            .expect("text");
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

/// A program that calls functions on states.
pub struct CProgram {
    /// The name of the files without an ending, which is the prefix as well.
    pub file: String,
    /// The arrays of a state, with their numbers of elements; those whose name begins with `is_` are of type `int`.
    pub arrays: Vec<(&'static str, usize)>,
    /// Names of the run-time parameters.
    pub parameters: Vec<String>,
    pub calls: Vec<CCall>,
}

impl CProgram {
    /// Returns the program of a mechanism: `q`, `v`, `a` and `tau`, with room for the velocities of the open tree.
    pub fn of(model: &Model, calls: Vec<CCall>) -> Self {
        let (nq, n) = (model.mechanism.nq(), velocity_count(model));
        let parameters = model.mechanism.parameters().iter();
        CProgram {
            file: model.mechanism.name().into(),
            arrays: [("q", nq), ("v", n), ("a", n), ("tau", effort_count(model))]
                .into_iter()
                .chain(
                    extras(model)
                        .into_iter()
                        .flat_map(|()| [("v_r", n), ("modes", n)]),
                )
                .collect(),
            parameters: parameters.map(|p| p.name.clone()).collect(),
            calls,
        }
    }

    /// Returns the text of the program.
    pub fn text<T: CNumber>(&self) -> String {
        let (file, real) = (&self.file, T::NAME);
        let word = format!("uint{}_t", 8 * size_of::<T>());
        let mut text = format!(
            "#include \"{file}.h\"
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
    {real} first;
    (void)print;
    while (next(&first)) {{
"
        );
        let mut line = |line: String| writeln!(text, "        {line}").expect("text");
        for (name, count) in &self.arrays {
            if name.starts_with("is_") {
                line(format!("int {name}[{count}];"));
                line(format!(
                    "for (int k = 0; k < {count}; ++k) {{ {real} x; next(&x); {name}[k] = x > 0; }}"
                ));
                continue;
            }
            line(format!("{real} {name}[{}];", count.max(&1)));
            line(format!("(void){name};"));
            line(format!(
                "for (int k = 0; k < {count}; ++k) next(&{name}[k]);"
            ));
        }
        if !self.parameters.is_empty() {
            line(format!(
                "struct {file}_parameters parameters = {file}_parameters_default();"
            ));
        }
        for parameter in &self.parameters {
            line(format!("next(&parameters.{parameter});"));
        }
        for call in &self.calls {
            line(self.call(call, real));
        }
        text + "        printf(\"\\n\");\n    }\n    return 0;\n}\n"
    }

    fn call(&self, call: &CCall, real: &str) -> String {
        let CCall {
            name,
            arguments,
            size,
            is_checked,
            is_struct,
            ..
        } = call;
        let given = call.reads_parameters && !self.parameters.is_empty();
        let given = given.then_some("&parameters");
        let arguments = arguments.iter().copied();
        let all: Vec<&str> = given
            .into_iter()
            .chain(arguments)
            .chain([if *is_struct { "&all" } else { "result" }])
            .collect();
        let called = format!("{}_{name}({})", self.file, all.join(", "));
        let called = match is_checked {
            true => format!(
                "int status = {called}; printf(\" %s%x\", status < 0 ? \"-\" : \"\", status < 0 ? 1U : (unsigned)status);"
            ),
            false => format!("{called}; printf(\" 0\");"),
        };
        if *is_struct {
            let all = format!("struct {}_{name} all", self.file);
            return format!(
                "{{ {all}; {real} result[{size}]; {called} if (sizeof all != sizeof result) return 1; memcpy(result, &all, sizeof result); for (int k = 0; k < {size}; ++k) print(result[k]); }}"
            );
        }
        format!(
            "{{ {real} result[{size}]; {called} for (int k = 0; k < {size}; ++k) print(result[k]); }}"
        )
    }
}

/// Returns a value if functions of the model have further arguments: other velocities, directions.
pub fn extras(model: &Model) -> Option<()> {
    let mut methods = model.all_methods();
    let has = methods.any(|method| {
        matches!(
            method,
            Method::Regressor(_) | Method::Payload(_) | Method::Directional(_)
        )
    });
    has.then_some(())
}

/// Returns a state of a mechanism as the numbers that its program reads.
pub fn numbers<T: CNumber>(state: &Inputs<T>) -> Vec<T> {
    let parts = [
        &state.q,
        &state.v,
        &state.a,
        &state.u,
        &state.x,
        &state.modes,
        &state.parameters,
    ];
    let parts = parts.into_iter();
    parts.flatten().copied().collect()
}

/// Returns the number of velocities and efforts of each kind that a program reads: enough for the open tree.
pub fn velocity_count(model: &Model) -> usize {
    let closed = model.bond_graph.closed.as_deref();
    let of_tree = closed.map_or(0, |closed| closed.tree.coordinates.len());
    of_tree.max(model.mechanism.nv())
}

/// Returns the number of efforts, or of parameters of the bodies, that a program reads.
pub fn effort_count(model: &Model) -> usize {
    let bodies = if model.has_regressors() {
        model.body_names().len()
    } else {
        0
    };
    velocity_count(model).max(10 * bodies)
}
