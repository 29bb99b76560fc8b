//! Runs a generated scene: fixed steps of the classical Runge–Kutta method, events located within
//! the step, and an account of where the energy went.

use bgdyn_runtime::{Balance, Scalar, System, settle};
use nalgebra::SVector;

use crate::plus_scaled;

/// A scene at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment<T: Scalar, const N: usize, const NM: usize> {
    /// Time, s.
    pub t: T,
    /// Positions, velocities, first-order states.
    pub y: SVector<T, N>,
    /// Modes.
    pub modes: SVector<T, NM>,
}

/// One step of length `h`, s, of the classical Runge–Kutta method (Kutta 1901) with the modes held.
/// Inputs that the scene does not drive itself are `given`.
///
/// # Errors
/// Where the mass matrix is singular at one of the four stages.
pub fn rk4_scene_step<
    S,
    T,
    const N: usize,
    const NM: usize,
    const NU: usize,
    const NE: usize,
    const NY: usize,
    const NP: usize,
>(
    scene: &S,
    at: &Moment<T, N, NM>,
    h: T,
    given: &SVector<T, NU>,
) -> Result<SVector<T, N>, S::Singular>
where
    S: System<T, N, NM, NU, NE, NY, NP>,
    T: Scalar,
{
    let rates = |t: T, y: &SVector<T, N>| {
        let input = scene.input(y, &at.modes, given, t);
        scene.derivative(y, &at.modes, &input, t)
    };
    let half = h * T::from_f64(0.5);
    let k1 = rates(at.t, &at.y)?;
    let k2 = rates(at.t + half, &plus_scaled(&at.y, half, &k1))?;
    let k3 = rates(at.t + half, &plus_scaled(&at.y, half, &k2))?;
    let k4 = rates(at.t + h, &plus_scaled(&at.y, h, &k3))?;
    let one = T::from_f64(1.0);
    let middle = plus_scaled(&k2, one, &k3);
    let ends = plus_scaled(&k1, one, &k4);
    let sum = plus_scaled(&ends, T::from_f64(2.0), &middle);
    Ok(plus_scaled(&at.y, h / T::from_f64(6.0), &sum))
}

/// Where the energy of a run went, J: for each entry what it supplied, stores more than at the
/// start, and dissipated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Audit<T: Scalar, const NP: usize> {
    /// Work that came from outside.
    pub supplied: SVector<T, NP>,
    /// What is stored more than at the start.
    pub stored: SVector<T, NP>,
    /// Work that was lost.
    pub dissipated: SVector<T, NP>,
}

impl<T: Scalar, const NP: usize> Audit<T, NP> {
    /// What the sums do not account for: the integration's error, in J.
    pub fn drift(&self) -> T {
        let zero = T::from_f64(0.0);
        let sum = |x: &SVector<T, NP>| x.iter().fold(zero, |sum, &x| sum + x);
        sum(&self.stored) + sum(&self.dissipated) - sum(&self.supplied)
    }
}

/// Why a run ended early. The state is that of the last step that succeeded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure<E> {
    /// The mass matrix is singular.
    Singular(E),
    /// A part of the state is no finite number any more.
    NotFinite,
    /// So many events followed each other within one step that time would not go on.
    TooManyEvents,
}

/// Events within one step at the most.
const EVENTS: usize = 64;

/// Halvings of the interval that holds an event: of a step of 1 ms 1e-15 s are left.
const HALVINGS: usize = 40;

/// A run of a scene.
pub struct Run<
    'a,
    S,
    const N: usize,
    const NM: usize,
    const NU: usize,
    const NE: usize,
    const NY: usize,
    const NP: usize,
> {
    scene: &'a S,
    /// Inputs that the scene does not drive itself.
    pub given: SVector<f64, NU>,
    /// Where it is.
    pub at: Moment<f64, N, NM>,
    /// Events that changed a mode, so far.
    pub events: usize,
    /// When the last of them was, s.
    pub last_event: f64,
    /// Energy at the start, once there was a step.
    start: Option<[f64; NP]>,
    supplied: SVector<f64, NP>,
    dissipated: SVector<f64, NP>,
}

impl<
    'a,
    S,
    const N: usize,
    const NM: usize,
    const NU: usize,
    const NE: usize,
    const NY: usize,
    const NP: usize,
> Run<'a, S, N, NM, NU, NE, NY, NP>
where
    S: System<f64, N, NM, NU, NE, NY, NP>,
{
    /// From where the scene begins.
    pub fn new(scene: &'a S) -> Self {
        let (y, modes) = scene.start();
        Self::from(scene, Moment { t: 0.0, y, modes })
    }

    /// From anywhere.
    pub fn from(scene: &'a S, at: Moment<f64, N, NM>) -> Self {
        Run {
            scene,
            given: SVector::zeros(),
            start: None,
            at,
            events: 0,
            last_event: 0.0,
            supplied: SVector::zeros(),
            dissipated: SVector::zeros(),
        }
    }

    /// Where the energy went since the start.
    pub fn audit(&self) -> Audit<f64, NP> {
        let now = self.energy();
        let start = self.start.unwrap_or(now);
        Audit {
            supplied: self.supplied,
            stored: SVector::from_fn(|i, _| now[i] - start[i]),
            dissipated: self.dissipated,
        }
    }

    /// Energy stored now, entry by entry.
    fn energy(&self) -> [f64; NP] {
        let at = &self.at;
        self.scene.energy(&at.y, &at.modes, &self.input(at), at.t)
    }

    /// The inputs at an instant.
    pub fn input(&self, at: &Moment<f64, N, NM>) -> SVector<f64, NU> {
        self.scene.input(&at.y, &at.modes, &self.given, at.t)
    }

    /// One step of length `h`, s; where an event falls into it, up to the event and on from there.
    ///
    /// # Errors
    /// Where the scene cannot go on.
    pub fn step(&mut self, h: f64) -> Result<(), Failure<S::Singular>> {
        self.start = self.start.or_else(|| Some(self.energy()));
        let mut left = h;
        for _ in 0..EVENTS {
            let taken = self.piece(left)?;
            left -= taken;
            if left <= h * 1e-12 {
                return Ok(());
            }
        }
        Err(Failure::TooManyEvents)
    }

    /// A step of length `h` at the most, up to the first event. Gives its length.
    fn piece(&mut self, h: f64) -> Result<f64, Failure<S::Singular>> {
        let before = self.values(&self.at)?;
        let whole = self.moved(h)?;
        let after = self.values(&whole)?;
        let crosses = |a: &SVector<f64, NE>, b: &SVector<f64, NE>| {
            (0..NE).find(|&e| a[e] >= 0.0 && b[e] < 0.0 && self.scene.event_modes()[e].is_some())
        };
        if crosses(&before, &after).is_none() {
            self.account(&whole, h)?;
            self.at = whole;
            return Ok(h);
        }
        // The last instant before the first event.
        let (mut low, mut high) = (0.0, h);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let there = self.moved(middle)?;
            match crosses(&before, &self.values(&there)?) {
                Some(_) => high = middle,
                None => low = middle,
            }
        }
        let there = self.moved(high)?;
        let event = crosses(&before, &self.values(&there)?);
        self.account(&there, high)?;
        self.at = there;
        if let Some(mode) = event.and_then(|e| self.scene.event_modes()[e]) {
            self.change(mode)?;
        }
        Ok(high)
    }

    /// A mode changes: what slipped comes to rest, what was held breaks away. All joints at rest are
    /// decided together.
    fn change(&mut self, mode: usize) -> Result<(), Failure<S::Singular>> {
        self.events += 1;
        self.last_event = self.at.t;
        let input = self.input(&self.at);
        let Moment { t, y, modes } = &mut self.at;
        if modes[mode] != 0.0 {
            // What the search for the instant has left of its slip would stay for ever.
            let contacts = self.scene.contacts(y, modes, &input, *t);
            let slip = contacts.map_err(Failure::Singular)?[mode].slip;
            y[self.scene.mode_velocities()[mode]] -= slip;
            modes[mode] = 0.0;
        }
        let settled = settle(self.scene, y, modes, &input, *t, 0.0);
        *modes = settled.map_err(Failure::Singular)?;
        Ok(())
    }

    fn moved(&self, h: f64) -> Result<Moment<f64, N, NM>, Failure<S::Singular>> {
        let y = rk4_scene_step(self.scene, &self.at, h, &self.given).map_err(Failure::Singular)?;
        if y.iter().any(|x| !x.is_finite()) {
            return Err(Failure::NotFinite);
        }
        Ok(Moment {
            t: self.at.t + h,
            y,
            modes: self.at.modes,
        })
    }

    fn values(&self, at: &Moment<f64, N, NM>) -> Result<SVector<f64, NE>, Failure<S::Singular>> {
        let events = self.scene.events(&at.y, &at.modes, &self.input(at), at.t);
        events.map_err(Failure::Singular)
    }

    /// Adds up work by Simpson's rule, the middle by Hermite's cubic.
    fn account(&mut self, to: &Moment<f64, N, NM>, h: f64) -> Result<(), Failure<S::Singular>> {
        let rates = |at: &Moment<f64, N, NM>| {
            let input = self.input(at);
            let rates = self.scene.derivative(&at.y, &at.modes, &input, at.t);
            rates.map_err(Failure::Singular)
        };
        let (f0, f1) = (rates(&self.at)?, rates(to)?);
        let middle = Moment {
            t: self.at.t + 0.5 * h,
            y: (self.at.y + to.y) * 0.5 + (f0 - f1) * (h / 8.0),
            modes: self.at.modes,
        };
        for (at, weight) in [(&self.at, 1.0), (&middle, 4.0), (to, 1.0)] {
            let input = self.input(at);
            let power = self.scene.power(&at.y, &at.modes, &input, at.t);
            let power: [Balance<f64>; NP] = power.map_err(Failure::Singular)?;
            for (i, entry) in power.iter().enumerate() {
                self.supplied[i] += entry.supplied * weight * h / 6.0;
                self.dissipated[i] += entry.dissipated * weight * h / 6.0;
            }
        }
        Ok(())
    }
}
