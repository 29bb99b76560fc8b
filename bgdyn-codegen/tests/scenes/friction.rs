//! Tests friction: its laws, their refusals, and that they never supply power.

use bgdyn_codegen::method::SceneFunction;

use super::common::{scene, try_scene};
use super::laws;
use super::one::{BLOCK, block, close, refused, text};

/// Slips from far below to far above every width and Stribeck speed in use here.
const SLIPS: [f64; 9] = [-3.0, -0.21, -1e-2, -1e-7, 0.0, 3e-9, 2e-3, 0.4, 40.0];

#[test]
fn smooth_coulomb_friction_is_a_hyperbolic_tangent() {
    let tried = block(
        "it: { type: coulomb_smooth, joint: slide, kinetic: 3 N, width: 10 mm/s, reference: belt }",
    );
    for slip in SLIPS {
        let wanted = -3.0 * (slip / 0.01).tanh();
        close(
            tried.effort(0.1, slip + 0.5, &[0.5]),
            -3.0 * ((slip + 0.5 - 0.5) / 0.01).tanh(),
        );
        close(tried.effort(-0.2, slip, &[0.0]), wanted);
    }
    laws::hold(&tried.system);
}

#[test]
fn stribeck_friction_is_its_curve() {
    let tried = block(
        "it: { type: stribeck, joint: slide, kinetic: 3 N, static: 5 N, stribeck_speed: 0.2 m/s, width: 10 mm/s, damping: 0.7 N*s/m }",
    );
    for s in SLIPS {
        let curve = 3.0 + (5.0 - 3.0) * (-(s / 0.2).powi(2)).exp();
        close(
            tried.effort(0.1, s, &[]),
            -curve * (s / 0.01).tanh() - 0.7 * s,
        );
    }
    laws::hold(&tried.system);
}

/// Without viscous friction and without an excess at rest it is the smooth Coulomb law.
#[test]
fn a_flat_stribeck_curve_is_coulombs() {
    let flat = block(
        "it: { type: stribeck, joint: slide, kinetic: 3 N, static: 3 N, stribeck_speed: 0.2 m/s, width: 10 mm/s }",
    );
    let smooth = block("it: { type: coulomb_smooth, joint: slide, kinetic: 3 N, width: 10 mm/s }");
    let count = |tried: &super::one::Tried| {
        tried
            .system
            .function(SceneFunction::Derivative)
            .operations()
    };
    for s in SLIPS {
        close(flat.effort(0.0, s, &[]), smooth.effort(0.0, s, &[]));
    }
    assert_eq!(count(&flat), count(&smooth), "the curve costs nothing");
}

/// Against a counterpart at rest no law of this family supplies power, in any state.
#[test]
fn memoryless_friction_never_drives() {
    let effects = [
        "it: { type: viscous, joint: slide, damping: 2 N*s/m }",
        "it: { type: coulomb_smooth, joint: slide, kinetic: 3 N, width: 10 mm/s }",
        "it: { type: stribeck, joint: slide, kinetic: 0 N, static: 5 N, stribeck_speed: 0.2 m/s, width: 10 mm/s }",
    ];
    for effect in effects {
        let tried = block(effect);
        for v in SLIPS {
            assert!(tried.effort(0.1, v, &[]) * v <= 0.0, "{effect} at {v}");
        }
    }
}

#[test]
fn what_friction_refuses() {
    refused(&[
        (
            "it: { type: coulomb_smooth, joint: slide, kinetic: -3 N, width: 10 mm/s }",
            "-3 N",
            "effect-sign",
            "`kinetic` is -3 N: it must not be negative",
        ),
        (
            "it: { type: coulomb_smooth, joint: slide, kinetic: 3 N, width: 0 }",
            "0 }",
            "effect-sign",
            "`width` is 0: it must be greater than 0",
        ),
        (
            "it: { type: coulomb_smooth, joint: slide, kinetic: 3 N }",
            "it",
            "missing-key",
            "`it` has no `width`",
        ),
        (
            "it: { type: coulomb_smooth, joint: slide, kinetic: 3 N*m, width: 1 mm/s }",
            "3 N*m",
            "unit-misfit",
            "force",
        ),
        (
            "it: { type: stribeck, joint: slide, kinetic: 5 N, static: 3 N, stribeck_speed: 0.2, width: 0.01 }",
            "3 N",
            "effect-order",
            "`static` is 3 N, which is less than `kinetic`, 5 N",
        ),
        (
            "it: { type: stribeck, joint: slide, kinetic: 3 N, static: 5 N, stribeck_speed: -1, width: 0.01 }",
            "-1",
            "effect-sign",
            "`stribeck_speed` is -1: it must be greater than 0",
        ),
        (
            "it: { type: stribeck, joint: slide, kinetic: 3 N, static: 5 N, stribeck_speed: 0.2, width: 0 }",
            "0 }",
            "effect-sign",
            "`width` is 0",
        ),
        (
            "it: { type: stribeck, joint: slide, kinetic: 3 N, static: 5 N, stribeck_speed: 0.2, width: 0.01, damping: -2 }",
            "-2",
            "effect-sign",
            "`damping` is -2",
        ),
        (
            "it: { type: stribeck, joint: slide, kinetic: 3 N, static: 5 N, stribeck_speed: 0.2, width: 0.3 }",
            "0.3",
            "effect-width",
            "`width` is 0.3, more than `stribeck_speed`, 0.2",
        ),
        (
            "it: { type: lugre, joint: slide, stiffness: 1e5, kinetic: 1 N, static: 1.5 N }",
            "1.5 N",
            "effect-missing",
            "`static` needs `stribeck_speed`",
        ),
    ]);
}

#[test]
fn a_joint_has_one_friction_that_holds() {
    let effects = [
        "one: { type: coulomb, joint: slide, kinetic: 1 N }",
        "two: { type: coulomb, joint: slide, kinetic: 2 N }",
    ];
    let text = text(&effects, "");
    let refusal = try_scene(&text, BLOCK).expect_err("two of them");
    let shown = super::common::told(&refusal, &text);
    assert!(shown.starts_with("scene.yaml:5:5: "), "{shown}");
    let message =
        "`one` and `two` are both of type `coulomb` at the joint `slide` [repeated-effect]";
    assert!(shown.contains(message), "{shown}");
}

/// σ₁ (F_s − F_c)/F_c of the bristles below, N·s/m.
const PASSIVE_FROM: f64 = 150.0;

fn bristles(viscous: f64) -> String {
    format!(
        "it: {{ type: lugre, joint: slide, stiffness: 1e5, damping: 300, viscous: {viscous}, kinetic: 1 N, static: 1.5 N, stribeck_speed: 1 mm/s }}"
    )
}

/// The warning appears on the correct side of the limit.
#[test]
fn lugre_friction_warns_where_it_is_not_passive() {
    for (viscous, warned) in [
        (PASSIVE_FROM * 0.999, true),
        (PASSIVE_FROM, false),
        (200.0, false),
    ] {
        let text = text(&[&bristles(viscous)], "");
        let (_, faults) = try_scene(&text, BLOCK).unwrap_or_else(|_| panic!("only a warning"));
        let shown = faults.render("scene.yaml", &text);
        assert_eq!(shown.contains("[effect-passivity]"), warned, "{shown}");
        assert_eq!(shown.contains("150.000000"), warned, "{shown}");
    }
}

/// Returns the energy dissipated by friction, J, while the block creeps until the bristles carry F_s and
/// is then pulled at `fast`, m/s, until they carry F_c, repeatedly: z returns to its start, so no energy
/// remains in the bristles.
fn cycle(viscous: f64, fast: f64) -> f64 {
    let tried = block(&bristles(viscous));
    let rates = |v: f64, z: f64| tried.rates(tried.at(&[0.0], &[v], &[z], &[]));
    // Power and ż at a speed; one Runge-Kutta step of both.
    let step = |v: f64, z: f64, h: f64| {
        let f = |z: f64| {
            let rates = rates(v, z);
            (-2.0 * rates[0] * v, rates[1])
        };
        let (p1, k1) = f(z);
        let (p2, k2) = f(z + h / 2.0 * k1);
        let (p3, k3) = f(z + h / 2.0 * k2);
        let (p4, k4) = f(z + h * k3);
        let mean = |a: f64, b: f64, c: f64, d: f64| h / 6.0 * (a + 2.0 * (b + c) + d);
        (mean(p1, p2, p3, p4), z + mean(k1, k2, k3, k4))
    };
    // Distances of bristle stretch, F/σ₀, 1e-5 m: creep 20 of them, pull 20 of them.
    let creep = 1e-5;
    let phase = |v: f64, z: f64| {
        let (steps, mut z, mut taken) = (4000, z, 0.0);
        let h = 20.0 * 1e-5 / v / f64::from(steps);
        for _ in 0..steps {
            let (energy, next) = step(v, z, h);
            (z, taken) = (next, taken + energy);
        }
        (taken, z)
    };
    let (_, start) = phase(fast, 0.0);
    let (slow, stretched) = phase(creep, start);
    let (quick, end) = phase(fast, stretched);
    assert!(
        (end - start).abs() < 1e-12,
        "the cycle closes: {start} {end}"
    );
    slow + quick
}

/// If the condition is satisfied the cycle dissipates energy; without viscous friction it supplies some,
/// and more for a faster pull: the warning is justified.
#[test]
fn lugre_friction_gives_energy_only_where_it_warns() {
    for fast in [0.01, 0.1, 1.0, 10.0] {
        assert!(cycle(PASSIVE_FROM, fast) > 0.0, "at {fast} m/s");
    }
    for fast in [1.0, 10.0] {
        let given = -cycle(0.0, fast);
        // A pull supplies σ₁ v ∮ (1 − σ₀ z/g) ds = σ₁ v (F_s − F_c)/σ₀, minus the loss by slipping.
        assert!(given > 300.0 * fast * 0.5e-5 * 0.5, "{given} at {fast} m/s");
    }
}

/// In every state with |z| ≤ F_s/σ₀ passive bristles dissipate power.
#[test]
fn passive_bristles_never_lose_less_than_nothing() {
    let dissipated = |viscous: f64, v: f64, z: f64| {
        let tried = super::one::block(&bristles(viscous));
        let power = tried.system.function(SceneFunction::Power);
        let (values, _) = power.evaluate(tried.at(&[0.0], &[v], &[z], &[]));
        values[2]
    };
    let passive = scene(&text(&[&bristles(PASSIVE_FROM)], ""), BLOCK);
    let tried = super::one::Tried::new(passive);
    let power = tried.system.function(SceneFunction::Power);
    let mut least = f64::INFINITY;
    for i in -30..=30 {
        for k in -40..=20 {
            for sign in [-1.0, 1.0] {
                let z = 1.5e-5 * f64::from(i) / 30.0;
                let v = sign * 10_f64.powf(f64::from(k) / 10.0);
                let (values, _) = power.evaluate(tried.at(&[0.0], &[v], &[z], &[]));
                least = least.min(values[2] / (v * v));
            }
        }
    }
    assert!(least > -1e-9, "{least}");
    assert!(dissipated(PASSIVE_FROM * 0.9, 10.0, 1.5e-5) < 0.0);
}
