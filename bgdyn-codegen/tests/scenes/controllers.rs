//! Tests controllers of scenes: integral parts, and limits of inputs.

use bgdyn_codegen::method::SceneFunction;

use super::common::{scene, told, try_scene};
use super::laws;
use super::one::{BLOCK, MASS, Tried, close, text};

const PID: &str = "{ pid: { target: { ramp: { from: 1, rate: 0.5 } }, stiffness: 8, damping: 3, integral: 4, anti_windup: 0.5 s }";

fn with(more: &str) -> Tried {
    Tried::new(scene(&text(&["inertia"], more), BLOCK))
}

/// Inputs at place q, speed v and integral part z, at t = 2 s: the target is at 2 with 0.5 m/s.
fn inputs(tried: &Tried, [q, v, z]: [f64; 3]) -> Vec<f64> {
    let mut at = tried.at(&[q], &[v], &[z], &[0.0, 0.0]);
    at.t = Some(2.0);
    tried.system.function(SceneFunction::Inputs).evaluate(at).0
}

#[test]
fn an_integral_part_is_a_state() {
    let tried = with(&format!(
        "inputs: {{ slide: {PID} }} }}\ninitial: {{ slide_integral: 7 N }}\n"
    ));
    let layout = &tried.system.scene.layout;
    let names = |parts: &[bgdyn_codegen::scene::Variable]| -> Vec<String> {
        parts.iter().map(|part| part.name.clone()).collect()
    };
    assert_eq!(names(&layout.states), ["slide_integral"]);
    assert_eq!(names(&layout.inputs), ["slide", "slide_integral_rate"]);
    assert!(layout.events.is_empty());
    assert_eq!(tried.system.initial.x[0].to_f64(), 7.0);
    let u = inputs(&tried, [1.5, 0.25, 6.0]);
    close(u[0], 8.0 * 0.5 + 3.0 * 0.25 + 6.0);
    close(u[1], 4.0 * 0.5);
    // ẏ takes both.
    let rates = tried.rates(tried.at(&[1.5], &[0.25], &[6.0], &[5.0, -2.5]));
    close(rates[0], 5.0 / MASS);
    close(rates[1], -2.5);
    laws::hold(&tried.system);
}

/// Beyond a limit the integral part goes back: ż = k_i e + (u − unlimited u)/T_t.
#[test]
fn a_limit_stops_the_integral_part() {
    let tried = with(&format!(
        "inputs: {{ slide: {PID}, limit: [-4 N, 5 N] }} }}\n"
    ));
    for ([q, v, z], unlimited) in [
        ([1.5, 0.25, 6.0], 10.75),
        ([1.5, 0.25, -1.0], 3.75),
        ([3.0, 0.5, -1.0], -9.0),
    ] {
        let u = inputs(&tried, [q, v, z]);
        let limited: f64 = f64::clamp(unlimited, -4.0, 5.0);
        close(u[0], limited);
        close(u[1], 4.0 * (2.0 - q) + (limited - unlimited) / 0.5);
        // Each limit is an event.
        let mut at = tried.at(&[q], &[v], &[z], &[limited, 0.0]);
        at.t = Some(2.0);
        let (events, _) = tried.system.function(SceneFunction::Events).evaluate(at);
        close(events[0], unlimited + 4.0);
        close(events[1], 5.0 - unlimited);
    }
    laws::hold(&tried.system);
}

/// Without its own time the integral part follows a limit in k/k_i.
#[test]
fn the_time_of_anti_windup_is_that_of_the_integral() {
    let of = |more: &str| {
        let pid = format!("{{ pid: {{ target: 1, stiffness: 8, integral: 4{more} }}, limit: 1 }}");
        inputs(
            &with(&format!("inputs: {{ slide: {pid} }}\n")),
            [0.0, 0.0, 3.0],
        )
    };
    assert_eq!(of(""), of(", anti_windup: 2 s"));
}

/// Where both are given, the narrower limits hold; other joints have those of the mechanism.
#[test]
fn limits_of_the_mechanism_act_if_the_scene_says_so() {
    let limited = BLOCK.replace("upper: 200 mm", "upper: 200 mm, effort: 3 N");
    let effort = |more: &str, effort: f64| {
        let text = text(&["inertia"], more);
        let tried = Tried::new(scene(&text, &limited));
        let at = tried.at(&[0.0], &[0.0], &[], &[effort]);
        tried.system.function(SceneFunction::Inputs).evaluate(at).0[0]
    };
    let acts = "effort_limits: true\n";
    assert_eq!(effort("inputs: { slide: 7 N }\n", 0.0), 7.0);
    for (more, wanted) in [
        ("inputs: { slide: 7 N }\n", 3.0),
        (
            "inputs: { slide: { constant: -7 N, limit: [-1 N, 20 N] } }\n",
            -1.0,
        ),
        (
            "inputs: { slide: { constant: 7 N, limit: [-1 N, 20 N] } }\n",
            3.0,
        ),
    ] {
        assert_eq!(effort(&format!("{more}{acts}"), 0.0), wanted, "{more}");
    }
    // Values of the caller as well.
    assert_eq!(
        effort(&format!("inputs: {{ slide: given }}\n{acts}"), -9.0),
        -3.0
    );
    assert_eq!(effort("inputs: { slide: { limit: 2 } }\n", -9.0), -2.0);
    assert_eq!(
        effort("inputs: { slide: 7 }\neffort_limits: false\n", 0.0),
        7.0
    );
}

#[test]
fn wrong_controllers_and_limits_are_refused() {
    for (more, message, help) in [
        (
            "inputs: { slide: { pid: { target: 1, stiffness: 2 } } }",
            "`pid` has no `integral`",
            "use `pd`",
        ),
        (
            "inputs: { slide: { pid: { target: 1, integral: 2, anti_windup: 0 s } } }",
            "`anti_windup` is 0 s: it must be positive",
            "follows a limit",
        ),
        (
            "inputs: { slide: { pid: { target: 1, integral: 2 }, limit: 3 } }",
            "no positive ratio stiffness/integral",
            "add `anti_windup: 0.2 s`",
        ),
        (
            "inputs: { slide: { pd: { target: 1, integral: 2 } } }",
            "`integral`",
            "damping",
        ),
        (
            "inputs: { slide: { constant: 1, limit: [2, -2] } }",
            "the limits are 2 and -2",
            "write a positive number",
        ),
        (
            "inputs: { slide: { constant: 1, limit: [2] } }",
            "a list of 1; 2 are needed",
            "[-5, 20]",
        ),
        (
            "inputs: { slide: { constant: 1, ramp: {}, limit: 2 } }",
            "an input has exactly one source",
            "pid",
        ),
        (
            "inputs: { slide: 2 }\neffort_limits: true",
            "no joint of which the effort is an input has `limits",
            "add limits",
        ),
        (
            "effort_limits: 3",
            "`effort_limits` is true or false",
            "leave the key out",
        ),
    ] {
        let text = text(&["inertia"], &format!("{more}\n"));
        let refused = try_scene(&text, BLOCK).expect_err(more);
        let shown = told(&refused, &text);
        assert!(shown.contains(message), "{shown}");
        assert!(shown.contains(help), "{shown}");
    }
    let limited = BLOCK.replace("upper: 200 mm", "upper: 200 mm, effort: 3 N");
    let beyond = "inputs: { slide: { constant: 7 N, limit: [5 N, 9 N] } }\neffort_limits: true\n";
    let beyond = text(&["inertia"], beyond);
    let shown = told(&try_scene(&beyond, &limited).expect_err("limits"), &beyond);
    assert!(
        shown.contains("within the limits 5 … 9 and within the effort 3"),
        "{shown}"
    );
    let push = text(
        &["push: { type: wrench, at: hook, components: [fx] }"],
        "inputs: { push_fx: { constant: 1, limit: 2 } }\n",
    );
    let shown = told(&try_scene(&push, BLOCK).expect_err("a limit"), &push);
    assert!(
        shown.contains("`push_fx` is not what a drive gives"),
        "{shown}"
    );
}

const PD: &str = "inputs: { slide: { pd: { target: 1, stiffness: 2, damping: 1 }, limit: 1 } }\n";

/// Sampled inputs have no events at limits, and the Jacobian is at held inputs.
#[test]
fn sampled_inputs_are_held() {
    let sampled = with(&format!(
        "{PD}control: {{ period: 2 ms, delay: 1 ms, quantisation: {{ position: {{ slide: 1 mm }}, effort: 0.1 }}, noise: {{ velocity: 0.5 }}, seed: 9 }}\n"
    ));
    let control = sampled.system.scene.control.as_ref().expect("control");
    assert_eq!((control.period, control.delay), (2e-3, 1e-3));
    assert_eq!(control.resolution, [1e-3, 0.0]);
    assert_eq!(control.noise, [0.0, 0.5]);
    assert_eq!(control.controlled, [0]);
    assert_eq!(control.input_resolution, [0.1]);
    assert_eq!(control.seed, 9);
    assert!(sampled.system.scene.layout.events.is_empty());
    let slope = |tried: &Tried| {
        let jacobian = tried.system.function(SceneFunction::Jacobian);
        jacobian.evaluate(tried.at(&[0.9], &[0.0], &[], &[0.2])).0[0]
    };
    assert_eq!(slope(&sampled), 0.0);
    let continuous = with(PD);
    assert_eq!(continuous.system.scene.layout.events.len(), 2);
    close(slope(&continuous), -2.0 / MASS);
}

#[test]
fn wrong_sampling_is_refused() {
    for (more, message, help) in [
        (
            "inputs: { slide: 1 }\ncontrol: { period: 1 ms }",
            "no input of the scene has a controller",
            "`pd`",
        ),
        (
            "control: { delay: 1 ms }",
            "`control` has no `period`",
            "period: 1 ms",
        ),
        ("control: { period: 0 s }", "`period` is 0 s", "positive"),
        (
            "control: { period: 1 ms, delay: -1 ms }",
            "`delay` is -1 ms",
            "must not be negative",
        ),
        (
            "control: { period: 1 ms, delay: 20 ms }",
            "longer than 16 periods, 0.016 s",
            "shorten the delay",
        ),
        (
            "control: { period: 1 ms, hold: first_order }",
            "held by `zero_order`",
            "leave it out",
        ),
        (
            "control: { period: 1 ms, seed: 1.5 }",
            "the seed 1.5 is no integer",
            "seed: 1",
        ),
        (
            "control: { period: 1 ms, noise: { position: { elbow: 1 } } }",
            "`elbow`",
            "joints of the state",
        ),
        (
            "control: { period: 1 ms, noise: { position: 1 deg } }",
            "1 deg",
            "",
        ),
        (
            "control: { period: 1 ms, noise: { effort: 1 } }",
            "`effort`",
            "position",
        ),
        (
            "control: { period: 1 ms, jitter: 1 }",
            "`jitter`",
            "quantisation",
        ),
        (
            "control: { period: 1 ms }\nintegration: { method: canonical_midpoint }",
            "`canonical_midpoint` integrates momenta",
            "`method: midpoint`",
        ),
    ] {
        let own = if more.contains("inputs") { "" } else { PD };
        let text = text(&["inertia"], &format!("{own}{more}\n"));
        let refused = try_scene(&text, BLOCK).expect_err(more);
        let shown = told(&refused, &text);
        assert!(shown.contains(message), "{shown}");
        assert!(shown.contains(help), "{shown}");
    }
}
