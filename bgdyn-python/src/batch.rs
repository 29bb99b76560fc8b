//! Computes a function at many states, in one thread or several.

use bgdyn_codegen::engine::{CallArguments, Callable};
use bgdyn_codegen::method::Argument;

use crate::parts::Part;

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
    /// A state with an argument that is NaN or infinite is not refused: where a pivot is, its result is NaN.
    pub fn compute(&self, count: usize, threads: usize, out: Vec<&mut [f64]>) -> Vec<Refusal> {
        let threads = threads.min(count);
        if threads < 2 {
            return self.compute_from(0, count, out);
        }
        let mut rest = out;
        std::thread::scope(|scope| {
            let mut running = Vec::new();
            let mut first = 0;
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
                let start = first;
                running.push(scope.spawn(move || self.compute_from(start, end - start, own)));
                first = end;
            }
            let found = running.into_iter().map(|thread| match thread.join() {
                Ok(refused) => refused,
                Err(panic) => std::panic::resume_unwind(panic),
            });
            found.flatten().collect()
        })
    }

    /// Computes `count` states from `first` on.
    fn compute_from(&self, first: usize, count: usize, mut out: Vec<&mut [f64]>) -> Vec<Refusal> {
        let whole = matches!(self.parts, [part] if part.is_whole(self.call.results()));
        let mut results = vec![0.0; self.call.results()];
        let mut refused = Vec::new();
        for k in 0..count {
            let from = self.arguments(first + k);
            let pivot = match whole {
                true => {
                    let width = results.len();
                    self.call
                        .call(&from, &mut out[0][k * width..(k + 1) * width])
                }
                false => self.call.call(&from, &mut results),
            }
            .refused();
            if !whole {
                self.distribute(&results, k, &mut out);
            }
            if let Some(pivot) = pivot {
                for (part, out) in self.parts.iter().zip(&mut out) {
                    out[k * part.len()..(k + 1) * part.len()].fill(f64::NAN);
                }
                if self.finite(first + k) {
                    refused.push(Refusal {
                        state: first + k,
                        pivot,
                    });
                }
            }
        }
        refused
    }

    /// Writes the numbers of a function into the arrays, at state `k` of these.
    fn distribute(&self, results: &[f64], k: usize, out: &mut [&mut [f64]]) {
        for (part, out) in self.parts.iter().zip(out) {
            let entries = &mut out[k * part.len()..(k + 1) * part.len()];
            for (entry, &source) in entries.iter_mut().zip(&part.source) {
                *entry = results[source];
            }
        }
    }

    fn finite(&self, state: usize) -> bool {
        let all = self.given.iter().flat_map(|given| given.at(state));
        all.chain(self.parameters).all(|x| x.is_finite())
    }

    fn arguments(&self, state: usize) -> CallArguments<'_> {
        let mut from = CallArguments {
            parameters: self.parameters,
            ..CallArguments::default()
        };
        for given in self.given {
            let values = given.at(state);
            match given.argument {
                Argument::Q => from.q = values,
                Argument::V | Argument::TreeV => from.v = values,
                Argument::A => from.a = values,
                // The others are a scene's.
                _ => from.u = values,
            }
        }
        from
    }
}
