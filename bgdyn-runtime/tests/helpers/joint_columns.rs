//! Columns of joints in every scalar.

use bgdyn_runtime::{Dd, JOINT_COLUMNS, Scalar, joint_columns};

fn check<T: Scalar>(to_f64: impl Fn(T) -> f64) {
    let columns = |v, a, width| {
        let [v, a, width] = [v, a, width].map(T::from_f64);
        joint_columns(v, a, width).map(&to_f64)
    };
    assert_eq!(columns(0.5, -2.0, 0.0078125), [-2.0, 0.5, 1.0, 1.0]);
    assert_eq!(columns(-0.5, 3.0, 0.0078125), [3.0, -0.5, -1.0, 1.0]);
    assert_eq!(columns(0.0, 0.0, 0.5), [0.0, 0.0, 0.0, 1.0]);
    // tanh 1
    let sign = columns(0.25, 0.0, 0.25)[2];
    assert!((sign - 0.761_594_155_955_764_9).abs() < 1e-7, "{sign}");
}

#[test]
fn columns_are_in_the_order_of_their_names() {
    assert_eq!(JOINT_COLUMNS, ["rotor", "viscous", "coulomb", "offset"]);
    check::<f32>(f64::from);
    check::<f64>(|x| x);
    check::<Dd>(Dd::to_f64);
}
