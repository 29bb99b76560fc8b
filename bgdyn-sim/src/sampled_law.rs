//! Controllers in Rust beside a scene.

use bgdyn_runtime::{HybridSystem, SampledControl};

use crate::real::Real;

/// A controller in Rust and how it is sampled.
pub(crate) struct SampledLaw<'a, S: HybridSystem<T>, T: Real> {
    /// How it is sampled.
    pub(crate) sampling: SampledControl<'a>,
    /// Given inputs by measured state and time.
    pub(crate) law: &'a dyn Fn(&S::State, T) -> S::Inputs,
}

impl<S: HybridSystem<T>, T: Real> core::fmt::Debug for SampledLaw<'_, S, T> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.sampling.fmt(f)
    }
}
