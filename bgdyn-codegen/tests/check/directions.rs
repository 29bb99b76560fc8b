//! Tests rotations and axes: which become exact, which are unchanged, which cause warnings.

use bgdyn_codegen::fault::{Fault, Severity};
use bgdyn_codegen::math::{Mat3, Vec3};
use bgdyn_runtime::Dd;

use super::{checked, dd, joint, rules, sound, whole};

fn warning(text: &str) -> Fault {
    let (mechanism, faults) = checked(text);
    assert!(mechanism.is_some(), "a warning refuses nothing: {faults:?}");
    assert_eq!(faults.0.len(), 1, "{faults:?}");
    assert_eq!(faults.0[0].severity, Severity::Warning);
    faults.0[0].clone()
}

fn rotation(text: &str) -> Mat3<Dd> {
    sound(&joint(&format!("origin: {{ rpy: [{text}] }}"))).links()[0]
        .joint
        .origin
        .rotation
}

fn axis(text: &str) -> Vec3<Dd> {
    sound(&joint(&format!("axis: {text}"))).links()[0]
        .joint
        .axis
}

#[test]
fn quarter_turns_are_exact() {
    let about_y = whole([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]);
    for quarter in [
        "90 deg",
        "-270 deg",
        "450 deg",
        "1.5707963267948966",
        "1.57079632679",
    ] {
        assert_eq!(rotation(&format!("0, {quarter}, 0")), about_y, "{quarter}");
    }
    let half = whole([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]);
    for turn in ["180 deg", "-3.14159265359", "9.42477796076938"] {
        assert_eq!(rotation(&format!("0, 0, {turn}")), half, "{turn}");
    }
    let mixed = whole([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(rotation("90 deg, 0, 90 deg"), mixed);
}

#[test]
fn turns_about_fixed_axes_x_then_y_then_z() {
    let r = rotation("0.1, -0.2, 0.3");
    let ((sr, cr), (sp, cp), (sy, cy)) = (
        dd("0.1").sin_cos(),
        dd("-0.2").sin_cos(),
        dd("0.3").sin_cos(),
    );
    let wanted = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ];
    for i in 0..3 {
        for j in 0..3 {
            assert!((r.0[i][j] - wanted[i][j]).to_f64().abs() < 1e-30, "{i}{j}");
        }
    }
}

#[test]
fn turns_that_undo_each_other_leave_exact_zeros() {
    // At pitch 90° roll and yaw rotate about one axis; 0.4 rad and −0.4 rad cancel.
    let r = rotation("0.4, 90 deg, 0.4");
    assert_eq!(
        r,
        whole([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    );
    let r = rotation("0.5, 90 deg, 0.2");
    assert_eq!(
        (r.0[2], r.0[0][0], r.0[1][0]),
        ([-Dd::ONE, Dd::ZERO, Dd::ZERO], Dd::ZERO, Dd::ZERO)
    );
    let (sin, cos) = dd("0.3").sin_cos();
    assert!((r.0[0][1] - sin).to_f64().abs() < 1e-30 && (r.0[1][1] - cos).to_f64().abs() < 1e-30);
}

#[test]
fn a_slanted_turn_keeps_its_zeros_and_length() {
    let r = rotation("0, 0, 30 deg");
    assert_eq!(
        (r.0[2], r.0[0][2], r.0[1][2]),
        ([Dd::ZERO, Dd::ZERO, Dd::ONE], Dd::ZERO, Dd::ZERO)
    );
    assert!((r.0[1][0] - dd("0.5")).to_f64().abs() < 1e-30);
    let product = r * r.transpose();
    assert!((product.0[0][0] - Dd::ONE).to_f64().abs() < 1e-30);
}

#[test]
fn rounded_quarter_turns_are_kept_and_warned_of() {
    let fault = warning(&joint("origin: { rpy: [1.5708, 0, -3.1416] }"));
    assert_eq!(
        (fault.rule, fault.path.as_str()),
        ("nearly-exact", "links[0].joint.origin.rpy")
    );
    assert_eq!(
        fault.headline("arm.yaml"),
        "arm.yaml:2:69: warning: links[0].joint.origin.rpy: roll is 3.67321e-6 rad, yaw is 7.34641e-6 rad off a multiple of 90 deg; kept as written [nearly-exact]"
    );
    let snapped = format!(
        "snap: 1e-4\n{}",
        joint("origin: { rpy: [1.5708, 0, -3.1416] }")
    );
    let r = sound(&snapped).links()[0].joint.origin.rotation;
    assert_eq!(
        r,
        whole([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
    );
    assert_eq!(
        rules(&joint("origin: { rpy: [1.57, 0, 0] }")),
        [""; 0],
        "1.57 is meant"
    );
}

#[test]
fn axes_have_length_one_and_exact_zeros() {
    let (zero, one) = (Dd::ZERO, Dd::ONE);
    assert_eq!(axis("x"), Vec3([one, zero, zero]));
    assert_eq!(axis("-z"), Vec3([zero, zero, -one]));
    assert_eq!(axis("[0, 1e-13, 7]"), Vec3([zero, zero, one]));
    assert_eq!(axis("[0, -0.3, 0]"), Vec3([zero, -one, zero]));
    assert_eq!(axis("[6, 0, 8]").0.map(|x| x.to_f64()), [0.6, 0.0, 0.8]);
    assert_eq!(axis("[1e-90, 0, 1e-90]").0[0], axis("[1, 0, 1]").0[0]);
    let fault = warning(&joint("axis: [0, 3.7e-6, -1]"));
    assert_eq!(
        fault.headline("arm.yaml"),
        "arm.yaml:2:60: warning: links[0].joint.axis: y is 3.7e-6 of the axis's length, nearly 0; kept as written [nearly-exact]"
    );
}

#[test]
fn snap_zero_takes_only_what_is_exact() {
    let text = format!(
        "snap: 0\n{}",
        joint("origin: { rpy: [0, 90 deg, 0] }, axis: [0, 0, 2]")
    );
    let joint = sound(&text).links()[0].joint.clone();
    assert_eq!(joint.origin.rotation.0[0], [Dd::ZERO, Dd::ZERO, Dd::ONE]);
    assert_eq!(joint.axis.0, [Dd::ZERO, Dd::ZERO, Dd::ONE]);
}

#[test]
fn what_snapping_changes_is_told_with_how_far() {
    let spec = |snap: &str, rpy: &str, axis: &str| {
        checked(&format!(
            "format: 1\nname: arm\n{snap}links:\n  - name: a\n    joint: {{ name: j, type: revolute, axis: {axis}, \
             origin: {{ rpy: {rpy} }} }}\n    mass: 1\n    com: [1, 2, 3]\n"
        ))
        .0
        .expect("a mechanism")
    };
    let told = |snap: &str, rpy: &str, axis: &str| {
        let mechanism = spec(snap, rpy, axis);
        let found = mechanism.snapped().cloned();
        found.map(|s| (s.count, format!("{:.1e}", s.most), s.location.path))
    };
    let (plain, slanted) = ("[0, 0, 0]", "[1, 0.5, 0]");
    // The rounding of an f64 is not reported.
    assert_eq!(
        told("", "[1.5707963267948966, 3.141592653589793, 0]", "z"),
        None
    );
    assert_eq!(told("", "[90 deg, 0.3, -180 deg]", slanted), None);
    assert_eq!(told("", plain, "[1, 1e-16, 0]"), None);
    // Larger deviations are.
    let at = |count, most: &str, path: &str| Some((count, most.to_owned(), path.to_owned()));
    let (rpy, axis) = ("links[0].joint.origin.rpy", "links[0].joint.axis");
    assert_eq!(
        told("", "[1.57079632679, 0, 0]", "z"),
        at(1, "4.9e-12", rpy)
    );
    assert_eq!(told("", plain, "[2, 4e-12, 0]"), at(1, "2.0e-12", axis));
    assert_eq!(
        told("", "[1.57079632679, 0, 0]", "[2, 4e-12, 0]"),
        at(2, "4.9e-12", rpy)
    );
    // Angles that almost cancel about a rotated axis.
    let undone = told("", "[0.4, 90 deg, 0.400000000005]", "z");
    assert_eq!(undone, at(1, "5.0e-12", rpy));
    // Unchanged, because the spec says so.
    assert_eq!(
        told("snap: 0\n", "[1.57079632679, 0, 0]", "[2, 4e-12, 0]"),
        None
    );
    assert_eq!(
        told("snap: 1e-4\n", "[1.5708, 0, 0]", "z"),
        at(1, "3.7e-6", rpy)
    );
}
