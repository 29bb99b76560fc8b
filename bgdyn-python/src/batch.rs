//! Computes a function at many states, in one thread or several.

use bgdyn_codegen::engine::{CallArguments, Callable};
use bgdyn_codegen::method::Argument;

use bgdyn_runtime::wide::f64x4;

use crate::interrupt::Interrupt;
use crate::lanes::{LANES, LaneCall, LaneMemory, joined};
use crate::parts::Part;
use crate::threads::in_threads;

/// Number of states between two questions whether to leave off.
const ASKING: usize = 256;

/// The values of one argument.
#[derive(Clone, Copy, Debug)]
pub struct Given<'a> {
    /// Which argument it is.
    pub argument: Argument,
    /// Its values, state after state; those of one state if all states share it.
    pub values: &'a [f64],
    /// Number of values of a state.
    pub width: usize,
    /// Whether all states share it.
    pub shared: bool,
}

impl<'a> Given<'a> {
    fn at(&self, state: usize) -> &'a [f64] {
        let first = match self.shared {
            true => 0,
            false => state * self.width,
        };
        &self.values[first..first + self.width]
    }
}

/// A function and its arguments at a number of states.
#[derive(Clone, Copy, Debug)]
pub struct Batch<'a> {
    /// The function.
    pub call: &'a dyn Callable,
    /// The same for several states at once.
    pub lanes: &'a LaneCall,
    /// Its arguments.
    pub given: &'a [Given<'a>],
    /// Run-time parameters.
    pub parameters: &'a [f64],
    /// The arrays of the result.
    pub parts: &'a [Part],
}

/// A state with a refused pivot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// Its number in the batch.
    pub state: usize,
    /// The refused pivot, as in [`bgdyn_codegen::engine::Status::Refused`].
    pub pivot: usize,
}

impl Batch<'_> {
    /// Computes the states 0 to `count`, in at most `threads` threads. `out` has an array for each part, state
    /// after state. Returns the refused states in their order; NaN is written there.
    ///
    /// A state with an argument that is NaN or infinite is not refused: where a pivot is, its result is NaN. If
    /// `interrupt` comes, the states after it are not computed.
    pub fn compute(
        &self,
        count: usize,
        threads: usize,
        out: Vec<&mut [f64]>,
        interrupt: &Interrupt,
    ) -> Vec<Refusal> {
        let threads = threads.min(count);
        if threads < 2 {
            return self.compute_from(0, count, out, &|| interrupt.ask());
        }
        let (mut shares, mut rest, mut first) = (Vec::new(), out, 0);
        for k in 0..threads {
            let end = count * (k + 1) / threads;
            let mut own = Vec::new();
            let mut others = Vec::new();
            for (part, out) in self.parts.iter().zip(rest) {
                let (head, tail) = out.split_at_mut((end - first) * part.len());
                own.push(head);
                others.push(tail);
            }
            rest = others;
            shares.push((first, end - first, own));
            first = end;
        }
        let one = |(first, count, out): (usize, usize, Vec<&mut [f64]>),
                   ends: &dyn Fn() -> bool| {
            self.compute_from(first, count, out, ends)
        };
        in_threads(shares, interrupt, one).concat()
    }

    /// Computes `count` states from `first` on: as many as possible in lanes, the others one by one. `ends` returns
    /// whether to leave off.
    fn compute_from(
        &self,
        first: usize,
        count: usize,
        mut out: Vec<&mut [f64]>,
        ends: &dyn Fn() -> bool,
    ) -> Vec<Refusal> {
        let mut refused = Vec::new();
        let in_lanes = count - count % LANES;
        let mut memory = LaneMemory::default();
        for k in (0..in_lanes).step_by(LANES) {
            if k % ASKING == ASKING - LANES && ends() {
                return refused;
            }
            let (results, pivots) = self.lanes_from(first + k, &mut memory);
            for (part, out) in self.parts.iter().zip(&mut out) {
                let entries = &mut out[k * part.len()..(k + LANES) * part.len()];
                scatter(results, part, entries);
            }
            for (lane, pivot) in pivots.into_iter().enumerate() {
                refused.extend(pivot.and_then(|p| self.refusal(first, k + lane, p, &mut out)));
            }
        }
        let mut results = vec![0.0; self.call.results()];
        for k in in_lanes..count {
            let status = self.call.call(&self.arguments(first + k), &mut results);
            for (part, out) in self.parts.iter().zip(&mut out) {
                let entries = &mut out[k * part.len()..(k + 1) * part.len()];
                for (entry, &source) in entries.iter_mut().zip(&part.source) {
                    *entry = results[source];
                }
            }
            let pivot = status.refused();
            refused.extend(pivot.and_then(|p| self.refusal(first, k, p, &mut out)));
        }
        refused
    }

    /// Computes four states from `state` on.
    fn lanes_from<'m>(
        &self,
        state: usize,
        memory: &'m mut LaneMemory,
    ) -> (&'m [f64x4], [Option<usize>; LANES]) {
        let parameters: Vec<f64x4> = self.parameters.iter().map(|&x| f64x4::splat(x)).collect();
        let values: Vec<Vec<f64x4>> = self
            .given
            .iter()
            .map(|given| joined([0, 1, 2, 3].map(|lane| given.at(state + lane))))
            .collect();
        let values = self.given.iter().zip(&values);
        let from = arguments(
            values.map(|(given, v)| (given.argument, &v[..])),
            &parameters,
        );
        self.lanes.call(memory, &from)
    }

    /// Writes NaN at state `k` after `first`, whose pivot is refused; returns the refusal unless an argument is
    /// the cause.
    fn refusal(
        &self,
        first: usize,
        k: usize,
        pivot: usize,
        out: &mut [&mut [f64]],
    ) -> Option<Refusal> {
        for (part, out) in self.parts.iter().zip(out) {
            out[k * part.len()..(k + 1) * part.len()].fill(f64::NAN);
        }
        let state = first + k;
        self.finite(state).then_some(Refusal { state, pivot })
    }

    fn finite(&self, state: usize) -> bool {
        let all = self.given.iter().flat_map(|given| given.at(state));
        all.chain(self.parameters).all(|x| x.is_finite())
    }

    fn arguments(&self, state: usize) -> CallArguments<'_> {
        let values = self
            .given
            .iter()
            .map(|given| (given.argument, given.at(state)));
        arguments(values, self.parameters)
    }
}

/// Returns the arguments of a call by their kinds.
fn arguments<'a, T>(
    given: impl Iterator<Item = (Argument, &'a [T])>,
    parameters: &'a [T],
) -> CallArguments<'a, T> {
    let mut from = CallArguments {
        parameters,
        ..CallArguments::default()
    };
    for (argument, values) in given {
        match argument {
            Argument::Q => from.q = values,
            Argument::V | Argument::TreeV => from.v = values,
            Argument::A | Argument::ReferenceA => from.a = values,
            Argument::ReferenceV | Argument::AlongQ | Argument::Cotangent => from.x = values,
            Argument::AlongV => from.modes = values,
            Argument::AlongTau => from.a = values,
            // The others are a scene's.
            _ => from.u = values,
        }
    }
    from
}

/// Writes the numbers of four states into an array, state after state.
fn scatter(results: &[f64x4], part: &Part, entries: &mut [f64]) {
    let width = part.len();
    for (i, &source) in part.source.iter().enumerate() {
        for (lane, x) in results[source].to_array().into_iter().enumerate() {
            entries[lane * width + i] = x;
        }
    }
}
