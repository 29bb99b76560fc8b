//! Plants behind a pointer (trait objects), so that one copy of an integrator serves all scenes of equal dimensions.
//!
//! The rates stay compiled code; to call them takes a nanosecond more.

use std::rc::Rc;

use bgdyn_sim::{Jacobian, Plant, Power, Real};
use nalgebra::SVector;

use crate::integrate::Measured;

/// A vector of numbers.
type Vector<T, const N: usize> = SVector<T, N>;
/// State and modes after an event.
type Changed<T, const N: usize, const NM: usize> = (Vector<T, N>, Vector<T, NM>);

/// What integrators call of a plant, without types of its own.
pub(crate) trait PlantObject<T: Real, const N: usize, const NM: usize, const NE: usize> {
    fn rates(&self, t: T, y: &Vector<T, N>, modes: &Vector<T, NM>) -> Result<Vector<T, N>, String>;
    fn jacobian(
        &self,
        t: T,
        y: &Vector<T, N>,
        modes: &Vector<T, NM>,
    ) -> Option<Result<Jacobian<Vector<T, N>>, String>>;
    fn positions(&self) -> usize;
    fn position_rates(
        &self,
        t: T,
        y: &Vector<T, N>,
        modes: &Vector<T, NM>,
    ) -> Result<Vector<T, N>, String>;
    fn events(
        &self,
        t: T,
        y: &Vector<T, N>,
        modes: &Vector<T, NM>,
    ) -> Result<Vector<T, NE>, String>;
    fn changes_mode(&self, event: usize) -> bool;
    fn change(
        &self,
        t: T,
        y: &Vector<T, N>,
        modes: &Vector<T, NM>,
        fell: &dyn Fn(usize) -> bool,
    ) -> Result<Changed<T, N, NM>, String>;
    fn measured(&self, t: T, y: &Vector<T, N>, modes: &Vector<T, NM>) -> Vec<T>;
}

/// Where there are no rates: the name that the error holds, in quotes.
fn told<X, E: std::fmt::Debug>(result: Result<X, E>) -> Result<X, String> {
    result.map_err(|e| {
        let text = format!("{e:?}");
        let named = text.split('"').nth(1).map(str::to_owned);
        named.unwrap_or(text)
    })
}

impl<T: Real, P, const N: usize, const NM: usize, const NE: usize> PlantObject<T, N, NM, NE> for P
where
    P: Measured<State = Vector<T, N>, Modes = Vector<T, NM>, Values = Vector<T, NE>>,
{
    fn rates(&self, t: T, y: &Vector<T, N>, modes: &Vector<T, NM>) -> Result<Vector<T, N>, String> {
        told(Plant::rates(self, t, y, modes))
    }

    fn jacobian(
        &self,
        t: T,
        y: &Vector<T, N>,
        modes: &Vector<T, NM>,
    ) -> Option<Result<Jacobian<Vector<T, N>>, String>> {
        Plant::jacobian(self, t, y, modes).map(told)
    }

    fn positions(&self) -> usize {
        Plant::positions(self)
    }

    fn position_rates(
        &self,
        t: T,
        y: &Vector<T, N>,
        modes: &Vector<T, NM>,
    ) -> Result<Vector<T, N>, String> {
        told(Plant::position_rates(self, t, y, modes))
    }

    fn events(
        &self,
        t: T,
        y: &Vector<T, N>,
        modes: &Vector<T, NM>,
    ) -> Result<Vector<T, NE>, String> {
        told(Plant::events(self, t, y, modes))
    }

    fn changes_mode(&self, event: usize) -> bool {
        Plant::changes_mode(self, event)
    }

    fn change(
        &self,
        t: T,
        y: &Vector<T, N>,
        modes: &Vector<T, NM>,
        fell: &dyn Fn(usize) -> bool,
    ) -> Result<Changed<T, N, NM>, String> {
        told(Plant::change(self, t, y, modes, fell))
    }

    fn measured(&self, t: T, y: &Vector<T, N>, modes: &Vector<T, NM>) -> Vec<T> {
        Measured::measured(self, t, y, modes)
    }
}

/// A plant behind a pointer.
#[derive(Clone)]
pub(crate) struct DynPlant<T: Real, const N: usize, const NM: usize, const NE: usize>(
    pub Rc<dyn PlantObject<T, N, NM, NE>>,
);

impl<T: Real, const N: usize, const NM: usize, const NE: usize> Plant for DynPlant<T, N, NM, NE> {
    type State = Vector<T, N>;
    type Modes = Vector<T, NM>;
    type Values = Vector<T, NE>;
    // Runs are not audited here.
    type Entries = Vector<T, 0>;
    type Error = String;

    fn rates(&self, t: T, y: &Vector<T, N>, modes: &Vector<T, NM>) -> Result<Vector<T, N>, String> {
        self.0.rates(t, y, modes)
    }

    fn jacobian(
        &self,
        t: T,
        y: &Vector<T, N>,
        modes: &Vector<T, NM>,
    ) -> Option<Result<Jacobian<Vector<T, N>>, String>> {
        self.0.jacobian(t, y, modes)
    }

    fn positions(&self) -> usize {
        self.0.positions()
    }

    fn position_rates(
        &self,
        t: T,
        y: &Vector<T, N>,
        modes: &Vector<T, NM>,
    ) -> Result<Vector<T, N>, String> {
        self.0.position_rates(t, y, modes)
    }

    fn events(
        &self,
        t: T,
        y: &Vector<T, N>,
        modes: &Vector<T, NM>,
    ) -> Result<Vector<T, NE>, String> {
        // A scene without events is not asked.
        match NE {
            0 => Ok(SVector::repeat(T::from_f64(0.0))),
            _ => self.0.events(t, y, modes),
        }
    }

    fn changes_mode(&self, event: usize) -> bool {
        self.0.changes_mode(event)
    }

    fn change(
        &self,
        t: T,
        y: &Vector<T, N>,
        modes: &Vector<T, NM>,
        fell: impl Fn(usize) -> bool,
    ) -> Result<Changed<T, N, NM>, String> {
        self.0.change(t, y, modes, &fell)
    }

    fn nothing(&self) -> Vector<T, 0> {
        SVector::repeat(T::from_f64(0.0))
    }

    fn energy(&self, _: T, _: &Vector<T, N>, _: &Vector<T, NM>) -> Result<Vector<T, 0>, String> {
        Ok(self.nothing())
    }

    fn power(
        &self,
        _: T,
        _: &Vector<T, N>,
        _: &Vector<T, NM>,
    ) -> Result<Power<Vector<T, 0>>, String> {
        Ok(Power {
            supplied: self.nothing(),
            dissipated: self.nothing(),
        })
    }
}

impl<T: Real, const N: usize, const NM: usize, const NE: usize> Measured
    for DynPlant<T, N, NM, NE>
{
    fn measured(&self, t: T, y: &Vector<T, N>, modes: &Vector<T, NM>) -> Vec<T> {
        self.0.measured(t, y, modes)
    }
}
