//! Controllers that a computer samples: measured at fixed instants, with noise and steps of the sensors, and held.
//!
//! A plant with such controllers has a [`Sampler`]. [`crate::Run`] ends a step at each of its instants
//! ([`Sampler::next`], part of [`crate::Plant::next_corner`]) and then calls [`Sampler::reached`], by way of
//! [`crate::Plant::reached`]. Between them the controllers' inputs are constant.

use bgdyn_runtime::random::Random;
use bgdyn_runtime::{SampledControl, Scalar, StateVector};

use crate::real::{Of, Real};

/// Values on their way: those of a delay of [`SampledControl::DELAYS`] periods, and one more.
const WAITING: usize = SampledControl::DELAYS + 1;

/// The state of sampled controllers: what they have computed, and when it acts. Until [`Sampler::reached`] is first
/// called the controllers are continuous.
#[derive(Clone, Debug)]
pub struct Sampler<U: StateVector> {
    /// Number of the next sample, once there was a first look.
    next: Option<u64>,
    /// Values that were computed and do not act yet, with the instants at which they will, in their order.
    waiting: [Option<(Of<U>, U)>; WAITING],
    /// The values that act, and since when; `None` before the first ones do.
    held: Option<(Of<U>, U)>,
    /// The values before these: points of the last step are read after it.
    before: Option<U>,
    random: Random,
}

impl<U: StateVector> Default for Sampler<U> {
    fn default() -> Self {
        Sampler {
            next: None,
            waiting: [const { None }; WAITING],
            held: None,
            before: None,
            random: Random(0),
        }
    }
}

impl<U: StateVector> Sampler<U>
where
    Of<U>: Real,
{
    /// Returns the first instant after `t` at which the controllers sample or a value of them begins to act; `None`
    /// before the first call of [`Sampler::reached`].
    pub fn next(&self, control: &SampledControl<'_>) -> Option<Of<U>> {
        let sample = instant(control, self.next?);
        let acts = self.waiting[0].as_ref().map(|(at, _)| *at);
        Some(acts.map_or(sample, |at| sample.min(at)))
    }

    /// Does what is due at `t`: samples the state, and lets values act whose delay is over. `inputs` are all inputs at
    /// a measured state.
    pub fn reached<Y: StateVector<Scalar = Of<U>>>(
        &mut self,
        control: &SampledControl<'_>,
        t: Of<U>,
        y: &Y,
        inputs: impl FnOnce(&Y) -> U,
    ) {
        let next = self.next.unwrap_or_else(|| {
            self.random = Random(control.seed);
            first_sample(control, t)
        });
        self.next = Some(next);
        let at: Of<U> = instant(control, next);
        if at <= t {
            let measured = self.measured(control, y);
            let mut values = inputs(&measured);
            for (&i, &step) in control.controlled.iter().zip(control.input_resolution) {
                let value = &mut values.entries_mut()[i];
                *value = rounded(*value, step);
            }
            let delay = Of::<U>::from_f64(control.delay);
            let free = self.waiting.iter_mut().find(|waiting| waiting.is_none());
            if let Some(free) = free {
                *free = Some((at + delay, values));
            }
            self.next = Some(next + 1);
        }
        while self.waiting[0].as_ref().is_some_and(|(at, _)| *at <= t) {
            let acts = self.waiting[0].take();
            self.waiting.rotate_left(1);
            self.before = self.held.take().map(|(_, values)| values);
            self.held = acts;
        }
    }

    /// Returns the inputs at `t`: those of controllers are held, 0 before their first value acts.
    pub fn hold(&self, control: &SampledControl<'_>, t: Of<U>, mut inputs: U) -> U {
        if self.next.is_none() {
            return inputs;
        }
        let acting = match &self.held {
            Some((since, values)) if *since <= t => Some(values),
            Some(_) => self.before.as_ref(),
            None => None,
        };
        let zero = Of::<U>::from_f64(0.0);
        for &i in control.controlled {
            let value = acting.map_or(zero, |values| values.entries()[i]);
            inputs.entries_mut()[i] = value;
        }
        inputs
    }

    /// Returns the state as the sensors give it. Each number of a sample takes the next random numbers, in the order
    /// of the state.
    fn measured<Y: StateVector<Scalar = Of<U>>>(
        &mut self,
        control: &SampledControl<'_>,
        y: &Y,
    ) -> Y {
        let mut measured = y.clone();
        let sensors = control.noise.iter().zip(control.resolution);
        for (x, (&noise, &step)) in measured.entries_mut().iter_mut().zip(sensors) {
            if noise > 0.0 {
                *x = *x + Of::<U>::from_f64(noise * normal(&mut self.random));
            }
            *x = rounded(*x, step);
        }
        measured
    }
}

/// Returns the instant of a sample, s.
fn instant<T: Real>(control: &SampledControl<'_>, sample: u64) -> T {
    T::from_f64(sample as f64) * T::from_f64(control.period)
}

/// Returns the number of the first sample that is not before `t`, within rounding.
fn first_sample<T: Real>(control: &SampledControl<'_>, t: T) -> u64 {
    let near = t.to_f64() / control.period;
    // The cast is 0 for negative times.
    let mut sample = near as u64;
    while instant::<T>(control, sample) < t {
        sample += 1;
    }
    sample
}

/// Returns the nearest multiple of a step, and the number itself for a step of 0.
fn rounded<T: Real>(x: T, step: f64) -> T {
    /// Above this every number is an integer.
    const INTEGERS: f64 = 4503599627370496.0;
    let steps = x.to_f64() / step;
    if step <= 0.0 || !steps.is_finite() || steps.abs() >= INTEGERS {
        return x;
    }
    let whole = (steps.abs() + 0.5) as u64 as f64;
    T::from_f64(if steps < 0.0 { -whole } else { whole } * step)
}

/// Returns a normally distributed number of mean 0 and deviation 1 (Box and Muller 1958).
fn normal(random: &mut Random) -> f64 {
    let radius = Scalar::sqrt(-2.0 * Scalar::ln(1.0 - random.unit()));
    let (_, cosine) = Scalar::sin_cos(core::f64::consts::TAU * random.unit());
    radius * cosine
}
