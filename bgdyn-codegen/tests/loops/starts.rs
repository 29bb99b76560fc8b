//! Starts of scenes with loops: what is given is kept, the loops are closed, and the rest does not move.

use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

use super::references::spec;

/// Reads a scene of a mechanism of `specs/loops` with this start.
fn scene(mechanism: &str, initial: &str) -> Result<SceneEquations, Refusal> {
    let text = format!(
        "scene: 1\nmechanism: {mechanism}.yaml\neffects: [inertia]\ninitial: {{ {initial} }}\n"
    );
    let own = spec(mechanism);
    bgdyn_codegen::read_scene(&text, "scene", |_| Ok(own.clone())).map(|(system, _)| system)
}

fn started(mechanism: &str, initial: &str) -> SceneEquations {
    scene(mechanism, initial).unwrap_or_else(|refusal| panic!("{initial}: {refusal:?}"))
}

/// Returns a position or the velocity of a joint at the start.
fn at(system: &SceneEquations, name: &str) -> f64 {
    let (layout, start) = (&system.scene.layout, &system.initial);
    let positions = layout.positions.iter().zip(&start.q);
    let mut found = positions.filter(|(p, _)| p.name == name);
    if let Some((_, q)) = found.next() {
        return q.to_f64();
    }
    let closure = system.scene.mechanism.closure().expect("loops");
    let map = closure.velocity_map(&start.q).expect("a regular start");
    let tree = system.scene.mechanism.open().joint_names();
    let joint = name.strip_suffix("_rate").expect("a velocity");
    let j = tree.iter().position(|own| own == joint).expect("a joint");
    let terms = map[j].iter().zip(&start.v);
    terms.fold(Dd::ZERO, |sum, (s, u)| sum + *s * *u).to_f64()
}

fn open(system: &SceneEquations) -> f64 {
    let closure = system.scene.mechanism.closure().expect("loops");
    let (residuals, _) = closure.values(&closure.rows, &system.initial.q);
    residuals
        .iter()
        .map(|x| x.to_f64().abs())
        .fold(0.0, f64::max)
}

#[test]
fn given_positions_are_kept_and_loops_closed() {
    for (given, kept) in [
        (
            "proximal1_angle: 2, proximal2_angle: 1.1",
            &["proximal1_angle", "proximal2_angle"][..],
        ),
        (
            "proximal1_angle: 0, proximal2_angle: 3.1",
            &["proximal1_angle", "proximal2_angle"],
        ),
        (
            "proximal1_angle: 1.8, distal2_angle: 1.2",
            &["proximal1_angle", "distal2_angle"][..],
        ),
        (
            "distal1_angle: -1.3, distal2_angle: 1.2",
            &["distal1_angle", "distal2_angle"][..],
        ),
    ] {
        let system = started("five_bar", given);
        assert!(
            open(&system) < 1e-25,
            "{given}: open by {:e}",
            open(&system)
        );
        for name in kept {
            let value = given.split(&format!("{name}: ")).nth(1).expect("a value");
            let value: f64 = value
                .split(',')
                .next()
                .expect("a value")
                .parse()
                .expect("a number");
            assert!((at(&system, name) - value).abs() < 1e-15, "{given}: {name}");
        }
    }
}

/// A platform stays where the mechanism has it, except for what is given.
#[test]
fn positions_that_are_not_given_do_not_move() {
    let system = started("stewart_platform", "pz_position: 0.7, px_position: 0.05");
    assert!(open(&system) < 1e-25);
    let closure = system.scene.mechanism.closure().expect("loops");
    let (start, moved) = (&closure.start, &system.initial.q);
    let names = system
        .scene
        .layout
        .positions
        .iter()
        .map(|p| p.name.as_str());
    for (p, name) in names.enumerate() {
        let value = moved[p].to_f64();
        let wanted = match name {
            "px_position" => 0.05,
            "pz_position" => 0.7,
            "py_position" | "yaw_angle" | "pitch_angle" | "platform_angle" => start[p].to_f64(),
            _ => continue,
        };
        assert!(
            (value - wanted).abs() < 1e-15,
            "{name}: {value} instead of {wanted}"
        );
    }
}

/// Velocities of dependent joints determine those of independent ones that are not given.
/// A given pose of a ball must be a closed one; written with eight digits it is closed to the last one.
#[test]
fn poses_in_loops_are_those_of_the_closed_start() {
    let start = started("spatial_slider_crank", "crank_angle: 0.4");
    let part = |name: &str| at(&start, &format!("rod_ball_{name}"));
    let pose = ["qx", "qy", "qz", "qw"].map(|name| format!("{:.8}", part(name)));
    let pose = pose.join(", ");
    let given = format!("crank_angle: 0.4, rod_ball: {{ quaternion: [{pose}] }}");
    let found = started("spatial_slider_crank", &given);
    assert!(open(&found) < 1e-15);
    for name in ["qx", "qy", "qz", "qw"] {
        let name = format!("rod_ball_{name}");
        assert!(
            (at(&found, &name) - at(&start, &name)).abs() < 1e-7,
            "{name}"
        );
    }
}

#[test]
fn given_velocities_are_kept() {
    let positions = "proximal1_angle: 2, proximal2_angle: 1.1";
    for (given, wanted) in [
        (
            "proximal1_angle_rate: 0.7",
            &[("proximal1_angle_rate", 0.7), ("proximal2_angle_rate", 0.0)][..],
        ),
        (
            "proximal1_angle_rate: 0.7, distal2_angle_rate: -0.4",
            &[("proximal1_angle_rate", 0.7), ("distal2_angle_rate", -0.4)],
        ),
        (
            "distal1_angle_rate: 0.3, distal2_angle_rate: -0.4",
            &[("distal1_angle_rate", 0.3), ("distal2_angle_rate", -0.4)],
        ),
    ] {
        let system = started("five_bar", &format!("{positions}, {given}"));
        for &(name, value) in wanted {
            let found = at(&system, name);
            assert!((found - value).abs() < 1e-14, "{given}: {name} is {found}");
        }
    }
}

#[test]
fn starts_that_do_not_exist_are_refused() {
    for (mechanism, given, rule) in [
        ("slider_crank", "slider_position: 0.8", "open-start"),
        ("parallelograms", "rod0_angle: 3.3", "other-branch"),
        (
            "five_bar",
            "proximal1_angle: 2, proximal2_angle: 1.1, distal1_angle: 0.5",
            "contradicting-start",
        ),
        (
            "spatial_slider_crank",
            "rod_ball: { rpy: [0, 30 deg, 0] }",
            "contradicting-start",
        ),
        (
            "five_bar",
            "proximal1_angle_rate: 1, proximal2_angle_rate: 0, distal1_angle_rate: 9",
            "contradicting-start",
        ),
    ] {
        let Err(Refusal::Spec(faults)) = scene(mechanism, given) else {
            panic!("{given}: accepted");
        };
        let rules: Vec<&str> = faults.0.iter().map(|fault| fault.rule).collect();
        assert_eq!(rules, [rule], "{given}: {:?}", faults.0);
    }
}

/// Replaces values of a start, as the options of a run do.
fn overridden(
    system: &SceneEquations,
    values: &[(&str, f64)],
) -> Result<SceneEquations, bgdyn_codegen::fault::Faults> {
    let found = values.iter().map(|&(name, value)| {
        let one = system
            .scene
            .override_named("part of the state", name, |_| true);
        (one.unwrap_or_else(|e| panic!("{e}")), Dd::from_f64(value))
    });
    system.with_overrides(&found.collect::<Vec<_>>())
}

/// Velocities of joints of any kind replace those of the file, which hold in their order as far as they are free.
#[test]
fn velocities_of_any_joints_replace_those_of_the_file() {
    let positions = "proximal1_angle: 2, proximal2_angle: 1.1";
    let both = "proximal1_angle_rate: 0.7, proximal2_angle_rate: 0.2";
    let rods = "distal1_angle_rate: 0.3, distal2_angle_rate: -0.4";
    for (file, values, wanted) in [
        // Nothing in the file: what does not follow is 0.
        (
            "",
            &[("distal1_angle_rate", 0.5)][..],
            &[("distal1_angle_rate", 0.5)][..],
        ),
        // The first one of the file is kept.
        (
            both,
            &[("distal1_angle_rate", 0.5)],
            &[("distal1_angle_rate", 0.5), ("proximal1_angle_rate", 0.7)],
        ),
        (
            both,
            &[("distal1_angle_rate", 0.5), ("distal2_angle_rate", -0.1)],
            &[("distal1_angle_rate", 0.5), ("distal2_angle_rate", -0.1)],
        ),
        (
            both,
            &[("distal1_angle_rate", 0.5), ("proximal2_angle_rate", -0.1)],
            &[("distal1_angle_rate", 0.5), ("proximal2_angle_rate", -0.1)],
        ),
        // Those of the file are at dependent joints, and hold at other positions too.
        (
            rods,
            &[("proximal1_angle", 1.9)],
            &[("distal1_angle_rate", 0.3), ("distal2_angle_rate", -0.4)],
        ),
        (
            rods,
            &[("proximal2_angle_rate", 0.25)],
            &[("proximal2_angle_rate", 0.25), ("distal1_angle_rate", 0.3)],
        ),
    ] {
        let system = started("five_bar", &format!("{positions}, {file}"));
        let system = overridden(&system, values).unwrap_or_else(|e| panic!("{values:?}: {e:?}"));
        assert!(open(&system) < 1e-25);
        for &(name, value) in wanted {
            let found = at(&system, name);
            assert!(
                (found - value).abs() < 1e-14,
                "{file}, {values:?}: {name} is {found}"
            );
        }
    }
}

/// Rates at a dead centre, where the slider stands still; more of them than velocities; a position out of reach.
#[test]
fn velocities_that_do_not_exist_are_refused() {
    let system = started("slider_crank", "crank_angle: 0.3");
    // The offset of 20 mm over the crank and the rod in line, 0.7 m.
    let dead = (0.02_f64 / 0.7).asin();
    for (values, rule, words) in [
        (
            &[("crank_angle", dead), ("slider_position_rate", 0.3)][..],
            "singular-start",
            ["`slider_position_rate` is 0.3 m/s here", "stands still"],
        ),
        (
            &[("crank_angle_rate", 2.0), ("slider_position_rate", 0.3)],
            "contradicting-start",
            ["`slider_position_rate` is 0.3 m/s here", "make it -"],
        ),
        (
            &[("rod_angle_rate", 2.0), ("slider_position_rate", 0.3)],
            "contradicting-start",
            ["here, but the loops", "make it "],
        ),
        // The position of the crank in the file makes room for that of the slider.
        (
            &[("slider_position", 0.8), ("slider_position_rate", 0.3)],
            "open-start",
            ["`rod_pin` does not close", "misses by 0.1"],
        ),
    ] {
        let faults = overridden(&system, values).expect_err("refused");
        assert_eq!(faults.0.len(), 1, "{values:?}: {:?}", faults.0);
        assert_eq!(faults.0[0].rule, rule, "{:?}", faults.0);
        for word in words {
            assert!(faults.0[0].message.contains(word), "{:?}", faults.0);
        }
    }
    let moved = overridden(&system, &[("slider_position", 0.6)]).expect("a start");
    assert!(open(&moved) < 1e-25 && (at(&moved, "slider_position") - 0.6).abs() < 1e-15);
    // At the dead centre the rod turns, and 0 is what the slider does.
    let values = [
        ("crank_angle", dead),
        ("slider_position_rate", 0.0),
        ("rod_angle_rate", 1.0),
    ];
    let still = overridden(&system, &values).expect("a start");
    assert!((at(&still, "rod_angle_rate") - 1.0).abs() < 1e-14);
    assert!(at(&still, "slider_position_rate").abs() < 1e-14);
}
