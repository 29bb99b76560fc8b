//! MJCFs whose meaning depends on a default, and locks of followers. What MuJoCo 4.0 makes of each file was
//! read from its compiled model.

use bgdyn_cli::import::{Base, Import, Lock, Options, import, import_with};

const WEIGHT: &str = "<inertial pos='0 0 0.1' mass='1' diaginertia='0.1 0.1 0.1'/>";

fn mjcf(inside: &str) -> String {
    format!("<mujoco model='m'>\n{inside}\n</mujoco>")
}

/// Two hinges, with these defaults and equalities.
fn pair(defaults: &str, equality: &str) -> Import {
    let text = mjcf(&format!(
        "{defaults}<worldbody><body name='a'><joint name='j'/>{WEIGHT}
        <body name='b' pos='0 0 1'><joint name='k'/>{WEIGHT}</body></body></worldbody>
        <equality>{equality}</equality>"
    ));
    import(&text).expect("an import")
}

/// A body with this joint.
fn joint(more: &str) -> String {
    let text = mjcf(&format!(
        "<worldbody><body name='b'><joint name='j' {more}/>{WEIGHT}</body></worldbody>"
    ));
    import(&text).expect("an import").yaml
}

fn warned(made: &Import, words: &str) {
    let found = made.warnings.iter().any(|line| line.contains(words));
    assert!(found, "{words}: {:?}", made.warnings);
}

/// A body whose mesh gives inertia must not move with a part of it.
#[test]
fn a_root_with_a_mesh_does_not_float_without_its_inertia() {
    let text = mjcf(
        "<worldbody><body name='base'><geom type='mesh' mesh='m'/><geom type='sphere' size='0.1' mass='0.5'/>
        <body name='arm'><joint name='j'/><geom type='sphere' size='0.1'/></body></body></worldbody>",
    );
    assert!(
        import(&text).is_ok(),
        "fixed to the world it needs no inertia"
    );
    for base in [Base::Floating, Base::Planar] {
        let options = Options {
            base: Some(base),
            ..Options::default()
        };
        let refused = import_with(&text, &options)
            .expect_err("refused")
            .to_string();
        assert!(
            refused.contains("`base`") && refused.contains("<inertial>"),
            "{refused}"
        );
    }
}

#[test]
fn an_equality_is_active_as_its_class_says() {
    let relation = "<joint joint1='k' joint2='j'/>";
    assert!(pair("", relation).yaml.contains("mimic"));
    let inactive = "<default><equality active='false'/></default>";
    let made = pair(inactive, relation);
    assert!(!made.yaml.contains("mimic"), "{}", made.yaml);
    warned(&made, "not active");
    let class = "<default><default class='off'><equality active='false'/></default></default>";
    let made = pair(class, "<joint class='off' joint1='k' joint2='j'/>");
    assert!(!made.yaml.contains("mimic"), "{}", made.yaml);
    let made = pair(inactive, "<joint joint1='k' joint2='j' active='true'/>");
    assert!(made.yaml.contains("mimic"), "{}", made.yaml);
}

#[test]
fn coefficients_that_are_not_given_have_their_defaults() {
    let made = pair("", "<joint joint1='k' joint2='j' polycoef='0.3'/>");
    assert!(
        made.yaml.contains("mimic: { joint: j, offset: 0.3 }"),
        "{}",
        made.yaml
    );
}

#[test]
fn a_second_equality_of_a_follower_says_so() {
    let made = pair(
        "",
        "<joint joint1='k' joint2='j'/><joint joint1='j' joint2='k'/>",
    );
    warned(&made, "in a circle");
}

/// Without `limited` only a range that is not empty limits.
#[test]
fn an_empty_range_limits_nothing() {
    for range in ["0 0", "10 10", "10 -10"] {
        let yaml = joint(&format!("range='{range}'"));
        assert!(!yaml.contains("limits"), "{range}: {yaml}");
    }
    assert!(joint("range='-10 10'").contains("limits"));
}

#[test]
fn a_free_joint_that_is_aligned_is_warned_of() {
    for (compiler, align, warns) in [
        ("", "align='true'", true),
        ("", "", false),
        ("<compiler alignfree='true'/>", "", true),
        ("<compiler alignfree='true'/>", "align='false'", false),
        ("", "align='auto'", false),
    ] {
        let text = mjcf(&format!(
            "{compiler}<worldbody><body name='b'><freejoint name='f' {align}/>{WEIGHT}</body></worldbody>"
        ));
        let made = import(&text).expect("an import");
        let found = made.warnings.iter().any(|line| line.contains("aligns"));
        assert_eq!(found, warns, "{compiler} {align}: {:?}", made.warnings);
    }
}

/// A URDF with two turning joints, the second one a follower of `leader`.
fn urdf(leader: &str) -> String {
    let link = |name: &str| {
        format!(
            "<link name='{name}'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>"
        )
    };
    format!(
        "<robot name='r'>{}{}{}
        <joint name='j' type='continuous'><parent link='base'/><child link='one'/><axis xyz='0 0 1'/></joint>
        <joint name='k' type='continuous'><parent link='one'/><child link='two'/><axis xyz='0 0 1'/>
        <mimic joint='{leader}' multiplier='2'/></joint></robot>",
        link("base"),
        link("one"),
        link("two")
    )
}

fn locked(text: &str, locks: &[&str]) -> Result<Import, String> {
    let options = Options {
        lock: locks
            .iter()
            .map(|lock| Lock::parse(lock).expect("a lock"))
            .collect(),
        ..Options::default()
    };
    import_with(text, &options).map_err(|error| error.to_string())
}

#[test]
fn locks_of_a_leader_and_its_follower_do_not_depend_on_their_order() {
    let text = urdf("j");
    let first = locked(&text, &["j=0.5", "k=0.25"]).expect("an import");
    let second = locked(&text, &["k=0.25", "j=0.5"]).expect("an import");
    assert_eq!(first.yaml, second.yaml);
    assert!(first.yaml.contains("0.25"), "{}", first.yaml);
}

#[test]
fn a_joint_that_follows_itself_is_fixed_once() {
    let made = locked(&urdf("k"), &["k=0.5"]).expect("an import");
    assert!(made.yaml.contains("rpy: [0, 0, 0.5]"), "{}", made.yaml);
}
