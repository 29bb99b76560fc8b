//! Bar 13: numbers of any size give numbers or the typed error, and a NaN never gives a number.

use bgdyn_runtime::{FixedVector, HybridSystem, StateVector};

use crate::bars::Digits;
use crate::outcome::Outcome;
use crate::rng::Rng;
use crate::{Extent, scenes};
use hard_cases_compiled::{Compiled, DEPENDS, Model, bit, model};

/// The repository's mechanisms.
pub(crate) const MECHANISMS: [&str; 17] = [
    "cart_pole",
    "crane",
    "cylinder",
    "double_pendulum",
    "elastic_arm",
    "gantry",
    "motor",
    "palletiser",
    "panda",
    "puma560",
    "scara",
    "slider",
    "spring_pendulum",
    "stanford",
    "torso",
    "two_masses",
    "ur5",
];

/// The largest arguments.
pub(crate) trait Range: Digits + Compiled {
    /// Largest position, and largest first-order state.
    const POSITION: f64;
    /// Largest value of all other arguments.
    const RATE: f64;
    /// The smallest positive number.
    const LEAST: f64;
    /// A large number whose square is finite.
    const LARGE: f64;
}

impl Range for f64 {
    const POSITION: f64 = 1e15;
    const RATE: f64 = 1e60;
    const LEAST: f64 = 5e-324;
    const LARGE: f64 = 1e150;
}

impl Range for f32 {
    const POSITION: f64 = 1e4;
    const RATE: f64 = 1e6;
    const LEAST: f64 = 1.4e-45;
    const LARGE: f64 = 1e18;
}

/// Returns a number of any size up to `most`: one in eight is ±0, one in eight a denormal, one in eight
/// the largest, the others any power of ten.
pub(crate) fn wild<T: Range>(rng: &mut Rng, most: f64) -> T {
    let sign = if rng.chance(0.5) { 1.0 } else { -1.0 };
    T::from_f64(match rng.below(8) {
        0 => sign * 0.0,
        1 => sign * T::LEAST * (1.0 + rng.unit() * 1e6).floor(),
        2 => sign * most,
        3 => rng.within(1.0) * most.min(4.0),
        _ => sign * most * 10_f64.powf(-rng.unit() * 2.0 * most.log10()),
    })
}

/// A compiled function: its results, or the error.
type Run<'a, T> = dyn Fn(&[Vec<T>; 4]) -> Result<Vec<T>, String> + 'a;

/// A function of a list of arguments, its results, and the mask of each result.
struct Tried<'a, T> {
    /// Its name, with that of the mechanism or the scene.
    name: String,
    /// Number of arguments of each kind, by the index of the kind in a mask.
    kinds: [usize; 4],
    /// Whether the third kind are first-order states: bristles, volumes, currents.
    first_order: bool,
    /// Ordinary arguments for tests with one NaN or infinite argument.
    around: [Vec<f64>; 4],
    run: Box<Run<'a, T>>,
    masks: Vec<u128>,
}

/// The kinds of faults.
#[derive(Clone, Copy)]
enum Fault {
    /// A result is neither a finite number nor the error.
    Infinite,
    /// A component is finite with an argument that is NaN, although it depends on that argument.
    Swallowed,
    /// A component is finite with an infinite argument, and differs from its limit for large arguments.
    Cut,
    /// A component is finite with an infinite argument, because its law saturates; no fault.
    Saturated,
}

/// Counts by [`Fault`], and the first occurrence of each.
#[derive(Default)]
struct Count {
    counts: [usize; 4],
    first: [String; 4],
}

impl Count {
    fn note(&mut self, fault: Fault, text: impl FnOnce() -> String) {
        let k = fault as usize;
        self.counts[k] += 1;
        if self.counts[k] == 1 {
            self.first[k] = text();
        }
    }

    fn merge(&mut self, other: Count) {
        for (k, first) in other.first.into_iter().enumerate() {
            if self.counts[k] == 0 {
                self.first[k] = first;
            }
            self.counts[k] += other.counts[k];
        }
    }
}

pub(crate) fn is_finite<T: Digits>(x: &T) -> bool {
    x.to_f64().is_finite()
}

impl<T: Range> Tried<'_, T> {
    fn arguments(&self, rng: &mut Rng) -> [Vec<T>; 4] {
        let all = |rng: &mut Rng, n: usize, most: f64| (0..n).map(|_| wild(rng, most)).collect();
        let most = |kind: usize| match kind {
            0 => T::POSITION,
            2 if self.first_order => T::POSITION,
            _ => T::RATE,
        };
        std::array::from_fn(|kind| all(rng, self.kinds[kind], most(kind)))
    }

    /// Counts faults for arguments of any size, and with each argument in turn NaN or infinite and the
    /// others ordinary.
    fn count(&self, rng: &mut Rng, states: usize, spoiled: usize) -> Count {
        let mut count = Count::default();
        for _ in 0..states {
            let arguments = self.arguments(rng);
            if let Ok(results) = (self.run)(&arguments)
                && !results.iter().all(is_finite)
            {
                count.note(Fault::Infinite, || {
                    format!("{}: {arguments:?} -> {results:?}", self.name)
                });
            }
        }
        let mut regular = 0;
        for _ in 0..spoiled {
            let near = |x: &Vec<f64>| x.iter().map(|&x| self.near(rng, x)).collect();
            let usual: Vec<Vec<T>> = self.around.iter().map(near).collect();
            let usual = usual.try_into().expect("four kinds");
            regular += usize::from((self.run)(&usual).is_ok());
            self.spoil(&usual, &mut count);
        }
        assert!(regular > 0, "{}: refused wherever it is tried", self.name);
        count
    }

    /// Returns a number near this one, or of ordinary size.
    fn near(&self, rng: &mut Rng, x: f64) -> T {
        let size = if x == 0.0 { 0.3 } else { 0.02 * x };
        T::from_f64(x + rng.within(size))
    }

    /// Returns whether another value of an argument changes a result.
    fn moves(&self, usual: &[Vec<T>; 4], (kind, i): (usize, usize), k: usize) -> bool {
        let at = |x: T| {
            let mut arguments = usual.clone();
            arguments[kind][i] = x;
            (self.run)(&arguments).ok().map(|results| results[k])
        };
        let here = at(usual[kind][i]);
        OTHERS.iter().any(|&x| at(T::from_f64(x)) != here)
    }

    /// Sets each argument in turn to NaN, or infinity.
    fn spoil(&self, usual: &[Vec<T>; 4], count: &mut Count) {
        let places = self.kinds.iter().enumerate();
        for (kind, i) in places.flat_map(|(kind, &n)| (0..n).map(move |i| (kind, i))) {
            let with = |x: f64| {
                let mut arguments = usual.clone();
                arguments[kind][i] = T::from_f64(x);
                (self.run)(&arguments)
            };
            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let Ok(results) = with(bad) else { continue };
                let large = with(T::LARGE.copysign(bad));
                for (k, (result, mask)) in results.iter().zip(&self.masks).enumerate() {
                    if mask & bit(kind, i) == 0 || !is_finite(result) {
                        continue;
                    }
                    let limit = large.as_ref().ok().map(|large| large[k].to_f64());
                    // A branch that is not taken in this state is no dependence: friction that holds.
                    if bad.is_nan() && !self.moves(usual, (kind, i), k) {
                        continue;
                    }
                    let fault = match (bad.is_nan(), limit) {
                        (true, _) => Fault::Swallowed,
                        (_, Some(limit)) if alike::<T>(limit, result.to_f64()) => Fault::Saturated,
                        _ => Fault::Cut,
                    };
                    count.note(fault, || {
                        let kind = ["q", "v", "a or x", "u"][kind];
                        format!(
                            "{}: {bad} in {kind}[{i}] leaves [{k}] {result:?}",
                            self.name
                        )
                    });
                }
            }
        }
    }
}

/// Other values for an argument.
const OTHERS: [f64; 8] = [0.0, 0.5, -0.5, 3.0, -3.0, 1e3, -1e3, 1e8];

/// Returns whether the numbers are equal within rounding, in units of 1 or of their size.
fn alike<T: Digits>(x: f64, y: f64) -> bool {
    (x - y).abs() <= 16.0 * T::EPS * x.abs().max(1.0)
}

/// Returns the five methods of a mechanism.
fn of_mechanism<T: Range>(name: &str) -> Vec<Tried<'static, T>> {
    let (_, masks) = DEPENDS.iter().find(|(own, _)| *own == name).expect(name);
    let n = model::<T>(name).nv();
    type Run<T> = fn(&dyn Model<T>, &[Vec<T>; 4]) -> Result<Vec<T>, String>;
    let runs: [(&str, [usize; 4], Run<T>); 5] = [
        ("inverse_dynamics", [n, n, n, 0], |m, x| {
            Ok(m.inverse_dynamics(&x[0], &x[1], &x[2]))
        }),
        ("mass_matrix", [n, 0, 0, 0], |m, x| {
            Ok(triangle(m.mass_matrix(&x[0])))
        }),
        ("bias", [n, n, 0, 0], |m, x| Ok(m.bias(&x[0], &x[1]))),
        ("gravity", [n, 0, 0, 0], |m, x| Ok(m.gravity(&x[0]))),
        ("forward_dynamics", [n, n, 0, n], |m, x| {
            m.forward_dynamics(&x[0], &x[1], &x[3])
        }),
    ];
    let tried = runs.into_iter().zip(masks);
    tried
        .map(|((method, kinds, run), masks)| {
            let model = model::<T>(name);
            Tried {
                name: format!("{name}::{method}"),
                kinds,
                first_order: false,
                around: kinds.map(|n| vec![0.0; n]),
                run: Box::new(move |x| run(&*model, x)),
                masks: masks.to_vec(),
            }
        })
        .collect()
}

/// The lower triangle of a matrix, row by row.
fn triangle<T: Copy>(full: Vec<T>) -> Vec<T> {
    let n = full.len().isqrt();
    let places = (0..n).flat_map(|i| (0..=i).map(move |j| i * n + j));
    places.map(|k| full[k]).collect()
}

/// Returns the derivative of a scene when it begins to move: modes as at the start.
fn of_scene<T: Range, S: HybridSystem<T> + 'static>(
    name: &'static str,
    scene: S,
) -> Tried<'static, T> {
    let found = scenes::DEPENDS.iter().find(|(own, ..)| *own == name);
    let (_, [nq, nv, nx], masks) = found.expect(name);
    let (start, modes) = scene.start();
    let mut start = start.entries().iter().map(|x| x.to_f64());
    let mut part = |n: usize| start.by_ref().take(n).collect::<Vec<f64>>();
    let around = [part(*nq), part(*nv), part(*nx), vec![0.0; S::Inputs::LEN]];
    // The rates of positions are velocities.
    let moved = (0..*nq).map(|i| bit(1, i));
    let run = move |x: &[Vec<T>; 4]| {
        let y = [&x[0][..], &x[1], &x[2]].concat();
        let y = S::State::from_entries(|i| y[i]);
        let u = S::Inputs::from_entries(|i| x[3][i]);
        let rates = scene.derivative(&y, &modes, &u, T::from_f64(0.25));
        rates
            .map(|r| r.entries().to_vec())
            .map_err(|e| format!("{e:?}"))
    };
    Tried {
        name: name.to_owned(),
        kinds: [*nq, *nv, *nx, S::Inputs::LEN],
        first_order: true,
        around,
        run: Box::new(run),
        masks: moved.chain(masks.iter().copied()).collect(),
    }
}

/// All scenes.
fn all_scenes<T: Range>() -> Vec<Tried<'static, T>> {
    let mut all = vec![];
    macro_rules! tried {
        ($module:ident, $scene:ident) => {
            all.push(of_scene(
                stringify!($module),
                scenes::$module::$scene::<T>::default(),
            ));
        };
    }
    hard_cases_compiled::each_scene!(tried);
    all
}

/// Total number of random arguments.
const STATES: usize = 10_000_000;
const STATES_QUICK: usize = 100_000;

fn outcomes<T: Range>(
    what: &str,
    tried: &[Tried<'_, T>],
    states: usize,
    extent: Extent,
) -> Vec<Outcome> {
    let mut all = Count::default();
    for (seed, one) in tried.iter().enumerate() {
        let mut rng = Rng::new(1300 + seed as u64);
        all.merge(one.count(&mut rng, states.div_ceil(tried.len()), extent.of(100, 4)));
    }
    let row = |quantity: String, fault: Fault| {
        let (count, first) = (all.counts[fault as usize], &all.first[fault as usize]);
        let quantity = format!("{quantity}{}", T::MARK);
        Outcome::new(what, "13", quantity, count as f64, 0.0).at(first)
    };
    let saturated = all.counts[Fault::Saturated as usize];
    let cut = format!("finite beside ±inf, not its limit ({saturated} are)");
    vec![
        row("neither finite nor refused".into(), Fault::Infinite),
        row("finite beside NaN".into(), Fault::Swallowed),
        row(cut, Fault::Cut),
    ]
}

fn of_scalar<T: Range>(extent: Extent) -> Vec<Outcome> {
    let states = extent.of(STATES, STATES_QUICK) / 2;
    let mechanisms: Vec<Tried<'_, T>> = MECHANISMS.iter().flat_map(|n| of_mechanism(n)).collect();
    let mut all = outcomes("17 mechanisms, five methods", &mechanisms, states, extent);
    all.extend(outcomes(
        "18 scenes, derivative",
        &all_scenes::<T>(),
        states,
        extent,
    ));
    all
}

/// In `f64`.
pub(crate) fn double(extent: Extent) -> Vec<Outcome> {
    of_scalar::<f64>(extent)
}

/// In `f32`.
pub(crate) fn single(extent: Extent) -> Vec<Outcome> {
    of_scalar::<f32>(extent)
}
