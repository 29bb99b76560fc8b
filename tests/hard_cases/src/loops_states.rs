//! Mechanisms with loops in single states: bars C1 to C3, C6, and the rates of C9.

use bgdyn_runtime::Dd;
use hard_cases_compiled::loops::{CompiledLoops, closed, spec};
use serde_json::Value;

use crate::Extent;
use crate::bars::{Digits, Found, apart, norm, rounded};
use crate::loop_bars::{Subject, exactly};
use crate::loop_exact::{Arguments, Exact};
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
type Effort = fn(&str, f64, f64, f64) -> f64;

/// A state of a file: positions and rates of the tree, efforts on its joints, and the accelerations of some.
struct Sample {
    at: String,
    q: Vec<f64>,
    rates: Vec<f64>,
    efforts: Vec<f64>,
    accelerations: Vec<(usize, f64)>,
}

fn names(value: &Value) -> Vec<String> {
    let all = value.as_array().expect("a list").iter();
    let name = |x: &Value| x.as_str().or(x["name"].as_str()).expect("a name").to_owned();
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
            let efforts = joints.iter().enumerate();
            let efforts = efforts.map(|(j, name)| effort(name, sample[0], q[j], rates[j]));
            Sample {
                at: format!("t = {} s", sample[0]),
                efforts: efforts.collect(),
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
    for (k, state) in file["states"].as_array().expect("states").iter().enumerate() {
        let spread = |drives: Vec<f64>| {
            let mut efforts = vec![0.0; joints.len()];
            for (&j, drive) in actuated.iter().zip(drives) {
                efforts[j] = drive;
            }
            efforts
        };
        let [inverse, forward] = ["inverse", "forward"].map(|key| &state[key]);
        let given = independent.iter().copied();
        for (kind, from, accelerations) in [
            ("inverse", inverse, given.zip(list(&inverse["qdd_independent"])).collect()),
            ("forward", forward, list(&forward["qdd"]).into_iter().enumerate().collect()),
        ] {
            samples.push(Sample {
                at: format!("state {k}, {kind}"),
                q: list(&state["q"]),
                rates: list(&state["qd"]),
                efforts: spread(list(&from["actuator_efforts"])),
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
    let exact = Exact::new(tree, &q, &u);
    let tau = exact.reduced(&exactly(&sample.efforts));
    let a = exact.forward(&tau);
    let found = rounded(&exact.accelerations(&a));
    let (found, wanted): (Vec<f64>, Vec<f64>) = (sample.accelerations.iter())
        .map(|&(j, wanted)| (found[j], wanted))
        .unzip();
    let allowed = exact.share(f64::EPSILON) * norm(&rounded(&exact.accelerations(&a)));
    let what = "accelerations, against the file";
    let agrees = Found::new("ref", what, apart(&found, &wanted), allowed);
    (Arguments { q, u, a, tau }, agrees)
}

/// Efforts on all joints of the tree, for their power.
fn loads(tree: &Tree, rng: &mut Rng) -> Vec<Dd> {
    let numbers: Vec<f64> = (0..tree.len()).map(|_| f64::from(rng.within(20.0) as f32)).collect();
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
fn of_file(case: &str, name: &str, text: &str, read: impl Fn(&Value) -> Vec<Sample>) -> Vec<Outcome> {
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

/// Returns the effort on a leg of the platform.
fn leg(name: &str, t: f64, q: f64, v: f64) -> f64 {
    let leg = name.strip_prefix("leg").and_then(|n| n.strip_suffix("_length"));
    let Some(k) = leg.map(|leg| leg.parse::<f64>().expect("a number") - 1.0) else {
        return 0.0;
    };
    30.0 - 2000.0 * (q - 0.75) - 60.0 * v + 40.0 * ((k + 2.0) * t + k).sin()
}

/// Returns the effort on a crank of the five-bar.
fn crank(name: &str, t: f64, q: f64, _: f64) -> f64 {
    match name {
        "proximal1" => -20.0 * (q - 1.9) + 3.0 * (4.0 * t).sin() + 1.2,
        "proximal2" => -20.0 * (q - 1.2) + 2.0 * (3.0 * t).cos() - 0.5,
        _ => 0.0,
    }
}

/// All states and samples of the references.
pub(crate) fn references(_: Extent) -> Vec<Outcome> {
    let torque: Effort = |name, _, _, _| if name == "crank" { 0.5 } else { 0.0 };
    let motions: [(&str, &str, &str, Effort); 4] = [
        ("slider_crank", "slider_crank", golden!("slider_crank"), torque),
        (
            "slider_crank_near_singular",
            "slider_crank_near_singular",
            golden!("slider_crank_near_singular"),
            |_, _, _, _| 0.0,
        ),
        ("five_bar_parallel", "five_bar", golden!("five_bar_parallel"), crank),
        ("stewart_platform", "stewart_platform", golden!("stewart_platform"), leg),
    ];
    let states = [
        ("delta_robot_static", "delta_robot", golden!("delta_robot_static")),
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

/// The mechanisms in seeded closed states.
pub(crate) fn seeded(extent: Extent) -> Vec<Outcome> {
    let mut outcomes = vec![];
    for name in MECHANISMS {
        let case = format!("{name}, seeded");
        let tree = Tree::new(spec(name), name);
        let model = closed::<f64>(name);
        let (mut worst, mut rng) = (Worst::default(), Rng::new(31));
        for k in 0..extent.of(3_000, 6) {
            let numbers: Vec<f64> = (0..model.nv()).map(|_| rng.unit()).collect();
            let mut some = |size: f64| -> Vec<Dd> {
                let numbers: Vec<f64> = (0..model.nv()).map(|_| rng.within(size)).collect();
                exactly(&numbers)
            };
            let s = Arguments {
                q: exactly(&model.sample(&numbers)),
                u: some(2.0),
                a: some(3.0),
                tau: some(20.0),
            };
            let (at, loads) = (format!("state {k}"), loads(&tree, &mut rng));
            let (at, state) = ((case.as_str(), at.as_str()), (&tree, &s, loads.as_slice()));
            bars::<f64>(&mut worst, name, at, state);
            if tree.len() <= SHORT {
                bars::<f32>(&mut worst, name, at, state);
            }
        }
        outcomes.extend(worst.finish());
    }
    outcomes
}
