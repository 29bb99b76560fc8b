//! Tests a study of a motion in closed form, x(t) = cos t, by integrators with known results: correct ones
//! and one with a wrong coefficient.

use bgdyn_accuracy::{
    Configuration, Cost, CountSteps, Effort, Finding, Grid, RunError, Samples, Spread, Status,
    StepControl, Study, TestCase, costs_csv, figures, page, rows_csv, study, targets, verdicts,
};
use bgdyn_runtime::Dd;
use bgdyn_sim::{Plant, Power};
use nalgebra::SVector;

/// A few steps and one round: the times are not evaluated.
const EFFORT: Effort = Effort {
    rounds: 1,
    resolution: 1e-6,
    ..Effort::QUICK
};

/// ẋ = y, ẏ = −x by the classical Runge–Kutta method, the weights of its slopes given.
fn oscillator(
    grid: &Grid,
    step_control: StepControl,
    weights: [f64; 4],
) -> Result<Samples, RunError> {
    let parts = grid.parts(step_control.value());
    let h = grid.interval() / parts as f64;
    let rates = |[x, y]: [f64; 2]| [y, -x];
    let at = |[x, y]: [f64; 2], k: f64, [a, b]: [f64; 2]| [x + k * a, y + k * b];
    let mut z = [1.0, 0.0];
    let mut values = Vec::new();
    for _ in 0..grid.samples {
        for _ in 0..parts {
            let a = rates(z);
            let b = rates(at(z, 0.5 * h, a));
            let c = rates(at(z, 0.5 * h, b));
            let d = rates(at(z, h, c));
            for (weight, slope) in weights.into_iter().zip([a, b, c, d]) {
                z = at(z, h * weight, slope);
            }
        }
        values.push(vec![z[0]]);
    }
    let estimate = None;
    Ok(Samples { values, estimate })
}

const RIGHT: [f64; 4] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];
/// Two weights are exchanged: consistent, of order 1.
const WRONG: [f64; 4] = [1.0 / 3.0, 1.0 / 6.0, 1.0 / 3.0, 1.0 / 6.0];

fn configuration(formulation: &str, weights: [f64; 4]) -> Configuration {
    Configuration {
        effects: "all".into(),
        method: "rk4".into(),
        order: 4,
        controlled: false,
        scalar: "f64",
        epsilon: f64::EPSILON,
        formulation: formulation.into(),
        run: Box::new(move |grid, step_control| oscillator(grid, step_control, weights)),
    }
}

fn test_case(configurations: Vec<Configuration>) -> TestCase {
    let words = ["oscillator", "A mass on a spring", "x", "m"];
    let mut test_case = TestCase::new(words, 2.0, "rk4", StepControl::Step(0.05));
    test_case.reference = Some(Box::new(|grid, _| {
        let times = (1..=grid.samples).map(|k| grid.interval() * k as f64);
        Ok(times.map(|t| vec![Dd::from_f64(t.cos())]).collect())
    }));
    test_case.configurations = configurations;
    test_case
}

fn studied(weights: [f64; 4]) -> Study {
    study(
        &test_case(vec![configuration("cheapest", weights)]),
        &EFFORT,
    )
    .expect("a reference")
}

#[test]
fn errors_are_those_of_the_closed_form() {
    let study = studied(RIGHT);
    // A step multiplies x − iy by R(ih), R(z) = 1 + z + z²/2 + z³/6 + z⁴/24.
    for row in &study.rows[..2] {
        let h = row.step_control.value();
        let (re, im) = (1.0 - h * h / 2.0 + h.powi(4) / 24.0, h - h.powi(3) / 6.0);
        let (size, angle) = (re.hypot(im), im.atan2(re));
        let parts = (0.2 / h).round() as i32;
        let apart = (1..=10).map(|k| {
            let n = k * parts;
            (size.powi(n) * (f64::from(n) * angle).cos() - (0.2 * f64::from(k)).cos()).abs()
        });
        let wanted = apart.fold(0.0, f64::max);
        let error = row.error.expect("an error");
        assert!((error - wanted).abs() < 1e-14, "{error} at {h}: {wanted}");
    }
    assert!(
        study
            .rows
            .iter()
            .all(|r| r.status == Status::Ok && r.ns.is_some())
    );
}

#[test]
fn a_wrong_coefficient_is_found() {
    let right = &verdicts(&studied(RIGHT))[0];
    assert!(!right.is_failure(), "{right:?}");
    let Finding::Converges(order) = right.finding else {
        panic!("{right:?}")
    };
    assert!((order - 4.0).abs() < 0.3, "{order}");

    let wrong = &verdicts(&studied(WRONG))[0];
    assert!(wrong.is_failure(), "{wrong:?}");
    assert!(
        wrong.words().contains("does not converge"),
        "{}",
        wrong.words()
    );
}

#[test]
fn a_run_that_fails_is_a_row_with_its_reason() {
    let mut failing = configuration("cheapest", RIGHT);
    failing.run = Box::new(
        |grid, step_control| match grid.parts(step_control.value()) {
            1 => Err(RunError {
                t: 0.4,
                why: "unstable: not finite".into(),
            }),
            _ => oscillator(grid, step_control, RIGHT),
        },
    );
    let study = study(&test_case(vec![failing]), &EFFORT).expect("a reference");
    let first = &study.rows[0];
    let why = "unstable: not finite at 0.4 s";
    assert_eq!(first.status, Status::Failed(why.into()));
    assert_eq!((first.error, first.ns), (None, None));
    assert!(rows_csv([first]).ends_with(&format!("failed: {why}\n")));
    let drawn = figures(&study);
    assert!(has_text(&drawn[0].svg, "failed"), "{}", drawn[0].svg);
}

/// Returns whether one of a drawing's texts is this one.
fn has_text(svg: &str, words: &str) -> bool {
    svg.contains(&format!(">\n{words}\n</text>"))
}

/// The reason of a failure is cut short in the drawing; the whole is the tooltip.
#[test]
fn a_long_reason_is_a_tooltip() {
    let mut study = priced();
    let why = "no \"rate\" of <a>: the mass matrix is singular at 0 s".to_owned();
    let last = study.rows.last_mut().expect("a row");
    (last.error, last.status) = (None, Status::Failed(why));
    let figures = figures(&study);
    let figure = figures.iter().find(|f| f.name.ends_with("_effects.svg"));
    let svg = &figure.expect("a figure of effects").svg;
    let whole = "<title>failed: no &quot;rate&quot; of &lt;a&gt;: the mass matrix is singular at 0 s</title>failed: ";
    assert_eq!(svg.matches(whole).count(), 1, "{svg}");
}

#[test]
fn a_study_is_read_as_it_was_written() {
    let study = studied(RIGHT);
    let again = Study::read(&study.write()).expect("a study");
    assert_eq!(again.len(), 1);
    assert_eq!(again[0].rows.len(), study.rows.len());
    assert_eq!(again[0].facts.scene, "oscillator");
    assert_eq!(again[0].write(), study.write());
    assert_eq!(Study::read("scene,effects\n1,2"), None);
}

/// Returns a study with costs.
fn priced() -> Study {
    let mut study = studied(RIGHT);
    for (effects, error) in [("all but springs", 0.5), ("all but drag", 0.0)] {
        let mut row = study.rows[0].clone();
        row.effects = effects.into();
        row.error = Some(error);
        study.rows.push(row);
    }
    let cost = |effects: &str, operations, [least, first, median, third]: [f64; 4], steps| Cost {
        effects: effects.into(),
        operations,
        ns: Spread {
            least,
            quartiles: [first, third],
            median,
        },
        steps,
    };
    study.costs = vec![
        cost("all", 42, [12.25, 12.3, 12.5, 12.6], Some(300)),
        cost("all but springs", 30, [12.25, 12.5, 12.75, 13.0], Some(40)),
        cost("all but drag", 37, [10.0, 10.5, 11.0, 11.5], None),
    ];
    study
}

#[test]
fn costs_of_effects_are_written_and_read() {
    let study = priced();
    let again = Study::read(&study.write()).expect("a study");
    assert_eq!(again[0].costs, study.costs);
    let table = costs_csv(study.costs.iter().map(|c| ("arm", c)));
    let wanted = "scene,effects,operations,ns_per_call,ns_least,ns_first_quartile,ns_third_quartile,steps\n\
                  arm,all,42,1.250e1,1.225e1,1.230e1,1.260e1,300\n\
                  arm,all but springs,30,1.275e1,1.225e1,1.250e1,1.300e1,40\n\
                  arm,all but drag,37,1.100e1,1.000e1,1.050e1,1.150e1,\n";
    assert_eq!(table, wanted);
}

/// Costs are those of calls with and without an effect; no difference of two times is shown.
#[test]
fn the_figure_of_effects_shows_calls_and_steps() {
    let study = priced();
    let figures = figures(&study);
    let figure = figures.iter().find(|f| f.name.ends_with("_effects.svg"));
    let svg = &figure.expect("a figure of effects").svg;
    // A time that does not differ measurably is marked.
    for number in ["42", "30", "37", "12.5", "≈ 12.8", "11", "300", "40", "0.5"] {
        assert!(has_text(svg, number), "{number}: {svg}");
    }
    for words in [
        "all effects",
        "without springs",
        "without drag",
        "operations",
        "steps",
    ] {
        assert!(has_text(svg, words), "{words}");
    }
    // A range for each time: a line and its two ends.
    let is_range = |line: &&str| line.starts_with("<polyline") && line.contains("#E69F00");
    assert_eq!(svg.lines().filter(is_range).count(), 9);
    assert!(!svg.contains(">\n-") && !svg.contains(">\n−"), "{svg}");
    // A bar for each cost, a dot for the change that is not 0.
    assert_eq!(svg.matches("fill=\"#0072B2\" stroke=\"none\"").count(), 8);
    assert_eq!(svg.matches("fill=\"#D55E00\" stroke=\"none\"").count(), 1);
    let mut unpriced = study.clone();
    unpriced.costs.clear();
    let without = bgdyn_accuracy::figures(&unpriced);
    assert!(without.iter().all(|f| !f.name.ends_with("_effects.svg")));
}

#[test]
fn no_figure_has_marks_of_code() {
    for figure in figures(&priced()) {
        assert!(!figure.svg.contains('`'), "{}", figure.name);
        assert!(figure.svg.contains("prefers-color-scheme: dark"));
    }
}

type V = SVector<f64, 1>;
type Nothing = SVector<f64, 0>;

/// ẋ = −x
struct Decay;

impl Plant for Decay {
    type State = V;
    type Modes = Nothing;
    type Values = Nothing;
    type Entries = Nothing;
    type Error = String;

    fn rates(&self, _: f64, y: &V, _: &Nothing) -> Result<V, String> {
        Ok(-y)
    }

    fn events(&self, _: f64, _: &V, _: &Nothing) -> Result<Nothing, String> {
        Ok(Nothing::zeros())
    }

    fn changes_mode(&self, _: usize) -> bool {
        false
    }

    fn change(
        &self,
        _: f64,
        y: &V,
        modes: &Nothing,
        _: impl Fn(usize) -> bool,
    ) -> Result<(V, Nothing), String> {
        Ok((*y, *modes))
    }

    fn nothing(&self) -> Nothing {
        Nothing::zeros()
    }

    fn energy(&self, _: f64, _: &V, _: &Nothing) -> Result<Nothing, String> {
        Ok(Nothing::zeros())
    }

    fn power(&self, _: f64, _: &V, _: &Nothing) -> Result<Power<Nothing>, String> {
        Ok(Power {
            supplied: Nothing::zeros(),
            dissipated: Nothing::zeros(),
        })
    }
}

impl bgdyn_accuracy::Measured for Decay {
    fn measured(&self, _: f64, y: &V, _: &Nothing) -> Vec<f64> {
        y.as_slice().to_vec()
    }
}

/// ẋ = −x with step control: consecutive steps to the end, more of them for a longer run.
#[test]
fn steps_are_counted() {
    use bgdyn_sim::{HybridState, WithIntegrator};
    let steps = |end: f64| {
        let count = CountSteps {
            plant: Decay,
            begin: HybridState {
                t: 0.0,
                y: V::repeat(1.0),
                modes: SVector::zeros(),
            },
            end,
        };
        count.with(bgdyn_sim::Dopri5).expect("a run")
    };
    let (short, long) = (steps(0.1), steps(10.0));
    assert!((1..10).contains(&short), "{short}");
    // At the tolerance 1e-6 the fifth order takes steps of some tenths of a second.
    assert!((10..200).contains(&long), "{long}");
}

#[test]
fn the_page_fetches_nothing_and_holds_every_figure() {
    let study = studied(RIGHT);
    assert!(!targets(&study).is_empty());
    let machine = bgdyn_accuracy::Machine::here();
    let page = page(std::slice::from_ref(&study), &machine);
    for figure in figures(&study) {
        assert!(page.contains(&figure.svg), "{}", figure.name);
    }
    let fetched = page.replace("http://www.w3.org/2000/svg", "");
    for word in ["http", "<script", "<link", "src="] {
        assert!(!fetched.contains(word), "{word}");
    }
}
