//! Tests the messages of the commands: for several files, standard input, colours, numbers with units.

use std::io::Write;
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::{Run, bgdyn, bgdyn_in, root, scratch};

const SCARA: &str = "tests/golden/specs/scara4.yaml";
const INVALID: &str = "specs/invalid/negative_mass.yaml";
const SCENE: &str = "specs/scenes/stick_slip.scene.yaml";
const ROBOT: &str = "<robot name=\"a\"><link name=\"b\"/></robot>";

/// Runs the command with this standard input and these variables.
fn fed(input: &str, arguments: &[&str], variables: &[(&str, &str)]) -> Run {
    let mut command = Command::new(env!("CARGO_BIN_EXE_bgdyn"));
    let command = command.args(arguments).current_dir(root());
    for name in ["NO_COLOR", "CLICOLOR_FORCE", "TERM"] {
        command.env_remove(name);
    }
    let mut child = command
        .envs(variables.iter().copied())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    stdin.write_all(input.as_bytes()).expect("it reads");
    drop(stdin);
    let done = child.wait_with_output().expect("it ends");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    Run {
        code: done.status.code(),
        stdout: text(done.stdout),
        stderr: text(done.stderr),
    }
}

fn file(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).expect("a file")
}

#[test]
fn of_several_files_every_one_is_checked() {
    let run = bgdyn(&["check", SCARA, INVALID, "nowhere.yaml", SCENE]);
    assert_eq!(
        run.stdout.lines().filter(|l| l.starts_with("ok: ")).count(),
        2
    );
    let told = run.bad_input();
    for said in [
        &format!("{INVALID}:16:11: "),
        &format!("{INVALID} has 1 fault"),
        "bgdyn: nowhere.yaml cannot be read: ",
    ] {
        assert!(told.contains(said), "{told}");
    }
    let two = bgdyn(&["check", SCARA, SCENE]).good();
    assert_eq!(two.lines().filter(|l| l.starts_with("ok: ")).count(), 2);
}

#[test]
fn json_of_several_files_is_a_list_of_reports() {
    let urdf = scratch("messages_json", "a.urdf", ROBOT);
    let files = [SCARA, INVALID, "nowhere.yaml", &urdf, SCENE];
    let run = bgdyn(&[&["check", "--json"], &files[..]].concat());
    let reports: Value = serde_json::from_str(&run.stdout).expect("JSON");
    run.bad_input();
    let reports = reports.as_array().expect("a list");
    assert_eq!(reports.len(), files.len());
    let rules = [
        None,
        Some("negative-mass"),
        Some("unreadable"),
        Some("urdf-given"),
        None,
    ];
    for ((report, file), rule) in reports.iter().zip(files).zip(rules) {
        assert_eq!(report["file"], file);
        assert_eq!(report["ok"], rule.is_none(), "{report}");
        match rule {
            Some(rule) => assert_eq!(report["findings"][0]["rule"], rule),
            None => assert_eq!(report["findings"], Value::Array(vec![])),
        }
    }
    assert!(reports[4]["scene"].is_object());
    let alone = bgdyn(&["check", "--json", &urdf]);
    let report: Value = serde_json::from_str(&alone.stdout).expect("JSON");
    assert_eq!(report["findings"][0]["rule"], "urdf-given");
    alone.bad_input();
}

#[test]
fn json_tells_the_faults_of_a_scene_and_of_its_mechanism() {
    let broken = file(INVALID);
    scratch(
        "messages_both",
        "arm.yaml",
        broken.replace("negative_mass", "arm"),
    );
    let scene = "scene: 2\nmechanism: arm.yaml\neffects: [gravity]\n";
    let scene = scratch("messages_both", "a.scene.yaml", scene);
    let run = bgdyn(&["check", "--json", &scene]);
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    run.bad_input();
    let findings = report["findings"].as_array().expect("a list");
    assert_eq!(findings[0]["rule"], "version");
    assert_eq!(findings[0]["file"], Value::Null);
    let other = findings
        .iter()
        .find(|f| f["rule"] == "negative-mass")
        .expect("the mechanism's");
    assert!(
        other["file"]
            .as_str()
            .expect("a file")
            .ends_with("arm.yaml")
    );
    let told = bgdyn(&["check", &scene]).bad_input();
    assert!(
        told.contains("[version]") && told.contains("[negative-mass]"),
        "{told}"
    );
}

#[test]
fn standard_input_is_read_like_a_file() {
    let named = format!("name: scara4\n{}", file(SCARA));
    let good = fed(&named, &["check", "-"], &[]).good();
    assert_eq!(good, bgdyn(&["check", SCARA]).good());
    let told = fed(&file(INVALID), &["check", "-"], &[]).bad_input();
    assert!(told.starts_with("<stdin>:16:11: "), "{told}");
    let ops = |arguments: &[&str]| fed(&file(SCARA), arguments, &[]).good();
    assert_eq!(ops(&["ops", "-"]), bgdyn(&["ops", SCARA]).good());
    let told = fed(ROBOT, &["ops", "-"], &[]).bad_input();
    assert!(told.contains("`bgdyn import -` writes"), "{told}");
    let made = fed(ROBOT, &["import", "-"], &[]).good();
    assert!(made.contains("format: 1"), "{made}");
    let nameless = fed(&file(SCARA), &["check", "-"], &[]).good();
    assert!(nameless.starts_with("ok: stdin, "), "{nameless}");
    // The path of a scene's mechanism is relative to the scene, in any working directory.
    let folder = root().join("specs/scenes");
    let mut command = Command::new(env!("CARGO_BIN_EXE_bgdyn"));
    let scene = std::fs::File::open(root().join(SCENE)).expect("a file");
    let done = command
        .args(["check", "-"])
        .current_dir(folder)
        .stdin(scene)
        .output();
    let done = done.expect("it runs");
    assert!(
        done.status.success(),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
}

/// Returns the text without colour codes.
fn bare(text: &str) -> String {
    let mut parts = text.split('\x1b');
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        out += part.split_once('m').expect("a colour").1;
    }
    out
}

#[test]
fn colours_change_nothing_but_colours() {
    let light = "format: 1\nlinks:\n  - { name: a, joint: { name: j, type: revolute, axis: y } }\n";
    let warned = scratch("messages_colour", "light.yaml", light);
    let told = fed("", &["check", &warned, "--color", "always"], &[]);
    assert!(told.good().starts_with("ok: light"));
    let told = fed("", &["check", &warned, "--color", "always"], &[]).stderr;
    assert!(told.contains("\x1b[1;33mwarning:\x1b[0m"), "{told:?}");
    let twice = scratch(
        "messages_colour",
        "twice.yaml",
        file(INVALID).replace("mass: -", "mass:  -"),
    );
    for file in [INVALID, "nowhere.yaml", &twice, &warned] {
        let plain = fed("", &["check", file], &[]).stderr;
        assert!(!plain.contains('\x1b'), "{plain:?}");
        let run = fed("", &["check", file, "--color", "always"], &[]);
        assert!(!run.stdout.contains('\x1b'));
        assert_eq!(bare(&run.stderr), plain);
        assert_eq!(run.stderr.contains('\x1b'), !plain.is_empty(), "{plain}");
    }
    let told = fed("", &["--color", "always", "check", INVALID], &[]).stderr;
    let first = told.lines().next().expect("a line");
    assert!(
        first.starts_with(&format!("\x1b[1;31m{INVALID}:16:11:\x1b[0m ")),
        "{first:?}"
    );
}

#[test]
fn a_pipe_gets_colours_only_where_they_are_asked_for() {
    let coloured = |options: &[&str], variables: &[(&str, &str)]| {
        let arguments = [&["check", INVALID], options].concat();
        fed("", &arguments, variables).stderr.contains('\x1b')
    };
    assert!(!coloured(&[], &[]));
    assert!(!coloured(&["--color", "auto"], &[("TERM", "xterm")]));
    assert!(coloured(&[], &[("CLICOLOR_FORCE", "1")]));
    assert!(!coloured(&[], &[("CLICOLOR_FORCE", "0")]));
    assert!(!coloured(
        &[],
        &[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]
    ));
    assert!(coloured(&["--color", "always"], &[("NO_COLOR", "1")]));
    assert!(!coloured(&["--color", "never"], &[("CLICOLOR_FORCE", "1")]));
}

/// Paths are printed as in the call, followed by line and column.
#[test]
fn paths_stay_as_written() {
    let folder = root().join("specs/scenes");
    let absolute = root().join(INVALID).display().to_string();
    for path in [
        "./../invalid/negative_mass.yaml",
        "../../specs/invalid/negative_mass.yaml",
        &absolute,
    ] {
        for command in ["check", "ops", "graph", "equations"] {
            let told = bgdyn_in(&folder, &[command, path]).bad_input();
            assert!(told.starts_with(&format!("{path}:16:11: ")), "{told}");
        }
    }
    let states = scratch("messages_states", "states.json", "{\n  \"states\": [\n");
    let told = bgdyn(&["eval", SCARA, "bias", "--states", &states]).bad_input();
    assert!(
        told.starts_with(&format!("bgdyn: {states}:3:0: "))
            || told.starts_with(&format!("bgdyn: {states}:2:")),
        "{told}"
    );
}

const SWING: &str = "\
scene: 1
mechanism: rod.yaml
effects: [gravity, inertia]
outputs: [swing]
integration: { method: rk4, step: 10 ms, end: 100 ms }
";

const ROD: &str = "\
format: 1
links:
  - name: rod
    joint: { name: swing, type: revolute, axis: y }
    mass: { parameter: load, value: 1.5 kg }
    com: [0.2, 0, 0]
    inertia: { xx: 0.1, yy: 0.1, zz: 0.1 }
";

/// The table of a run with these options.
fn table(options: &[&str]) -> String {
    scratch("messages_units", "rod.yaml", ROD);
    let scene = scratch("messages_units", "swing.scene.yaml", SWING);
    let out = scene.replace(
        "swing.scene.yaml",
        &options.join("_").replace(['/', ':'], "_"),
    );
    let batch = options.iter().any(|o| ["--sweep", "--batch"].contains(o));
    bgdyn(
        &[
            &["simulate", &scene, "--out", &out, "--points", "3"],
            options,
        ]
        .concat(),
    )
    .good();
    let name = if batch {
        "swing_batch.csv"
    } else {
        "swing.csv"
    };
    std::fs::read_to_string(format!("{out}/{name}")).expect("a table")
}

/// A number with a unit equals the number in SI units.
#[test]
fn numbers_have_units_as_in_files() {
    let batch = scratch(
        "messages_units",
        "batch.csv",
        "swing,load\n30 deg,500 g\n0.5,1\n",
    );
    let plain = scratch(
        "messages_units",
        "plain.csv",
        "swing,load\n0.52359877559829887307710723055,0.5\n0.5,1\n",
    );
    for (with, without) in [
        (&["--end", "200ms"] as &[&str], &["--end", "0.2"] as &[&str]),
        (&["--step", "5 ms"], &["--step", "0.005"]),
        (
            &["--step", "500 us", "--end", "1 s"],
            &["--step", "5e-4", "--end", "1"],
        ),
        (
            &["--initial", "swing=30 deg"],
            &["--initial", "swing=0.52359877559829887307710723055"],
        ),
        (
            &["--initial", "swing_rate=-90deg/s"],
            &["--initial", "swing_rate=-1.57079632679489661923132169164"],
        ),
        (&["--parameter", "load=500 g"], &["--parameter", "load=0.5"]),
        (
            &["--sweep", "load=500 g:1 kg:3"],
            &["--sweep", "load=0.5:1:3"],
        ),
        (&["--batch", &batch], &["--batch", &plain]),
    ] {
        assert_eq!(table(with), table(without), "{with:?}");
    }
    let two_states = "{\"states\": [{\"q\": [0.3]}]}";
    let states = scratch("messages_units", "states.json", two_states);
    let rod = scratch("messages_units", "rod.yaml", ROD);
    let gravity = |load: &str| {
        bgdyn(&[
            "eval",
            &rod,
            "gravity",
            "--states",
            &states,
            "--parameter",
            load,
        ])
        .good()
    };
    assert_eq!(gravity("load=750 g"), gravity("load=0.75"));
    assert_ne!(gravity("load=750 g"), gravity("load=0.7"));
}

/// Wrong dimensions and invalid numbers have the same messages as in files, with the option as a prefix.
#[test]
fn numbers_that_are_none_are_refused() {
    scratch("messages_refused", "rod.yaml", ROD);
    let scene = scratch("messages_refused", "swing.scene.yaml", SWING);
    for (options, said) in [
        (
            ["--end", "2 m"],
            "`--end 2 m`: `2 m` is a length; a time belongs here: write ",
        ),
        (["--step", "1 sec"], "`--step 1 sec`: "),
        (
            ["--step", "fast"],
            "`--step fast`: `fast` is not a number: write ",
        ),
        (["--step", "nan"], "`--step nan`: "),
        (["--step", "0 s"], "write a number greater than 0"),
        (
            ["--tolerance", "1 ms"],
            "`--tolerance 1 ms`: `1 ms` is a time",
        ),
        (
            ["--initial", "swing=3 kg"],
            "`3 kg` is a mass; an angle belongs here",
        ),
        (["--initial", "swing="], "`--initial swing=`: "),
        (["--parameter", "load=inf"], "`--parameter load=inf`: "),
        (
            ["--sweep", "load=0:1 m:3"],
            "`--sweep load=0:1 m:3`: `1 m` is a length",
        ),
        (["--points", "0"], "the start and the end are 2"),
        (["--threads", "0"], "--threads"),
    ] {
        let told = bgdyn(&[&["simulate", &scene], &options[..]].concat()).bad_usage();
        assert!(told.contains(said), "{told}");
    }
    let chance = ["simulate", &scene, "--runs", "3", "--random", "load=2:1"];
    assert!(bgdyn(&chance).bad_usage().contains("2 is above 1"));
}
