//! A function at four states at once, one in each lane of a SIMD register.

use bgdyn_codegen::engine::CallArguments;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::tape::Program;
use bgdyn_runtime::wide::f64x4;

/// Number of states of a call.
pub const LANES: usize = 4;

/// A function that is prepared for lanes. Each lane has the bits of a single call.
#[derive(Debug)]
pub struct LaneCall {
    program: Program,
    constants: Vec<f64x4>,
}

/// Memory of a thread.
#[derive(Debug, Default)]
pub struct LaneMemory {
    values: Vec<f64x4>,
    out: Vec<f64x4>,
}

impl LaneCall {
    /// Prepares a function.
    pub fn new(function: &Function) -> Self {
        let program = Program::new(function);
        LaneCall {
            constants: program.constants(),
            program,
        }
    }

    /// Computes the results, and the refused pivot of each lane.
    ///
    /// # Panics
    /// If `from` lacks a component that the function reads.
    pub fn call<'a>(
        &self,
        memory: &'a mut LaneMemory,
        from: &CallArguments<'_, f64x4>,
    ) -> (&'a [f64x4], [Option<usize>; LANES]) {
        let LaneMemory { values, out } = memory;
        out.resize(self.program.results(), f64x4::splat(0.0));
        let refused = self.program.call(&self.constants, values, from, out);
        // A joint's index, or -1.
        let pivots = refused.to_array();
        (
            out,
            pivots.map(|pivot| (pivot >= 0.0).then_some(pivot as usize)),
        )
    }
}

/// Returns the values of four states as lanes; those of one state in all lanes if they share it.
pub fn joined(states: [&[f64]; LANES]) -> Vec<f64x4> {
    let width = states[0].len();
    let lane = |i: usize| f64x4::new(states.map(|state| state[i]));
    (0..width).map(lane).collect()
}
