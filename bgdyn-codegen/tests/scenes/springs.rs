//! Tests springs, dampers, stops: their laws and their refusals.

use bgdyn_codegen::method::SceneFunction;
use bgdyn_runtime::{Dd, Scalar};

use super::common::{scene, told, try_scene};
use super::laws;
use super::one::{BLOCK, MASS, Tried, block, close, refused, text};

/// s = √(q² + 0.4²) from anchor to hook.
fn distance(q: f64) -> f64 {
    q.hypot(0.4)
}

#[test]
fn a_damper_acts_at_a_joint_and_along_a_line() {
    let at_joint = block("it: { type: damper, joint: slide, damping: 3 N*s/m, reference: belt }");
    let line =
        block("it: { type: damper, between: [anchor, hook], damping: 3 N*s/m, reference: belt }");
    for (q, v, r) in [(0.3, 1.5, 0.0), (-0.1, 0.2, 0.7), (0.0, 2.0, -1.0)] {
        close(at_joint.effort(q, v, &[r]), -3.0 * (v - r));
        let direction = q / distance(q);
        close(
            line.effort(q, v, &[r]),
            -3.0 * (v * direction - r) * direction,
        );
    }
    laws::hold(&at_joint.system);
    laws::hold(&line.system);
}

#[test]
fn a_spring_acts_along_a_line() {
    let line = block(
        "it: { type: spring, between: [anchor, hook], stiffness: 50 N/m, rest: 0.3 m, preload: 2 N }",
    );
    for q in [0.3, -0.1, 1e-3] {
        let pull = 50.0 * (distance(q) - 0.3) + 2.0;
        close(line.effort(q, 0.4, &[]), -pull * q / distance(q));
    }
    laws::hold(&line.system);
}

#[test]
fn a_stop_pushes_back_as_hunt_and_crossley_say() {
    let tried = block(
        "it: { type: stop, joint: slide, stiffness: 1e4 N/m, restitution: 0.5, impact_speed: 2 m/s, lower: -0.1 m, upper: 0.2 m }",
    );
    // y of (1 + e) y = ln((1 + y)/(1 − e y)) at e = 1/2, by halving.
    let (mut low, mut high) = (0.1_f64, 1.999);
    for _ in 0..60 {
        let y = 0.5 * (low + high);
        let below = 1.5 * y > ((1.0 + y) / (1.0 - 0.5 * y)).ln();
        if below { low = y } else { high = y }
    }
    let mu = low / 2.0;
    for (depth, rate) in [(1e-3, 1.0), (2e-2, -0.4), (5e-3, -3.0 / mu), (-1e-3, 1.0)] {
        let force = 1e4 * f64::max(depth, 0.0) * f64::max(1.0 + mu * rate, 0.0);
        let upper = tried.effort(0.2 + depth, rate, &[]);
        let lower = tried.effort(-0.1 - depth, -rate, &[]);
        for (got, wanted) in [(upper, -force), (lower, force)] {
            assert!(
                (got - wanted).abs() <= 1e-9 * force.max(1.0),
                "{got}, not {wanted}"
            );
        }
    }
    laws::hold(&tried.system);
}

/// A stop's default position is the joint's limit.
#[test]
fn stops_stand_at_the_limits() {
    let whole =
        "it: { type: stop, joint: slide, stiffness: 1e4, restitution: 0.5, impact_speed: 2 }";
    let limits = block(whole);
    let written = block(&whole.replace(" }", ", lower: -0.3 m, upper: 0.2 m }"));
    let narrower = block(&whole.replace(" }", ", lower: -0.1 m }"));
    for q in [-0.31, -0.15, 0.0, 0.23] {
        assert_eq!(
            limits.effort(q, 0.1, &[]),
            written.effort(q, 0.1, &[]),
            "{q}"
        );
    }
    assert!(narrower.effort(-0.15, 0.0, &[]) > 0.0);
    assert!(
        narrower.effort(0.23, 0.0, &[]) < 0.0,
        "the other limit stays"
    );
}

/// From nearly plastic to nearly elastic; for the latter the equation itself loses the digits.
#[test]
fn the_damping_solves_the_equation_of_the_restitution() {
    for e in ["0.01", "0.1", "0.5", "0.9", "0.999", "0.999999"] {
        let tried = block(&format!(
            "it: {{ type: stop, joint: slide, stiffness: 1, restitution: {e}, impact_speed: 1, lower: -1, upper: 0 }}"
        ));
        let one = Dd::ONE;
        let at = |v: Dd| tried.rates(tried.at(&[one], &[v], &[], &[]))[0];
        // −k δ (1 + μ v) at δ = 1: the difference of two speeds gives μ.
        let y = (at(one) - at(Dd::ZERO)) / at(Dd::ZERO);
        let e: Dd = e.parse().expect("a number");
        // (1 + y) exp(−(1 + e) y) = 1 − e y
        let left = (one + y) * (-((one + e) * y)).exp();
        let right = one - e * y;
        let scale = y * y * (one - e) + Dd::from_f64(1e-300);
        let off = ((left - right) / scale).to_f64().abs();
        assert!(off < 1e-13, "e = {e:?}: y = {y:?}, off by {off:e}");
        assert!(y > Dd::ZERO);
    }
}

/// Speed of a block after an impact on a stop, by the classical Runge-Kutta method.
fn rebound(mass: f64, stiffness: f64, restitution: f64, speed: f64, upper: bool) -> f64 {
    let mechanism = BLOCK.replace("mass: 2 kg", &format!("mass: {mass} kg"));
    let effect = format!(
        "it: {{ type: stop, joint: slide, stiffness: {stiffness}, restitution: {restitution}, impact_speed: 1.5 m/s }}"
    );
    let tried = Tried::new(scene(&text(&[&effect], ""), &mechanism));
    let outwards = if upper { 1.0 } else { -1.0 };
    let wall = if upper { 0.2 } else { -0.3 };
    let rates = |y: [f64; 2]| [y[1], tried.rates(tried.at(&[y[0]], &[y[1]], &[], &[]))[0]];
    let step = |y: [f64; 2], h: f64| {
        let along = |k: [f64; 2], h: f64| [y[0] + h * k[0], y[1] + h * k[1]];
        let k1 = rates(y);
        let k2 = rates(along(k1, h / 2.0));
        let k3 = rates(along(k2, h / 2.0));
        let k4 = rates(along(k3, h));
        [0, 1].map(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
    };
    // The contact lasts about half a period of mass and spring.
    let h = (mass / stiffness).sqrt() * 2e-3;
    let mut y = [wall, outwards * speed];
    for _ in 0..20_000 {
        let next = step(y, h);
        if (next[0] - wall) * outwards < 0.0 {
            // The last step of the contact: shortened to the instant at which the depth is 0.
            let (mut short, mut long) = (0.0, h);
            for _ in 0..60 {
                let middle = 0.5 * (short + long);
                let inside = (step(y, middle)[0] - wall) * outwards > 0.0;
                if inside {
                    short = middle
                } else {
                    long = middle
                }
            }
            return step(y, short)[1] * -outwards;
        }
        y = next;
    }
    panic!("the block stays in the wall");
}

#[test]
fn a_block_leaves_the_stop_with_the_stated_restitution() {
    for (mass, stiffness, e) in [
        (2.0, 1e6, 0.6),
        (50.0, 3e4, 0.6),
        (0.1, 1e4, 0.2),
        (2.0, 1e6, 1.0),
    ] {
        for upper in [false, true] {
            let left = rebound(mass, stiffness, e, 1.5, upper);
            assert!(
                (left / 1.5 - e).abs() < 1e-8,
                "{mass} kg, {stiffness} N/m: {left}"
            );
        }
    }
    // At another speed the restitution differs: less for a harder impact.
    let ratio = |speed| rebound(2.0, 1e6, 0.6, speed, true) / speed;
    assert!(
        ratio(3.0) < 0.55 && ratio(0.1) > 0.9,
        "{} {}",
        ratio(3.0),
        ratio(0.1)
    );
}

/// One event falls through zero where contact begins, the other where it ends, at both stops.
#[test]
fn contact_begins_and_ends_at_events() {
    let tried = block(
        "it: { type: stop, joint: slide, stiffness: 1e4, restitution: 0.5, impact_speed: 2, lower: -0.1, upper: 0.2 }",
    );
    let names: Vec<_> = tried
        .system
        .scene
        .layout
        .events
        .iter()
        .map(|e| e.name.as_str())
        .collect();
    assert_eq!(names, ["it_begins", "it_ends", "it_pulled"]);
    let events = tried.system.function(SceneFunction::Events);
    for (q, gap) in [(0.0, 0.1), (0.19, 0.01), (0.21, -0.01), (-0.13, -0.03)] {
        let (values, _) = events.evaluate(tried.at(&[q], &[0.3], &[], &[]));
        assert!(
            (values[0] - gap).abs() < 1e-15 && values[1] == -values[0],
            "{values:?}"
        );
        // At this speed the stops push at every depth.
        assert_eq!(values[2] > 0.0, gap < 0.0);
    }
    // Leaving the upper stop, the law without its limit would pull at speeds above 1/μ.
    let pulled = |speed: f64| {
        let at = tried.at(&[0.21], &[speed], &[], &[]);
        events.evaluate(at).0[2]
    };
    assert!(pulled(-1.0) > 0.0 && pulled(-40.0) < 0.0);
    assert_eq!(pulled(0.0), 1e4 * (0.21 - 0.2));
}

#[test]
fn what_springs_dampers_and_stops_refuse() {
    let stop = |change: (&str, &str)| {
        "it: { type: stop, joint: slide, stiffness: 1e4, restitution: 0.5, impact_speed: 2 }"
            .replace(change.0, change.1)
    };
    let cases = [
        (
            stop(("0.5", "0")),
            "0, imp",
            "effect-sign",
            "`restitution` is 0: it must be greater than 0",
        ),
        (
            stop(("0.5", "1.2")),
            "1.2",
            "effect-sign",
            "`restitution` is 1.2: it must be at most 1",
        ),
        (
            stop(("speed: 2", "speed: 0")),
            "0 }",
            "effect-sign",
            "`impact_speed` is 0",
        ),
        (
            stop(("1e4", "-5")),
            "-5",
            "effect-sign",
            "`stiffness` is -5",
        ),
        (
            stop(("2 }", "2, lower: 0.3 }")),
            "it",
            "effect-order",
            "`upper` is 0.2 m, which is less than `lower`, 0.3",
        ),
        (
            stop(("0.5", "{ parameter: bounce, value: 0.5 }")),
            "{ parameter",
            "misplaced-parameter",
            "`restitution` of a `stop` cannot be a run-time parameter",
        ),
        (
            "it: { type: damper, damping: 3 }".into(),
            "it",
            "effect-place",
            "`it` does not say where it acts",
        ),
        (
            "it: { type: damper, joint: slide, between: [anchor, hook], damping: 3 }".into(),
            "it",
            "effect-place",
            "acts at one place only",
        ),
        (
            "it: { type: damper, joint: slide, damping: -3 }".into(),
            "-3",
            "effect-sign",
            "`damping` is -3",
        ),
        (
            "it: { type: damper, between: [anchor, hok], damping: 3 }".into(),
            "hok",
            "unknown-name",
            "hook",
        ),
    ];
    let cases: Vec<_> = cases
        .iter()
        .map(|(a, b, c, d)| (a.as_str(), *b, *c, *d))
        .collect();
    refused(&cases);
}

#[test]
fn a_stop_without_a_place_is_refused() {
    let free = BLOCK.replace(", limits: { lower: -300 mm, upper: 200 mm }", "");
    let text = text(
        &["it: { type: stop, joint: slide, stiffness: 1e4, restitution: 0.5, impact_speed: 2 }"],
        "",
    );
    let refusal = try_scene(&text, &free).expect_err("no limits");
    let shown = told(&refusal, &text);
    assert!(
        shown.contains("`slide` has no limits [effect-missing]"),
        "{shown}"
    );
}

/// The effort at the joint as the scene reports it.
#[test]
fn stops_report_their_effort() {
    let effect =
        "it: { type: stop, joint: slide, stiffness: 1e4, restitution: 0.5, impact_speed: 2 }";
    let tried = Tried::new(scene(&text(&[effect], "outputs: [it_effort]\n"), BLOCK));
    let outputs = tried.system.function(SceneFunction::Outputs);
    let (values, _) = outputs.evaluate(tried.at(&[0.21], &[0.3], &[], &[]));
    close(
        values[0],
        MASS * tried.rates(tried.at(&[0.21], &[0.3], &[], &[]))[0],
    );
}
