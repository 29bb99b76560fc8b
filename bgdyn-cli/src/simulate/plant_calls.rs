//! Calls of a scene's functions: their arguments, and their errors by name.

use bgdyn_codegen::engine::{CallArguments, Callable, Status};
use bgdyn_runtime::Cause;
use bgdyn_sim::Plant as _;

use super::plant::{Evaluated, Evaluation, Numbers};
use super::undefined::{Undefined, UndefinedCause};

impl Evaluated<'_> {
    /// Returns the arguments of functions, with all inputs 0.
    pub(super) fn arguments<'b>(
        &'b self,
        t: f64,
        y: &'b Numbers,
        modes: &'b Numbers,
    ) -> CallArguments<'b> {
        let layout = &self.system.scene.layout;
        let (nq, nv) = (layout.nq(), layout.nv());
        let y = y.as_slice();
        CallArguments {
            q: &y[..nq],
            v: &y[nq..nq + nv],
            x: &y[nq + nv..],
            u: &self.no_inputs,
            modes: modes.as_slice(),
            parameters: &self.parameters,
            t: Some(t),
            ..CallArguments::default()
        }
    }

    /// Calls a function with arguments in which the inputs are those that the scene drives.
    pub(super) fn driven<R>(
        &self,
        t: f64,
        y: &Numbers,
        modes: &Numbers,
        call: impl FnOnce(&CallArguments<'_>) -> R,
    ) -> R {
        let at = self.arguments(t, y, modes);
        match &self.functions.inputs {
            None => call(&at),
            Some(inputs) => {
                let (u, _) = inputs.value(&at);
                let u = self.held_inputs(t, u);
                call(&CallArguments { u: &u, ..at })
            }
        }
    }

    /// Returns all inputs, with those of sampled controllers as if they were sampled now.
    pub(super) fn live_inputs(&self, t: f64, y: &Numbers, modes: &Numbers) -> Vec<f64> {
        let inputs = self.functions.inputs.as_ref();
        inputs.map_or_else(Vec::new, |inputs| {
            inputs.value(&self.arguments(t, y, modes)).0
        })
    }

    /// Returns inputs in which those of sampled controllers are held.
    pub(super) fn held_inputs(&self, t: f64, inputs: Vec<f64>) -> Vec<f64> {
        match &self.system.scene.control {
            None => inputs,
            Some(control) => {
                let held = self.sampler.hold(&control.sampled(), t, inputs.into());
                held.as_slice().to_vec()
            }
        }
    }

    /// Computes a function that exists if the mass matrix is regular.
    pub(super) fn regular(
        &self,
        function: &dyn Callable,
        at: &CallArguments<'_>,
    ) -> Evaluation<Vec<f64>> {
        let (values, status) = function.value(at);
        match status.refused() {
            None => Ok(values),
            Some(j) => Err(self.refused(j)),
        }
    }

    /// Computes rates, or columns of rates, which must be finite.
    pub(super) fn checked(
        &self,
        function: &dyn Callable,
        at: &CallArguments<'_>,
    ) -> Evaluation<Vec<f64>> {
        let (values, status) = function.value(at);
        self.finite(status)?;
        Ok(values)
    }

    /// Returns the error of a call with a refused pivot, or a rate that is not finite.
    fn finite(&self, status: Status) -> Evaluation<()> {
        match status {
            Status::Done => Ok(()),
            Status::Refused(j) => Err(self.refused(j)),
            Status::NotFinite(i) => Err(self.not_finite(i % self.rows())),
        }
    }

    /// Returns the number of rates in the derivative, and in a column of the Jacobian.
    fn rows(&self) -> usize {
        let layout = &self.system.scene.layout;
        (layout.nv() + layout.nx() + layout.coupled().len()).max(1)
    }

    /// Returns the error of a refused pivot: those of the coordinates come first, those of the loops after all
    /// rates.
    pub(super) fn refused(&self, i: usize) -> Undefined {
        let layout = &self.system.scene.layout;
        let rates = layout.nv() + layout.nx();
        let (at, cause) = match Cause::of_pivot(i, rates) {
            (Cause::Pivot, i) => (&layout.coordinates[i].name, UndefinedCause::Singular),
            (Cause::OutOfReach, i) => (&layout.loops[i - rates], UndefinedCause::OutOfReach),
            (_, i) => (&layout.loops[i - rates], UndefinedCause::Loop),
        };
        let at = at.clone();
        Undefined { at, cause }
    }

    /// Returns the error of rate `i`, which is not finite: the coordinates come first, then the first-order states,
    /// then coupled positions.
    pub(super) fn not_finite(&self, i: usize) -> Undefined {
        let layout = &self.system.scene.layout;
        let own = layout.nv() + layout.nx();
        let at = match (i.checked_sub(layout.nv()), i.checked_sub(own)) {
            (_, Some(k)) => &layout.positions[layout.coupled()[k]].name,
            (Some(i), None) => &layout.states[i].name,
            (None, None) => &layout.coordinates[i].name,
        };
        let (at, cause) = (at.clone(), UndefinedCause::NotFinite);
        Undefined { at, cause }
    }

    /// Returns ẏ at y.
    pub(super) fn natural_rates(
        &self,
        t: f64,
        y: &Numbers,
        modes: &Numbers,
    ) -> Evaluation<Numbers> {
        let (derivative, nq) = (&self.functions.derivative, self.positions());
        let mut rates = vec![0.0; nq + derivative.results()];
        let status = self.driven(t, y, modes, |at| derivative.call(at, &mut rates[nq..]));
        self.finite(status)?;
        // The rates of coupled positions come last.
        let mut coupled = y.len();
        for (i, position) in self.system.scene.layout.positions.iter().enumerate() {
            rates[i] = match position.coordinate {
                Some(j) => y[nq + j],
                None => {
                    coupled += 1;
                    rates[coupled - 1]
                }
            };
        }
        rates.truncate(y.len());
        Ok(rates.into())
    }
}
