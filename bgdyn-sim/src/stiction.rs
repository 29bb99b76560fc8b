//! Modes of dry friction in a run: what comes to rest and what gives way, after events and from outside.

use bgdyn_runtime::{Contact, StateVector, mode_by_slip, resolve_stiction_by};

use crate::real::Real;

/// What can hold the coordinates of a plant at an instant: the data that decide its modes.
///
/// A [`crate::Plant`] with dry friction needs no more than this to write [`crate::Plant::change`] and
/// [`crate::Plant::resolve_stiction`].
#[derive(Clone, Copy, Debug)]
pub struct Stiction<'a, F> {
    /// The mode that each event may change; `None` where the law only has a kink.
    pub event_modes: &'a [Option<usize>],
    /// The component of the state that is the velocity of each mode's coordinate.
    pub mode_velocities: &'a [usize],
    /// The contacts in a state, one per mode, at the modes that it is given.
    pub contacts: F,
}

impl<F> Stiction<'_, F> {
    /// State and modes after the events for which `fell` holds: what slipped comes to rest, what was
    /// held breaks away. All joints at rest are decided together.
    ///
    /// # Errors
    /// Those of `contacts`.
    pub fn after_events<T, Y, M, C, E>(
        &self,
        y: &Y,
        modes: &M,
        fell: impl Fn(usize) -> bool,
    ) -> Result<(Y, M), E>
    where
        T: Real,
        Y: StateVector<Scalar = T>,
        M: StateVector<Scalar = T>,
        C: AsRef<[Contact<T>]>,
        F: Fn(&Y, &M) -> Result<C, E>,
    {
        let zero = T::from_f64(0.0);
        let (mut rested, mut held) = (y.clone(), modes.clone());
        let events = self.event_modes.iter().enumerate();
        let fallen = events.filter(|&(event, _)| fell(event));
        for mode in fallen.filter_map(|(_, mode)| *mode) {
            if held.entries()[mode] != zero {
                // What the search for the instant has left of its slip would stay for ever.
                let slip = (self.contacts)(&rested, &held)?.as_ref()[mode].slip;
                self.stop(&mut rested, mode, slip);
                held.entries_mut()[mode] = zero;
            }
        }
        let held = self.resolved(&rested, &held)?;
        Ok((rested, held))
    }

    /// State and modes that agree: what moves slips the way it moves, what is at rest holds where it
    /// can. A coordinate counts as at rest up to the part `rest` of its velocity. `None` where state and
    /// modes agree as they are.
    ///
    /// # Errors
    /// Those of `contacts`.
    pub fn resolve<T, Y, M, C, E>(&self, y: &Y, modes: &M, rest: T) -> Result<Option<(Y, M)>, E>
    where
        T: Real,
        Y: StateVector<Scalar = T>,
        M: StateVector<Scalar = T>,
        C: AsRef<[Contact<T>]>,
        F: Fn(&Y, &M) -> Result<C, E>,
    {
        if self.mode_velocities.is_empty() {
            return Ok(None);
        }
        let zero = T::from_f64(0.0);
        let contacts = (self.contacts)(y, modes)?;
        let (mut rested, mut now) = (y.clone(), modes.clone());
        for (k, contact) in contacts.as_ref().iter().enumerate() {
            let (mode, slip) = (modes.entries()[k], contact.slip);
            let velocity = y.entries()[self.mode_velocities[k]];
            let by_slip = mode_by_slip(mode, slip, resting_slip(slip, velocity, rest));
            now.entries_mut()[k] = by_slip;
            if by_slip == zero && mode != zero {
                self.stop(&mut rested, k, slip);
            }
        }
        let now = self.resolved(&rested, &now)?;
        Ok((now != *modes || rested != *y).then_some((rested, now)))
    }

    /// The modes, with those of all joints at rest decided together.
    fn resolved<T, Y, M, C, E>(&self, y: &Y, modes: &M) -> Result<M, E>
    where
        T: Real,
        M: StateVector<Scalar = T>,
        C: AsRef<[Contact<T>]>,
        F: Fn(&Y, &M) -> Result<C, E>,
    {
        let no_slip = T::from_f64(0.0);
        resolve_stiction_by(modes, no_slip, |modes| (self.contacts)(y, modes))
    }

    /// Takes the slip of a mode from the velocity of its coordinate.
    fn stop<T: Real, Y: StateVector<Scalar = T>>(&self, y: &mut Y, mode: usize, slip: T) {
        let velocity = &mut y.entries_mut()[self.mode_velocities[mode]];
        *velocity = *velocity - slip;
    }
}

/// The least velocity, rad/s or m/s, that the part `rest` is taken of: a counterpart that turns back is at rest
/// for an instant, what it carries only up to the errors of the integrator.
const LEAST: f64 = 1e-6;

/// The slip, rad/s or m/s, up to which a coordinate with this `velocity` counts as at rest: the part
/// `rest` of the larger of its own and its counterpart's velocity, and what rounding leaves.
fn resting_slip<T: Real>(slip: T, velocity: T, rest: T) -> T {
    let velocities = velocity.abs().max((velocity - slip).abs());
    let largest = velocities.max(T::from_f64(LEAST));
    rest * largest + T::EPSILON * T::from_f64(64.0)
}
