//! Tests locked joints, chains, frames, effects, `snap`, and their messages.

use super::{effects, many, mechanism, near, pose, value};
use bgdyn_cli::import::{Import, Lock, Options, import_with};
use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;

/// A branched robot with tilted axes: the torso has two arms, the right one a hand with a massless tool.
const ROBOT: &str = r#"<robot name="two arms">
<link name="floor"/>
<link name="Torso"><inertial><mass value="9"/><origin xyz="0 0.1 0.3"/><inertia ixx="0.3" iyy="0.2" izz="0.4" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="left"><inertial><mass value="2"/><origin xyz="0.1 0 0.2"/><inertia ixx="0.03" iyy="0.02" izz="0.04" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="right"><inertial><mass value="2.5"/><origin xyz="0.1 0.2 0.2"/><inertia ixx="0.03" iyy="0.02" izz="0.04" ixy="0.001" ixz="0" iyz="0"/></inertial></link>
<link name="fore"><inertial><mass value="1.5"/><origin xyz="0.1 0.2 0"/><inertia ixx="0.03" iyy="0.02" izz="0.04" ixy="0.001" ixz="0" iyz="0"/></inertial></link>
<link name="weight"><inertial><mass value="0.7"/><origin xyz="0 0 0.1"/><inertia ixx="0.003" iyy="0.002" izz="0.004" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="flange"/>
<link name="tool0"/>
<joint name="stand" type="fixed"><parent link="floor"/><child link="Torso"/><origin xyz="0 0 0.5" rpy="0.3 0.2 0.1"/></joint>
<joint name="swing" type="revolute"><parent link="Torso"/><child link="left"/><origin xyz="0 0.2 0.5" rpy="0 0.2 0.1"/><axis xyz="1 0 1"/><limit lower="-1" upper="1" effort="9" velocity="9"/></joint>
<joint name="Shoulder" type="revolute"><parent link="Torso"/><child link="right"/><origin xyz="0 -0.2 0.5" rpy="0.4 0.2 -0.1"/><axis xyz="1 2 3"/><limit lower="-1" upper="1" effort="9" velocity="9"/><dynamics damping="0.25" friction="0.5"/></joint>
<joint name="slide" type="prismatic"><parent link="right"/><child link="fore"/><origin xyz="0 -0.2 0.1" rpy="0.4 0.5 -0.1"/><axis xyz="0 3 4"/><limit lower="-1" upper="1" effort="9" velocity="9"/><dynamics damping="4"/></joint>
<joint name="wrist" type="continuous"><parent link="fore"/><child link="weight"/><origin xyz="0.1 0 0.1" rpy="1.57079632679 0 0"/><axis xyz="0 1 0"/></joint>
<joint name="plate" type="fixed"><parent link="weight"/><child link="flange"/><origin xyz="0.1 0.02 0" rpy="0.1 0.2 0.3"/></joint>
<joint name="tip" type="fixed"><parent link="flange"/><child link="tool0"/><origin xyz="0 0 0.3" rpy="0 -1.2 0.3"/></joint>
</robot>"#;

fn made(options: Options) -> Import {
    import_with(ROBOT, &options).expect("an import")
}

fn locks(texts: &[&str]) -> Vec<Lock> {
    texts
        .iter()
        .map(|text| Lock::parse(text).expect("a lock"))
        .collect()
}

fn list(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| name.to_string()).collect()
}

/// Returns the efforts of the joints with these indices in the whole robot, for these values of all
/// coordinates.
fn efforts(yaml: &str, state: [&[f64]; 3]) -> Vec<f64> {
    value(&mechanism(yaml), Method::InverseDynamics, state)
}

#[test]
fn a_locked_joint_is_one_that_rests_there() {
    let whole = made(Options::default()).yaml;
    let mut numbers = Random(3);
    let cases = [
        ("swing", 0, 0.0),
        ("swing", 0, -0.7),
        ("Shoulder", 1, 0.9),
        ("shoulder", 1, 0.9),
        ("slide", 2, 0.4),
        ("wrist", 3, 2.0),
    ];
    for (joint, at, angle) in cases {
        let text = if angle == 0.0 {
            joint.to_owned()
        } else {
            format!("{joint}={angle}")
        };
        let locked = made(Options {
            lock: locks(&[&text]),
            ..Options::default()
        });
        assert!(
            locked.written.contains("7 joints (3 moving)"),
            "{}",
            locked.written
        );
        let mut all = [(); 3].map(|()| many(&mut numbers, 4));
        let rest = all.clone().map(|mut part| {
            part.remove(at);
            part
        });
        all[0][at] = angle;
        (all[1][at], all[2][at]) = (0.0, 0.0);
        let mut wanted = efforts(&whole, all.each_ref().map(Vec::as_slice));
        wanted.remove(at);
        near(
            &efforts(&locked.yaml, rest.each_ref().map(Vec::as_slice)),
            &wanted,
            1e-13,
        );
    }
}

#[test]
fn a_locked_joint_at_zero_keeps_its_digits() {
    let locked = made(Options {
        lock: locks(&["slide"]),
        ..Options::default()
    });
    assert!(
        locked
            .yaml
            .contains("type: fixed, origin: { xyz: [0, -0.2, 0.1], rpy: [0.4, 0.5, -0.1] }")
            || locked
                .yaml
                .contains("origin: { xyz: [0, -0.2, 0.1], rpy: [0.4, 0.5, -0.1] }"),
        "{}",
        locked.yaml
    );
    let degrees = made(Options {
        lock: locks(&["wrist=90deg"]),
        ..Options::default()
    });
    let radians = made(Options {
        lock: locks(&["wrist=1.5707963267948966"]),
        ..Options::default()
    });
    assert_eq!(degrees.yaml, radians.yaml);
}

/// Units are those of files, and must fit the joint.
#[test]
fn a_lock_has_a_unit_that_its_joint_moves_in() {
    let yaml = |text: &str| {
        made(Options {
            lock: locks(&[text]),
            ..Options::default()
        })
        .yaml
    };
    assert_eq!(yaml("slide=20 mm"), yaml("slide=0.02"));
    assert_eq!(yaml("wrist=90 °"), yaml("wrist=90deg"));
    assert_eq!(yaml("wrist=0.5 rad"), yaml("wrist=0.5"));
    for (text, said) in [
        (
            "slide=90deg",
            "`slide` slides, and its value is an angle: write a length, in m",
        ),
        (
            "wrist=20 mm",
            "`wrist` turns, and its value is a length: write an angle, in rad",
        ),
    ] {
        let options = Options {
            lock: locks(&[text]),
            ..Options::default()
        };
        let told = import_with(ROBOT, &options)
            .expect_err("refused")
            .to_string();
        assert!(told.contains(said), "{told}");
    }
    for text in ["slide=2 kg", "slide=nan", "slide=", "slide=far"] {
        let told = Lock::parse(text).expect_err("refused");
        assert!(told.starts_with("`slide`: "), "{told}");
    }
}

#[test]
fn a_chain_keeps_what_is_fixed_to_it_and_the_direction_of_gravity() {
    let whole = made(Options::default()).yaml;
    let chain = |base: &str, tip: &str| {
        made(Options {
            chain: Some([base.into(), tip.into()]),
            ..Options::default()
        })
    };
    let mut numbers = Random(5);
    // Those of the right arm alone, and of the bodies outboard of the shoulder with the shoulder at 0 and
    // at rest.
    for (base, first) in [("Torso", 1), ("floor", 1), ("right", 2)] {
        for tip in ["tool0", "weight"] {
            let right = chain(base, tip);
            let mut all = [(); 3].map(|()| many(&mut numbers, 4));
            for part in &mut all {
                part[..first].fill(0.0);
            }
            let own = all.clone().map(|part| part[first..].to_vec());
            let wanted = efforts(&whole, all.each_ref().map(Vec::as_slice));
            near(
                &efforts(&right.yaml, own.each_ref().map(Vec::as_slice)),
                &wanted[first..],
                1e-13,
            );
            let told = right
                .warnings
                .iter()
                .find(|w| w.starts_with("--chain: left out"));
            assert!(
                told.is_some_and(|told| told.contains("`left`")),
                "{:?}",
                right.warnings
            );
        }
    }
    let short = chain("floor", "fore");
    assert!(short.written.contains("(2 moving)"), "{}", short.written);
    let error = |base: &str, tip: &str| {
        let options = Options {
            chain: Some([base.into(), tip.into()]),
            ..Options::default()
        };
        import_with(ROBOT, &options)
            .expect_err("refused")
            .to_string()
    };
    assert!(error("left", "tool0").starts_with("--chain: `left` does not carry `tool0`"));
    assert!(
        error("head", "tool0")
            .starts_with("--chain: there is no link `head`; the links are `floor`")
    );
}

#[test]
fn a_frame_is_where_its_link_would_be() {
    let whole = mechanism(&made(Options::default()).yaml);
    let q = many(&mut Random(7), 4);
    for asked in [&["tool0"][..], &["flange", "tool0"], &["all"]] {
        let framed = made(Options {
            frames: list(asked),
            ..Options::default()
        });
        let own = mechanism(&framed.yaml);
        assert!(own.frames().iter().any(|frame| frame.name == "tool0"));
        assert_eq!(own.links().len() + own.frames().len(), whole.links().len());
        for place in ["tool0", "flange"] {
            near(&pose(&own, place, &q), &pose(&whole, place, &q), 1e-14);
        }
    }
    let one = made(Options {
        frames: list(&["tool0"]),
        ..Options::default()
    });
    assert!(
        one.yaml.contains(
            "  - { name: tool0, link: flange, origin: { xyz: [0, 0, 0.3], rpy: [0, -1.2, 0.3] } }\n"
        ),
        "{}",
        one.yaml
    );
    let error = |name: &str| {
        let options = Options {
            frames: list(&[name]),
            ..Options::default()
        };
        import_with(ROBOT, &options)
            .expect_err("refused")
            .to_string()
    };
    assert!(error("weight").contains("`weight` is no frame"));
    assert!(error("floor").contains("`floor` is no frame"));
    assert!(error("flange").contains("`flange` carries `tool0`"));
    assert!(error("nose").contains("there is no link `nose`"));
}

#[test]
fn damping_and_friction_are_declared_as_effects() {
    let whole = made(Options::default());
    let wanted = "\neffects:\n  shoulder_damping: { type: viscous, joint: shoulder, damping: 0.25 }\n  \
        shoulder_friction: { type: coulomb, joint: shoulder, kinetic: 0.5 }\n  \
        slide_damping: { type: viscous, joint: slide, damping: 4 }\n";
    assert!(whole.yaml.ends_with(wanted), "{}", whole.yaml);
    assert_eq!(effects(&whole.yaml), 3);
    assert!(whole.written.contains("3 effects"), "{}", whole.written);
    let without = made(Options {
        no_effects: true,
        ..Options::default()
    });
    assert!(!without.yaml.contains("effects:"));
    assert!(
        without
            .warnings
            .iter()
            .any(|w| w.contains("left out, as asked"))
    );
    // A locked joint has no limits.
    let locked = made(Options {
        lock: locks(&["Shoulder"]),
        ..Options::default()
    });
    assert_eq!(effects(&locked.yaml), 1);
    let clash = ROBOT.replace("\"left\"", "\"slide_damping\"");
    let clash = import_with(&clash, &Options::default()).expect("an import");
    assert!(
        clash.yaml.contains("  slide_damping_2: { type: viscous"),
        "{}",
        clash.yaml
    );
    assert_eq!(effects(&clash.yaml), 3);
}

#[test]
fn snapping_is_told_with_how_far() {
    let whole = made(Options::default());
    let told = whole.warnings.iter().find(|w| w.starts_with("snapped: "));
    let told = told.expect("a wrist that is 4.9e-12 rad off");
    assert!(
        told.contains("1 direction, 4.9e-12 rad off (`links[5].joint.origin.rpy`)"),
        "{told}"
    );
    let kept = made(Options {
        snap: Some(0.0),
        ..Options::default()
    });
    assert!(kept.yaml.contains("\nsnap: 0\n"), "{}", kept.yaml);
    assert!(kept.warnings.iter().all(|w| !w.starts_with("snapped: ")));
    let coarse = made(Options {
        snap: Some(1e-4),
        ..Options::default()
    });
    assert!(coarse.yaml.contains("\nsnap: 0.0001\n"), "{}", coarse.yaml);
}

#[test]
fn a_base_that_nothing_carries_is_told_of() {
    let told = |urdf: &str| {
        import_with(urdf, &Options::default())
            .expect("an import")
            .warnings
    };
    let grounded = |urdf: &str| {
        told(urdf)
            .into_iter()
            .find(|w| w.starts_with("fixed to the world"))
    };
    let all = grounded(ROBOT).expect("a torso fixed to a floor");
    assert!(all.contains("`floor` (9 kg)"), "{all}");
    assert_eq!(grounded(&ROBOT.replace("\"floor\"", "\"world\"")), None);
    let light = ROBOT.replace(
        "type=\"fixed\"><parent link=\"floor\"",
        "type=\"continuous\"><parent link=\"floor\"",
    );
    assert_eq!(grounded(&light), None);
    let written = made(Options::default()).written;
    assert_eq!(
        written,
        "8 links, 7 joints (4 moving), 0 frames, 3 effects; fixed to the world: `floor`"
    );
}

#[test]
fn what_is_asked_of_no_joint_is_an_error() {
    let error = |text: &str| {
        let options = Options {
            lock: locks(&[text]),
            ..Options::default()
        };
        import_with(ROBOT, &options)
            .expect_err("refused")
            .to_string()
    };
    assert!(
        error("elbow").starts_with(
            "--lock: there is no joint `elbow`; those that move are `swing`, `Shoulder`"
        )
    );
    assert!(error("plate").starts_with("--lock: the joint `plate` is fixed already"));
    for text in ["wrist=", "wrist=far", "wrist=nan", "wrist=inf"] {
        assert!(Lock::parse(text).is_err(), "{text}");
    }
}

/// The base of the page, rolled by a quarter turn, falls freely and does not rotate. Its y axis points up:
/// accelerations and efforts are in link axes.
#[test]
fn the_base_of_the_page_moves_freely() {
    let page = include_str!("../../../docs/import.md");
    let block = page
        .split("```yaml\n")
        .nth(1)
        .and_then(|rest| rest.split("```").next());
    let base = mechanism(block.expect("a block of YAML"));
    assert_eq!((base.nq(), base.nv()), (7, 6));
    let half = 0.5_f64.sqrt();
    let q = [1.0, 2.0, 3.0, half, 0.0, 0.0, half];
    let fall = [0.0, -9.81, 0.0, 0.0, 0.0, 0.0];
    let efforts = value(&base, Method::InverseDynamics, [&q, &[0.0; 6], &fall]);
    assert!(
        efforts.iter().all(|effort| effort.abs() < 1e-12),
        "{efforts:?}"
    );
    let weight = value(&base, Method::InverseDynamics, [&q, &[0.0; 6], &[0.0; 6]]);
    assert!((weight[1] - 12.0 * 9.81).abs() < 1e-12, "{weight:?}");
    assert!(
        weight[0].abs() < 1e-12 && weight[2].abs() < 1e-12,
        "{weight:?}"
    );
}
