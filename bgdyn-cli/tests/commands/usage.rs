//! Bad usage, help, and readers that stop early.

use std::io::Read;
use std::process::{Command, Stdio};

use bgdyn_codegen::formulation::FORMULATIONS;

use crate::{bgdyn, root};

const SCARA: &str = "tests/golden/specs/scara4.yaml";
const VALUES: &str = "tests/golden/values/scara4.json";
const COMMANDS: [&str; 8] = [
    "check",
    "ops",
    "eval",
    "equations",
    "generate",
    "graph",
    "identify",
    "import",
];

#[test]
fn bad_usage_exits_with_two() {
    for arguments in [
        &["chekc", SCARA] as &[&str],
        &[],
        &["check"],
        &["check", "--fast", SCARA],
        &["graph", SCARA, SCARA],
        &["check", SCARA, "--color", "pink"],
        &["graph", SCARA, "--format", "png"],
        &["ops", SCARA, "--formulation"],
        &["ops", SCARA, "--formulation", "fastest"],
        &["generate", SCARA, "--formulation", "fastest"],
        &["generate", SCARA, "--prefer", "speed"],
        &["eval", SCARA, "bias", "--states", VALUES, "--prefer", "x"],
        &["eval", SCARA, "bias"],
        &["eval", SCARA, "gravitation", "--states", VALUES],
        &[
            "eval",
            SCARA,
            "bias",
            "--states",
            VALUES,
            "--formulation",
            "x",
        ],
        &["import"],
    ] {
        let stderr = bgdyn(arguments).bad_usage();
        assert!(!stderr.is_empty(), "{arguments:?}");
    }
    let stderr = bgdyn(&["ops", SCARA, "--formulation", "fastest"]).bad_usage();
    let names: Vec<&str> = FORMULATIONS.iter().map(|f| f.name()).collect();
    let names = names.join(", ");
    let told = format!("bgdyn: no formulation is called `fastest`; there are {names}\n");
    assert_eq!(stderr, told);
    let stderr = bgdyn(&["ops", SCARA, "--prefer", "acuracy"]).bad_usage();
    let told = "bgdyn: no preference is called `acuracy`: did you mean `accuracy`?\n";
    assert_eq!(stderr, told);
}

#[test]
fn bad_input_exits_with_one() {
    for arguments in [
        &["check", "nowhere.yaml"] as &[&str],
        &["ops", "nowhere.yaml"],
        &["generate", "nowhere.yaml"],
        &["graph", "nowhere.yaml"],
        &["import", "nowhere.urdf"],
        &["import", SCARA],
        &["eval", "nowhere.yaml", "bias", "--states", VALUES],
        &["eval", SCARA, "bias", "--states", "nowhere.json"],
        &["eval", SCARA, "bias", "--states", SCARA],
        &["ops", "specs/invalid/negative_mass.yaml"],
    ] {
        let run = bgdyn(arguments);
        assert_eq!(run.stdout, "", "{arguments:?}");
        assert!(!run.bad_input().is_empty(), "{arguments:?}");
    }
}

#[test]
fn every_help_has_an_example() {
    for command in COMMANDS {
        let help = bgdyn(&[command, "--help"]).good();
        let example = format!("Example:\n  bgdyn {command} ");
        assert!(help.contains(&example), "{help}");
    }
    let help = bgdyn(&["--help"]).good();
    assert!(help.contains("Example:\n  bgdyn "), "{help}");
    let listed = help.lines().filter(|l| l.starts_with("  ")).count();
    for command in COMMANDS {
        assert!(help.contains(&format!("\n  {command} ")), "{help}");
    }
    assert!(listed >= COMMANDS.len());
}

/// Runs the command, reads `bytes` of its output, closes the pipe, and returns exit code and the other
/// stream.
fn stop_reading(arguments: &[&str], bytes: usize) -> (Option<i32>, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_bgdyn"))
        .args(arguments)
        .current_dir(root())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut stdout = child.stdout.take().expect("a pipe");
    let mut first = vec![0; bytes];
    stdout.read_exact(&mut first).expect("some output");
    drop(stdout);
    let output = child.wait_with_output().expect("the command ends");
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code(), stderr)
}

#[test]
fn a_reader_may_stop_early() {
    // More than the capacity of a pipe, so that the command is still writing when the pipe closes.
    let chain = "tests/golden/specs/chain8.yaml";
    let ended = stop_reading(&["generate", chain], 10);
    assert_eq!(ended, (Some(0), String::new()));
    // The pipe is closed before anything is written.
    for command in [&["check", SCARA] as &[&str], &["ops", SCARA]] {
        let (code, stderr) = stop_reading(command, 0);
        assert_eq!((code, stderr.as_str()), (Some(0), ""), "{command:?}");
    }
}

/// A scene refuses options of mechanisms.
#[test]
fn options_that_a_scene_does_not_have() {
    const SCENE: &str = "specs/scenes/motor_linear_stiff.scene.yaml";
    let told = bgdyn(&["ops", SCENE, "--formulation", "literal", "--derivatives"]).bad_usage();
    for what in ["`formulation` is an option of mechanisms", "see `jacobian`"] {
        assert!(told.contains(what), "{told}");
    }
    let told = bgdyn(&["generate", SCENE, "--methods", "bias"]).bad_usage();
    assert!(
        told.contains("`methods` is an option of mechanisms"),
        "{told}"
    );
    let told = bgdyn(&["ops", SCENE, "--explain"]).bad_usage();
    assert!(told.contains("`--per-effect`"), "{told}");
}
