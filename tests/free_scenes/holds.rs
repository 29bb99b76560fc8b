//! Controllers that hold a pose: efforts against the gradients of potentials, dampings, moving targets, the sign
//! of a quaternion, scalars and lanes. `hold_runs` has their runs.

use bgdyn::runtime::manifold::{floating, planar, rotation, spherical};
use bgdyn::runtime::wide::f64x4;
use bgdyn::runtime::{Dd, FixedVector, HybridSystem, Scalar, StateVector};
use bgdyn_sim::{HybridState, Rk4, Run, ScenePlant};

use crate::heavy_top_hold::HeavyTopHold;
use crate::loose_ball_hold::LooseBallHold;
use crate::platform_hold::PlatformHold;
use crate::probe_guided::ProbeGuided;
use crate::probe_hold::ProbeHold;

/// The step of differences in double-double: their error is below 1e-15.
const H: f64 = 1e-10;

pub(crate) fn dd<const N: usize>(x: [f64; N]) -> [Dd; N] {
    x.map(Dd::from_f64)
}

/// The efforts of a scene's inputs at positions q and velocities v.
fn efforts<T: Scalar, S: HybridSystem<T>>(scene: &S, q: &[T], v: &[T], t: T) -> Vec<T>
where
    S::Inputs: FixedVector,
{
    let all: Vec<T> = q.iter().chain(v).copied().collect();
    let y = S::State::from_entries(|i| all[i]);
    let (_, modes) = scene.start();
    let inputs = scene.input(&y, &modes, &S::Inputs::zero_vector(), t);
    inputs.entries().to_vec()
}

/// Unit quaternions of several turns: small ones, about a quarter, near half a turn.
fn orientations() -> Vec<[Dd; 4]> {
    let vectors = [
        [1e-3, -2e-3, 5e-4],
        [0.7, -0.4, 1.1],
        [-2.0, 1.5, 0.3],
        [1.8, 1.8, -1.8],
        [3.1, 0.0, 0.1],
    ];
    let neutral = dd([0.0, 0.0, 0.0, 1.0]);
    vectors
        .map(|v| spherical::integrate(neutral, dd(v)))
        .to_vec()
}

/// Returns the vector in the axes of the joint's origin.
fn turned(q: [Dd; 4], x: [Dd; 3]) -> [Dd; 3] {
    let r = rotation(q);
    std::array::from_fn(|i| r[(i, 0)] * x[0] + r[(i, 1)] * x[1] + r[(i, 2)] * x[2])
}

/// Returns the vector in link axes.
fn turned_back(q: [Dd; 4], x: [Dd; 3]) -> [Dd; 3] {
    let [u, v, s, w] = q;
    turned([-u, -v, -s, w], x)
}

/// Returns Σ ½ g_i (1 − (R_targetᵀ R)_ii) with g_x = k_y + k_z − k_x, …
pub(crate) fn potential(q: [Dd; 4], target: [Dd; 4], k: [f64; 3]) -> Dd {
    let [q, target] = [q, target].map(spherical::normalize);
    let (r, to) = (rotation(q), rotation(target));
    let entry = |i: usize| r[(0, i)] * to[(0, i)] + r[(1, i)] * to[(1, i)] + r[(2, i)] * to[(2, i)];
    let sum = k[0] + k[1] + k[2];
    let term = |i: usize| (Dd::ONE - entry(i)) * Dd::from_f64((sum - 2.0 * k[i]) / 2.0);
    term(0) + term(1) + term(2)
}

/// Returns Σ ½ k_i (p_i − r_i)².
pub(crate) fn spring<const N: usize>(p: [Dd; N], target: [f64; N], k: [f64; N]) -> Dd {
    let term = |i: usize| {
        let stretch = p[i] - Dd::from_f64(target[i]);
        stretch * stretch * Dd::from_f64(k[i] / 2.0)
    };
    (0..N).map(term).fold(Dd::ZERO, |sum, x| sum + x)
}

/// Compares efforts with the negative gradient of a potential along the tangent.
fn pulls<const N: usize>(name: &str, found: &[Dd], energy: impl Fn([Dd; N]) -> Dd) {
    assert_eq!(found.len(), N, "{name}");
    for (j, found) in found.iter().enumerate() {
        let moved = |by: f64| {
            let mut d = [Dd::ZERO; N];
            d[j] = Dd::from_f64(by);
            energy(d)
        };
        let wanted = -((moved(H) - moved(-H)) / Dd::from_f64(2.0 * H)).to_f64();
        let off = (found.to_f64() - wanted).abs();
        assert!(
            off < 1e-13,
            "{name}, effort {j}: {found:?} instead of {wanted}"
        );
    }
}

pub(crate) const PROBE_TARGET: [f64; 4] = [0.48, 0.6, 0.0, 0.64];

#[test]
fn efforts_at_rest_are_gradients_of_potentials() {
    let probe = ProbeHold::<Dd>::default();
    for [x, y, z, w] in orientations() {
        let q = [
            Dd::from_f64(0.3),
            Dd::from_f64(-1.2),
            Dd::from_f64(0.6),
            x,
            y,
            z,
            w,
        ];
        let found = efforts(&probe, &q, &[Dd::ZERO; 6], Dd::ZERO);
        pulls::<6>("probe", &found, |d| {
            let [px, py, pz, x, y, z, w] = floating::integrate(q, d);
            let turned = potential([x, y, z, w], dd(PROBE_TARGET), [2.0, 3.0, 4.0]);
            turned + spring([px, py, pz], [0.5, -0.2, 0.1], [30.0, 40.0, 50.0])
        });
    }
    let ball = LooseBallHold::<Dd>::default();
    for q in orientations() {
        let q = q.map(|x| x * Dd::from_f64(1.7));
        let found = efforts(&ball, &q, &[Dd::ZERO; 3], Dd::ZERO);
        pulls::<3>("ball", &found, |d| {
            let moved = spherical::integrate(q, d);
            potential(moved, dd([0.0, 0.0, 0.6, 0.8]), [9.0, 12.0, 4.0])
        });
    }
    let platform = PlatformHold::<Dd>::default();
    for angle in [-2.0, 0.3, 4.0] {
        let q = dd([0.4, -0.9, angle]);
        // The target moves at 0.3 m/s along y: a damper pulls along with it.
        let found = efforts(&platform, &q, &[Dd::ZERO; 3], Dd::from_f64(2.0));
        pulls::<3>("platform", &found, |d| {
            let [x, y, turned] = planar::integrate(q, d);
            let off = turned - Dd::PI * Dd::from_f64(0.5);
            let place = spring([x, y], [1.0, 0.6], [20.0, 30.0]);
            place + off * off * Dd::from_f64(4.0) - y * Dd::from_f64(6.0 * 0.3)
        });
    }
}

/// For one stiffness the moment is −k n sin θ, from an orientation that is not the target's.
#[test]
fn one_stiffness_pulls_with_the_sine_of_the_angle() {
    let top = HeavyTopHold::<f64>::default();
    for angle in [1e-9, 0.4, 1.5, 3.0, 3.13] {
        let n = [0.48, -0.6, 0.64];
        let q = spherical::integrate([0.0, 0.0, 0.0, 1.0], n.map(|n: f64| n * angle));
        let found = efforts(&top, &q, &[0.0; 3], 0.0);
        for k in 0..3 {
            let wanted = -300.0 * n[k] * f64::sin(angle);
            let off = (found[k] - wanted).abs();
            assert!(
                off < 1e-13 * 300.0,
                "{angle}: {} instead of {wanted}",
                found[k]
            );
        }
    }
}

/// Dampings of moments are along link axes, those of forces along the axes of the joint's origin.
#[test]
fn dampings_resist_along_their_axes() {
    let v = dd([0.3, -0.7, 1.1, 0.9, -0.2, 0.5]);
    let still = [Dd::ZERO; 6];
    for [x, y, z, w] in orientations() {
        let q = [Dd::ONE, Dd::ZERO, Dd::ONE, x, y, z, w];
        let along = |d: [f64; 3]| {
            let fixed = turned([x, y, z, w], [v[0], v[1], v[2]]);
            let damped = std::array::from_fn(|i| fixed[i] * Dd::from_f64(d[i]));
            turned_back([x, y, z, w], damped)
        };
        let check = |found: Vec<Dd>, rest: Vec<Dd>, linear: [f64; 3], angular: [f64; 3]| {
            let force = along(linear);
            for i in 0..6 {
                let wanted = match i {
                    0..3 => force[i].to_f64(),
                    _ => angular[i - 3] * v[i].to_f64(),
                };
                let off = ((rest[i] - found[i]).to_f64() - wanted).abs();
                assert!(off < 1e-15, "effort {i}: by {off:e}");
            }
        };
        let (probe, t) = (ProbeHold::<Dd>::default(), Dd::ZERO);
        let pair = [&v, &still].map(|v| efforts(&probe, &q, v, t));
        let [found, rest] = pair;
        check(found, rest, [16.0; 3], [0.4, 0.5, 0.6]);
        let (guided, t) = (ProbeGuided::<Dd>::default(), Dd::from_f64(0.7));
        let [found, rest] = [&v, &still].map(|v| efforts(&guided, &q, v, t));
        check(found, rest, [3.0, 4.0, 5.0], [1.0, 2.0, 3.0]);
    }
}

/// The turns of the guided probe's target at a time, as a quaternion: about x, then y, then z.
fn guided_target(t: Dd) -> [Dd; 4] {
    let tau = Dd::PI * Dd::from_f64(2.0);
    let roll = (tau * Dd::from_parts(0.2, -1.1102230246251566e-17) * t)
        .sin_cos()
        .0;
    let third = Dd::PI / Dd::from_f64(9.0);
    let yaw = Dd::from_parts(0.9, -2.220446049250313e-17) * t
        - Dd::from_parts(0.4, -2.220446049250313e-17);
    let about = |axis: usize, angle: Dd| {
        let mut vector = [Dd::ZERO; 3];
        vector[axis] = angle;
        vector
    };
    let neutral = dd([0.0, 0.0, 0.0, 1.0]);
    // A turn about a fixed axis is multiplied from the left: begin with the last one.
    let turned = spherical::integrate(neutral, about(2, yaw));
    let turned = spherical::integrate(turned, about(1, third));
    let roll = roll * Dd::from_parts(0.7, -5.551115123125783e-17);
    spherical::integrate(turned, about(0, roll))
}

/// A target that moves: the damper acts on the difference of the angular velocities, in link axes.
#[test]
fn dampers_act_against_the_velocity_of_the_target() {
    let scene = ProbeGuided::<Dd>::default();
    let two = Dd::from_f64(2.0 * H);
    for t in [0.0, 0.8, 3.3] {
        let t = Dd::from_f64(t);
        let target = guided_target(t);
        let [ahead, behind] = [H, -H].map(|h| guided_target(t + Dd::from_f64(h)));
        let speed = spherical::difference(ahead, behind).map(|x| x / two);
        for [x, y, z, w] in orientations() {
            let q = [Dd::ZERO, Dd::ZERO, Dd::ZERO, x, y, z, w];
            let found = efforts(&scene, &q, &[Dd::ZERO; 6], t);
            let own = turned_back([x, y, z, w], turned(target, speed));
            let damped: Vec<Dd> = (0..3)
                .map(|i| own[i] * Dd::from_f64(1.0 + i as f64))
                .collect();
            let rest: Vec<Dd> = (0..3).map(|i| found[3 + i] - damped[i]).collect();
            pulls::<3>("guided", &rest, |d| {
                potential(spherical::integrate([x, y, z, w], d), target, [5.0; 3])
            });
        }
        // On the target and with its velocity no moment acts.
        let [x, y, z, w] = target;
        let (q, [a, b, c]) = ([Dd::ZERO, Dd::ZERO, Dd::ZERO, x, y, z, w], speed);
        let v = [Dd::ZERO, Dd::ZERO, Dd::ZERO, a, b, c];
        let found = efforts(&scene, &q, &v, t);
        assert!(
            found[3..].iter().all(|m| m.to_f64().abs() < 1e-15),
            "{found:?}"
        );
    }
}

#[test]
fn the_sign_of_a_quaternion_changes_no_effort() {
    let scene = ProbeHold::<f64>::default();
    let guided = ProbeGuided::<f64>::default();
    for q in orientations() {
        let [x, y, z, w] = q.map(Dd::to_f64);
        let v = [0.1, 0.2, 0.3, -0.4, 0.5, 0.6];
        let (plus, minus) = ([0.3, 0.2, 0.1, x, y, z, w], [0.3, 0.2, 0.1, -x, -y, -z, -w]);
        assert_eq!(
            efforts(&scene, &plus, &v, 0.0),
            efforts(&scene, &minus, &v, 0.0)
        );
        assert_eq!(
            efforts(&guided, &plus, &v, 0.4),
            efforts(&guided, &minus, &v, 0.4)
        );
    }
    let (y, modes) = scene.start();
    let end = |sign: f64| {
        let mut y = y;
        y.rows_mut(3, 4).scale_mut(sign);
        let from = HybridState { t: 0.0, y, modes };
        let mut run = Run::by(Rk4, ScenePlant::new(&scene), from);
        (0..200).for_each(|_| {
            run.step(0.01).expect("it moves");
        });
        let mut y = *run.y();
        y.rows_mut(3, 4).scale_mut(sign);
        y
    };
    assert_eq!(end(1.0), end(-1.0));
}

/// Inputs in `f32`, in double-double and in lanes are those in `f64`; in lanes bit for bit.
#[test]
fn every_scalar_holds_alike() {
    let (double, single) = (ProbeGuided::<f64>::default(), ProbeGuided::<f32>::default());
    let (two, wide) = (
        ProbeGuided::<Dd>::default(),
        ProbeGuided::<f64x4>::default(),
    );
    let v = [0.1, -0.2, 0.3, 0.4, -0.5, 0.6];
    let states: Vec<[f64; 7]> = orientations()
        .into_iter()
        .map(|q| {
            let [x, y, z, w] = q.map(Dd::to_f64);
            [0.3, -0.1, 0.2, x, y, z, w]
        })
        .collect();
    let t = 0.75;
    for q in &states {
        let wanted = efforts(&two, &dd(*q), &dd(v), Dd::from_f64(t));
        let found = efforts(&double, q, &v, t);
        let narrow = efforts(
            &single,
            &q.map(|x| x as f32),
            &v.map(|x| x as f32),
            t as f32,
        );
        for i in 0..6 {
            let wanted = wanted[i].to_f64();
            assert!((found[i] - wanted).abs() < 2e-14, "{}, {wanted}", found[i]);
            let narrow = f64::from(narrow[i]);
            assert!((narrow - wanted).abs() < 2e-5, "{narrow}, {wanted}");
        }
    }
    let lane = |i: usize| f64x4::from(std::array::from_fn(|k| states[k][i]));
    let q: [f64x4; 7] = std::array::from_fn(lane);
    let found = efforts(&wide, &q, &v.map(f64x4::splat), f64x4::splat(t));
    for (k, q) in states[..4].iter().enumerate() {
        let alone = efforts(&double, q, &v, t);
        let lane: Vec<f64> = found.iter().map(|x| x.to_array()[k]).collect();
        assert_eq!(lane, alone, "lane {k}");
    }
}
