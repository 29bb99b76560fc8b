//! Motions of the controlled arms and the efforts for them, by the same generated models in `f64`.
//!
//! Each arm is simulated under computed torque along a quintic from rest to rest. Its efforts are scaled
//! by a few per cent, a disturbance unknown to the controller, so that there are errors to correct. Every
//! input of the controller is rounded to `f32` before the host uses it, so that only the arithmetic of the
//! microcontroller differs.
#![forbid(unsafe_code)]

use std::fmt::Write;

use bgdyn::Dynamics;
use bgdyn::nalgebra::SVector;
use bgdyn::runtime::Limits;
use control::{ComputedTorque, Record};

include!(concat!(env!("OUT_DIR"), "/scara.rs"));
include!(concat!(env!("OUT_DIR"), "/puma560.rs"));
include!(concat!(env!("OUT_DIR"), "/scara_payload.rs"));

/// Control steps per second.
pub const RATE: u32 = 1000;
/// Steps of each motion.
pub const STEPS: usize = 500;
/// Kp, 1/s²: critically damped with Kd, at 2.5 Hz.
pub const STIFFNESS: f64 = 256.0;
/// Kd, 1/s.
pub const DAMPING: f64 = 32.0;
/// Mass of the part that the SCARA carries, kg, in place of its spec's.
pub const PAYLOAD: f64 = 2.25;

/// The fraction of its effort that a joint's drive delivers.
const DELIVERED: f64 = 0.97;

/// Returns Rust source, for programs in which `Real` is a scalar: the motions as `SCARA`, `PUMA560` and
/// `SCARA_PAYLOAD`, each with its arm's largest efforts, `SCARA_EFFORTS`, and the constants above.
pub fn motions() -> String {
    let mut text = String::new();
    write_motion(&mut text, "SCARA", &scara_motion(), &scara::JOINT_LIMITS);
    let limits = &puma560::JOINT_LIMITS;
    write_motion(&mut text, "PUMA560", &puma560_motion(), limits);
    let limits = &scara_payload::JOINT_LIMITS;
    write_motion(&mut text, "SCARA_PAYLOAD", &scara_payload_motion(), limits);
    for (name, what, x) in [
        ("STIFFNESS", "Kp, 1/s².", STIFFNESS),
        ("DAMPING", "Kd, 1/s.", DAMPING),
        ("PAYLOAD", "Mass of the part, kg.", PAYLOAD),
    ] {
        writeln!(text, "/// {what}\npub const {name}: Real = {x:?};").expect("memory");
    }
    text
}

fn write_motion<const N: usize>(
    text: &mut String,
    name: &str,
    records: &[Record<f64, N>],
    limits: &[Limits; N],
) {
    let (count, efforts) = (records.len(), limits.map(|l| l.effort));
    writeln!(
        text,
        "/// What the host found.\n\
         pub static {name}: [Record<Real, {N}>; {count}] = {records:?};\n\
         /// Largest efforts: N·m, N.\n\
         pub const {name}_EFFORTS: [Real; {N}] = {efforts:?};"
    )
    .expect("memory");
}

/// The SCARA's motion.
pub fn scara_motion() -> Vec<Record<f64, 4>> {
    let (from, to) = ([0.4, -1.1, 0.03, 0.0], [-0.5, 1.2, 0.12, 1.5]);
    motion(&scara::Scara::default(), &scara::JOINT_LIMITS, from, to)
}

/// The PUMA's motion.
pub fn puma560_motion() -> Vec<Record<f64, 6>> {
    let from = [0.2, 0.3, -0.4, 0.1, 0.5, -0.3];
    let to = [0.6, 0.7, -0.9, 0.5, 0.1, 0.4];
    let model = puma560::Puma560::default();
    motion(&model, &puma560::JOINT_LIMITS, from, to)
}

/// The motion of the SCARA with a part of [`PAYLOAD`].
pub fn scara_payload_motion() -> Vec<Record<f64, 4>> {
    let (from, to) = ([-0.5, 1.2, 0.12, 1.5], [0.3, -0.6, 0.05, 0.0]);
    let model = scara_payload::ScaraPayload { payload: PAYLOAD };
    motion(&model, &scara_payload::JOINT_LIMITS, from, to)
}

fn motion<M: Dynamics<f64, N, N>, const N: usize>(
    model: &M,
    limits: &[Limits; N],
    from: [f64; N],
    to: [f64; N],
) -> Vec<Record<f64, N>> {
    let law = ComputedTorque {
        stiffness: STIFFNESS,
        damping: DAMPING,
        limits: SVector::from(limits.map(|l| l.effort)),
    };
    let (mut q, mut v) = (SVector::from(from), SVector::<f64, N>::zeros());
    let step = |k| {
        let mut record = wanted(from, to, k as f64 / STEPS as f64);
        (record.q, record.v) = (single(q.into()), single(v.into()));
        let tau = law.effort(model, &record);
        record.tau = tau.into();
        advance(model, &mut q, &mut v, &(tau * DELIVERED));
        record
    };
    (0..STEPS).map(step).collect()
}

/// Advances by one period, with Heun's steps.
fn advance<M: Dynamics<f64, N, N>, const N: usize>(
    model: &M,
    q: &mut SVector<f64, N>,
    v: &mut SVector<f64, N>,
    tau: &SVector<f64, N>,
) {
    const PARTS: u32 = 4;
    let h = 1.0 / f64::from(RATE * PARTS);
    let rate = |q: &_, v: &_| {
        let a = model.forward_dynamics(q, v, tau);
        a.expect("a regular mass matrix")
    };
    for _ in 0..PARTS {
        let a = rate(q, v);
        let (q1, v1) = (*q + *v * h, *v + a * h);
        let a1 = rate(&q1, &v1);
        *q += (*v + v1) * (0.5 * h);
        *v += (a + a1) * (0.5 * h);
    }
}

/// Returns the quintic s(x) = 10x³ − 15x⁴ + 6x⁵ from `from` to `to`, at the fraction x of the motion's
/// time.
fn wanted<const N: usize>(from: [f64; N], to: [f64; N], x: f64) -> Record<f64, N> {
    let seconds = STEPS as f64 / f64::from(RATE);
    let s = x * x * x * (10.0 + x * (6.0 * x - 15.0));
    let rate = 30.0 * x * x * (x - 1.0) * (x - 1.0) / seconds;
    let curvature = 60.0 * x * (x - 1.0) * (2.0 * x - 1.0) / (seconds * seconds);
    let along = |rate: f64| std::array::from_fn(|i| (to[i] - from[i]) * rate);
    let way: [f64; N] = along(s);
    Record {
        wanted_q: single(std::array::from_fn(|i| from[i] + way[i])),
        wanted_v: single(along(rate)),
        wanted_a: single(along(curvature)),
        q: from,
        v: [0.0; N],
        tau: [0.0; N],
    }
}

/// Rounds to `f32`.
fn single<const N: usize>(x: [f64; N]) -> [f64; N] {
    x.map(|x| f64::from(x as f32))
}
