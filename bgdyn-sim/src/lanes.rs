//! Runs several states at once, one in each lane of a SIMD register, by an explicit integrator with fixed
//! steps.
//!
//! Every lane does the same operations as a [`crate::Solver`] with fixed steps, so its states equal those
//! of that run bit for bit (if the target has fused multiply-add, both must be compiled for it). Lanes
//! differ in their states and in the model's run-time parameters, which are lanes, too.
//!
//! A lane ends at its last state if its mass matrix is singular, or if its next state would not be finite;
//! the other lanes continue.

use core::convert::Infallible;
use core::marker::PhantomData;

use bgdyn_runtime::{Dynamics, FixedVector, HybridSystem, Scalar, Singular, StateVector};
use nalgebra::SVector;

use crate::integrator::{Integrator, Start};
use crate::ode::Ode;
use crate::quasi_joints;
use crate::real::{Of, Real};
use crate::scene_positions::{self, position_rates};
use crate::two_sum::sum_in_two;

/// A scalar that has one number per lane; a plain number has one lane.
pub trait Lanes: Scalar {
    /// Number of lanes.
    const LANES: usize;
    /// The type of the number in a lane.
    type Word: Real;

    /// Builds the scalar from one number per lane.
    fn pack(lane: impl FnMut(usize) -> Self::Word) -> Self;

    /// Returns the number in lane `k`, below [`Lanes::LANES`].
    fn lane(self, k: usize) -> Self::Word;

    /// Returns the accelerations of an error: those of the lanes that succeeded, NaN in the others.
    fn accelerations<const N: usize>(error: Self::Singular<N>) -> SVector<Self, N>;
}

/// The error of a scene's `derivative` in lanes; some lanes may have succeeded.
pub trait LaneError<T> {
    /// Returns rate `i` (velocities first, then first-order states): values in the lanes that succeeded,
    /// NaN in the others.
    fn rate(&self, i: usize) -> T;
}

macro_rules! one_lane {
    ($($float:ident),*) => {$(
        impl Lanes for $float {
            const LANES: usize = 1;
            type Word = $float;

            fn pack(mut lane: impl FnMut(usize) -> $float) -> Self {
                lane(0)
            }

            fn lane(self, _: usize) -> $float {
                self
            }

            fn accelerations<const N: usize>(error: Singular) -> SVector<Self, N> {
                SVector::from_fn(|i, _| error.rate(i))
            }
        }

        impl LaneError<$float> for Singular {
            fn rate(&self, _: usize) -> $float {
                $float::NAN
            }
        }
    )*};
}

one_lane!(f32, f64);

#[cfg(feature = "wide")]
mod registers {
    use bgdyn_runtime::LaneSingular;
    use bgdyn_runtime::wide::{f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};
    use nalgebra::SVector;

    use super::{LaneError, Lanes};

    macro_rules! lanes {
        ($($lanes:ident: $float:ident, $n:literal;)*) => {$(
            impl Lanes for $lanes {
                const LANES: usize = $n;
                type Word = $float;

                fn pack(lane: impl FnMut(usize) -> $float) -> Self {
                    Self::new(core::array::from_fn(lane))
                }

                fn lane(self, k: usize) -> $float {
                    self.to_array()[k]
                }

                fn accelerations<const N: usize>(
                    error: LaneSingular<Self, $n, N>,
                ) -> SVector<Self, N> {
                    SVector::from_fn(|i, _| error.rate(i))
                }
            }

            impl<const N: usize> LaneError<$lanes> for LaneSingular<$lanes, $n, N> {
                fn rate(&self, i: usize) -> $lanes {
                    let rates = self.accelerations[i].to_array();
                    $lanes::pack(|k| match self.errors[k] {
                        None => rates[k],
                        Some(_) => $float::NAN,
                    })
                }
            }
        )*};
    }

    lanes! {
        f64x2: f64, 2;
        f64x4: f64, 4;
        f64x8: f64, 8;
        f32x4: f32, 4;
        f32x8: f32, 8;
        f32x16: f32, 16;
    }
}

/// Packs one state per lane; lanes beyond the last state repeat it.
///
/// # Panics
/// If `states` is empty.
pub fn packed<T: Lanes, const N: usize>(states: &[SVector<T::Word, N>]) -> SVector<T, N> {
    SVector::from_fn(|i, _| T::pack(|k| states[k.min(states.len() - 1)][i]))
}

/// Returns the state in lane `k`.
pub fn unpacked<T: Lanes, const N: usize>(states: &SVector<T, N>, k: usize) -> SVector<T::Word, N> {
    states.map(|x| x.lane(k))
}

/// A mechanism under the efforts τ(t, q, v), in any scalar; y is q followed by v, so that `Y` is 2 `N`.
#[derive(Debug)]
pub struct Driven<'a, T, M, F, const N: usize, const Y: usize> {
    model: &'a M,
    efforts: F,
    scalar: PhantomData<T>,
}

impl<'a, T, M, F, const N: usize, const Y: usize> Driven<'a, T, M, F, N, Y>
where
    T: Lanes,
    M: Dynamics<T, N, N>,
    F: Fn(T, &SVector<T, N>, &SVector<T, N>) -> SVector<T, N>,
{
    /// Returns the mechanism under these efforts.
    pub fn new(model: &'a M, efforts: F) -> Self {
        const { assert!(Y == 2 * N, "y is q, then v") };
        Driven {
            model,
            efforts,
            scalar: PhantomData,
        }
    }
}

impl<T, M, F, const N: usize, const Y: usize> Ode for Driven<'_, T, M, F, N, Y>
where
    T: Lanes,
    M: Dynamics<T, N, N>,
    F: Fn(T, &SVector<T, N>, &SVector<T, N>) -> SVector<T, N>,
{
    type State = SVector<T, Y>;
    type Error = Infallible;

    fn rates(&self, t: T, y: &SVector<T, Y>) -> Result<SVector<T, Y>, Infallible> {
        let q: SVector<T, N> = SVector::from_fn(|i, _| y[i]);
        let v: SVector<T, N> = SVector::from_fn(|i, _| y[N + i]);
        let tau = (self.efforts)(t, &q, &v);
        let found = self.model.forward_dynamics(&q, &v, &tau);
        let a = found.unwrap_or_else(T::accelerations);
        Ok(SVector::from_fn(|i, _| if i < N { v[i] } else { a[i - N] }))
    }

    fn positions(&self) -> usize {
        N
    }

    fn position_rates(&self, _: T, y: &SVector<T, Y>) -> Result<SVector<T, Y>, Infallible> {
        let mut rates = *y;
        quasi_joints::position_rates(&[], N, y.entries(), rates.entries_mut());
        Ok(rates)
    }
}

/// A scene without dry friction that can hold and without rigid contacts, in any scalar. Kinks of its laws and corners of its inputs are
/// stepped over: there the method loses its order, and [`crate::Run`] would not.
#[derive(Debug)]
pub struct SmoothScene<'a, T: Lanes, S: HybridSystem<T>> {
    scene: &'a S,
    /// Inputs that the scene does not drive.
    pub given: S::Inputs,
}

impl<'a, T, S> SmoothScene<'a, T, S>
where
    T: Lanes,
    S: HybridSystem<T, Modes = SVector<T, 0>, Singular: LaneError<T>>,
{
    /// Returns the scene with all given inputs at 0.
    pub fn new(scene: &'a S) -> Self {
        let given = S::Inputs::zero_vector();
        SmoothScene { scene, given }
    }

    /// Returns all inputs at an instant.
    pub fn input(&self, t: T, y: &S::State) -> S::Inputs {
        self.scene
            .input(y, &S::Modes::zero_vector(), &self.given, t)
    }

    /// Returns the outputs of the scene at an instant.
    pub fn output(&self, t: T, y: &S::State) -> S::Outputs {
        let input = self.input(t, y);
        self.scene.output(y, &S::Modes::zero_vector(), &input, t)
    }
}

impl<T, S> Ode for SmoothScene<'_, T, S>
where
    T: Lanes,
    S: HybridSystem<T, Modes = SVector<T, 0>, Singular: LaneError<T>>,
{
    type State = S::State;
    type Error = Infallible;

    fn rates(&self, t: T, y: &S::State) -> Result<S::State, Infallible> {
        let input = self.input(t, y);
        let found = self
            .scene
            .derivative(y, &S::Modes::zero_vector(), &input, t);
        Ok(found.unwrap_or_else(|error| {
            let positions = self.scene.positions();
            let rates = position_rates(self.scene, y);
            S::State::from_entries(|i| match i.checked_sub(positions) {
                None => rates.entries()[i],
                Some(i) => error.rate(i),
            })
        }))
    }

    fn positions(&self) -> usize {
        self.scene.positions()
    }

    fn position_rates(&self, _: T, y: &S::State) -> Result<S::State, Infallible> {
        Ok(position_rates(self.scene, y))
    }

    fn position_change(&self, _: T, y: &S::State, h: T) -> Result<S::State, Infallible> {
        Ok(scene_positions::position_change(self.scene, y, h))
    }

    fn rigid_contacts(&self) -> usize {
        self.scene.rigid_contact_names().len()
    }

    fn project(&self, _: T, y: &mut S::State) -> Result<bool, Infallible> {
        // In a lane with a loop that does not close, its positions are NaN, and the lane ends.
        Ok(scene_positions::project(self.scene, y).unwrap_or(true))
    }
}

/// Runs in lanes, with their current time and states.
#[derive(Clone, Debug)]
pub struct LaneRun<Y: StateVector> {
    t: Of<Y>,
    /// Rounding error of the time.
    low_time: Of<Y>,
    y: Y,
    /// End time of each lane; infinity while it runs.
    ended: Of<Y>,
}

impl<Y: StateVector> LaneRun<Y>
where
    Of<Y>: Lanes,
{
    /// Returns runs from these states, at t = 0.
    pub fn new(y: Y) -> Self {
        let zero = Of::<Y>::from_f64(0.0);
        LaneRun {
            t: zero,
            low_time: zero,
            y,
            ended: Of::<Y>::from_f64(f64::INFINITY),
        }
    }

    /// Returns the time of the running lanes, s.
    pub fn t(&self) -> Of<Y> {
        self.t
    }

    /// Returns the states; for a lane that ended, its last state.
    pub fn y(&self) -> &Y {
        &self.y
    }

    /// Returns the end time of a lane, s; `None` while it runs.
    pub fn ended(&self, k: usize) -> Option<<Of<Y> as Lanes>::Word> {
        Some(self.ended.lane(k)).filter(|t| t.is_finite())
    }

    /// Takes a step of the length `h`, s, in all running lanes. Rigid contacts end them all: no explicit integrator knows
    /// them.
    pub fn step<M, O>(&mut self, method: &M, ode: &O, h: f64)
    where
        M: Integrator<Y>,
        O: Ode<State = Y, Error = Infallible>,
    {
        if ode.rigid_contacts() > 0 {
            self.end(|_| true);
            return;
        }
        let (h, one) = (Of::<Y>::from_f64(h), Of::<Y>::from_f64(1.0));
        let start = Start {
            t: self.t,
            y: &self.y,
            before: None,
        };
        // An explicit integrator fails only if its rates do.
        let Ok(step) = method.step(ode, &start, h) else {
            self.end(|_| true);
            return;
        };
        let mut y = self.y.plus(one, &step.change);
        let Ok(_) = ode.project(self.t + h, &mut y);
        let zero = Of::<Y>::from_f64(0.0);
        #[allow(clippy::eq_op, reason = "x − x is 0 for finite numbers only")]
        let rest = y.entries().iter().fold(zero, |sum, &x| sum + (x - x));
        self.end(|k| !rest.lane(k).is_finite());
        if (0..Of::<Y>::LANES).any(|k| self.ended(k).is_some()) {
            for (new, &old) in y.entries_mut().iter_mut().zip(self.y.entries()) {
                let made = *new;
                *new = Of::<Y>::pack(|k| match self.ended(k) {
                    None => made.lane(k),
                    Some(_) => old.lane(k),
                });
            }
        }
        self.y = y;
        (self.t, self.low_time) = sum_in_two(self.t, self.low_time + h);
    }

    /// Ends the lanes for which `fails` is true.
    fn end(&mut self, fails: impl Fn(usize) -> bool) {
        let before = self.ended;
        self.ended = Of::<Y>::pack(|k| match self.ended(k) {
            None if fails(k) => self.t.lane(k),
            _ => before.lane(k),
        });
    }
}
