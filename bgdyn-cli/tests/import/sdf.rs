//! SDFs against mechanisms written by hand, and random ones against mechanisms that are written beside them.

use super::sdf_writer::{Pose, SdfModel, number_list};
use super::{effects, made, many, mechanism, near, pose, value};
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;

const ARM: &str = include_str!("../sdf/arm.sdf");
const ARM_BY_HAND: &str = include_str!("../sdf/arm.yaml");
const FOUR_BAR: &str = include_str!("../sdf/four_bar.sdf");
const FOUR_BAR_BY_HAND: &str = include_str!("../../../specs/loops/four_bar.yaml");

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
