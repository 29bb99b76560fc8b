//! Measures instructions and stack of every function of three arms, generated and by the textbook, in
//! `f32` and `f64`: one line each, for `figures.py`. Fails if the count of a generated function depends on
//! the state, or if its results are not those of the textbook.
#![no_std]
#![no_main]

use core::hint::black_box;

use bgdyn::nalgebra::{RealField, SVector, Vector3, convert};
use bgdyn::{Dynamics, Scalar};
use control::{ComputedTorque, Record};
use cortex_m_rt::entry;
use cortex_m_semihosting::hprintln;
use firmware::arms::{bodies, panda, puma560, scara};
use firmware::board;
use firmware::measure::{Counter, double_precision, stack};
use firmware::subject::{Function, Generated, Out, Plain, Subject, functions};
use textbook::{Body, Textbook};

use random::Random;

// That of the generator, which the boards do not depend on.
#[allow(dead_code)]
#[path = "../../../bgdyn-runtime/src/random.rs"]
mod random;

/// Largest number of instructions of generated functions in `f32`.
const BARS: [(&str, &str, u32); 2] = [
    ("scara", "inverse dynamics", 350),
    ("panda", "inverse dynamics", 1600),
];
/// Largest number of instructions of a square root in `f32`: one of the FPU, and the call.
const ROOT: u32 = 16;
/// Largest stack size of a generated function, bytes.
const STACK: usize = 2048;

/// Number of random states.
const STATES: usize = 128;

#[entry]
fn main() -> ! {
    let counter = Counter::start();
    let double = double_precision();
    let mut well = true;
    macro_rules! arm {
        ($module:ident, $model:ident, $bodies:ident, $gravity:ident) => {
            let arm = Arm {
                name: stringify!($module),
                efforts: $module::JOINT_LIMITS.map(|l| l.effort),
                slides: $module::JOINT_MOTIONS.map(|m| m == bgdyn::runtime::Motion::Translation),
                bodies: &bodies::$bodies,
                gravity: bodies::$gravity,
                counter: &counter,
            };
            well &= arm.measure::<_, f32>("f32", $module::$model::default(), true);
            well &= arm.measure::<_, f64>("f64", $module::$model::default(), double);
            #[cfg(feature = "c")]
            {
                let law = arm.law();
                let (mut c, model) = (firmware::c::$model { law }, $module::$model::default());
                well &= arm.subject("f32", "C", &mut c, true);
                well &= arm.same_bits(&mut c, &mut Generated { model, law });
            }
        };
    }
    let (square_root, mut root) = (black_box(<f32 as Scalar>::sqrt as fn(f32) -> f32), 0.0);
    let count = counter.of(|| root = square_root(2.0));
    hprintln!("root;f32;{}", count);
    if count > ROOT || black_box(root) != core::f32::consts::SQRT_2 {
        hprintln!("MISSED: the square root takes {} instructions", count);
        well = false;
    }
    arm!(scara, Scara, SCARA, SCARA_GRAVITY);
    arm!(puma560, Puma560, PUMA560, PUMA560_GRAVITY);
    arm!(panda, Panda, PANDA, PANDA_GRAVITY);
    board::exit(well);
}

/// An arm with the models and states for its measurement.
struct Arm<'a, const N: usize> {
    name: &'a str,
    efforts: [f64; N],
    slides: [bool; N],
    bodies: &'a [Body; N],
    gravity: Vector3<f64>,
    counter: &'a Counter,
}

impl<const N: usize> Arm<'_, N> {
    /// Measures all functions in one scalar; `constant`: whether the counts of the generated ones must not
    /// depend on the state.
    fn measure<M: Dynamics<T, N, N>, T>(&self, scalar: &str, model: M, constant: bool) -> bool
    where
        T: Scalar + RealField,
    {
        let law = self.law();
        let tree = Textbook::<T, N>::new(self.bodies, self.gravity);
        let ours = tree.clone().with_sine(<T as Scalar>::sin_cos);
        let (mut generated, mut plain) = (Generated { model, law }, Plain { tree, law });
        let mut same_sine = Plain { tree: ours, law };
        let well = self.subject(scalar, "generated", &mut generated, constant);
        self.subject(scalar, "textbook, sines of libm", &mut plain, false);
        self.subject(scalar, "textbook, sines of bgdyn", &mut same_sine, false);
        self.beyond(scalar, &mut generated);
        well & self.agree(&mut generated, &mut plain)
    }

    /// Returns the controller.
    fn law<T: Scalar>(&self) -> ComputedTorque<T, N> {
        ComputedTorque {
            stiffness: T::from_f64(256.0),
            damping: T::from_f64(32.0),
            limits: SVector::from(self.efforts.map(T::from_f64)),
        }
    }

    fn subject<S: Subject<T, N>, T: Scalar>(
        &self,
        scalar: &str,
        how: &str,
        subject: &mut S,
        constant: bool,
    ) -> bool {
        let mut well = true;
        for (name, function) in functions::<S, T, N>() {
            let (least, most, bytes) = self.function(subject, function);
            hprintln!(
                "figure;{};{};{};{};{};{};{}",
                self.name,
                scalar,
                how,
                name,
                least,
                most,
                bytes
            );
            if !["generated", "C"].contains(&how) {
                continue;
            }
            if constant && least != most {
                hprintln!(
                    "MISSED: {} of {} takes {} to {}",
                    name,
                    self.name,
                    least,
                    most
                );
                well = false;
            }
            let bar = BARS
                .iter()
                .find(|b| (b.0, b.1, scalar) == (self.name, name, "f32"));
            if bar.is_some_and(|bar| most > bar.2) || bytes >= STACK {
                hprintln!(
                    "MISSED: {} of {}: {}, {} bytes",
                    name,
                    self.name,
                    most,
                    bytes
                );
                well = false;
            }
        }
        well
    }

    /// Measures least and most instructions over random states, and the largest stack size in bytes.
    fn function<S, T: Scalar>(
        &self,
        subject: &mut S,
        function: Function<S, T, N>,
    ) -> (u32, u32, usize) {
        let (mut least, mut most, mut bytes) = (u32::MAX, 0, 0);
        let (mut random, mut out) = (Random(0x2545_f491), Out::default());
        let function = black_box(function);
        for _ in 0..STATES {
            let record = black_box(self.record(&mut random));
            let count = self.counter.of(|| function(subject, &record, &mut out));
            (least, most) = (least.min(count), most.max(count));
            bytes = bytes.max(stack(&mut || function(subject, &record, &mut out)));
        }
        (least, most, bytes)
    }

    /// Returns whether the results of both have the same bits, also for an angle beyond the sine's branch-free path.
    #[cfg(feature = "c")]
    fn same_bits<A: Subject<f32, N>, B: Subject<f32, N>>(&self, c: &mut A, rust: &mut B) -> bool {
        let mut random = Random(0x0bad_cafe);
        let (a, b) = (functions::<A, f32, N>(), functions::<B, f32, N>());
        let mut well = true;
        for k in 0..STATES {
            let mut record = self.record(&mut random);
            if k % 4 == 3 {
                record.q[1] = 3e5 * random.signed() as f32;
            }
            for ((name, a), (_, b)) in a.iter().zip(&b) {
                let (mut x, mut y) = (Out::default(), Out::default());
                a(c, &record, &mut x);
                b(rust, &record, &mut y);
                let are_same = x.vector.map(f32::to_bits) == y.vector.map(f32::to_bits)
                    && x.matrix.map(f32::to_bits) == y.matrix.map(f32::to_bits);
                if !are_same || x.refused || y.refused {
                    hprintln!("MISSED: {} of {} in C has other bits", name, self.name);
                    well = false;
                }
            }
        }
        well
    }

    /// Measures the exception: an angle beyond the sine's branch-free path.
    fn beyond<M: Dynamics<T, N, N>, T: Scalar>(
        &self,
        scalar: &str,
        generated: &mut Generated<M, T, N>,
    ) {
        let (mut random, mut out) = (Random(1), Out::default());
        let function = black_box(Generated::<M, T, N>::inverse_dynamics as Function<_, T, N>);
        let mut record = self.record(&mut random);
        record.q[1] = T::from_f64(3e5);
        let record = black_box(record);
        let count = self.counter.of(|| function(generated, &record, &mut out));
        let bytes = stack(&mut || function(generated, &record, &mut out));
        hprintln!("beyond;{};{};{};{}", self.name, scalar, count, bytes);
    }

    /// Returns whether the generated results and those of the textbook are equal within rounding.
    fn agree<A, B, T>(&self, generated: &mut A, plain: &mut B) -> bool
    where
        A: Subject<T, N>,
        B: Subject<T, N>,
        T: Scalar + RealField,
    {
        let mut random = Random(0x1234_5678);
        let (a, b) = (functions::<A, T, N>(), functions::<B, T, N>());
        let mut well = true;
        for _ in 0..STATES {
            let record = self.record(&mut random);
            for ((name, a), (_, b)) in a.iter().zip(&b) {
                let (mut x, mut y) = (Out::default(), Out::default());
                a(generated, &record, &mut x);
                b(plain, &record, &mut y);
                let size = x.vector.amax() + x.matrix.amax();
                let off = (x.vector - y.vector).amax() + (x.matrix - y.matrix).amax();
                // A wrist's inertia is a thousandth of the arm's: forward dynamics loses three digits.
                let allowed = T::default_epsilon() * convert(2e4) * size;
                if x.refused || !(off <= allowed) {
                    hprintln!("MISSED: {} of {} is not the textbook's", name, self.name);
                    well = false;
                }
            }
        }
        well
    }

    /// Returns a random state: any angle, ±0.3 m; rates and accelerations within ±2, efforts within ±10.
    fn record<T: Scalar>(&self, random: &mut Random) -> Record<T, N> {
        let mut joints = |size: f64| [(); N].map(|()| size * random.signed());
        let mut q = joints(core::f64::consts::PI);
        for (q, &slides) in q.iter_mut().zip(&self.slides) {
            *q *= if slides { 0.1 } else { 1.0 };
        }
        let wanted_q = q.map(|q| q + 1e-3);
        Record {
            wanted_q: wanted_q.map(T::from_f64),
            wanted_v: joints(2.0).map(T::from_f64),
            wanted_a: joints(2.0).map(T::from_f64),
            q: q.map(T::from_f64),
            v: joints(2.0).map(T::from_f64),
            tau: joints(10.0).map(T::from_f64),
        }
    }
}
