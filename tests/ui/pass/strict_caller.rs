//! The generated module brings no warning into a crate that allows none.
#![deny(warnings, clippy::all, missing_docs, rust_2018_idioms)]
#![forbid(unsafe_code)]

use bgdyn::nalgebra::Vector2;

bgdyn::bgdyn!("arm.yaml", identification = true);
bgdyn::bgdyn!("robots/lift.yaml");

fn main() {
    let model = arm::Arm::<f64>::default();
    let (q, v, a) = (Vector2::new(0.3, -0.4), Vector2::zeros(), Vector2::zeros());
    let tau = model.inverse_dynamics(&q, &v, &a);
    assert!((tau - model.gravity(&q)).norm() < 1e-12);
    assert_eq!(arm::JOINT_NAMES, ["shoulder", "elbow"]);
    assert_eq!(arm::LINK_NAMES.len(), 2);
    assert_eq!((arm::NQ, arm::NV), (2, 2));
    assert_eq!(core::mem::size_of_val(&model), 0);
    let loaded = lift::Lift { load: 12.0 };
    assert_eq!(core::mem::size_of_val(&loaded), 8);
    let (empty, rest) = (lift::Lift::default(), bgdyn::nalgebra::Vector1::zeros());
    assert_eq!(loaded.gravity(&rest)[0], 4.0 * empty.gravity(&rest)[0]);
}
