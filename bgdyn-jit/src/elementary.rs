//! The functions that machine code calls: those of the runtime, so that the bits are the same.

use bgdyn_codegen::tape::Operation;
use bgdyn_runtime::Scalar;

extern "C" fn exponential(x: f64) -> f64 {
    Scalar::exp(x)
}

extern "C" fn logarithm(x: f64) -> f64 {
    Scalar::ln(x)
}

extern "C" fn hyperbolic_tangent(x: f64) -> f64 {
    Scalar::tanh(x)
}

/// Returns the function of one number that computes an operation, if it is one that is called.
pub(crate) fn called(operation: Operation) -> Option<extern "C" fn(f64) -> f64> {
    match operation {
        Operation::Exponential => Some(exponential),
        Operation::Logarithm => Some(logarithm),
        Operation::HyperbolicTangent => Some(hyperbolic_tangent),
        _ => None,
    }
}
