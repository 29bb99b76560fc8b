//! SDFs: what the format gives by default and gave before, joints in any direction, messages.

use super::{changed, made, mechanism, near, refused, value};
use bgdyn_cli::import::{Base, Lock, Options, import_with};
use bgdyn_codegen::method::Method;

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
