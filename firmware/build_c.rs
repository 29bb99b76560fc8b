//! The measured arms in C, compiled by gcc for the processor of the firmware.

use std::fs;
use std::path::Path;
use std::process::Command;

use bgdyn_codegen::backend::{BackendInput, GivenOptions, backend_named};
use bgdyn_codegen::options::Options;
use bgdyn_codegen::selection;

const COMPILER: &str = "arm-none-eabi-gcc";
const ARCHIVER: &str = "arm-none-eabi-ar";
/// With these the bits are Rust's; as in Rust, each function is linked only if it is called.
const FLAGS: [&str; 9] = [
    "-std=c99",
    "-O3",
    "-ffp-contract=off",
    "-fno-math-errno",
    "-ffunction-sections",
    "-fdata-sections",
    "-mthumb",
    "-mfloat-abi=hard",
    "-c",
];

/// Writes `ARM.c` of each arm in `float`, with names that begin with `c_ARM`, and links them. `rust_flags` are those of
/// the firmware: they name its processor.
pub fn build(arms: &[&str], out: &Path, rust_flags: &str) {
    let processor = match rust_flags.contains("target-cpu=cortex-m7") {
        true => ["-mcpu=cortex-m7", "-mfpu=fpv5-d16"],
        false => ["-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16"],
    };
    let folder = out.join("c");
    fs::create_dir_all(&folder).expect("OUT_DIR can be written");
    let mut archive = Command::new(ARCHIVER);
    archive.current_dir(&folder).args(["crs", "libarms.a"]);
    for arm in arms {
        write(arm, &folder);
        let mut compile = Command::new(COMPILER);
        compile.current_dir(&folder).args(FLAGS).args(processor);
        run(compile.arg(format!("{arm}.c")));
        archive.arg(format!("{arm}.o"));
    }
    run(&mut archive);
    println!("cargo::rustc-link-search={}", folder.display());
    println!("cargo::rustc-link-lib=static=arms");
}

fn write(arm: &str, folder: &Path) {
    let text = fs::read_to_string(format!("../specs/{arm}.yaml")).expect("a spec");
    let (mechanism, _) = bgdyn_codegen::read(&text, Some(arm));
    let options = Options {
        methods: Some(vec!["dynamics".into()]),
        ..Options::default()
    };
    let model = selection::model(mechanism.expect("a sound spec"), &options);
    let backend = backend_named("c").expect("a backend");
    let given = [
        ("float", "float".to_string()),
        ("prefix", format!("c_{arm}")),
    ];
    let given = given.map(|(name, value)| (name.to_string(), value));
    let given = GivenOptions::new(format!("{arm}.yaml"), "c", backend.options(), given);
    let model = model.expect("methods that exist");
    let files = backend.files(
        &BackendInput::Mechanism(&model),
        &given.expect("its options"),
    );
    for file in files.expect("an arm that C can have") {
        fs::write(folder.join(file.name), file.text).expect("OUT_DIR can be written");
    }
}

fn run(command: &mut Command) {
    let status = command.status();
    let status =
        status.unwrap_or_else(|error| panic!("{command:?}: {error}: install gcc-arm-none-eabi"));
    assert!(status.success(), "{command:?}");
}
