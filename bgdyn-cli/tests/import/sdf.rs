//! SDFs against mechanisms written by hand, and random ones against mechanisms that are written beside them.

use super::sdf_writer::{Pose, SdfModel, number_list};
use super::{effects, many, mechanism, near, pose, value};
use bgdyn_cli::import::{Base, Import, Lock, Options, import, import_with};
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;

const ARM: &str = include_str!("../sdf/arm.sdf");
const ARM_BY_HAND: &str = include_str!("../sdf/arm.yaml");
const FOUR_BAR: &str = include_str!("../sdf/four_bar.sdf");
const FOUR_BAR_BY_HAND: &str = include_str!("../../../specs/loops/four_bar.yaml");

fn made(text: &str) -> Import {
    import(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn refused(text: &str) -> String {
    match import(text) {
        Ok(made) => panic!("imported:\n{}", made.yaml),
        Err(error) => error.to_string(),
    }
}

/// Replaces a text that must be there.
fn changed(text: &str, old: &str, new: &str) -> String {
    assert!(text.contains(old), "{old}");
    text.replacen(old, new, 1)
}

/// Returns random positions of a mechanism, with quaternions of length 1.
fn positions(mechanism: &Mechanism, random: &mut Random) -> Vec<f64> {
    let mut q = many(random, mechanism.nq());
    let names = mechanism.position_names();
    for first in (0..q.len()).filter(|&p| names[p].ends_with("_qx")) {
        let length = q[first..first + 4]
            .iter()
            .map(|x| x * x)
            .sum::<f64>()
            .sqrt();
        q[first..first + 4].iter_mut().for_each(|x| *x /= length);
    }
    q
}

/// Asserts that two mechanisms have the same coordinates, efforts, mass matrix and poses at random states.
fn assert_same(found: &Mechanism, wanted: &Mechanism, places: &[&str], bar: f64) {
    assert_eq!(found.joint_names(), wanted.joint_names());
    assert_eq!(found.position_names(), wanted.position_names());
    let mut random = Random(5);
    for _ in 0..4 {
        let q = positions(wanted, &mut random);
        let [v, a] = [(); 2].map(|()| many(&mut random, wanted.nv()));
        for method in [Method::InverseDynamics, Method::MassMatrix] {
            let [x, y] = [found, wanted].map(|m| value(m, method, [&q, &v, &a]));
            near(&x, &y, bar);
        }
        for place in places {
            let [x, y] = [found, wanted].map(|m| pose(m, place, &q));
            near(&x, &y, bar);
        }
    }
}

#[test]
fn an_arm_is_the_mechanism_written_by_hand() {
    let made = made(ARM);
    let (found, wanted) = (mechanism(&made.yaml), mechanism(ARM_BY_HAND));
    assert_same(&found, &wanted, &["elbow_place", "nut", "bob"], 1e-14);
    assert_eq!(found.gravity().0.map(|x| x.to_f64()), [0.0, 0.0, -9.81]);
    // Damping, friction and spring of the shoulder, damping about the second axis of the cross.
    assert_eq!(effects(&made.yaml), 4);
    for line in [
        "label: Shoulder",
        "limits: { lower: -1.5, effort: 60 }",
        "type: helical, lead: 0.005",
        "xyz: [0.38, 0.05, 0.1], rpy: [0, 90 deg, 0]",
        "joint: cross_axis2, damping: 0.01",
    ] {
        assert!(made.yaml.contains(line), "{line}\n{}", made.yaml);
    }
    for words in [
        "models that are static, not imported: `ground`",
        "`<visual>` in `<link>` (1 time, with 1 mesh file)",
        "`<plugin>` in `<model>`",
        "`<physics>` in `<world>`",
    ] {
        let told = made.warnings.iter().any(|line| line.contains(words));
        assert!(told, "{words}\n{:#?}", made.warnings);
    }
}

/// Random trees of all types of joints: poses relative to the model, to the parent, to its joint and to a frame; axes in
/// the joint's frame, the model's and the child's; poses as angles, degrees and quaternions.
#[test]
fn random_models_are_the_mechanisms_written_beside_them() {
    let mut random = Random(42);
    for _ in 0..12 {
        let mut model = SdfModel::new();
        for k in 1..=6 {
            let parent = random.below(k) as usize;
            let kinds = [
                "revolute",
                "continuous",
                "prismatic",
                "screw",
                "universal",
                "ball",
                "fixed",
            ];
            let kind = kinds[random.below(7) as usize];
            model.link(&mut random, parent, kind);
        }
        let found = made(&model.sdf());
        let (found, wanted) = (mechanism(&found.yaml), mechanism(&model.yaml()));
        let tips = ["link_1", "link_3", "link_6", "mark_2", "mark_5"];
        assert_same(&found, &wanted, &tips, 1e-12);
    }
}

/// The second joint of the rocker closes the loop.
#[test]
fn a_four_bar_is_the_mechanism_written_by_hand() {
    let made = made(FOUR_BAR);
    let (found, wanted) = (mechanism(&made.yaml), mechanism(FOUR_BAR_BY_HAND));
    assert_eq!((found.nv(), found.nq()), (1, 3));
    let at_file = [
        std::f64::consts::FRAC_PI_2,
        -1.1042766339307688,
        1.5466085432748902,
    ];
    // The pose of the file is closed.
    let start = found.closure().expect("a loop").start.iter();
    near(
        &start.map(|x| x.to_f64()).collect::<Vec<_>>(),
        &[0.0; 3],
        1e-12,
    );
    for sample in &wanted.closure().expect("a loop").samples[..6] {
        let q: Vec<f64> = sample.iter().map(|x| x.to_f64()).collect();
        let own: Vec<f64> = q.iter().zip(at_file).map(|(q, at)| q - at).collect();
        let gap = value(&found, Method::ConstraintResidual, [&own, &[], &[]]);
        near(&gap, &[0.0; 2], 1e-14);
        for method in [Method::InverseDynamics, Method::MassMatrix] {
            let state = |q| value(q, method, [&own, &[1.5], &[-2.0]]);
            let by_hand = value(&wanted, method, [&q, &[1.5], &[-2.0]]);
            near(&state(&found), &by_hand, 1e-12);
        }
    }
    let words = "joints that close loops: `rocker_pin` (hinge)";
    assert!(
        made.warnings.iter().any(|line| line == words),
        "{:#?}",
        made.warnings
    );
    let words = "limits, damping, friction and springs of joints that close loops, not imported: `rocker_pin`";
    assert!(
        made.warnings.iter().any(|line| line == words),
        "{:#?}",
        made.warnings
    );
}

/// Two branches of four joints whose ends a joint of each type connects: the loop written by hand.
#[test]
fn joints_that_close_loops_are_the_loops_written_beside_them() {
    let mut random = Random(77);
    for (kind, second, nv) in [
        ("revolute", "revolute", 3),
        ("continuous", "revolute", 3),
        ("prismatic", "revolute", 3),
        ("fixed", "ball", 4),
        ("ball", "screw", 5),
        ("universal", "ball", 6),
    ] {
        let mut model = SdfModel::new();
        for k in 1..=8 {
            let parent = if k == 5 { 0 } else { k - 1 };
            let joint = match k {
                2 => second,
                3 => "prismatic",
                _ => "revolute",
            };
            model.link(&mut random, parent, joint);
        }
        model.close(&mut random, [4, 8], kind);
        let import = made(&model.sdf());
        let wanted = mechanism(&model.yaml());
        assert_eq!(mechanism(&import.yaml).nv(), nv, "{kind}: {}", import.yaml);
        // The choice of independent joints depends on the axes in which rows are written.
        let own = wanted.joint_names().join(", ");
        let found = mechanism(&format!("{}independent: [{own}]\n", import.yaml));
        assert_eq!(found.joint_names(), wanted.joint_names(), "{kind}");
        for sample in &wanted.closure().expect("a loop").samples[..4] {
            let q: Vec<f64> = sample.iter().map(|x| x.to_f64()).collect();
            let gap = value(&found, Method::ConstraintResidual, [&q, &[], &[]]);
            near(&gap, &vec![0.0; gap.len()], 1e-12);
            let [v, a] = [(); 2].map(|()| many(&mut random, nv));
            let [x, y] = [&found, &wanted].map(|m| value(m, Method::InverseDynamics, [&q, &v, &a]));
            near(&x, &y, 1e-9);
        }
    }
}

/// A body.
fn link(name: &str) -> String {
    format!("<link name='{name}'><inertial><mass>1</mass></inertial></link>\n")
}

fn joint(name: &str, kind: &str, [parent, child]: [&str; 2], inside: &str) -> String {
    format!(
        "<joint name='{name}' type='{kind}'><parent>{parent}</parent><child>{child}</child>{inside}</joint>\n"
    )
}

fn model(inside: &str) -> String {
    format!("<sdf version='1.9'><model name='m'>\n{inside}</model></sdf>")
}

const AXIS: &str = "<axis><xyz>0 1 0</xyz></axis>";

/// A model that is not static and has no joint to the world moves freely, unless an option says otherwise.
#[test]
fn links_without_a_joint_move_freely() {
    let text = model(&(link("a") + &link("b") + &joint("j", "revolute", ["a", "b"], AXIS)));
    let text = changed(
        &text,
        "<link name='a'>",
        "<link name='a'><pose>0 0 1 0 0 0</pose>",
    );
    let free = made(&text);
    assert_eq!(mechanism(&free.yaml).nv(), 7);
    assert!(
        free.yaml
            .contains("{ name: a_free, type: floating, origin: { xyz: [0, 0, 1] } }")
    );
    for (base, nv) in [(Base::Fixed, 1), (Base::Planar, 4)] {
        let options = Options {
            base: Some(base),
            ..Options::default()
        };
        let import = import_with(&text, &options).expect("an import");
        assert_eq!(mechanism(&import.yaml).nv(), nv);
    }
}

/// What the format gives where nothing is written; older files; a screw by its pitch in rad/m; locks.
#[test]
fn defaults_and_older_versions() {
    let chain =
        joint("on", "fixed", ["world", "a"], "") + &joint("j", "revolute", ["a", "b"], "<axis/>");
    let plain = made(&model(&format!("<link name='a'/><link name='b'/>{chain}")));
    let found = mechanism(&plain.yaml);
    assert_eq!(value(&found, Method::MassMatrix, [&[0.3], &[], &[]]), [1.0]);
    let words = "to which the format gives 1 kg and 1 kg·m² about each axis: `a`; `b`";
    assert!(
        plain.warnings.iter().any(|line| line.contains(words)),
        "{:#?}",
        plain.warnings
    );
    // In the model's frame up to 1.4, and up to 1.6 if the file says so.
    let turned = "<link name='a'/><link name='b'><pose>0 0 0 0 1.5707963267948966 0</pose></link>";
    let along = |version: &str, inside: &str| {
        let axis = format!("<axis><xyz>0 0 1</xyz>{inside}</axis>");
        let joints =
            joint("on", "fixed", ["world", "a"], "") + &joint("j", "revolute", ["a", "b"], &axis);
        let text = model(&format!("{turned}{joints}"));
        made(&changed(
            &text,
            "version='1.9'",
            &format!("version='{version}'"),
        ))
        .yaml
    };
    let of_model = "<use_parent_model_frame>true</use_parent_model_frame>";
    for (version, inside, axis) in [
        ("1.4", "", "axis: -x"),
        ("1.6", of_model, "axis: -x"),
        ("1.6", "", "type: revolute, origin"),
        ("1.7", of_model, "type: revolute, origin"),
    ] {
        let yaml = along(version, inside);
        assert!(yaml.contains(axis), "{version}: {yaml}");
    }
    let screw = "<thread_pitch>-1256.6370614359173</thread_pitch><axis/>";
    let screw = model(&(link("a") + &joint("thread", "screw", ["world", "a"], screw)));
    let turns = made(&screw).yaml;
    assert!(turns.contains("type: helical, lead: 0.005"), "{turns}");
    let options = Options {
        lock: vec![Lock::parse("thread=180 deg").expect("a lock")],
        ..Options::default()
    };
    let locked = import_with(&screw, &options).expect("an import").yaml;
    assert!(
        locked.contains("xyz: [0, 0, 0.0025], rpy: [0, 0, 180 deg]"),
        "{locked}"
    );
}

/// SDF prescribes no tree: joints in any order and direction are the same mechanism, and no link floats.
#[test]
fn joints_in_any_direction_carry_their_links() {
    let bodies = "<link name='a'><inertial><mass>2</mass><pose>0.1 0 0.3 0 0 0</pose></inertial></link>
        <link name='b'><pose>0 0 1 0.3 0 0</pose><inertial><mass>3</mass><pose>0 0.2 0 0 0 0</pose></inertial></link>";
    let chain = |joints: String| mechanism(&made(&model(&format!("{bodies}{joints}"))).yaml);
    let limited = "<axis><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>2</upper></limit></axis>";
    // The joint's frame is that of its child: of link b in both.
    let at_b = "<pose relative_to='b'>0 0 0 0 0 0</pose>";
    let opposite = limited.replace("0 1 0", "0 -1 0");
    let right = chain(
        joint("on", "fixed", ["world", "a"], "") + &joint("hinge", "revolute", ["a", "b"], limited),
    );
    let inside = format!("{at_b}{opposite}");
    let reversed = joint("hinge", "revolute", ["b", "a"], &inside);
    for joints in [
        joint("on", "fixed", ["world", "a"], "") + &reversed,
        reversed.clone() + &joint("on", "fixed", ["world", "a"], ""),
    ] {
        let found = chain(joints);
        assert_eq!(found.joint_names(), ["hinge"]);
        for q in [-0.7, 0.0, 1.3] {
            for method in [Method::InverseDynamics, Method::MassMatrix] {
                let [x, y] = [&found, &right].map(|m| value(m, method, [&[q], &[0.8], &[-1.1]]));
                near(&x, &y, 1e-14);
            }
        }
    }
    // The world's joint comes last, to the middle of a chain.
    let last = chain(
        joint("hinge", "revolute", ["a", "b"], limited) + &joint("on", "fixed", ["world", "b"], ""),
    );
    assert_eq!(last.nv(), 1);
    // Two links fixed to the same one.
    let bodies = link("a") + &link("b") + &link("c");
    let fixed = joint("j1", "fixed", ["a", "c"], "") + &joint("j2", "fixed", ["b", "c"], "");
    let welded = made(&model(&(bodies + &fixed)));
    assert_eq!(mechanism(&welded.yaml).nv(), 6, "{}", welded.yaml);
    let words = "joints that carry their parent here";
    let told = welded.warnings.iter().any(|line| line.starts_with(words));
    assert!(told, "{:#?}", welded.warnings);
}

/// A universal joint from its child to its parent is the same cross the other way round.
#[test]
fn a_reversed_universal_joint_has_its_axes_in_the_opposite_order() {
    let bodies = link("a")
        + "<link name='b'><pose>0 0 0.5 0 0 0</pose><inertial><mass>1</mass><pose>0 0 0.2 0 0 0</pose></inertial></link>";
    let axes = |first: &str, second: &str| {
        format!(
            "<pose relative_to='b'/><axis><xyz>{first}</xyz></axis><axis2><xyz>{second}</xyz></axis2>"
        )
    };
    let on = joint("on", "fixed", ["world", "a"], "");
    let right = joint("cross", "universal", ["a", "b"], &axes("1 0 0", "0 1 0"));
    let other = joint("cross", "universal", ["b", "a"], &axes("0 -1 0", "-1 0 0"));
    let [right, other] =
        [right, other].map(|cross| mechanism(&made(&model(&format!("{bodies}{on}{cross}"))).yaml));
    assert_eq!(right.joint_names(), ["cross", "cross_axis2"]);
    assert_eq!(other.joint_names(), ["cross_axis2", "cross"]);
    let state: [&[f64]; 3] = [&[0.4, -0.9], &[1.1, 0.7], &[-0.3, 0.2]];
    let [x, y] = [&right, &other].map(|m| value(m, Method::InverseDynamics, state));
    near(&x, &y, 1e-14);
}

/// Before 1.6 gravity is in the physics, before 1.7 poses name their frame by `frame`, and a joint may have a link's name.
#[test]
fn older_files_keep_their_meaning() {
    let world = |version: &str, inside: &str| {
        let fixed = joint("on", "fixed", ["world", "a"], "");
        format!(
            "<sdf version='{version}'><world name='w'>{inside}<model name='m'>{}{fixed}</model></world></sdf>",
            link("a")
        )
    };
    let of_physics = "<physics type='ode'><gravity>0 0 -1.62</gravity></physics>";
    for (version, inside, gravity) in [
        ("1.5", of_physics, -1.62),
        ("1.6", of_physics, -9.8),
        ("1.6", "<gravity>0 0 -3.7</gravity>", -3.7),
    ] {
        let found = mechanism(&made(&world(version, inside)).yaml);
        assert_eq!(found.gravity().0[2].to_f64(), gravity, "{version}");
    }
    // Lights and grounds from other files do not move.
    let sun = "<include><uri>model://sun</uri></include>";
    let with_sun = made(&world("1.6", sun));
    let words = "models and lights from other files beside the model, not imported: `model://sun`";
    assert!(
        with_sun.warnings.iter().any(|line| line == words),
        "{:#?}",
        with_sun.warnings
    );
    let old = "<sdf version='1.6'><model name='m'>
        <link name='wheel'><pose>0 0 1 0 0 0</pose></link>
        <link name='b'><pose frame='wheel'>1 0 0 0 0 0</pose></link>
        <joint name='on' type='fixed'><parent>world</parent><child>wheel</child></joint>
        <joint name='wheel' type='Revolute'><parent>wheel</parent><child>b</child><axis><xyz>0 1 0</xyz><use_parent_model_frame>False</use_parent_model_frame></axis></joint>
        </model></sdf>";
    let yaml = made(old).yaml;
    assert!(yaml.contains("xyz: [1, 0, 0]"), "{yaml}");
    assert_eq!(mechanism(&yaml).joint_names(), ["wheel"]);
    let newer = changed(old, "version='1.6'", "version='1.7'");
    assert!(refused(&newer).contains("a second link, joint or frame called `wheel`"));
}

/// Followers, with a reference, and of the second axis of a universal joint.
#[test]
fn followers_are_written_with_their_relation() {
    let follows = "<axis><xyz>0 1 0</xyz><mimic joint='cross' axis='axis2'><multiplier>2</multiplier><offset>0.1</offset><reference>0.3</reference></mimic></axis>";
    let cross = format!("{AXIS}<axis2><xyz>1 0 0</xyz></axis2>");
    let text = model(
        &(link("a")
            + &link("b")
            + &joint("cross", "universal", ["world", "a"], &cross)
            + &joint("tail", "revolute", ["world", "b"], follows)),
    );
    let yaml = made(&text).yaml;
    let words = "mimic: { joint: cross_axis2, ratio: 2, offset: -0.5 }";
    assert!(yaml.contains(words), "{yaml}");
    assert_eq!(mechanism(&yaml).nv(), 2);
}

/// Each with its place, and several in one message.
#[test]
fn what_a_mechanism_does_not_have_is_refused_by_name() {
    let pair = link("a") + &link("b");
    let ring = link("a")
        + &link("b")
        + &link("c")
        + &joint("on", "fixed", ["world", "a"], "")
        + &joint("turn", "revolute", ["a", "b"], AXIS)
        + &joint("j", "revolute", ["b", "c"], AXIS);
    for (text, words) in [
        (
            model(&format!("{pair}<model name='inner'/><include><uri>model://cup</uri></include>")),
            &[
                "4:1: model `inner` is inside of `m`: nested models are not imported",
                "`model://cup` is included from another file",
            ][..],
        ),
        (
            model(&(pair.clone() + &joint("g", "gearbox", ["a", "b"], AXIS) + &joint("h", "hinge2", ["a", "b"], ""))),
            &["joint `g` is a gearbox", "constraint of type `gear`", "joint `h` is `hinge2`: the types are"],
        ),
        (
            model(&(ring + &joint("k", "screw", ["a", "c"], AXIS))),
            &["joint `k` closes a loop, and a loop cannot be closed by a screw"],
        ),
        (
            model(&(pair.clone() + &joint("j", "revolute", ["a", "inner::b"], AXIS))),
            &["the pose of `j` refers to `inner::b`", "nested models are not imported"],
        ),
        (
            model(&(pair.clone() + &joint("j", "revolute", ["a", "world"], AXIS))),
            &["`world`"],
        ),
        (
            model(&(pair.clone() + "<frame name='a'/>")),
            &["4:1: there is a second link, joint or frame called `a`"],
        ),
        (
            model("<link name='a'><pose relative_to='b'/></link><link name='b'><pose relative_to='a'/></link>"),
            &["relative to themselves"],
        ),
        (
            model("<link name='a'><pose>0 0 1</pose></link>"),
            &["2:16: `<pose>` must be 6 finite numbers, not `0 0 1`"],
        ),
        (
            model("<link name='a'><inertial auto='true'/></link>"),
            &["the inertia of link `a` is that of its collisions"],
        ),
        (
            "<sdf version='1.9'><world name='w'><model name='m'><link name='a'/></model><model name='n'><link name='b'/></model></world></sdf>".into(),
            &["2 models move: ", "leave the others out"],
        ),
        (
            changed(&model(&pair), "<model name='m'>", "<model name='m'><static>true</static>"),
            &["this file has no model that moves"],
        ),
    ] {
        let said = refused(&text);
        for word in words {
            assert!(said.contains(word), "{word}\n{said}");
        }
    }
}

/// Poses of the writer are those of the mechanism: a check of this test's own arithmetic.
#[test]
fn poses_of_the_writer_are_rigid() {
    let mut random = Random(1);
    for _ in 0..20 {
        let pose = Pose::random(&mut random);
        let back = pose.then(&pose.inverse());
        let numbers = back.rpy().into_iter().chain(back.xyz);
        assert!(
            numbers.into_iter().all(|x| x.abs() < 1e-14),
            "{}",
            number_list(&back.xyz)
        );
    }
}
