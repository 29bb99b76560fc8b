//! The operations that generated C executes are those that its comments state: the file is compiled as C++ with a
//! number type that counts.

use std::fmt::Write as _;
use std::fs;
use std::process::Command;

use bgdyn_codegen::backend::GeneratedFile;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_runtime::Operations;

use crate::c_program::{answers, write};
use crate::same_bits::{files, model};

/// Functions of the file that the program replaces.
const REPLACED: [&str; 6] = [
    "add_angle",
    "sin_cos",
    "sin_cos_sum",
    "sin_cos_pair",
    "sin_cos_all",
    "checked_pivot",
];

/// Returns the file with the functions of [`REPLACED`] under other names; their calls keep theirs.
fn with_replaced(text: &str, prefix: &str) -> String {
    let begins = |line: &str| {
        line.starts_with("static ")
            || line.starts_with(&format!("{}_INLINE ", prefix.to_uppercase()))
    };
    let line = |line: &str| {
        let of = |name: &&&str| begins(line) && line.contains(&format!(" {prefix}_{name}("));
        match REPLACED.iter().find(of) {
            Some(name) => line.replace(&format!("{prefix}_{name}("), &format!("unused_{name}(")),
            None => line.to_string(),
        }
    };
    text.lines().map(|text| line(text) + "\n").collect()
}

/// Returns the program around the file.
fn program(model: &Model) -> String {
    let name = model.mechanism.name();
    let mut text = format!("#define NAME(x) {name}_##x\n#define FILE_OF_C \"counted_{name}.c\"\n");
    text += include_str!("counted.cpp");
    text += "int main()\n{\n    Counted x[64], result[1024];\n";
    text += "    for (int k = 0; k < 64; ++k) x[k] = Counted(0.3 + 0.1 * k);\n";
    for function in &model.functions {
        let arguments = function.method.arguments().iter();
        let arguments: Vec<String> = arguments
            .enumerate()
            .map(|(k, _)| format!("x + {}", 9 * k))
            .collect();
        let (method, arguments) = (function.name(), arguments.join(", "));
        writeln!(
            text,
            "    {name}_{method}({arguments}, result);\n    print(\"{method}\");"
        )
        .expect("text");
    }
    text + "}\n"
}

/// Returns the counts that the program prints, with the names of the functions.
fn executed(model: &Model, files: &[GeneratedFile], source: &str) -> Vec<(String, Operations)> {
    let name = model.mechanism.name();
    let folder = write(&format!("counted_{name}"), files);
    fs::write(
        folder.join(format!("counted_{name}.c")),
        with_replaced(source, name),
    )
    .expect("a file");
    fs::write(folder.join("main.cpp"), program(model)).expect("a file");
    let mut compile = Command::new("g++");
    compile
        .current_dir(&folder)
        .args(["-std=c++17", "-w", "main.cpp", "-o", "program"]);
    let output = compile.output().expect("it runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let output = Command::new(folder.join("program"))
        .output()
        .expect("it runs");
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).expect("text");
    let line = |line: &str| {
        let (name, counts) = line.split_once(' ').expect("a name");
        let counts: Vec<usize> = counts
            .split(' ')
            .map(|x| x.parse().expect("a count"))
            .collect();
        let counts: [usize; 6] = counts.try_into().expect("six counts");
        (name.to_string(), Operations::new(counts))
    };
    text.lines().map(line).collect()
}

/// Returns the count in the comment above a function.
fn stated<'a>(source: &'a str, function: &str) -> &'a str {
    let at = source
        .find(&format!(" {function}(const"))
        .expect("the function");
    let (_, rest) = source[..at].rsplit_once("Operations: ").expect("a comment");
    rest.split_once(" (").expect("a formulation").0
}

/// Arms with their derivatives, whose columns are computed in loops.
#[test]
fn executed_operations_are_those_stated() {
    if !answers("g++") {
        println!("skipped: g++ does not run here");
        return;
    }
    for arm in ["scara", "puma560", "panda"] {
        let options = Options {
            derivatives: true,
            ..Options::default()
        };
        let model = model(&format!("specs/{arm}.yaml"), &options);
        let files = files(&model, &[]);
        let source = files.iter().find(|file| file.name.ends_with(".c"));
        let source = source.expect("a source file");
        let executed = executed(&model, &files, &source.text);
        assert_eq!(executed.len(), model.functions.len(), "{arm}");
        for (function, (name, operations)) in model.functions.iter().zip(executed) {
            assert_eq!(function.name(), name, "{arm}");
            let stated = stated(&source.text, &format!("{arm}_{name}"));
            assert_eq!(operations.to_string(), stated, "{arm}: {name}");
        }
    }
}
