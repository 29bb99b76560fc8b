//! Tests the options of build scripts and of the command, and their messages.
#![cfg(feature = "source")]

use std::fs;
use std::path::PathBuf;

use bgdyn_codegen::Build;

const ARM: &str = "
format: 1
links:
  - name: arm
    joint: { name: hinge, type: revolute, axis: y }
    mass: 2
    com: [0.3, 0, 0]
    inertia: { xx: 0.1, yy: 0.2, zz: 0.2 }
frames:
  - { name: hook, link: arm, origin: { xyz: [0.5, 0, 0] } }
";

fn spec(name: &str, text: impl AsRef<[u8]>) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("build_script");
    fs::create_dir_all(&folder).expect("a directory");
    let path = folder.join(name);
    fs::write(&path, text).expect("a file");
    path
}

fn refusal(build: Build) -> String {
    let error = build.source().expect_err("refused");
    assert_eq!(format!("{error}"), format!("{error:?}"));
    error.to_string()
}

#[test]
fn only_what_is_asked_for_is_written() {
    let path = spec("arm.yaml", ARM);
    let whole = Build::new(&path).source().expect("a good spec");
    assert_eq!(whole.module, "arm");
    assert!(whole.text.contains("pub fn pose_hook") && whole.text.contains("Dynamics<T, NQ, NV>"));
    let build = Build::new(&path).methods(["gravity"]).frames(["arm"]);
    let build = build.module("hinged").visibility("pub(crate)");
    let small = build.bgdyn("crate::dyn_gen").source().expect("a good spec");
    assert_eq!(small.module, "hinged");
    for wanted in [
        "pub(crate) mod hinged {",
        "use crate::dyn_gen::runtime as __rt;",
        "pub struct Arm<T = f64>",
        "pub fn gravity",
        "pub fn jacobian_world_arm",
    ] {
        assert!(small.text.contains(wanted), "{wanted}");
    }
    for unwanted in ["fn bias", "_hook", "__rt::Dynamics<", "include_bytes"] {
        assert!(!small.text.contains(unwanted), "{unwanted}");
    }
}

#[test]
fn derivatives_come_on_top() {
    let path = spec("sloped.yaml", ARM);
    let build = Build::new(path).methods(["dynamics"]).derivatives(true);
    let text = build.source().expect("a good spec").text;
    assert!(text.contains("fn forward_dynamics_derivatives") && text.contains("fn bias"));
    assert!(!text.contains("fn coriolis_matrix") && !text.contains("fn pose_"));
}

/// A double pendulum has a more accurate inverse dynamics than its cheapest one.
#[test]
fn accuracy_may_be_preferred() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..");
    let pendulum = folder.join("tests/golden/specs/dpend2.yaml");
    let build = || Build::new(&pendulum).methods(["inverse_dynamics"]);
    let text = |build: Build| build.source().expect("a good spec").text;
    assert_eq!(text(build()), text(build().prefer("operations")));
    assert_ne!(text(build()), text(build().prefer("accuracy")));
}

#[test]
fn every_unknown_name_is_told() {
    let build = Build::new(spec("asked.yaml", ARM));
    let text = refusal(build.methods(["gravty", "bias"]).frames(["hok", "arm"]));
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 2, "{text}");
    assert!(
        lines[0].ends_with("asked.yaml: no method is called `gravty`: did you mean `gravity`?")
    );
    assert!(lines[1].ends_with("no link or frame is called `hok`: did you mean `hook`?"));
}

#[test]
fn what_stands_in_the_way_is_told() {
    let good = || Build::new(spec("good.yaml", ARM));
    for (build, wanted) in [
        (
            Build::new("no/such.yaml"),
            "no/such.yaml: the spec cannot be read",
        ),
        (
            Build::new(spec("latin.yaml", b"name: \xe4")),
            "is not UTF-8",
        ),
        (good().module("Arm"), "`Arm` cannot name a module"),
        (
            good().visibility("pub("),
            "the visibility `pub(` is not Rust",
        ),
        (good().formulation("litteral"), "did you mean `literal`?"),
        (good().prefer("accurracy"), "did you mean `accuracy`?"),
        (
            Build::new(spec("heavy.yaml", ARM.replace("mass: 2", "mass: -2"))),
            "heavy.yaml:6:11: links[0].mass: ",
        ),
    ] {
        let text = refusal(build);
        assert!(text.contains(wanted), "{text}");
    }
    // Outside a build script there is no folder for the output.
    let error = good().write().expect_err("no OUT_DIR here");
    assert!(error.to_string().starts_with("OUT_DIR is not set"));
}

#[test]
fn warnings_are_single_lines() {
    let text = ARM.replace("axis: y", "axis: [1e-9, 1, 0]");
    let source = Build::new(spec("nearly.yaml", text))
        .source()
        .expect("a good spec");
    assert_eq!(source.warnings.len(), 1, "{:?}", source.warnings);
    assert!(source.warnings[0].contains("nearly.yaml:5:49: warning: links[0].joint.axis: "));
    assert!(!source.warnings[0].contains('\n'));
}
