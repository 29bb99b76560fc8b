//! `bgdyn excite`: what is refused, and what is written then.

use std::fs;
use std::path::{Path, PathBuf};

use crate::excite::planned;
use crate::identify_logs::text;
use crate::{bgdyn, scratch};

/// Two links that swing; LIMITS of the first joint, and effects.
const SWINGS: &str = "format: 1
name: swings
links:
  - { name: arm, joint: { name: swing, type: revolute, axis: y, limits: LIMITS }, mass: 2, com: [0, 0, -0.3], inertia: { solid: sphere, radius: 0.1 } }
  - { name: bob, parent: arm, joint: { name: nod, type: revolute, axis: y, origin: { xyz: [0, 0, -0.5] }, limits: { upper: 1, velocity: 3 } }, mass: 1, com: [0, 0, -0.2], inertia: { solid: sphere, radius: 0.1 } }
effects:
";

/// Writes a spec of the swings; returns its path.
fn swings(test: &str, limits: &str, effects: &str) -> String {
    let spec = SWINGS.replace("LIMITS", limits) + effects;
    scratch(test, "swings.yaml", spec)
}

/// A folder of this name that does not exist.
fn no_folder(name: &str) -> PathBuf {
    let folder: PathBuf = [env!("CARGO_TARGET_TMPDIR"), name].iter().collect();
    let _ = fs::remove_dir_all(&folder);
    folder
}

#[test]
fn faults_are_told_together_and_nothing_is_written() {
    let slide = scratch(
        "excite_faults",
        "slide.yaml",
        "format: 1\nname: slide\nlinks:\n  - { name: cart, joint: { name: rail, type: prismatic, axis: x }, mass: 2 }\n  - { name: bob, parent: cart, joint: { name: swing, type: continuous, axis: y }, mass: 1, com: [0, 0, -0.3], inertia: { solid: sphere, radius: 0.1 } }\n",
    );
    let never: PathBuf = [env!("CARGO_TARGET_TMPDIR"), "excite_never"]
        .iter()
        .collect();
    let _ = fs::remove_dir_all(&never);
    let out = text(&never);
    let cases: [(&str, &[&str], &[&str]); 5] = [
        (
            &slide,
            &["--keep", "bob.z>1", "--keep", "hand.z>1"],
            &[
                "joint `rail` slides",
                "[no-range]",
                "add `limits:",
                "no frame or link `hand`: there are cart, bob",
            ],
        ),
        (
            "specs/panda.yaml",
            &["--only", "finger"],
            &["`--only finger`", "left_finger"],
        ),
        (
            "specs/loops/slider_crank.yaml",
            &[],
            &["has loops", "only trees of revolute"],
        ),
        (
            "specs/panda.yaml",
            &["--keep", "tool.z>3 m", "--starts", "2"],
            &["[keep-not-met]", "beyond the plane", "help: move the plane"],
        ),
        (
            "specs/scenes/puma_drives.scene.yaml",
            &[],
            &["is a scene: give its mechanism"],
        ),
    ];
    for (spec, more, wanted) in cases {
        let told = bgdyn(&[&["excite", spec, "-o", &out], more].concat()).bad_input();
        for text in wanted {
            assert!(told.contains(text), "`{text}` is missing in\n{told}");
        }
        assert!(!never.exists(), "{told}");
    }
    let usages: [(&[&str], &str); 15] = [
        (&["--period", "0"], "greater than 0"),
        (&["--harmonics", "1"], "2 to 100"),
        (&["--margin", "100%"], "below 100 %"),
        (&["--rate", "1 Hz"], "more than 1 rows"),
        (&["--acceleration", "0"], "greater than 0"),
        (&["--speed", "2 m"], "a length"),
        (&["--ascents", "0"], "1 or more"),
        (&["--speed", "2,0.5"], "`2 rad/s,0.5 m/s`"),
        (&["--speed", "2 rad/s,3 rad/s"], "`2 rad/s,0.5 m/s`"),
        (&["--speed", "2 rad/s,1 m/s,3 m/s"], "`2 rad/s,0.5 m/s`"),
        (&["--acceleration", "2,3 m/s^2"], "`7 rad/s^2,2 m/s^2`"),
        (&["--rate", "1e6"], "at most 100000 Hz"),
        (&["--keep", "tool>1 m"], "write FRAME.AXIS>LENGTH"),
        (&["--keep", "tool.z>a"], "`a` is not a number"),
        (&["--keep", "tool.z>1 rad"], "`--keep tool.z>1 rad`"),
    ];
    for (more, wanted) in usages {
        let told = bgdyn(&[&["excite", "specs/panda.yaml", "-o", &out], more].concat()).bad_usage();
        assert!(told.contains(wanted), "{told}");
        assert!(!never.exists());
    }
}

const BOUNDED: &str = "{ lower: -1, velocity: 3, effort: 60 }";
const SEARCH: [&str; 4] = ["--starts", "3", "--steps", "3"];

#[test]
fn effects_that_efforts_do_not_contain_are_told() {
    let folder = "excite_springs";
    let spring =
        |joint: &str| format!("  coil: {{ type: spring, joint: {joint}, stiffness: 5 }}\n");
    let spec = swings(folder, BOUNDED, &spring("swing"));
    let told = bgdyn(&["excite", &spec]).bad_input();
    let wanted = [
        "[effort-incomplete]",
        "`coil` (spring)",
        "joints swing",
        "help: take `effort`",
    ];
    for text in wanted {
        assert!(told.contains(text), "{told}");
    }
    // At a link all joints are concerned.
    let drag = "  air: { type: drag, at: bob, linear: 0.5 }\n";
    let spec = swings(folder, BOUNDED, drag);
    let told = bgdyn(&["excite", &spec]).bad_input();
    assert!(
        told.contains("`air` (drag)") && told.contains("joints swing"),
        "{told}"
    );
    // Without a limit a remark; which limits of position are missing, too.
    let spec = swings(folder, BOUNDED, &spring("nod"));
    let said = bgdyn(&[&["excite", &spec], &SEARCH[..]].concat()).good();
    let wanted = [
        "do not contain the effect `coil` (spring)",
        "`swing` has no upper limit of position: -1.0000 … 5.2832 rad",
        "`nod` has no lower limit of position: -5.2832 … 1.0000 rad",
        "of the limits less the margin: position",
    ];
    for text in wanted {
        assert!(said.contains(text), "{said}");
    }
    let spec = swings(folder, "{ effort: 0 }", &spring("nod"));
    let told = bgdyn(&["excite", &spec]).bad_input();
    assert!(
        told.contains("[no-effort]") && told.contains("limit of effort 0"),
        "{told}"
    );
}

#[test]
fn friction_of_several_joints_at_once_is_in_the_efforts() {
    let limits = "{ effort: 60 }";
    let all = "  wet: { type: viscous, joints: all, damping: 0.5 }\n  dry: { type: coulomb, joints: [swing], kinetic: 0.3 }\n";
    let each = "  a: { type: viscous, joint: swing, damping: 0.5 }\n  b: { type: viscous, joint: nod, damping: 0.5 }\n  c: { type: coulomb, joint: swing, kinetic: 0.3 }\n";
    let table = |name: &str, effects: &str| {
        let spec = swings(&format!("{name}_spec"), limits, effects);
        let (folder, _) = planned(name, &spec, &["--rate", "20 Hz"]);
        fs::read_to_string(folder.join("swings_motion.csv")).expect("the table")
    };
    let (all, each) = (table("excite_all", all), table("excite_each", each));
    assert_eq!(all.lines().count(), 202);
    assert!(all == each);
    assert!(
        all != table(
            "excite_smooth",
            "  a: { type: viscous, joint: nod, damping: 0 }\n"
        )
    );
}

#[test]
fn friction_above_a_limit_of_effort_is_a_fault() {
    // Bodies alone keep to the limit.
    let dry =
        |kinetic: &str| format!("  dry: {{ type: coulomb, joint: swing, kinetic: {kinetic} }}\n");
    let spec = swings("excite_dry", BOUNDED, &dry("56"));
    let told = bgdyn(&["excite", &spec]).bad_input();
    assert!(
        told.contains("[effort-limit]") && told.contains("joint `swing`"),
        "{told}"
    );
    let spec = swings("excite_dry", BOUNDED, &dry("1"));
    bgdyn(&[&["excite", &spec], &SEARCH[..]].concat()).good();
}

#[test]
fn a_motion_that_shows_too_little_is_called_so() {
    let spec = swings(
        "excite_weak_spec",
        BOUNDED,
        "  a: { type: viscous, joint: nod, damping: 0 }\n",
    );
    let slow = [
        "--period", "200 s", "--speed", "0.005", "--starts", "3", "--steps", "3",
    ];
    let (folder, found) = planned("excite_weak", &spec, &slow);
    let weak = found["weak"].as_str().expect("a remark").to_owned();
    assert!(
        weak.contains("is above 1000. Take more --harmonics"),
        "{weak}"
    );
    let said = bgdyn(&[&["excite", &spec], &slow[..]].concat()).good();
    assert!(said.contains(&weak), "{said}");
    let page = fs::read_to_string(folder.join("swings_motion.html")).expect("the page");
    assert!(page.contains(&format!("\"weak\":\"{weak}")));
}

/// The names and bytes of a folder.
fn content(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut all: Vec<(String, Vec<u8>)> = entries
        .map(|entry| {
            let path = entry.expect("an entry").path();
            let name = path.file_name().expect("a name").to_string_lossy().into();
            (name, fs::read(&path).unwrap_or_default())
        })
        .collect();
    all.sort();
    all
}

#[test]
fn targets_are_checked_before_the_search_and_stay_as_they_are() {
    let spec = swings(
        "excite_targets",
        BOUNDED,
        "  a: { type: viscous, joint: nod, damping: 0 }\n",
    );
    // So many random motions take longer than a test may.
    let long = ["--starts", "100000000"];
    let refused = |folder: &Path, words: &[&str]| {
        let out = text(folder);
        let told = bgdyn(&[&["excite", &spec, "-o", &out], &long[..]].concat()).bad_input();
        for word in words {
            assert!(told.contains(word), "`{word}` is missing in\n{told}");
        }
    };
    let folder = no_folder("excite_targets_out");
    fs::create_dir_all(folder.join("swings_motion.html")).expect("a folder in the way");
    fs::write(folder.join("swings.yaml"), "name: another").expect("another spec");
    let before = content(&folder);
    refused(
        &folder,
        &[
            "swings_motion.html cannot be replaced",
            "swings.yaml has other content than the spec",
        ],
    );
    assert_eq!(content(&folder), before);
    refused(
        &folder.join("swings.yaml").join("below"),
        &["is not a folder"],
    );
    assert_eq!(content(&folder), before);
    // The same spec, and files of an earlier plan, are no hindrance; no other files remain.
    let (folder, _) = planned("excite_targets_again", &spec, &SEARCH);
    let out = text(&folder);
    bgdyn(&[&["excite", &spec, "-o", &out, "--seed", "2"], &SEARCH[..]].concat()).good();
    let names: Vec<String> = content(&folder).into_iter().map(|(name, _)| name).collect();
    let ends = [
        "yaml",
        "_motion.csv",
        "_motion.html",
        "_motion.json",
        "_motion.scene.yaml",
    ];
    assert_eq!(names.len(), ends.len(), "{names:?}");
    assert!(
        names.iter().all(|name| name.starts_with("swings")),
        "{names:?}"
    );
}
