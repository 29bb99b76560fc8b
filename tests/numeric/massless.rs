//! Tests compiled code for a mechanism whose pivots are checked against their rounding error.

use bgdyn::nalgebra::vector;

use crate::counting::counts_equal;

bgdyn::bgdyn!("wrist.yaml", derivatives = true);

use wrist::Wrist;

#[test]
fn executes_what_is_counted() {
    counts_equal::<_, 3>("wrist", &Wrist::default(), &wrist::OPERATIONS);
}

/// Forward dynamics is the inverse of inverse dynamics up to the gimbal lock; at the lock the error names
/// the joint, also in the derivatives.
#[test]
fn solved_up_to_the_lock() {
    let model = Wrist::<f64>::default();
    let (v, a) = (vector![0.1, -0.2, 0.3], vector![1.0, 2.0, 3.0]);
    for bend in [1.5, 0.1, 1e-3] {
        let q = vector![0.3, bend, 0.4];
        let tau = model.inverse_dynamics(&q, &v, &a);
        let found = model.forward_dynamics(&q, &v, &tau).expect("regular");
        let bar = 64.0 * f64::EPSILON / (bend * bend);
        assert!((found - a).norm() <= bar * a.norm(), "{bend}: {found}");
    }
    let q = vector![0.3, 0.0, 0.4];
    let tau = vector![1.0, 1.0, 1.0];
    let refused = model.forward_dynamics(&q, &v, &tau).expect_err("locked");
    assert_eq!(refused.name(), "roll");
    let refused = model.forward_dynamics_derivatives(&q, &v, &tau);
    assert!(refused.is_err());
}
