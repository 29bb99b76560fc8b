//! Runs a plant with an integrator, and samples it at given times.

use std::fmt::Debug;

use bgdyn_sim::event_driven::EventError;
use bgdyn_sim::{
    EventDriven, HybridState, Integrator, Of, Plant, Real, Reason, Run, Tolerance, WithIntegrator,
};

use crate::configuration::{Grid, RunError, StepControl};

/// A plant with a measured output.
pub trait Measured: Plant {
    /// Returns the measured output at a time, in a state; NaN if it does not exist.
    fn measured(
        &self,
        t: Of<Self::State>,
        state: &Self::State,
        modes: &Self::Modes,
    ) -> Vec<Of<Self::State>>;

    /// Describes the reason for which there are no rates, in a few words.
    fn in_words(error: &Self::Error) -> String {
        named(error)
    }
}

/// A scene whose rigid contacts are solved from event to event.
impl<P: Measured> Measured for EventDriven<P>
where
    Of<P::State>: Real,
{
    fn measured(&self, t: Of<P::State>, y: &P::State, modes: &Self::Modes) -> Vec<Of<P::State>> {
        self.plant.measured(t, y, &modes.plant)
    }

    fn in_words(error: &Self::Error) -> String {
        match error {
            EventError::Plant(error) => P::in_words(error),
            error => error.to_string(),
        }
    }
}

/// A run to be made, by any integrator.
#[derive(Debug)]
pub struct Integrate<'a, P: Plant> {
    /// The plant.
    pub plant: P,
    /// Its start.
    pub begin: HybridState<P::State, P::Modes>,
    /// The sample times.
    pub grid: &'a Grid,
    /// The choice of its steps.
    pub step_control: StepControl,
}

/// The measured output at each sample, or the reason for an early end.
pub(crate) type SampledOutput<T> = Result<Vec<Vec<T>>, RunError>;

impl<P: Measured> WithIntegrator<P::State> for Integrate<'_, P>
where
    Of<P::State>: Real,
{
    type Output = SampledOutput<Of<P::State>>;

    fn with<M: Integrator<P::State>>(self, integrator: M) -> Self::Output {
        let number = |x: f64| <Of<P::State> as bgdyn_runtime::Scalar>::from_f64(x);
        // Divided in the run's own scalar, so that steps in double-double end exactly at the samples.
        let interval = number(self.grid.end) / number(self.grid.samples as f64);
        let mut run = Run::by(integrator, self.plant, self.begin).unaudited();
        let (steps, h) = match self.step_control {
            StepControl::Step(h) => {
                let parts = self.grid.parts(h);
                (parts, interval / number(parts as f64))
            }
            StepControl::Tolerance(tolerance) => {
                let tolerance = number(tolerance);
                run = run.with_tolerance(Tolerance {
                    absolute: tolerance,
                    relative: tolerance,
                });
                (1, interval)
            }
        };
        let mut samples = Vec::with_capacity(self.grid.samples);
        for _ in 0..self.grid.samples {
            for _ in 0..steps {
                run.step(h).map_err(|failure| RunError {
                    t: failure.t.to_f64(),
                    why: in_short(&failure.reason, P::in_words),
                })?;
            }
            samples.push(run.plant().measured(run.t(), run.y(), run.modes()));
        }
        Ok(samples)
    }
}

/// Describes a reason in a few words; `words` describes why there are no rates.
pub(crate) fn in_short<E>(reason: &Reason<E>, words: impl Fn(&E) -> String) -> String {
    match reason {
        Reason::Singular(error) => words(error),
        Reason::NotFinite => "unstable: not finite".into(),
        Reason::NoConvergence { .. } => "stages not solved".into(),
        Reason::SingularMatrix => "matrix of the stages singular".into(),
        Reason::RigidContacts => "knows no rigid contacts".into(),
        Reason::ImpactLaw => "has another law of impacts".into(),
        Reason::NoJacobian => "needs slopes".into(),
        Reason::StepTooSmall { h, .. } => format!("steps below {h:.0e} s"),
        Reason::TooManyEvents { .. } => "too many events".into(),
    }
}

/// Describes an error that is, or prints as, the name of what has no rate.
pub(crate) fn named<E: Debug>(error: &E) -> String {
    format!("no rate of {}", format!("{error:?}").trim_matches('"'))
}

/// Returns the largest distance between two sequences of an output.
pub(crate) fn distance<T: Real>(a: &[Vec<T>], b: &[Vec<T>]) -> f64 {
    let apart = |(a, b): (&Vec<T>, &Vec<T>)| {
        let parts = a.iter().zip(b).map(|(&a, &b)| (a - b).to_f64());
        parts.map(|d| d * d).sum::<f64>().sqrt()
    };
    a.iter().zip(b).map(apart).fold(0.0, |most: f64, x| {
        // A distance that is NaN is larger than all others.
        if x.is_nan() {
            f64::INFINITY
        } else {
            most.max(x)
        }
    })
}

/// Converts the numbers to `f64`.
pub(crate) fn numbers<T: Real>(values: Vec<Vec<T>>) -> Vec<Vec<f64>> {
    let all = values.into_iter();
    all.map(|row| row.into_iter().map(Real::to_f64).collect())
        .collect()
}
