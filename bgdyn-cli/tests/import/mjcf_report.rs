//! MJCFs: what is refused, and what is reported.

use super::mechanism;
use bgdyn_cli::import::{Base, Options, import, import_with};
use std::fs;
use std::path::{Path, PathBuf};

/// An MJCF with this inside its root.
fn mjcf(inside: &str) -> String {
    format!("<mujoco model='m'>\n{inside}\n</mujoco>")
}

/// An MJCF with one body, which has this inside.
fn body(inside: &str) -> String {
    mjcf(&format!(
        "<worldbody><body name='b'>{inside}</body></worldbody>"
    ))
}

const WEIGHT: &str = "<inertial pos='0 0 0.1' mass='1' diaginertia='0.1 0.1 0.1'/>";

fn told(text: &str) -> String {
    match import(text) {
        Ok(made) => panic!("imported:\n{}", made.yaml),
        Err(error) => error.to_string(),
    }
}

#[test]
fn each_refusal_says_where_and_what() {
    let geom = |more: &str| body(&format!("<joint/><geom {more}/>"));
    let place = |more: &str| {
        mjcf(&format!(
            "<worldbody><body name='b' {more}>{WEIGHT}</body></worldbody>"
        ))
    };
    let compiler = |more: &str| {
        mjcf(&format!(
            "<compiler {more}/><worldbody><body>{WEIGHT}</body></worldbody>"
        ))
    };
    let joint = |more: &str| body(&format!("<joint name='j' {more}/>{WEIGHT}"));
    let free = body(&format!(
        "<freejoint/>{WEIGHT}<body><freejoint name='f'/></body>"
    ));
    let cases = [
        (
            mjcf(""),
            "1:1: this `<mujoco>` has no `<worldbody>`: import the file that includes it",
        ),
        (mjcf("<worldbody/>"), "1:1: the robot has no link"),
        (
            compiler("coordinate='global'"),
            "2:1: `coordinate` must be `local`",
        ),
        (
            compiler("angle='grad'"),
            "2:1: `angle` of `<compiler>` is `degree` or `radian`, not `grad`",
        ),
        (
            compiler("eulerseq='xyw'"),
            "2:1: `eulerseq` is three letters out of x, y, z, X, Y, Z, not `xyw`",
        ),
        (
            compiler("inertiafromgeom='yes'"),
            "is `false` or `true` or `auto`, not `yes`",
        ),
        (
            place("euler='0 0'"),
            "`euler` of `<body>` must be 3 finite numbers, not `0 0`",
        ),
        (
            place("quat='0 0 0 0'"),
            "2:12: the quaternion of `quat` is zero",
        ),
        (place("zaxis='0 0 0'"), "the axis of `zaxis` is zero"),
        (
            place("xyaxes='1 0 0 2 0 0'"),
            "the axes of `xyaxes` are parallel or zero",
        ),
        (
            place("quat='1 0 0 0' euler='0 0 0'"),
            "`quat` and `euler` both give an orientation: leave one",
        ),
        (
            joint("type='screw'"),
            "`type` of `<joint>` is `free` or `ball` or `slide` or `hinge`, not `screw`",
        ),
        (joint("axis='0 0 0'"), "2:27: the axis of joint `j` is zero"),
        (
            joint("limited='true'"),
            "2:27: this joint is limited and has no `range`",
        ),
        (
            joint("class='gone'"),
            "2:27: there is no default class `gone`",
        ),
        (
            free,
            "the free joint of body `body_2` must be its only one, and the body on the world",
        ),
        (
            body("<joint/><joint type='free'/>"),
            "the free joint of body `b` must be its only one",
        ),
        (
            mjcf("<worldbody><joint/></worldbody>"),
            "`<joint>` in `<worldbody>`: the world does not move",
        ),
        (
            body(&format!("{WEIGHT}{WEIGHT}")),
            "a second `<inertial>` in body `b`",
        ),
        (
            body("<inertial pos='0 0 0' mass='heavy'/>"),
            "`mass` of `<inertial>` must be a finite number, not `heavy`",
        ),
        (
            body("<inertial mass='1' diaginertia='1 1 1' fullinertia='1 1 1 0 0 0'/>"),
            "`diaginertia` and `fullinertia` both give the tensor: leave one",
        ),
        (
            geom("size='0.1' type='cone'"),
            "a `<geom>` has no type `cone`",
        ),
        (
            geom("size='0.1' type='capsule'"),
            "`size` of this `<geom>` of type capsule needs 2 numbers above 0",
        ),
        (
            geom("size='-1'"),
            "`size` of this `<geom>` of type sphere needs 1 number above 0",
        ),
        (
            geom("type='capsule' size='1' fromto='1 1 1 1 1 1'"),
            "the two points of `fromto` are one",
        ),
        (
            geom("type='mesh' mesh='skull'"),
            "the inertia of a body is that of meshes or shells, which is not computed here: `b` (mesh `skull`); \
             give each an `<inertial>`",
        ),
        (geom("size='1' shellinertia='true'"), "`b` (`shellinertia`)"),
        (
            body("<replicate count='3'/><composite/>"),
            "`<replicate>` of line 2 makes bodies that are not in the file",
        ),
        (
            body("<replicate count='3'/><composite/>"),
            "; `<composite>` of line 2 makes bodies",
        ),
        (
            mjcf("<default><default><joint/></default></default><worldbody/>"),
            "this nested `<default>` names no class: `class=…` is missing",
        ),
        (
            mjcf("<worldbody><body name='b'/><body name='b'/></worldbody>"),
            "there is a second link `b`",
        ),
        (
            mjcf("<include/>"),
            "2:1: this `<include>` names no file: `file=…` is missing",
        ),
        (
            mjcf("<include file='legs.xml'/>"),
            "2:1: the file `legs.xml` is included, and the folder of files is not known",
        ),
    ];
    for (text, wanted) in cases {
        let found = told(&text);
        assert!(found.contains(wanted), "{found}\n{wanted}\n{text}");
        assert!(found.starts_with(|c: char| c.is_ascii_digit()), "{found}");
    }
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

#[test]
fn included_files_are_read_in_place() {
    let folder = folder("mjcf_include");
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).expect("a file");
    write(
        "arm.xml",
        &format!(
            "<mujocoinclude><body name='arm'><joint name='j'/>{WEIGHT}<include file='hand.xml'/></body></mujocoinclude>"
        ),
    );
    write(
        "hand.xml",
        "<mujoco><body name='hand' pos='0 0 1'/></mujoco>",
    );
    write("wrong.xml", "<mujoco>\n<body></mujoco>");
    write("other.xml", "<robot/>");
    write(
        "bad.xml",
        "<mujoco>\n\n<worldbody><joint/></worldbody></mujoco>",
    );
    let options = Options {
        folder: Some(folder.clone()),
        ..Options::default()
    };
    let read = |inside: &str| import_with(&mjcf(inside), &options);
    let made = read("<worldbody><include file='arm.xml'/></worldbody>").expect("an import");
    assert!(
        made.written.starts_with("2 links, 2 joints (1 moving)"),
        "{}",
        made.written
    );
    mechanism(&made.yaml);
    for (inside, wanted) in [
        (
            "<worldbody><include file='hand.xml'/><include file='arm.xml'/></worldbody>",
            "2:38: the file `hand.xml` is included a second time",
        ),
        (
            "<include file='wrong.xml'/>",
            "2:1: in the included file `wrong.xml`: 2:",
        ),
        ("<include file='gone.xml'/>", "gone.xml cannot be read: "),
        (
            "<include file='other.xml'/>",
            "2:1: the root of the included file `other.xml` is `<robot>`",
        ),
        // Elements of an included file have the place of the `<include>`.
        (
            "\n <include file='bad.xml'/>",
            "3:2: `<joint>` in `<worldbody>`",
        ),
    ] {
        let found = read(inside).expect_err("refused").to_string();
        assert!(found.contains(wanted), "{found}");
    }
}

/// Nothing is lost in silence: each thing that a mechanism does not have is named with its count.
#[test]
fn what_is_not_taken_over_is_named_with_its_count() {
    let text = mjcf(&format!(
        "<compiler meshdir='m'/><option timestep='0.1' density='1.2'><flag contact='disable'/></option>
        <visual/><statistic extent='1'/>
        <default><motor gear='2'/><joint damping='1' margin='3'/></default>
        <asset><mesh name='a'/><mesh name='b'/><texture/></asset>
        <worldbody>
          <light/><site/>
          <body name='a' pos='0 0 1' gravcomp='1'><freejoint/><camera/><light/>{WEIGHT}
            <geom size='1' rgba='1 1 1 1' friction='1'/><geom type='plane' rgba='1 1 1 1'/>
            <body name='b'><joint name='j' type='ball' range='0 1' armature='0.1'/>{WEIGHT}<site name='s' size='1'/>
              <body name='c'><joint name='k' damping='1 2' springdamper='1 1'/>{WEIGHT}</body></body>
          </body>
          <body name='d' mocap='true'/>
        </worldbody>
        <equality><flex/><flex/><joint joint1='k'/><joint joint1='k' joint2='j'/></equality>
        <tendon><fixed/></tendon><actuator><motor/><motor/><position/></actuator><sensor><gyro/></sensor>
        <contact><exclude/></contact><keyframe><key/></keyframe>"
    ));
    let made = import(&text).expect("an import");
    for line in [
        "poses at the start, not a part of a mechanism: `a_free` at 0 0 1, rpy 0 0 0",
        "compensation of gravity (gravcomp), not imported: `a` (1)",
        "bodies whose pose is an input (mocap), fixed here: `d`",
        "of ball and free joints, not imported: range 0 1 of `j`; damping 1 of `j`; armature 0.1 of `j`",
        "polynomials, not imported: damping 1 2 of `k`",
        "sites without a name, not imported: line 7",
        "not imported: the shapes of 2 geoms, for contacts and drawing; 0 of them gave bodies their inertia",
        "not imported: `<motor>` in `<default>` (1 time)",
        "not imported: `<mesh>` in `<asset>` (2 times)",
        "not imported: `<camera>` in `<body>` (1 time)",
        "not imported: `<light>` in `<worldbody>` (1 time)",
        "not imported: `<flex>` in `<equality>` (2 times)",
        "not imported: `<fixed>` in `<tendon>` (1 time)",
        "not imported: `<motor>` in `<actuator>` (2 times)",
        "not imported: `<position>` in `<actuator>` (1 time)",
        "not imported: `<gyro>` in `<sensor>` (1 time)",
        "not imported: `<exclude>` in `<contact>` (1 time)",
        "not imported: `<key>` in `<keyframe>` (1 time)",
        "not imported: `<visual>` in `<mujoco>` (1 time)",
        "not imported: attributes of `<compiler>`: meshdir (1)",
        "not imported: attributes of `<option>`: timestep (1), density (1)",
        "not imported: attributes of `<flag>`: contact (1)",
        "not imported: attributes of `<geom>`: rgba (2), friction (1)",
        "not imported: attributes of `<joint>`: margin (1), springdamper (1)",
        "equality constraints that are no linear relation of two joints with one coordinate, not imported: `k` \
         (line 15); `k`, `j` (line 15)",
    ] {
        assert!(
            made.warnings.iter().any(|it| it == line),
            "{line}\n{:#?}",
            made.warnings
        );
    }
    mechanism(&made.yaml);
}

/// A flag disables gravity; a body that does not move needs no inertia of its mesh; `--base` lets one move.
#[test]
fn bodies_on_the_world_stay_or_move_as_asked() {
    let text = mjcf(
        "<option><flag gravity='disable'/></option>
        <worldbody><body name='table' pos='1 2 3'><geom type='mesh' mesh='m'/></body></worldbody>",
    );
    let made = import(&text).expect("an import");
    let line = "bodies that do not move, without the inertia of their meshes: `table`";
    assert!(
        made.warnings.iter().any(|it| it == line),
        "{:?}",
        made.warnings
    );
    assert!(made.yaml.contains("gravity: [0, 0, 0]"), "{}", made.yaml);
    let options = Options {
        base: Some(Base::Planar),
        ..Options::default()
    };
    let text = body(WEIGHT).replace("name='b'", "name='b' pos='1 2 3'");
    let moved = import_with(&text, &options).expect("an import");
    let joint = "joint: { name: root, type: planar, origin: { xyz: [1, 2, 3] } }";
    assert!(moved.yaml.contains(joint), "{}", moved.yaml);
    let free = body(&format!("<freejoint/>{WEIGHT}"));
    let found = import_with(&free, &options)
        .expect_err("refused")
        .to_string();
    assert!(
        found.starts_with("--base: no link is fixed to the world"),
        "{found}"
    );
}

/// A chain keeps sites on its links and on the world; its base is where it is with every joint at 0.
#[test]
fn a_chain_of_an_mjcf_keeps_its_sites() {
    let text = include_str!("../mjcf/everything.xml");
    let chain = |base: &str, tip: &str| {
        import_with(
            text,
            &Options {
                chain: Some([base.into(), tip.into()]),
                ..Options::default()
            },
        )
    };
    let made = chain("knee", "toe").expect("an import");
    assert!(
        made.written
            .starts_with("3 links, 2 joints (1 moving), 2 frames"),
        "{}",
        made.written
    );
    mechanism(&made.yaml);
    // Its link is a part of the floating trunk.
    let made = chain("trunk", "hip").expect("an import");
    let line = "--chain: `trunk` is fixed to the world where it is with every joint at 0";
    assert!(
        made.warnings.iter().any(|it| it == line),
        "{:?}",
        made.warnings
    );
    mechanism(&made.yaml);
    let found = chain("arm", "thumb").expect_err("refused").to_string();
    assert!(
        found.contains("joint `pinch` follows `grip`, and there is no such joint here"),
        "{found}"
    );
}
