//! `bgdyn import` as a library: texts made from URDFs, warnings, errors.

use bgdyn_cli::import::{Import, ImportArgs, import, run};
use serde_yaml::Value;

const GRIPPER_ARM: &str = include_str!("../urdf/gripper_arm.urdf");
const HARD_INERTIA: &str = include_str!("../urdf/hard_inertia.urdf");
const LIMITS: &str = include_str!("../urdf/limits.urdf");
const VERSION_1_2: &str = include_str!("../urdf/version_1_2.urdf");
const NAMES: &str = include_str!("../urdf/names.urdf");

/// Returns all messages of an import, as one text.
fn told(import: &Import) -> String {
    let mut out = format!("{}\n--- {}\n", import.yaml, import.name);
    for note in &import.notes {
        out += &format!("renamed: {note}\n");
    }
    for warning in &import.warnings {
        out += &format!("warning: {warning}\n");
    }
    out + &format!("written: {}\n", import.written)
}

fn error(urdf: &str) -> String {
    import(urdf).unwrap_err().to_string()
}

/// Returns a robot of two links, with this text as the joint and this one as the child's inertial.
fn with(joint: &str, inertial: &str) -> String {
    format!(
        "<robot name=\"r\">\n<link name=\"a\"/>\n<link name=\"b\">{inertial}</link>\n{joint}</robot>"
    )
}

fn hinge(inside: &str) -> String {
    let joint = "<joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/>";
    with(&format!("{joint}{inside}</joint>"), "")
}

#[test]
fn a_robot_package_file() {
    insta::assert_snapshot!(told(&import(GRIPPER_ARM).unwrap()));
}

#[test]
fn inertia_that_no_body_has() {
    insta::assert_snapshot!(told(&import(HARD_INERTIA).unwrap()));
}

#[test]
fn limits_of_all_kinds() {
    insta::assert_snapshot!(told(&import(LIMITS).unwrap()));
}

#[test]
fn rules_of_later_versions() {
    insta::assert_snapshot!(told(&import(VERSION_1_2).unwrap()));
}

#[test]
fn names_that_need_care() {
    insta::assert_snapshot!(told(&import(NAMES).unwrap()));
}

#[test]
fn errors_say_where_and_what() {
    let joint = |kind: &str| {
        with(
            &format!("<joint name='j' {kind}><parent link='a'/><child link='b'/></joint>"),
            "",
        )
    };
    let cases = [
        String::new(),
        "no xml".into(),
        "<robot name='r'>\n<link name='a'>\n</robot>".into(),
        "<scene version='1.6'/>".into(),
        "<robot name='r'/>".into(),
        "<robot name='r'><link/></robot>".into(),
        "<robot name='r'><link name='a'/>\n <link name='a'/></robot>".into(),
        "<robot xmlns:xacro='http://www.ros.org/wiki/xacro'>\n  <xacro:include filename='x'/></robot>".into(),
        "<robot>\n  <xacro:include filename='x'/></robot>".into(),
        format!("<robot name='r'>{}</robot>", "<a>".repeat(300) + &"</a>".repeat(300)),
        joint("type='spherical'"),
        joint("type='ball &#7;'"),
        joint(""),
        with("<joint type='fixed'/>", ""),
        with("<joint name='j' type='fixed'><parent link='a'/></joint>", ""),
        with("<joint name='j' type='fixed'><parent link='a'/><child link='c'/></joint>", ""),
        with("<joint name='j' type='fixed'><parent link='a'/><child link='a'/></joint>", ""),
        joint("type='fixed'").replace("</robot>", "<link name='c'/></robot>").replace(
            "</robot>",
            "<joint name='k' type='fixed'><parent link='c'/><child link='b'/></joint></robot>",
        ),
        joint("type='fixed'").replace(
            "</robot>",
            "<joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint></robot>",
        ),
        hinge("<axis xyz='0 0 -0.0'/>"),
        hinge("<axis xyz='0 0'/>"),
        hinge("<axis xyz='0 0 1'/>\n<axis xyz='0 0 1'/>"),
        hinge("<origin xyz='0 0 nan'/>"),
        hinge("<origin xyz='0 0 ${length/2}'/>"),
        hinge("<origin rpy='0 0 1 x'/>"),
        hinge("<limit lower='0,5' velocity='1'/>"),
        with("", "<inertial><mass value='heavy'/></inertial>"),
        with("", "<inertial><mass value='1e999'/></inertial>"),
        hinge("<origin rpy='0 0 0' quat_xyzw='0 0 0 1'/>").replace("<robot", "<robot version='1.1'"),
        hinge("<origin quat_xyzw='0 0 0 0'/>").replace("<robot", "<robot version='1.1'"),
        hinge("<limit lower='2' upper='1'/>").replace("<robot", "<robot version='1.2'"),
    ];
    insta::assert_snapshot!(cases.map(|case| error(&case)).join("\n"));
}

#[test]
fn several_unsupported_joints_come_in_one_error() {
    let urdf = "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>
        <joint name='root' type='ball'><parent link='a'/><child link='b'/></joint>
        <joint name='slide' type='screw'><parent link='b'/><child link='c'/></joint></robot>";
    let error = error(urdf);
    assert!(
        error.starts_with("2:9: joint `root` is `ball`, joint `slide` is `screw`: "),
        "{error}"
    );
}

#[test]
fn an_expanded_xacro_is_a_urdf() {
    let urdf = hinge("").replace(
        "<robot",
        "<robot xmlns:xacro='http://www.ros.org/wiki/xacro'",
    );
    assert!(import(&urdf).is_ok());
}

#[test]
fn encodings_and_doctypes() {
    let urdf = format!(
        "\u{feff}<?xml version='1.0' encoding='ISO-8859-1'?>\n{}",
        hinge("").replace("\"j\"", "\"é\"")
    );
    assert_eq!(import(&urdf).unwrap().notes, ["joints `é` → `joint`"]);
    import(&urdf.replace("ISO-8859-1", "klingon")).unwrap();
    let bomb = "<!DOCTYPE r [<!ENTITY a 'aaaaaaaaaaaaaaaa'>".to_string()
        + &(0..12)
            .map(|i| {
                format!(
                    "<!ENTITY a{i} '{}'>",
                    if i == 0 {
                        "&a;".repeat(9)
                    } else {
                        format!("&a{};", i - 1).repeat(9)
                    }
                )
            })
            .collect::<String>()
        + "]><robot name='r'><link name='x'/>&a11;</robot>";
    assert!(error(&bomb).contains("entity reference loop"));
}

#[test]
fn several_roots_stand_on_the_world() {
    let import = import("<robot name='r'><link name='a'/><link name='b'/></robot>").unwrap();
    assert!(
        import
            .yaml
            .ends_with("links:\n  - name: a\n\n  - name: b\n"),
        "{}",
        import.yaml
    );
    assert_eq!(
        import.warnings,
        ["several links have no joint, all are fixed to the world: `a`, `b`"]
    );
}

#[test]
fn nothing_is_said_where_nothing_is_lost() {
    let urdf =
        hinge("<limit lower='-1' upper='1' effort='2' velocity='3'/><dynamics damping='0.0'/>");
    let import = import(&urdf).unwrap();
    assert!(
        import.warnings.is_empty() && import.notes.is_empty(),
        "{import:?}"
    );
}

/// The numbers of the mechanism are those of the file's attributes.
#[test]
fn numbers_are_those_of_the_file() {
    let yaml: Value = serde_yaml::from_str(&import(GRIPPER_ARM).unwrap().yaml).unwrap();
    let entries = yaml["links"].as_sequence().unwrap();
    let file = roxmltree::Document::parse(GRIPPER_ARM).unwrap();
    let robot = file.root_element();
    let all = |tag| {
        robot
            .children()
            .filter(move |child| child.has_tag_name(tag))
    };
    let part = |node: roxmltree::Node<'_, '_>, tags: &[&str], attribute: &str| {
        let inside = tags.iter().try_fold(node, |node, tag| {
            node.children().find(|child| child.has_tag_name(*tag))
        });
        let value = inside
            .and_then(|node| node.attribute(attribute))
            .map(str::to_owned);
        value.unwrap_or_default()
    };
    let numbers = |text: String| -> Vec<f64> {
        let numbers = text.split_whitespace().map(|x| x.parse().unwrap());
        numbers.collect()
    };
    let vector = |text: String| match text.is_empty() {
        true => vec![0.0; 3],
        false => numbers(text),
    };
    let number = |text: String| numbers(text).first().copied().unwrap_or(0.0);
    let written = |value: Option<&Value>| value.map_or(0.0, |v| v.as_f64().unwrap());
    let written3 = |value: Option<&Value>| match value {
        Some(value) => (0..3).map(|i| value[i].as_f64().unwrap()).collect(),
        None => vec![0.0; 3],
    };
    let label = |value: &Value| value.get("label").unwrap_or(&value["name"]).clone();

    assert_eq!(entries.len(), all("link").count());
    for (entry, joint) in entries[1..].iter().zip(all("joint")) {
        let child = part(joint, &["child"], "link");
        assert_eq!(label(entry), child.as_str());
        let read = &entry["joint"];
        assert_eq!(label(read), joint.attribute("name").unwrap());
        let origin = read.get("origin").cloned().unwrap_or_default();
        for key in ["xyz", "rpy"] {
            let wanted = vector(part(joint, &["origin"], key));
            assert_eq!(written3(origin.get(key)), wanted, "{key} of {child}");
        }
        let link = all("link").find(|link| link.attribute("name") == Some(&child));
        let inertial = |tag, attribute| part(link.unwrap(), &["inertial", tag], attribute);
        assert_eq!(
            written(entry.get("mass")),
            number(inertial("mass", "value"))
        );
        assert_eq!(
            written3(entry.get("com")),
            vector(inertial("origin", "xyz"))
        );
        let inertia = entry.get("inertia").cloned().unwrap_or_default();
        for key in ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"] {
            let wanted = number(inertial("inertia", key));
            assert_eq!(written(inertia.get(&key[1..])), wanted, "{key} of {child}");
        }
    }
}

#[test]
fn the_command_writes_the_file() {
    let dir = std::env::temp_dir().join(format!("bgdyn-import-{}", std::process::id()));
    std::fs::create_dir_all(&dir).unwrap();
    let (file, output) = (dir.join("limits.urdf"), dir.join("limits.yaml"));
    std::fs::write(&file, LIMITS).unwrap();
    run(ImportArgs {
        file: file.clone(),
        output: Some(output.clone()),
        ..ImportArgs::default()
    })
    .unwrap();
    assert_eq!(
        std::fs::read_to_string(&output).unwrap(),
        import(LIMITS).unwrap().yaml
    );

    std::fs::write(&file, b"<robot>\n\xff</robot>").unwrap();
    let error = run(ImportArgs {
        file: file.clone(),
        output: None,
        ..ImportArgs::default()
    })
    .unwrap_err()
    .to_string();
    assert_eq!(
        error,
        format!(
            "{}:2:1: this line is not UTF-8: convert the file first",
            file.display()
        )
    );
    std::fs::write(&file, "<scene/>").unwrap();
    let error = run(ImportArgs {
        file: file.clone(),
        output: None,
        ..ImportArgs::default()
    })
    .unwrap_err()
    .to_string();
    assert!(
        error.starts_with(&format!("{}:1:1: ", file.display())),
        "{error}"
    );
    std::fs::remove_dir_all(&dir).unwrap();
    let gone = ImportArgs {
        file,
        ..ImportArgs::default()
    };
    assert!(run(gone).is_err());
}
