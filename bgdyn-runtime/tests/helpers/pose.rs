//! Tests poses and rotation vectors against Rodrigues' formula in double-double.

use bgdyn_runtime::nalgebra::{Isometry3, Matrix3, SVector, Vector3};
use bgdyn_runtime::{Dd, Pose, Scalar, rotation};
use proptest::prelude::*;

/// Returns the rotation about a unit axis by an angle: 1 + sin·K + (1 − cos)·K².
fn turn(axis: [f64; 3], angle: Dd) -> Matrix3<Dd> {
    let [x, y, z] = unit(axis).into();
    let (s, _) = angle.sin_cos();
    let (half, _) = (angle * Dd::from_f64(0.5)).sin_cos();
    let versine = Dd::from_f64(2.0) * half * half;
    let axis = [x, y, z];
    let k = rotation::skew(&Vector3::new(x, y, z));
    Matrix3::from_fn(|i, j| {
        let square = axis[i] * axis[j] - if i == j { Dd::ONE } else { Dd::ZERO };
        let one = if i == j { Dd::ONE } else { Dd::ZERO };
        one + s * k[(i, j)] + versine * square
    })
}

fn unit(axis: [f64; 3]) -> Vector3<Dd> {
    let [x, y, z] = axis.map(Dd::from_f64);
    let length = (x * x + y * y + z * z).sqrt();
    Vector3::new(x / length, y / length, z / length)
}

fn rounded<T: Scalar>(r: &Matrix3<Dd>) -> Matrix3<T> {
    r.map(|x| T::from_parts(x.hi(), x.lo()))
}

const AXES: [[f64; 3]; 9] = [
    [1.0, 0.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
    [-1.0, 0.0, 1.0],
    [1.0, -1.0, 1.0],
    [0.3, -0.2, 0.9],
    [1e-9, 1.0, -1e-5],
    [-0.7, 0.1, 1e-12],
];

/// Returns angles near 0, near π, and between.
fn angles() -> Vec<Dd> {
    let small = (0..=15).map(|k| Dd::from_f64(10f64.powi(-k)));
    let small: Vec<Dd> = small.collect();
    let large = small.iter().map(|&x| Dd::PI - x);
    let between = (1..31).map(|k| Dd::from_f64(0.1 * f64::from(k)));
    small.iter().copied().chain(large).chain(between).collect()
}

/// Returns the largest error of the vector, in units of `eps` of its length.
fn worst<T: Scalar>(eps: f64, value: impl Fn(T) -> Dd) -> f64 {
    let mut worst: f64 = 0.0;
    for axis in AXES {
        for angle in angles() {
            let found = rotation::vector(&rounded::<T>(&turn(axis, angle)));
            let wanted = unit(axis).map(|x| x * angle);
            for k in 0..3 {
                let error = (value(found[k]) - wanted[k]).abs() / angle;
                worst = worst.max(error.to_f64() / eps);
            }
        }
    }
    worst
}

#[test]
fn rotation_vectors_keep_the_digits_of_their_scalar() {
    // Relative to the length, also near angle 0: an error of eps rad would be 1e15 of these units.
    let double = worst::<f64>(f64::EPSILON, Dd::from_f64);
    assert!(double < 4.0, "f64: {double}");
    let single = worst::<f32>(f64::from(f32::EPSILON), |x| Dd::from_f64(x.into()));
    assert!(single < 4.0, "f32: {single}");
    let long = worst::<Dd>(2f64.powi(-104), |x| x);
    assert!(long < 16.0, "double-double: {long}");
}

#[test]
fn no_turn_and_half_turns_have_their_vectors() {
    let none = rotation::vector(&Matrix3::<f64>::identity());
    assert_eq!(none, Vector3::zeros());
    for k in 0..3 {
        let half = Matrix3::from_fn(|i, j| match (i == j, i == k) {
            (false, _) => 0.0,
            (true, true) => 1.0,
            (true, false) => -1.0,
        });
        let vector: Vector3<f64> = rotation::vector(&half);
        let wanted = Vector3::from_fn(|i, _| if i == k { std::f64::consts::PI } else { 0.0 });
        assert!((vector.abs() - wanted).amax() < 1e-15, "{vector}");
    }
}

fn any_pose() -> impl Strategy<Value = Pose<f64>> {
    let angles = [-4.0..4.0, -4.0..4.0, -4.0..4.0];
    let places = [-2.0..2.0, -2.0..2.0, -2.0..2.0];
    (angles, places).prop_map(|([roll, pitch, yaw], place)| Pose {
        rotation: rotation::rpy(roll, pitch, yaw),
        translation: place.into(),
    })
}

fn any_twist() -> impl Strategy<Value = SVector<f64, 6>> {
    let one = || -2.0..2.0;
    [one(), one(), one(), one(), one(), one()].prop_map(SVector::from)
}

fn far(a: &Pose<f64>, b: &Pose<f64>) -> f64 {
    (a.to_homogeneous() - b.to_homogeneous()).amax()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 500, ..ProptestConfig::default() })]

    #[test]
    fn products_and_inverses_are_those_of_matrices(a in any_pose(), b in any_pose()) {
        let product = (a * b).to_homogeneous();
        prop_assert!((product - a.to_homogeneous() * b.to_homogeneous()).amax() < 1e-14);
        let one = Pose::identity();
        prop_assert!(far(&(a * a.inverse()), &one) < 1e-14);
        prop_assert!(far(&(a.inverse() * a), &one) < 1e-14);
        prop_assert_eq!(a * one, a);
    }

    #[test]
    fn the_rotation_vector_leads_from_one_pose_to_the_other(a in any_pose(), b in any_pose()) {
        let vector = rotation::between(&a.rotation, &b.rotation);
        let angle = vector.norm();
        prop_assert!(angle <= std::f64::consts::PI + 1e-15);
        let axis: [f64; 3] = vector.into();
        let turned = turn(axis, Dd::from_f64(angle)).map(|x| x.to_f64()) * a.rotation;
        prop_assert!((turned - b.rotation).amax() < 1e-14, "{}", turned - b.rotation);
        let error = a.error_to(&b);
        prop_assert_eq!(error.fixed_rows::<3>(0).into_owned(), vector);
        let left: Vector3<f64> = error.fixed_rows::<3>(3).into();
        prop_assert_eq!(left, b.translation - a.translation);
    }

    #[test]
    fn isometries_place_points_alike(a in any_pose(), p in any_twist()) {
        let point = Vector3::new(p[0], p[1], p[2]);
        let isometry = Isometry3::from(a);
        let placed = isometry * bgdyn_runtime::nalgebra::Point3::from(point);
        prop_assert!((placed.coords - a.transform_point(&point)).amax() < 1e-14);
        prop_assert!(far(&Pose::from(isometry), &a) < 1e-14);
    }

    /// A moving body: the position of its point after a short time, and the point's velocity.
    #[test]
    fn twists_move_the_same_points(a in any_pose(), twist in any_twist(), p in any_twist()) {
        let at = |twist: &SVector<f64, 6>, point: &Vector3<f64>| -> Vector3<f64> {
            let spin = Vector3::new(twist[0], twist[1], twist[2]);
            Vector3::new(twist[3], twist[4], twist[5]) + spin.cross(point)
        };
        // A point given in the frame, and its velocity from the twist in the frame.
        let own = Vector3::new(p[0], p[1], p[2]);
        let wanted = a.transform_vector(&at(&twist, &own));
        let point = a.transform_point(&own);
        let from_world = at(&a.transform_twist(&twist), &point);
        prop_assert!((from_world - wanted).amax() < 1e-13);
        let from_frame = at(&a.turn_twist(&twist), &(point - a.translation));
        prop_assert!((from_frame - wanted).amax() < 1e-13);
    }
}

#[cfg(feature = "num-dual")]
#[test]
fn the_derivative_is_right_where_there_is_no_turn() {
    use bgdyn_runtime::num_dual::Dual64;
    let axis = Vector3::new(0.3, -0.5, 0.8);
    let along = Matrix3::from_fn(|i, j| {
        let one = if i == j { 1.0 } else { 0.0 };
        Dual64::new(one, rotation::skew(&axis)[(i, j)])
    });
    let vector = rotation::vector(&along);
    for k in 0..3 {
        assert_eq!(vector[k].re, 0.0);
        assert!((vector[k].eps - axis[k]).abs() < 1e-15, "{}", vector[k]);
    }
}

#[cfg(feature = "wide")]
#[test]
fn lanes_give_the_bits_of_scalars() {
    use bgdyn_runtime::wide::f64x4;
    // Angles 0, small, large, almost π: a different branch for the quaternion in every lane.
    let lanes: [Matrix3<f64>; 4] = [
        Matrix3::identity(),
        rotation::about_x(1e-9),
        rotation::about_y(2.8),
        rotation::about_z(-3.125),
    ];
    let packed = Matrix3::from_fn(|i, j| f64x4::new(lanes.map(|r| r[(i, j)])));
    let vectors = rotation::vector(&packed);
    for (lane, alone) in lanes.iter().map(rotation::vector).enumerate() {
        for k in 0..3 {
            assert_eq!(vectors[k].to_array()[lane], alone[k]);
        }
    }
}
