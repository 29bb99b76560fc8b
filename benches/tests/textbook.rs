//! Checks that the textbook's recursions equal the generated methods on every spec, so that the benchmarks
//! compare the same work.

use benches::body::{bodies, slides};
use benches::inputs::{Input, inputs};
use benches::plain::Plain;
use benches::states::states;

/// Largest permitted difference, relative to the largest entry (at least 1).
const RELATIVE: f64 = 1e-11;

/// Number of compared states.
const TRIED: usize = 64;

#[track_caller]
fn near(what: &str, found: &[f64], wanted: &[f64]) {
    assert_eq!(found.len(), wanted.len(), "{what}");
    let size = wanted.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    for (x, y) in found.iter().zip(wanted) {
        let error = (x - y).abs();
        assert!(
            error <= RELATIVE * size,
            "{what}: {x} is off by {error:e} of {size:e}"
        );
    }
}

/// The generated modules.
mod models {
    include!(concat!(env!("OUT_DIR"), "/models.rs"));
}

macro_rules! robots {
    ($($module:ident $model:ident $jacobian:ident $tip:literal $spec:literal,)*) => {$(
        #[test]
        fn $module() {
            const N: usize = models::$module::NV;
            let model = models::$module::$model::<f64>::default();
            let mechanism = benches::read($spec.as_ref()).expect("a spec");
            let states = states(&slides(&bodies(&mechanism)));
            let mut plain = Plain::<f64>::new(&mechanism, $tip);
            for s in inputs::<f64, N>(&states[..TRIED]) {
                let Input { q, v, a, tau } = &s;
                plain.inverse_dynamics(&s);
                let wanted = model.inverse_dynamics(q, v, a);
                near("inverse dynamics", &plain.vector, wanted.as_slice());
                plain.bias(&s);
                near("bias", &plain.vector, model.bias(q, v).as_slice());
                plain.gravity(&s);
                near("gravity", &plain.vector, model.gravity(q).as_slice());
                plain.mass_matrix(&s);
                let wanted = model.mass_matrix(q);
                near("mass matrix", plain.mass.as_slice(), wanted.as_slice());
                plain.forward_dynamics(&s);
                let wanted = model.forward_dynamics(q, v, tau).expect("a regular mass matrix");
                near("forward dynamics", &plain.vector, wanted.as_slice());
                plain.jacobian(&s);
                let wanted = model.$jacobian(q);
                near("Jacobian", plain.jacobian.as_slice(), wanted.as_slice());
            }
        }
    )*};
}
include!(concat!(env!("OUT_DIR"), "/robots.rs"));
