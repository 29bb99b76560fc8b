//! Tests steps and point-to-point motions: values, rates and accelerations on both sides of their corners.

use bgdyn_codegen::method::SceneFunction;

use super::common::{scene, told, try_scene};
use super::one::{BLOCK, MASS, Tried, close, text};

/// The effort at time t of a source, with the block at rest at 0.
fn effort(tried: &Tried, t: f64) -> f64 {
    let inputs = tried.system.function(SceneFunction::Inputs);
    let mut at = tried.at(&[0.0], &[0.0], &[], &[0.0]);
    at.t = Some(t);
    inputs.evaluate(at).0[0]
}

fn tried(source: &str) -> Tried {
    Tried::new(scene(
        &text(&["inertia"], &format!("inputs: {{ slide: {source} }}\n")),
        BLOCK,
    ))
}

/// Position, velocity and acceleration of a target: controllers on each alone.
fn motion(course: &str, t: f64) -> [f64; 3] {
    let with = |word: &str, gains: &str| {
        let tried = tried(&format!("{{ {word}: {{ target: {course}, {gains} }} }}"));
        effort(&tried, t)
    };
    [
        with("pd", "stiffness: 1"),
        with("pd", "damping: 1"),
        with("computed_torque", "damping: 0") / MASS,
    ]
}

fn all_close(got: [f64; 3], wanted: [f64; 3], t: f64) {
    for (got, wanted) in got.into_iter().zip(wanted) {
        let off = (got - wanted).abs() / wanted.abs().max(1.0);
        assert!(off < 1e-13, "t = {t}: {got:e}, not {wanted:e}");
    }
}

#[test]
fn a_step_jumps_at_its_time() {
    let source = "{ step: { before: 1 N, after: -2 N, time: 0.5 s } }";
    let tried = tried(source);
    for (t, wanted) in [(0.0, 1.0), (0.4999, 1.0), (0.5, -2.0), (7.0, -2.0)] {
        assert_eq!(effort(&tried, t), wanted);
    }
    assert_eq!(tried.system.scene.corners(), [0.5]);
    all_close(
        motion("{ step: { after: 3, time: 1 } }", 2.0),
        [3.0, 0.0, 0.0],
        2.0,
    );
}

/// From −1 to 2 in 2 s with 6 m/s²: a T² = 24 ≥ 12, t_a = (2 − √2)/2.
#[test]
fn a_trapezoid_accelerates_cruises_and_brakes() {
    let ramp = 1.0 - 0.5_f64.sqrt();
    let top = 6.0 * ramp;
    let by_limits = format!(
        "{{ trapezoidal: {{ from: -1, to: 2, start: 1 s, velocity: {top}, acceleration: 6 }} }}"
    );
    let by_duration =
        "{ trapezoidal: { from: -1, to: 2, start: 1 s, duration: 2 s, acceleration: 6 } }";
    let by_velocity = format!(
        "{{ trapezoidal: {{ from: -1, to: 2, start: 1 s, duration: 2 s, velocity: {top} }} }}"
    );
    for course in [by_limits.as_str(), by_duration, &by_velocity] {
        let half = 0.5 * 6.0;
        for (t, wanted) in [
            (0.5, [-1.0, 0.0, 0.0]),
            (1.1, [-1.0 + half * 0.01, 0.6, 6.0]),
            (2.0, [0.5, top, 0.0]),
            (2.9, [2.0 - half * 0.01, 0.6, -6.0]),
            (3.5, [2.0, 0.0, 0.0]),
        ] {
            let got = motion(course, t);
            for (got, wanted) in got.into_iter().zip(wanted) {
                // The top speed is written with its 17 digits.
                assert!(
                    (got - wanted).abs() < 1e-13,
                    "{course} at {t}: {got} {wanted}"
                );
            }
        }
    }
    let corners = tried(&format!("{{ pd: {{ target: {by_duration} }} }}"))
        .system
        .scene
        .corners();
    for (got, wanted) in corners.iter().zip([1.0, 1.0 + ramp, 3.0 - ramp, 3.0]) {
        close(*got, wanted);
    }
    assert_eq!(corners.len(), 4);
}

/// Limits that a short distance does not reach give a triangle, here downwards.
#[test]
fn a_short_trapezoid_is_a_triangle() {
    let course = "{ trapezoidal: { from: 0.5, to: 0, velocity: 10, acceleration: 2 } }";
    for (t, wanted) in [
        (0.25, [0.4375, -0.5, -2.0]),
        (0.75, [0.0625, -0.5, 2.0]),
        (1.25, [0.0, 0.0, 0.0]),
    ] {
        all_close(motion(course, t), wanted, t);
    }
}

#[test]
fn a_quintic_starts_and_ends_at_rest() {
    let course = "{ quintic: { from: 1, to: 3, start: 0.5 s, duration: 4 s } }";
    let exact = |t: f64| {
        let s = (t - 0.5) / 4.0;
        [
            1.0 + 2.0 * s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s),
            0.5 * s * s * (30.0 - 60.0 * s + 30.0 * s * s),
            0.125 * s * (60.0 - 180.0 * s + 120.0 * s * s),
        ]
    };
    for t in [0.5, 0.6, 1.3, 2.5, 4.4999] {
        all_close(motion(course, t), exact(t), t);
    }
    all_close(motion(course, 0.3), [1.0, 0.0, 0.0], 0.3);
    all_close(motion(course, 4.5), [3.0, 0.0, 0.0], 4.5);
}

/// Of two limits the one that needs more time determines the duration, and it is reached.
#[test]
fn a_quintic_reaches_one_of_its_limits() {
    let fast = "{ quintic: { to: 2, velocity: 1, acceleration: 100 } }";
    let duration = 3.75;
    let middle = motion(fast, duration / 2.0);
    all_close(middle, [1.0, 1.0, 0.0], duration / 2.0);
    let strong = "{ quintic: { to: -2, velocity: 100, acceleration: 3 } }";
    let duration = (20.0 / (3.0 * 3.0_f64.sqrt())).sqrt();
    // s'' is largest at s = (3 − √3)/6.
    let t = duration * (3.0 - 3.0_f64.sqrt()) / 6.0;
    close(motion(strong, t)[2], -3.0);
}

#[test]
fn wrong_motions_are_refused() {
    let of = |source: &str| text(&["inertia"], &format!("inputs: {{ slide: {source} }}\n"));
    for (source, message, help) in [
        (
            "{ trapezoidal: { to: 1, duration: 1 s } }",
            "`trapezoidal` is given by two of",
            "leave the third out",
        ),
        (
            "{ trapezoidal: { to: 1, duration: 1 s, acceleration: 3 } }",
            "an acceleration of 3 does not go the distance 1 in 1 s",
            "it takes 4 or more",
        ),
        (
            "{ trapezoidal: { to: 1, duration: 3 s, velocity: 1 } }",
            "with the velocity 1 the distance 1 does not take 3 s",
            "above 1 s, and at most 2 s",
        ),
        ("{ quintic: { to: 1 } }", "`quintic` is given by", "limits"),
        (
            "{ quintic: { to: 1, duration: -1 s } }",
            "`duration` is -1 s: it must be positive",
            "sign of the motion",
        ),
        ("{ step: { till: 1 } }", "`till`", "before"),
    ] {
        let text = of(source);
        let refused = try_scene(&text, BLOCK).expect_err(source);
        let shown = told(&refused, &text);
        assert!(shown.contains(message), "{shown}");
        assert!(shown.contains(help), "{shown}");
    }
}
