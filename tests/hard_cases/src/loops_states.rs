//! Mechanisms with loops in single states: bars C1 to C3, C6, and the rates of C9.

use std::collections::HashMap;

use bgdyn_runtime::Dd;
use hard_cases_compiled::loops::{Closed, CompiledLoops, closed, spec};
use serde_json::Value;

use crate::Extent;
use crate::bars::{Digits, Found, apart, norm, rounded};
use crate::loop_bars::{Subject, exactly};
use crate::loop_exact::{Arguments, Exact, rounding};
use crate::loop_tree::Tree;
use crate::outcome::{Outcome, Worst};
use crate::rng::Rng;
use crate::single::SHORT;
use crate::written::list;

/// The repository's mechanisms with loops.
pub(crate) const MECHANISMS: [&str; 7] = [
    "delta_robot",
    "excavator",
    "five_bar",
    "four_bar",
    "slider_crank",
    "slider_crank_near_singular",
    "stewart_platform",
];

/// The reference of this name, from `tests/golden/loops`.
macro_rules! golden {
    ($name:literal) => {
        include_str!(concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../golden/loops/",
            $name,
            ".json"
        ))
    };
}
pub(crate) use golden;

/// The effort on a joint of a motion: from its name, time, position, rate.
type Effort = fn(&str, Dd, Dd, Dd) -> Dd;

/// A state of a file: positions and rates of the tree, efforts on its joints, and the accelerations of some.
struct Sample {
    at: String,
    q: Vec<f64>,
    rates: Vec<f64>,
    /// Efforts by position and rate of each joint.
    efforts: Box<dyn Fn(usize, Dd, Dd) -> Dd>,
    accelerations: Vec<(usize, f64)>,
}

fn number(x: f64) -> Dd {
    Dd::from_f64(x)
}

fn names(value: &Value) -> Vec<String> {
    let all = value.as_array().expect("a list").iter();
    let name = |x: &Value| {
        x.as_str()
            .or(x["name"].as_str())
            .expect("a name")
            .to_owned()
    };
    all.map(name).collect()
}

/// The samples of a motion.
fn of_motion(file: &Value, effort: Effort) -> Vec<Sample> {
    let (joints, columns) = (names(&file["mechanism"]), names(&file["columns"]));
    let samples = file["samples"].as_array().expect("samples").iter();
    samples
        .map(|sample| {
            let sample = list(sample);
            let read = |ending: &str| -> Vec<f64> {
                let place = |joint: &String| {
                    let name = format!("{joint}{ending}");
                    columns.iter().position(|c| *c == name).expect("a column")
                };
                joints.iter().map(|joint| sample[place(joint)]).collect()
            };
            let (q, rates) = (read(""), read("_rate"));
            // Times are whole milliseconds.
            let t = number((sample[0] * 1e3).round()) / number(1e3);
            let joints = joints.clone();
            Sample {
                at: format!("t = {} s", sample[0]),
                efforts: Box::new(move |j, q, v| effort(&joints[j], t, q, v)),
                accelerations: read("_acceleration").into_iter().enumerate().collect(),
                q,
                rates,
            }
        })
        .collect()
}

/// The states of a static file: each with given accelerations and with given efforts.
fn of_states(file: &Value) -> Vec<Sample> {
    let joints = names(&file["mechanism"]);
    let places = |key: &str| -> Vec<usize> {
        let place = |name: &String| joints.iter().position(|own| own == name).expect("a joint");
        names(&file[key]).iter().map(place).collect()
    };
    let (actuated, independent) = (places("actuated"), places("independent"));
    let mut samples = vec![];
    for (k, state) in file["states"]
        .as_array()
        .expect("states")
        .iter()
        .enumerate()
    {
        let [inverse, forward] = ["inverse", "forward"].map(|key| &state[key]);
        let given = independent.iter().copied();
        for (kind, from, accelerations) in [
            (
                "inverse",
                inverse,
                given.zip(list(&inverse["qdd_independent"])).collect(),
            ),
            (
                "forward",
                forward,
                list(&forward["qdd"]).into_iter().enumerate().collect(),
            ),
        ] {
            let drives = list(&from["actuator_efforts"]).into_iter().map(number);
            let drives: HashMap<usize, Dd> = actuated.iter().copied().zip(drives).collect();
            samples.push(Sample {
                at: format!("state {k}, {kind}"),
                q: list(&state["q"]),
                rates: list(&state["qd"]),
                efforts: Box::new(move |j, _, _| drives.get(&j).copied().unwrap_or(Dd::ZERO)),
                accelerations,
            });
        }
    }
    samples
}

/// Compares the reference with the file, and returns the arguments of the state.
fn arguments(tree: &Tree, sample: &Sample) -> (Arguments, Found) {
    let q = exactly(&sample.q);
    let u = tree.independents.iter().map(|&j| sample.rates[j]);
    let u = exactly(&u.collect::<Vec<f64>>());
    let s = Arguments {
        q,
        u,
        a: vec![],
        tau: vec![],
    };
    let drives = |exact: &Exact, q: &[Dd]| {
        let rates = exact.rates.iter().zip(q).enumerate();
        let efforts: Vec<Dd> = rates
            .map(|(j, (&v, &q))| (sample.efforts)(j, q, v))
            .collect();
        exact.reduced(&efforts)
    };
    let moved = |s: &Arguments| {
        let exact = Exact::new(tree, &s.q, &s.u);
        exact.accelerations(&exact.forward(&drives(&exact, &s.q)))
    };
    let exact = Exact::new(tree, &s.q, &s.u);
    let tau = drives(&exact, &s.q);
    let a = exact.forward(&tau);
    let found = rounded(&exact.accelerations(&a));
    let size = norm(&found);
    let (found, wanted): (Vec<f64>, Vec<f64>) = (sample.accelerations.iter())
        .map(|&(j, wanted)| (found[j], wanted))
        .unzip();
    // The file's numbers are rounded.
    let allowed = rounding(&s, f64::EPSILON, moved) + 4.0 * f64::EPSILON * size;
    let s = Arguments { a, tau, ..s };
    let what = "accelerations, against the file";
    let agrees = Found::new("ref", what, apart(&found, &wanted), allowed);
    (s, agrees)
}

/// Efforts on all joints of the tree, for their power.
fn loads(tree: &Tree, rng: &mut Rng) -> Vec<Dd> {
    let numbers: Vec<f64> = (0..tree.len())
        .map(|_| f64::from(rng.within(20.0) as f32))
        .collect();
    exactly(&numbers)
}

/// Checks the bars in one state in the scalar T.
fn bars<T: Digits + CompiledLoops>(
    worst: &mut Worst,
    name: &str,
    (case, at): (&str, &str),
    (tree, s, loads): (&Tree, &Arguments, &[Dd]),
) {
    let model = &*closed::<T>(name);
    worst.add(case, T::MARK, at, Subject { model, tree }.all(s, loads));
}

/// The states of a file.
fn of_file(
    case: &str,
    name: &str,
    text: &str,
    read: impl Fn(&Value) -> Vec<Sample>,
) -> Vec<Outcome> {
    let file: Value = serde_json::from_str(text).expect("JSON");
    let tree = Tree::new(spec(name), name);
    assert_eq!(tree.names, names(&file["mechanism"]), "{case}");
    let (mut worst, mut rng) = (Worst::default(), Rng::new(29));
    for sample in read(&file) {
        let (s, agrees) = arguments(&tree, &sample);
        worst.add(case, "", &sample.at, vec![agrees]);
        let loads = loads(&tree, &mut rng);
        let (at, state) = ((case, sample.at.as_str()), (&tree, &s, loads.as_slice()));
        bars::<f64>(&mut worst, name, at, state);
        if tree.len() <= SHORT {
            bars::<f32>(&mut worst, name, at, state);
        }
    }
    worst.finish()
}

/// Returns k sin (w t + p).
fn wave(k: f64, t: Dd, w: f64, p: f64) -> Dd {
    number(k) * (number(w) * t + number(p)).sin_cos().0
}

/// Returns −k (q − q₀) + p; q₀ in hundredths.
fn spring(k: f64, q: Dd, rest: f64, p: f64) -> Dd {
    let tenth = number(10.0);
    number(p) / tenth - number(k) * (q - number(rest) / number(100.0))
}

/// Returns the effort on a leg of the platform.
fn leg(name: &str, t: Dd, q: Dd, v: Dd) -> Dd {
    let leg = name
        .strip_prefix("leg")
        .and_then(|n| n.strip_suffix("_length"));
    let Some(k) = leg.map(|leg| leg.parse::<f64>().expect("a number") - 1.0) else {
        return Dd::ZERO;
    };
    spring(2000.0, q, 75.0, 300.0) - number(60.0) * v + wave(40.0, t, k + 2.0, k)
}

/// Returns the effort on a crank of the five-bar.
fn crank(name: &str, t: Dd, q: Dd, _: Dd) -> Dd {
    match name {
        "proximal1" => spring(20.0, q, 190.0, 12.0) + wave(3.0, t, 4.0, 0.0),
        "proximal2" => {
            let cos = (number(3.0) * t).sin_cos().1;
            spring(20.0, q, 120.0, -5.0) + number(2.0) * cos
        }
        _ => Dd::ZERO,
    }
}

/// All states and samples of the references.
pub(crate) fn references(_: Extent) -> Vec<Outcome> {
    let torque: Effort = |name, _, _, _| match name {
        "crank" => number(0.5),
        _ => Dd::ZERO,
    };
    let motions: [(&str, &str, &str, Effort); 4] = [
        (
            "slider_crank",
            "slider_crank",
            golden!("slider_crank"),
            torque,
        ),
        (
            "slider_crank_near_singular",
            "slider_crank_near_singular",
            golden!("slider_crank_near_singular"),
            |_, _, _, _| Dd::ZERO,
        ),
        (
            "five_bar_parallel",
            "five_bar",
            golden!("five_bar_parallel"),
            crank,
        ),
        (
            "stewart_platform",
            "stewart_platform",
            golden!("stewart_platform"),
            leg,
        ),
    ];
    let states = [
        (
            "delta_robot_static",
            "delta_robot",
            golden!("delta_robot_static"),
        ),
        (
            "stewart_platform_static",
            "stewart_platform",
            golden!("stewart_platform_static"),
        ),
    ];
    let mut outcomes = vec![];
    for (case, name, text, effort) in motions {
        outcomes.extend(of_file(case, name, text, |file| of_motion(file, effort)));
    }
    for (case, name, text) in states {
        outcomes.extend(of_file(case, name, text, of_states));
    }
    outcomes
}

/// A walk over closed positions, on the branch of the start: it goes by up to 0.1 rad or m in each independent
/// joint, and stays where a step would leave the reach or cross a singular position.
pub(crate) struct Walk<'a> {
    model: &'a dyn Closed<f64>,
    tree: &'a Tree,
    q: Vec<f64>,
}

impl<'a> Walk<'a> {
    /// Begins at the start of the mechanism.
    pub fn new(model: &'a dyn Closed<f64>, tree: &'a Tree) -> Self {
        let q = model.neutral();
        Walk { model, tree, q }
    }

    /// Goes on by a few steps, or, rarely, from the start again; returns the position.
    pub fn next(&mut self, rng: &mut Rng) -> Vec<f64> {
        if rng.chance(0.02) {
            self.q = self.model.neutral();
        }
        for _ in 0..4 {
            let step: Vec<f64> = (0..self.model.nv()).map(|_| rng.within(0.1)).collect();
            let q = self.model.integrate(&self.q, &step);
            if q.iter().all(|x| x.is_finite()) && self.tree.on_branch(&exactly(&q)) {
                self.q = q;
            }
        }
        self.q.clone()
    }
}

/// The mechanisms in seeded closed states.
pub(crate) fn seeded(extent: Extent) -> Vec<Outcome> {
    let mut outcomes = vec![];
    for name in MECHANISMS {
        let case = format!("{name}, seeded");
        let (model, tree) = (closed::<f64>(name), Tree::new(spec(name), name));
        let (mut worst, mut rng) = (Worst::default(), Rng::new(31));
        let mut walk = Walk::new(&*model, &tree);
        let mut refused = 0_u32;
        for k in 0..extent.of(3_000, 20) {
            let q = exactly(&walk.next(&mut rng));
            refused += u32::from(is_refused(&*model, &q));
            let mut some = |size: f64| -> Vec<Dd> {
                let numbers: Vec<f64> = (0..model.nv()).map(|_| rng.within(size)).collect();
                exactly(&numbers)
            };
            let s = Arguments {
                q,
                u: some(2.0),
                a: some(3.0),
                tau: some(20.0),
            };
            let cond = Exact::new(&tree, &s.q, &s.u).cond_rows;
            let at = format!("state {k}, cond J_d {cond:.0e}");
            let loads = loads(&tree, &mut rng);
            let (at, state) = ((case.as_str(), at.as_str()), (&tree, &s, loads.as_slice()));
            bars::<f64>(&mut worst, name, at, state);
            if tree.len() <= SHORT {
                bars::<f32>(&mut worst, name, at, state);
            }
        }
        outcomes.extend(worst.finish());
        let quantity = "refused, on the branch of the start";
        outcomes.push(Outcome::new(
            &*case,
            "C2",
            quantity,
            f64::from(refused),
            0.0,
        ));
    }
    outcomes
}

/// Returns whether the accelerations at rest are refused.
fn is_refused(model: &dyn Closed<f64>, q: &[Dd]) -> bool {
    let none = vec![0.0; model.nv()];
    model.forward_dynamics(&rounded(q), &none, &none).is_err()
}
