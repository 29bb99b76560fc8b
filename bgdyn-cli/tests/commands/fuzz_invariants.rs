//! Tests the invariants of parser, check and importer with texts of all kinds.

use std::fs;
use std::path::Path;

use bgdyn_cli::fuzz_invariants::any_text;
use proptest::prelude::*;
use proptest::sample::{Index, select};

/// Syntax that the files do not have: anchors, folded text, quotes, a snap.
const DENSE: &str = "\
format: 1
name: arm
description: >
  Two links
gravity: [0, 0, -9.81 m/s^2]
snap: 1e-4
links:
  - &upper
    name: upper_arm
    joint: { name: shoulder, type: revolute, axis: [0, 1, 1e-5] }
    mass: 2.4
    com: [0.15, 0, 0]
    inertia: { xx: 0.002, yy: 0.018, zz: 0.018, xy: 1 kg*mm^2, rpy: [0, 90 deg, 1.5708] }
  - name: \"forearm\"
    parent: upper_arm
    joint:
      name: elbow
      type: prismatic
      axis: -y
      origin: { xyz: [300 mm, 0, 0], rpy: [0, 90 deg, 0] }
      limits: { lower: -15 cm, upper: 150 mm, velocity: 3, effort: 40 }
    nonphysical: allow
frames:
  - { name: tool, link: forearm, origin: { xyz: [0.25, 0, 0] } }
";

/// Returns specs, scenes, URDFs and MJCFs of the repository, valid and invalid ones.
fn seeds() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folders = [
        "specs",
        "specs/invalid",
        "specs/scenes",
        "bgdyn-cli/tests/urdf",
        "bgdyn-cli/tests/mjcf",
    ];
    let mut files: Vec<_> = (folders.iter())
        .flat_map(|folder| fs::read_dir(root.join(folder)).expect("a folder"))
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_file())
        // Neither the values nor the script that made them.
        .filter(|path| {
            !["json", "py"]
                .iter()
                .any(|it| path.extension() == Some(it.as_ref()))
        })
        .collect();
    files.sort();
    assert!(files.len() > 80);
    let texts = files
        .into_iter()
        .map(|path| fs::read_to_string(path).expect("a text"))
        // The search for closed positions takes too long for thousands of texts.
        .filter(|text| !text.contains("\nloops:"));
    texts.chain([DENSE.to_owned()]).collect()
}

#[test]
fn the_dense_spec_is_sound() {
    let (mechanism, faults) = bgdyn_codegen::read(DENSE, Some("arm"));
    assert!(mechanism.is_some(), "{faults:?}");
}

/// Texts that once violated an invariant; the fuzzer found them.
#[test]
fn found_once() {
    // A name in a flow mapping may extend over lines; the message that quoted it did so too.
    any_text("scene: 1\nmechanism: arm.yaml\nintegration: { method: rk\n\n4 }\n");
}

#[test]
fn every_file_of_the_repository() {
    seeds().iter().for_each(|text| any_text(text));
}

/// Words of the formats, and difficult texts.
const WORDS: &[&str] = &[
    "solid: sphere",
    "solid: box",
    "radius: 0",
    "size: [1, 1]",
    "about: origin",
    "products: { xy: 1 }",
    "- a\n",
    "inertia:",
    "{ parameter: p, value: 1 }",
    "parameter: p",
    "effects:",
    "type: viscous",
    "lock: { a: 1 }",
    "scene: 1\n",
    "mechanism: a.yaml\n",
    "&a ",
    "*a",
    "<<: *a",
    "!t ",
    "---\n",
    "- ",
    "[",
    "]",
    "{",
    "}",
    "\"",
    "'",
    "|",
    "#",
    "\t",
    "\r\n",
    "\u{feff}",
    "\0",
    ".nan",
    "1e999",
    "-0",
    "90 deg",
    "5 mm",
    "kg",
    "é",
    "\u{2028}",
    "\n",
    "  ",
    "<",
    "/>",
    "<link name='x'/>",
    "<mujoco>",
    "<worldbody>",
    "<body name='x' pos='0 0 1' euler='1 2 3'>",
    "</body>",
    "<joint name='x' type='slide' ref='1'/>",
    "<freejoint name='x'/>",
    "<joint type='ball' name='y'/>",
    "<geom size='1 1 1' type='box' mesh='x'/>",
    "<geom type='capsule' fromto='0 0 0 0 0 0' size='1'/>",
    "<default class='x'>",
    "<include file='x'/>",
    "<joint joint1='x' joint2='y' polycoef='1e999 2'/>",
    "<site name='x_qx'/>",
    "<compiler boundinertia='1' settotalmass='1'/>",
    " name='x_x'",
    " type='floating'",
    "<mimic joint='x'/>",
    "<joint",
    "</robot>",
    "&#0;",
    "&lt;",
    "]]>",
    "name: a",
    "parent: a",
    "{:?}",
    "&a",
    "<<: ",
    "!!str ",
    "!x ",
    "...\n",
    "? ",
    ": ",
    ">",
    "%YAML 1.2\n",
    "\r",
    "~",
    "-.inf",
    "0x1F",
    "\u{85}",
    ",",
    "- - - ",
    "world",
    "inertia: { xx: -1 }",
    "type: fixed",
    "mass: &m [*m]",
    "[ -~\n]{0,6}",
    "/",
    "&",
    "&#10;",
    "0",
    "-1",
    "nan",
    "inf",
    "1e-400",
    "<!--",
    "<origin/>",
    "<axis xyz='1 2 3'/>",
    "<limit/>",
    "type='fixed'",
    "version='1.2'",
];

/// A word, or a few letters.
fn word() -> impl Strategy<Value = String> {
    prop_oneof![
        select(WORDS).prop_map(String::from),
        "[ -~\n]{0,6}",
        ".{0,3}"
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1000) })]

    #[test]
    fn arbitrary_text(text in any::<String>()) {
        any_text(&text);
    }

    #[test]
    fn words_in_a_row(words in prop::collection::vec(word(), 0..30)) {
        any_text(&words.concat());
    }

    #[test]
    fn arbitrary_names_and_numbers(names in prop::array::uniform4(".*"), number in any::<f64>(), digits in "[-+0-9.eE ]{0,40}") {
        let [robot, a, b, joint] = names.map(|name| {
            name.chars().map(|c| format!("&#{};", u32::from(c))).collect::<String>()
        });
        any_text(&format!(
            "<robot name='{robot}'><link name='{a}'/><link name='{b}'><inertial><mass value='{number:e}'/>\
             <inertia ixx='{number}' ixy='{digits}' ixz='0' iyy='1' iyz='0' izz='2'/></inertial></link>\
             <joint name='{joint}' type='revolute'><parent link='{a}'/><child link='{b}'/>\
             <origin xyz='{digits} {digits} {number}'/><limit lower='{digits}' velocity='{digits}'/></joint></robot>"
        ));
    }

    #[test]
    fn names_and_numbers_of_an_mjcf(names in prop::array::uniform3(".*"), number in any::<f64>(), digits in "[-+0-9.eE ]{0,40}") {
        let [robot, a, joint] = names.map(|name| {
            name.chars().map(|c| format!("&#{};", u32::from(c))).collect::<String>()
        });
        any_text(&format!(
            "<mujoco model='{robot}'><compiler boundinertia='{digits}'/><worldbody><body name='{a}' pos='{digits}'><freejoint name='{joint}'/>\
             <geom type='capsule' size='{number}' fromto='0 0 {number:e} {digits}'/>\
             <body name='{joint}'><joint name='{a}' pos='0 0 {number}' ref='{digits}' axis='{digits}'/></body></body></worldbody>\
             <equality><joint joint1='{a}' joint2='{a}' polycoef='{digits}'/></equality></mujoco>"
        ));
    }

    #[test]
    fn files_cut_and_mended(
        seed in select(seeds()),
        edits in prop::collection::vec((any::<Index>(), 0usize..40, word()), 1..8),
    ) {
        let mut text: Vec<char> = seed.chars().collect();
        for (place, length, word) in edits {
            let from = place.index(text.len() + 1);
            let to = (from + length).min(text.len());
            text.splice(from..to, word.chars());
        }
        any_text(&text.into_iter().collect::<String>());
    }

    #[test]
    fn lines_of_two_files(a in select(seeds()), b in select(seeds()), cut in any::<Index>(), from in any::<Index>()) {
        let (a, b): (Vec<&str>, Vec<&str>) = (a.lines().collect(), b.lines().collect());
        let (cut, from) = (cut.index(a.len() + 1), from.index(b.len() + 1));
        any_text(&[&a[..cut], &b[from..]].concat().join("\n"));
    }
}
