//! Contains one function only, to measure its size: the environment variable `PROBE` names it at compile
//! time, as `scara/f32/generated/inverse dynamics`, with `all` for all except the control step and `none`
//! for a program without any. `size.sh` builds it; it is not run.
#![no_std]
#![no_main]

use core::hint::black_box;

use bgdyn::Scalar;
use bgdyn::nalgebra::SVector;
use control::{ComputedTorque, Record};
use cortex_m_rt::entry;
use firmware::arms::{bodies, panda, puma560, scara};
use firmware::subject::{Generated, Out, Plain, Subject};
use textbook::Textbook;

const PROBE: [&str; 4] = parts(match option_env!("PROBE") {
    Some(probe) => probe,
    None => "scara/f32/generated/all",
});

/// The four parts between slashes.
const fn parts(mut text: &str) -> [&str; 4] {
    let mut parts = [""; 4];
    let (mut part, mut at) = (0, 0);
    while at < text.len() {
        if text.as_bytes()[at] == b'/' {
            let (before, after) = text.split_at(at);
            (parts[part], text) = (before, after.split_at(1).1);
            (part, at) = (part + 1, 0);
        } else {
            at += 1;
        }
    }
    parts[part] = text;
    parts
}

/// Returns whether a part of the probe has this name.
const fn is(part: usize, name: &str) -> bool {
    let (a, b) = (PROBE[part].as_bytes(), name.as_bytes());
    let (mut at, mut same) = (0, a.len() == b.len());
    while same && at < a.len() {
        same = a[at] == b[at];
        at += 1;
    }
    same
}

/// Calls the selected functions of the subject.
#[inline(always)]
fn call<S: Subject<T, N>, T: Scalar, const N: usize>(mut subject: S) {
    let subject = black_box(&mut subject);
    let zero = [T::from_f64(0.0); N];
    let mut record = Record {
        wanted_q: zero,
        wanted_v: zero,
        wanted_a: zero,
        q: zero,
        v: zero,
        tau: zero,
    };
    let (record, mut out) = (&*black_box(&mut record), Out::default());
    let out = black_box(&mut out);
    if const { is(3, "inverse dynamics") || is(3, "all") } {
        subject.inverse_dynamics(record, out);
        black_box(&mut *out);
    }
    if const { is(3, "mass matrix") || is(3, "all") } {
        subject.mass_matrix(record, out);
        black_box(&mut *out);
    }
    if const { is(3, "forward dynamics") || is(3, "all") } {
        subject.forward_dynamics(record, out);
        black_box(&mut *out);
    }
    if const { is(3, "control step") } {
        subject.control_step(record, out);
        black_box(&mut *out);
    }
}

#[entry]
fn main() -> ! {
    macro_rules! arm {
        ($module:ident, $model:ident, $bodies:ident, $gravity:ident, $scalar:ident) => {
            if const { is(0, stringify!($module)) && is(1, stringify!($scalar)) } {
                let law = ComputedTorque::<$scalar, { $module::NV }> {
                    stiffness: 256.0,
                    damping: 32.0,
                    limits: SVector::from($module::JOINT_LIMITS.map(|l| l.effort as $scalar)),
                };
                let model = $module::$model::<$scalar>::default();
                if const { is(2, "generated") } {
                    call(Generated { model, law });
                } else {
                    let tree = Textbook::new(&bodies::$bodies, bodies::$gravity);
                    let tree = if const { is(3, "none") } {
                        tree.with_sine(|q| (q, q))
                    } else {
                        tree
                    };
                    call(Plain { tree, law });
                }
            }
        };
    }
    macro_rules! arms {
        ($scalar:ident) => {
            arm!(scara, Scara, SCARA, SCARA_GRAVITY, $scalar);
            arm!(puma560, Puma560, PUMA560, PUMA560_GRAVITY, $scalar);
            arm!(panda, Panda, PANDA, PANDA_GRAVITY, $scalar);
        };
    }
    arms!(f32);
    arms!(f64);
    loop {
        cortex_m::asm::nop();
    }
}
