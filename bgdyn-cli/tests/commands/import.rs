//! `bgdyn import` with its options, as a user calls it; what they mean is tested in `import`.

use crate::{bgdyn, scratch};

/// A stand with an arm; a tool without mass at its tip.
const ARM: &str = r#"<robot name="arm">
<link name="floor"/>
<link name="stand"><inertial><mass value="9"/><inertia ixx="0.3" iyy="0.2" izz="0.4" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="upper"><inertial><mass value="2"/><origin xyz="0.1 0 0"/><inertia ixx="0.03" iyy="0.02" izz="0.04" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="fore"><inertial><mass value="1"/><origin xyz="0.1 0 0"/><inertia ixx="0.03" iyy="0.02" izz="0.04" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="tool"/>
<joint name="bolt" type="fixed"><parent link="floor"/><child link="stand"/></joint>
<joint name="shoulder" type="revolute"><parent link="stand"/><child link="upper"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="9" velocity="9"/><dynamics damping="0.25" friction="0.5"/></joint>
<joint name="elbow" type="continuous"><parent link="upper"/><child link="fore"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/></joint>
<joint name="tip" type="fixed"><parent link="fore"/><child link="tool"/><origin xyz="0.2 0 0"/></joint>
</robot>"#;

#[test]
fn options_reach_the_import() {
    let file = scratch("import_options", "arm.urdf", ARM);
    let run = bgdyn(&[
        "import",
        &file,
        "--lock",
        "elbow=90deg",
        "--frames",
        "tool",
        "--no-effects",
        "--snap",
        "1e-9",
        "--chain",
        "stand",
        "tool",
    ]);
    let told = run.stderr.clone();
    let yaml = run.good();
    for line in ["snap: 1e-9", "frames:", "- { name: tool, link: fore"] {
        assert!(yaml.contains(line), "{line}: {yaml}");
    }
    for word in ["floor", "effects:", "damping"] {
        assert!(!yaml.contains(word), "{word}: {yaml}");
    }
    let written =
        "written: 3 links, 2 joints (1 moving), 1 frame, 0 effects; fixed to the world: `stand`";
    assert!(told.contains(written), "{told}");
}

#[test]
fn without_options_damping_and_friction_are_effects() {
    let file = scratch("import_plain", "arm.urdf", ARM);
    let yaml = bgdyn(&["import", &file]).good();
    for word in ["effects:", "damping: 0.25", "0.5"] {
        assert!(yaml.contains(word), "{word}: {yaml}");
    }
}

#[test]
fn a_table_is_read_by_its_ending() {
    let table = "a, alpha, d, theta\n0.3, 0, 0, 0\n0.2, 90 deg, 0.1, 0\n";
    let file = scratch("import_table", "arm.csv", table);
    let asks = bgdyn(&["import", &file]).bad_input();
    assert!(asks.contains("arm.csv:2:1: "), "{asks}");
    assert!(asks.contains("`--convention standard`"), "{asks}");
    let yaml = bgdyn(&["import", &file, "--convention", "modified"]).good();
    let checked = bgdyn(&["check", &scratch("import_table", "made.yaml", &yaml)]).good();
    assert!(checked.contains("NQ 2, NV 2"), "{checked}");
}

/// The root element decides that a file is an MJCF, from standard input too; included files are relative to
/// the folder of the file.
#[test]
fn an_mjcf_is_read_by_its_root() {
    let legs = "<mujocoinclude><body name='leg'><joint name='hip' axis='0 1 0'/><geom size='0.1'/></body></mujocoinclude>";
    let trunk = "<mujoco model='walker'><worldbody><body name='trunk'><freejoint name='root'/><geom size='0.2'/>\
                 <include file='legs.xml'/></body></worldbody></mujoco>";
    scratch("import_mjcf", "legs.xml", legs);
    let file = scratch("import_mjcf", "walker.xml", trunk);
    let run = bgdyn(&["import", &file]);
    let told = run.stderr.clone();
    let yaml = run.good();
    assert!(
        yaml.starts_with("# Imported from an MJCF (robot walker)"),
        "{yaml}"
    );
    let written = "fixed to the world: none; moving in the world: `trunk` by `root` (floating)";
    assert!(told.contains(written), "{told}");
    let checked = bgdyn(&["check", &scratch("import_mjcf", "made.yaml", &yaml)]).good();
    assert!(checked.contains("NQ 8, NV 7"), "{checked}");
}

#[test]
fn a_base_moves_when_the_option_says_so() {
    let file = scratch("import_base", "arm.urdf", ARM);
    let yaml = bgdyn(&["import", &file, "--base", "floating"]).good();
    let checked = bgdyn(&["check", &scratch("import_base", "made.yaml", &yaml)]).good();
    assert!(checked.contains("NQ 9, NV 8"), "{checked}");
    let given = bgdyn(&["import", &file, "--base", "given"]).good();
    assert!(given.contains("\nbase: given\n"), "{given}");
    let given = scratch("import_base", "given.yaml", &given);
    assert!(bgdyn(&["check", &given]).good().contains("NQ 2, NV 2"));
}
