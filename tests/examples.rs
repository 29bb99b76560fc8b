//! Runs the examples: they write their results, and refuse unknown arguments.

use std::path::Path;
use std::process::{Command, Output};
use std::sync::Once;

/// Runs an example in the profile of this test. It is built with the features of the whole workspace, as
/// `cargo test --workspace` has built it already: `-p controllers` would compile the generator once more.
fn example(name: &str, arguments: &[&str]) -> Output {
    static BUILD: Once = Once::new();
    BUILD.call_once(|| {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.current_dir(env!("CARGO_MANIFEST_DIR"));
        cargo.args(["build", "--quiet", "--workspace"]);
        cargo.args([
            "--example",
            "scara",
            "--example",
            "puma560",
            "--example",
            "balance",
            "--example",
            "reach",
        ]);
        if !cfg!(debug_assertions) {
            cargo.arg("--release");
        }
        assert!(cargo.status().expect("cargo runs").success());
    });
    let tests = std::env::current_exe().expect("a path of this test");
    let profile = tests.ancestors().nth(2).expect("the profile's folder");
    let mut example = Command::new(profile.join("examples").join(name));
    example.current_dir(env!("CARGO_MANIFEST_DIR"));
    example.args(arguments).output().expect("the example runs")
}

fn runs(name: &str) {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("example-{name}"));
    let output = example(name, &["--out", out.to_str().expect("a path in UTF-8")]);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{name} failed: {errors}");
    let report = String::from_utf8_lossy(&output.stdout);
    assert!(!report.contains("NaN"), "{report}");

    let plot = out.join(format!("{name}.svg"));
    assert!(report.contains(&format!("wrote {}", plot.display())));
    let svg = std::fs::read_to_string(&plot).expect("the plot is there");
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
}

#[test]
fn scara_runs() {
    runs("scara");
}

#[test]
fn puma560_runs() {
    runs("puma560");
}

#[test]
fn reach_runs() {
    runs("reach");
}

/// The regulator that knows of the delay ends with the pole upright, within what the sensors' noise leaves.
#[test]
fn balance_runs() {
    let output = example("balance", &[]);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "balance failed: {errors}");
    let report = String::from_utf8_lossy(&output.stdout);
    assert!(!report.contains("NaN"), "{report}");
    let (_, designed) = report
        .split_once("designed with the delay")
        .expect("its part");
    let (_, late) = designed.split_once("after 6 s within ").expect("its angle");
    let (late, _) = late.split_once('°').expect("degrees");
    assert!(late.parse::<f64>().expect("a number") < 1.0, "{report}");
}

#[test]
fn bad_arguments_are_refused() {
    for (arguments, message) in [
        (&["--fast"][..], "unknown argument `--fast`"),
        (&["--out"][..], "`--out` needs a folder"),
    ] {
        let output = example("scara", arguments);
        assert_eq!(output.status.code(), Some(2));
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(errors.contains(message), "{errors}");
        assert!(errors.contains("Usage:"), "{errors}");
    }
    // A file exists with the name of the folder.
    let output = example("scara", &["--out", "Cargo.toml"]);
    assert_eq!(output.status.code(), Some(1));
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(errors.contains("Cargo.toml"), "{errors}");
}

#[test]
fn help_is_printed() {
    let output = example("puma560", &["--help"]);
    assert!(output.status.success());
    assert!(String::from_utf8_lossy(&output.stdout).contains("--example puma560"));
}

/// The simulated arms are the models, line by line, plus a part.
#[test]
fn loaded_arms_are_the_models_and_a_part() {
    for name in ["scara", "puma560"] {
        let read = |folder: &str, stem: &str| {
            let file = format!("{}/{folder}/{stem}.yaml", env!("CARGO_MANIFEST_DIR"));
            std::fs::read_to_string(file).expect("the spec is there")
        };
        let model = read("specs", name);
        let loaded = read("examples/controllers/plants", &format!("{name}_loaded"));
        let from_links = |text: &str| text[text.find("\nlinks:").expect("links")..].to_string();
        let model = from_links(&model);
        let links = &model[..model.find("\nframes:").expect("frames")];
        assert!(
            from_links(&loaded).starts_with(links),
            "the links of examples/controllers/plants/{name}_loaded.yaml are not those of specs/{name}.yaml"
        );
    }
}
