//! Tests which of the joints at rest hold: `resolve_stiction` on scenes.

use bgdyn_codegen::random::Random;
use bgdyn_runtime::nalgebra::SVector;
use bgdyn_runtime::{Contact, HybridSystem, resolve_stiction};

use super::common::{read, scene};
use super::evaluated::{Evaluated, step};

/// An arm of three joints in a vertical plane with dry friction in all of them.
fn arm(kinetic: [f64; 3], limit: [f64; 3]) -> Arm {
    let link = |name: &str, joint: &str, more: &str| {
        format!(
            "  - name: {name}\n    joint: {{ name: {joint}, type: revolute, axis: y{more} }}\n    mass: 1.5\n    com: [0.15, 0, 0]\n    inertia: {{ xx: 0.001, yy: 0.012, zz: 0.012 }}\n"
        )
    };
    let carried = ", origin: { xyz: [0.3, 0, 0] }";
    let mechanism = format!(
        "format: 1\nlinks:\n{}{}    parent: a\n{}    parent: b\n",
        link("a", "ja", ""),
        link("b", "jb", carried),
        link("c", "jc", carried),
    );
    let friction: Vec<String> = ["ja", "jb", "jc"]
        .iter()
        .enumerate()
        .map(|(k, j)| {
            let (kinetic, limit) = (kinetic[k], limit[k]);
            format!(
                "  - f{j}: {{ type: coulomb, joint: {j}, kinetic: {kinetic}, static: {limit} }}\n"
            )
        })
        .collect();
    let text = format!(
        "scene: 1\nmechanism: arm.yaml\neffects:\n  - gravity\n  - inertia: distributed\n  - velocity_products\n{}inputs: {{ ja: given, jb: given, jc: given }}\n",
        friction.concat()
    );
    Evaluated::new(&scene(&text, &mechanism))
}

type Arm = Evaluated<6, 3, 3, 3>;

/// Returns whether every joint holds within its limit or continues to slip from rest.
fn consistent(contacts: &[Contact<f64>; 3], modes: &SVector<f64, 3>) -> bool {
    contacts
        .iter()
        .zip(modes.iter())
        .all(|(c, mode)| match *mode {
            0.0 => c.margin >= 0.0,
            mode => c.slip_rate * mode >= 0.0,
        })
}

/// Every combination of modes that is consistent.
fn all_consistent(arm: &Arm, y: &SVector<f64, 6>, u: &SVector<f64, 3>) -> Vec<SVector<f64, 3>> {
    let choices =
        (0..27).map(|i| SVector::from([i % 3, i / 3 % 3, i / 9].map(|m| f64::from(m) - 1.0)));
    choices
        .filter(|modes| {
            consistent(
                &arm.contacts(y, modes, u, 0.0).expect("not singular"),
                modes,
            )
        })
        .collect()
}

/// A random arm at rest under random efforts.
fn at_rest(random: &mut Random) -> (SVector<f64, 6>, SVector<f64, 3>) {
    let mut y = SVector::zeros();
    for j in 0..3 {
        y[j] = 3.0 * random.signed();
    }
    (y, SVector::from([0; 3].map(|_| 12.0 * random.signed())))
}

/// If static and sliding friction are equal the solution is unique, and `resolve_stiction` finds it.
#[test]
fn an_arm_at_rest_settles_in_the_only_way() {
    let arm = arm([16.0, 8.0, 3.0], [16.0, 8.0, 3.0]);
    let mut random = Random(11);
    let mut seen = [0; 4];
    for _ in 0..400 {
        let (y, u) = at_rest(&mut random);
        let found =
            resolve_stiction(&arm, &y, &SVector::zeros(), &u, 0.0, 0.0).expect("not singular");
        assert_eq!(all_consistent(&arm, &y, &u), [found], "{y:?} {u:?}");
        seen[found.iter().filter(|m| **m != 0.0).count()] += 1;
    }
    assert!(seen.iter().all(|n| *n > 10), "joints that slip: {seen:?}");
}

/// If static friction is larger the result is consistent, and all joints hold if they can.
#[test]
fn an_arm_at_rest_settles_consistently() {
    let arm = arm([10.0, 5.0, 2.0], [16.0, 8.0, 3.0]);
    let mut random = Random(12);
    let mut several = 0;
    for _ in 0..400 {
        let (y, u) = at_rest(&mut random);
        let found =
            resolve_stiction(&arm, &y, &SVector::zeros(), &u, 0.0, 0.0).expect("not singular");
        let all = all_consistent(&arm, &y, &u);
        assert!(all.contains(&found), "{found:?} is none of {all:?}");
        if all.contains(&SVector::<f64, 3>::zeros()) {
            assert_eq!(found, SVector::<f64, 3>::zeros());
        }
        several += usize::from(all.len() > 1);
    }
    assert!(several > 10, "{several}");
}

/// Joints that slip keep their modes while others are decided.
#[test]
fn moving_joints_keep_their_modes() {
    let arm = arm([5.0, 3.0, 1.0], [5.0, 3.0, 1.0]);
    let mut random = Random(13);
    for _ in 0..50 {
        let (mut y, u) = at_rest(&mut random);
        y[4] = -0.3;
        let modes = SVector::from([0.0, -1.0, 1.0]);
        let found = resolve_stiction(&arm, &y, &modes, &u, 0.0, 1e-9).expect("not singular");
        assert_eq!(found[1], -1.0);
        let contacts = (&arm as &Arm)
            .contacts(&y, &found, &u, 0.0)
            .expect("not singular");
        for k in [0, 2] {
            let c = &contacts[k];
            assert!(if found[k] == 0.0 {
                c.margin >= 0.0
            } else {
                c.slip_rate * found[k] >= 0.0
            });
        }
    }
}

/// A held joint does not creep, not even by the last digit.
#[test]
fn a_held_arm_does_not_creep() {
    let arm = arm([60.0, 60.0, 60.0], [60.0, 60.0, 60.0]);
    let y = SVector::from([0.3, -0.7, 1.1, 0.0, 0.0, 0.0]);
    let u = SVector::from([2.0, -1.0, 0.5]);
    let modes = resolve_stiction(&arm, &y, &SVector::zeros(), &u, 0.0, 0.0).expect("not singular");
    assert_eq!(modes, SVector::<f64, 3>::zeros());
    let mut now = y;
    for _ in 0..200 {
        now = step(&arm, &now, &modes, &u, 1e-3);
    }
    assert_eq!(now, y);
}

/// A joint breaks away at its static limit, in the direction of the load, against sliding friction.
#[test]
fn a_joint_breaks_away_at_the_static_limit() {
    let arm = arm([40.0, 2.0, 40.0], [60.0, 3.0, 60.0]);
    let y = SVector::from([0.3, -0.7, 1.1, 0.0, 0.0, 0.0]);
    let held = |u: f64| {
        let u = SVector::from([0.0, u, 0.0]);
        let contacts = (&arm as &Arm)
            .contacts(&y, &SVector::zeros(), &u, 0.0)
            .expect("not singular");
        (u, contacts[1].holding)
    };
    // Without a load the joint carries only the weight: friction takes the rest.
    let weight = held(0.0).1;
    for sign in [-1.0, 1.0] {
        for (part, mode) in [(1.0 - 1e-9, 0.0), (1.0 + 1e-9, sign)] {
            let (u, holding) = held(weight + sign * 3.0 * part);
            assert!((holding + sign * 3.0 * part).abs() < 1e-12, "{holding}");
            let found =
                resolve_stiction(&arm, &y, &SVector::zeros(), &u, 0.0, 0.0).expect("not singular");
            assert_eq!(found, SVector::from([0.0, mode, 0.0]));
        }
    }
}

/// The block on the belt, event by event: m = 1, k = 100, belt 0.1 m/s, 4 N at rest, 3 N in motion.
/// Times and states are those of the closed solution, piece by piece a harmonic motion.
#[test]
fn the_block_on_the_belt_sticks_and_slips() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/scenes");
    let belt = Evaluated::<2, 1, 2, 1>::new(&read(&folder.join("stick_slip.scene.yaml")));
    let input = SVector::from([0.1, 0.0]);
    let margin = |y: &SVector<f64, 2>, modes: &SVector<f64, 1>| {
        belt.events(y, modes, &input, 0.0).expect("not singular")[0]
    };
    let samples = [
        (0.45, 0.043570081004945756, 0.03981570232861697),
        (0.7, 0.02151127511459422, -0.11311125046603127),
        (0.9, 0.022876110196153102, 0.1),
        (1.1, 0.04242586460126365, 0.06752620891999123),
        (1.45, 0.01599500984691686, -0.019647520993866668),
        (1.6, 0.025752220392306204, 0.1),
        (2.0, 0.026927189592679427, -0.1380426876732927),
    ];
    let wanted = [0.4, 0.871238898038469, 1.071238898038469, 1.542477796076938];
    let (mut y, mut modes, mut t) = (SVector::from([0.0, 0.1]), SVector::from([0.0]), 0.0);
    let mut events = Vec::new();
    for (until, place, speed) in samples {
        while t < until {
            let h = f64::min(2e-4, until - t);
            let mut next = step(&belt, &y, &modes, &input, h);
            let mut taken = h;
            if margin(&next, &modes) < 0.0 {
                let (mut short, mut long) = (0.0, h);
                for _ in 0..60 {
                    let middle = 0.5 * (short + long);
                    let beyond = margin(&step(&belt, &y, &modes, &input, middle), &modes) < 0.0;
                    if beyond {
                        long = middle
                    } else {
                        short = middle
                    }
                }
                (taken, next) = (long, step(&belt, &y, &modes, &input, long));
                // At the end of a slip the block moves with the belt.
                next[1] = 0.1;
                modes = resolve_stiction(&belt, &next, &SVector::from([0.0]), &input, 0.0, 0.0)
                    .expect("not singular");
                events.push(t + taken);
            }
            (y, t) = (next, t + taken);
        }
        assert!(
            (y[0] - place).abs() < 1e-11 && (y[1] - speed).abs() < 1e-10,
            "{t}: {y:?}"
        );
    }
    for (time, wanted) in events.iter().zip(wanted) {
        assert!((time - wanted).abs() < 1e-9, "{time}, not {wanted}");
    }
    assert!(events.len() >= 4, "{events:?}");
}
