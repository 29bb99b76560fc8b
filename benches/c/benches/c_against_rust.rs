//! Times of generated C, compiled by gcc and by clang, over those of the same functions in Rust: all of them in turn
//! over the same states, medians. Fails where a result of C is not that of Rust.
//!
//! `RUSTFLAGS="-C target-cpu=native" cargo bench -p benches_c` compiles both for the processor of this machine.

use std::hint::black_box;
use std::time::Duration;

use benches::body::{bodies, slides};
use benches::clock;
use benches::states::{STATES, State, states};
use benches_c::{c, models};
use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::runtime::Singular;

/// Number of rounds.
const ROUNDS: usize = 15;
/// Duration of the timing of one contender in a round.
const SPAN: Duration = Duration::from_millis(8);
/// Largest difference of a result, relative to the largest entry: both fuse products and sums, or neither does.
const TOLERANCE: f64 = 1e-13;

const METHODS: [&str; 5] = [
    "inverse dynamics",
    "mass matrix",
    "forward dynamics",
    "its derivatives, inverse",
    "its derivatives, forward",
];

/// A function: its time is taken by the index of a state, its result is written row by row.
struct Contender<'a> {
    call: Box<dyn FnMut(usize) + 'a>,
    result: Box<dyn Fn(usize) -> Vec<f64> + 'a>,
}

/// What was measured of a method: the times of Rust and of each C, ns, and how many entries of C have other bits.
struct Measured {
    times: Vec<f64>,
    entries: usize,
    differ: Vec<usize>,
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Times the contenders in turn; the first one is Rust.
fn measure(what: &str, mut contenders: Vec<Contender<'_>>) -> Measured {
    let mut measured = Measured {
        times: Vec::new(),
        entries: 0,
        differ: vec![0; contenders.len() - 1],
    };
    for k in 0..STATES {
        let rust = (contenders[0].result)(k);
        measured.entries += rust.len();
        let size = rust.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        for (differ, c) in measured.differ.iter_mut().zip(&contenders[1..]) {
            for (x, y) in (c.result)(k).iter().zip(&rust) {
                let near = (x - y).abs() <= TOLERANCE * size;
                assert!(near, "{what}, state {k}: C says {x}, Rust {y}");
                *differ += usize::from(x != y);
            }
        }
    }
    let mut rounds = vec![Vec::new(); contenders.len()];
    for _ in 0..ROUNDS {
        for (times, contender) in rounds.iter_mut().zip(&mut contenders) {
            times.push(clock::median(STATES, SPAN, &mut contender.call));
        }
    }
    measured.times = rounds.into_iter().map(median).collect();
    measured
}

/// A result of Rust, flat.
trait Flat {
    fn flat(&self) -> Vec<f64>;
}

impl<const R: usize, const C: usize> Flat for SMatrix<f64, R, C> {
    fn flat(&self) -> Vec<f64> {
        self.transpose().iter().copied().collect()
    }
}

impl<T: Flat, const K: usize> Flat for [T; K] {
    fn flat(&self) -> Vec<f64> {
        self.iter().flat_map(Flat::flat).collect()
    }
}

impl<T: Flat> Flat for Result<T, Singular> {
    fn flat(&self) -> Vec<f64> {
        self.as_ref().expect("a regular mass matrix").flat()
    }
}

/// Calls a function by its address, as C is called.
#[inline(never)]
fn out_of_line<R>(f: impl FnOnce() -> R) -> R {
    f()
}

/// The arguments of a state.
struct Arguments<const N: usize> {
    q: [f64; N],
    v: [f64; N],
    a: [f64; N],
    tau: [f64; N],
}

fn arguments<const N: usize>(states: &[State]) -> Vec<Arguments<N>> {
    let array = |x: &Vec<f64>| std::array::from_fn(|i| x[i]);
    let all = states.iter().map(|s| Arguments {
        q: array(&s.q),
        v: array(&s.v),
        a: array(&s.a),
        tau: array(&s.tau),
    });
    all.collect()
}

/// The function in Rust.
macro_rules! rust {
    ($model:ident, $states:ident, $method:ident, ($($argument:ident)*)) => {{
        let vectors: Vec<_> = $states
            .iter()
            .map(|s| ($(SVector::from(s.$argument),)*))
            .collect();
        let (model, same) = ($model::<f64>::default(), vectors.clone());
        Contender {
            call: Box::new(move |k| {
                let ($($argument,)*) = black_box(&vectors[k]);
                black_box(&out_of_line(|| model.$method($($argument),*)));
            }),
            result: Box::new(move |k| {
                let ($($argument,)*) = &same[k];
                $model::<f64>::default().$method($($argument),*).flat()
            }),
        }
    }};
}

/// The function in C.
macro_rules! in_c {
    ($states:ident, $c:ident, ($($argument:ident)*), $size:expr) => {{
        let mut out = [0.0; $size];
        Contender {
            call: Box::new(move |k| {
                let s = black_box(&$states[k]);
                black_box(c::$c($(&s.$argument,)* &mut out));
                black_box(&mut out);
            }),
            result: Box::new(|k| {
                let (s, mut out) = (&$states[k], [0.0; $size]);
                let _ = c::$c($(&s.$argument,)* &mut out);
                out.to_vec()
            }),
        }
    }};
}

/// Rust and each C as contenders for a method.
macro_rules! method {
    ($model:ident, $states:ident, $arm:literal, $method:ident $arguments:tt, $size:expr; $($c:ident)*) => {{
        let rust = rust!($model, $states, $method, $arguments);
        let contenders = vec![rust, $(in_c!($states, $c, $arguments, $size)),*];
        measure(concat!($arm, ", ", stringify!($method)), contenders)
    }};
}

macro_rules! arms {
    ($($arm:ident $model:ident $spec:literal [$(($compiler:literal $id:ident $m:ident $fd:ident $did:ident $dfd:ident))*],)*) => {$(
        fn $arm() -> [Measured; METHODS.len()] {
            use models::$arm::{$model as Model, NV as N};
            let mechanism = benches::read($spec.as_ref()).expect("a spec");
            let states = &arguments::<N>(&states(&slides(&bodies(&mechanism))));
            [
                method!(Model, states, $spec, inverse_dynamics(q v a), N; $($id)*),
                method!(Model, states, $spec, mass_matrix(q), N * N; $($m)*),
                method!(Model, states, $spec, forward_dynamics(q v tau), N; $($fd)*),
                method!(Model, states, $spec, inverse_dynamics_derivatives(q v a), 2 * N * N; $($did)*),
                method!(Model, states, $spec, forward_dynamics_derivatives(q v tau), 3 * N * N; $($dfd)*),
            ]
        }
    )*

        const ARMS: &[(&str, fn() -> [Measured; METHODS.len()])] = &[$((stringify!($arm), $arm)),*];
    };
}
include!(concat!(env!("OUT_DIR"), "/arms.rs"));

fn main() {
    // `cargo test --benches` runs benchmarks without this argument, to check that they run.
    let arms = match std::env::args().any(|argument| argument == "--bench") {
        true => ARMS,
        false => &ARMS[..1],
    };
    for compiler in models::COMPILERS {
        println!("{compiler}");
    }
    println!(
        "| arm | function | Rust, ns | {} | other bits |",
        "C over Rust | ".repeat(models::COMPILERS.len())
    );
    for (name, arm) in arms {
        for (method, m) in METHODS.iter().zip(arm()) {
            let ratios = m.times[1..]
                .iter()
                .map(|time| format!("{:.2} ({time:.1})", time / m.times[0]));
            let differ = m
                .differ
                .iter()
                .map(|count| format!("{count} of {}", m.entries));
            let cells = ratios.chain(differ).collect::<Vec<_>>().join(" | ");
            println!("| {name} | {method} | {:.1} | {cells} |", m.times[0]);
        }
    }
}
