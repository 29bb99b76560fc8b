//! Measures the cost of an effect: operations and time of `derivative` with and without it, and steps of a
//! run.

use std::hint::black_box;
use std::rc::Rc;

use bgdyn_runtime::HybridSystem;
use bgdyn_sim::{
    Dopri5, HybridState, Integrator, Of, Plant, Real, Run, ScenePlant, Tolerance, WithIntegrator,
};

use crate::clock::{Spread, calls};
use crate::configuration::RunError;
use crate::dyn_plant::DynPlant;
use crate::integrate::{Measured, in_short};
use crate::priced::{Call, Priced};
use crate::scheme::Scheme;
use crate::step_sequence::Effort;
use crate::table::write_csv;
use crate::test_case::TestCase;

/// The integrator with which steps are counted.
pub const METHOD: &str = "dopri5";
/// Its tolerance, absolute and relative, in SI units.
pub const TOLERANCE: f64 = 1e-6;
/// Runs of more steps are stopped.
const STEPS: usize = 1_000_000;

/// The measured cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Cost {
    /// The effects of the scene: `all`, `all but friction`.
    pub effects: String,
    /// Operations of one call of `derivative`.
    pub operations: usize,
    /// Time of one call, ns.
    pub ns: Spread,
    /// Steps of [`METHOD`] in the scene's run; `None` if the run ends early.
    pub steps: Option<usize>,
}

/// Returns all costs; the times are measured in turn.
pub(crate) fn costs(all: &[Priced], end: f64, effort: &Effort) -> Vec<Cost> {
    let compiled = |p: &Priced| matches!(p.call, Call::Compiled(_));
    let jobs = all.iter().filter_map(|p| match &p.call {
        Call::Compiled(call) => Some(&**call),
        Call::Estimated(_) => None,
    });
    let mut times = calls(&jobs.collect::<Vec<_>>(), effort).into_iter();
    let one = |p: &Priced| Cost {
        effects: p.effects.clone(),
        operations: p.operations,
        ns: match (compiled(p), &p.call) {
            (false, Call::Estimated(ns)) => Spread::exact(*ns),
            _ => times.next().unwrap_or(Spread::exact(f64::NAN)),
        },
        steps: (p.steps)(end).ok(),
    };
    all.iter().map(one).collect()
}

/// Counts the steps of a run with step control.
#[derive(Debug)]
pub struct CountSteps<P: Plant> {
    /// The plant.
    pub plant: P,
    /// Its start.
    pub begin: HybridState<P::State, P::Modes>,
    /// End of the run, s.
    pub end: f64,
}

impl<P: Measured> WithIntegrator<P::State> for CountSteps<P>
where
    Of<P::State>: Real,
{
    type Output = Result<usize, RunError>;

    fn with<M: Integrator<P::State>>(self, integrator: M) -> Self::Output {
        let number = |x: f64| <Of<P::State> as bgdyn_runtime::Scalar>::from_f64(x);
        let tolerance = Tolerance {
            absolute: number(TOLERANCE),
            relative: number(TOLERANCE),
        };
        let run = Run::by(integrator, self.plant, self.begin).unaudited();
        let mut run = run.with_tolerance(tolerance);
        for steps in 0..STEPS {
            let left = self.end - run.t().to_f64();
            if left <= 1e-12 * self.end {
                return Ok(steps);
            }
            let taken = run.advance_densely(number(left));
            taken.map_err(|failure| RunError {
                t: failure.t.to_f64(),
                why: in_short(&failure.reason, P::in_words),
            })?;
        }
        let why = format!("more than {STEPS:e} steps");
        let t = run.t().to_f64();
        Err(RunError { t, why })
    }
}

impl TestCase {
    /// Adds the scene with these effects, whose `derivative` has this number of operations, to the costs
    /// to measure: operations and time of `derivative`, without rigid contacts, and steps of a run.
    pub fn price<S, C: Scheme>(&mut self, effects: &str, operations: usize, scene: S, _: C)
    where
        S: HybridSystem<f64> + 'static,
    {
        let scene: &'static S = Box::leak(Box::new(scene));
        let begin = Run::begin(scene);
        let plant = ScenePlant::new(scene);
        let input = plant.input(begin.t, &begin.y, &begin.modes);
        let call = move |times: usize| {
            let (y, modes) = (begin.y, begin.modes);
            for _ in 0..times {
                let (y, modes) = (black_box(&y), black_box(&modes));
                let _ = black_box(
                    scene
                        .derivative(y, modes, black_box(&input), begin.t)
                        .is_ok(),
                );
            }
        };
        self.prices.push(Priced {
            effects: effects.into(),
            operations,
            call: Call::Compiled(Box::new(call)),
            steps: Box::new(move |end| {
                let plant = DynPlant(Rc::new(ScenePlant::new(scene)));
                let (plant, begin) = C::scene((plant, Run::begin(scene)));
                CountSteps { plant, begin, end }.with(Dopri5)
            }),
        });
    }
}

/// The columns, in their order.
const COLUMNS: [&str; 8] = [
    "scene",
    "effects",
    "operations",
    "ns_per_call",
    "ns_least",
    "ns_first_quartile",
    "ns_third_quartile",
    "steps",
];

/// Returns costs as CSV, with a header; each with its scene's name.
pub fn costs_csv<'a>(costs: impl IntoIterator<Item = (&'a str, &'a Cost)>) -> String {
    let header = COLUMNS.map(str::to_owned).to_vec();
    let rows = costs.into_iter().map(|(scene, cost)| {
        let scene = std::iter::once(scene.to_owned());
        scene.chain(cost.record()).collect()
    });
    write_csv(std::iter::once(header).chain(rows))
}

impl Cost {
    /// Returns its fields, without the scene.
    pub(crate) fn record(&self) -> [String; 7] {
        let [first, third] = self.ns.quartiles;
        let [median, least, first, third] =
            [self.ns.median, self.ns.least, first, third].map(|ns| format!("{ns:.3e}"));
        [
            self.effects.clone(),
            self.operations.to_string(),
            median,
            least,
            first,
            third,
            self.steps.map_or(String::new(), |n| n.to_string()),
        ]
    }

    /// Parses a cost from its fields; `None` if they are invalid.
    pub(crate) fn of_record(fields: Vec<String>) -> Option<Cost> {
        let [effects, operations, median, least, first, third, steps] =
            <[String; 7]>::try_from(fields).ok()?;
        Some(Cost {
            effects,
            operations: operations.parse().ok()?,
            ns: Spread {
                least: least.parse().ok()?,
                quartiles: [first.parse().ok()?, third.parse().ok()?],
                median: median.parse().ok()?,
            },
            steps: match steps.as_str() {
                "" => None,
                steps => Some(steps.parse().ok()?),
            },
        })
    }
}
