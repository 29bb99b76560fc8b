//! The functions of the run-time crate that generated code calls, for each scalar.

use bgdyn::Scalar;
use bgdyn::nalgebra::{Matrix3, Matrix4, SMatrix, SVector, Vector3};
use bgdyn::runtime::{
    Argument, Dd, LogCholesky, Pose, inertia, inner_products, joint_columns, manifold, matrix,
    mirror, rotation, vector,
};

/// Functions that must not panic, and `all`, which keeps them in the program and returns their number.
macro_rules! proved {
    ($($name:ident($($argument:ident: $type:ty),*) -> $output:ty = $value:expr;)*) => {
        $(
            #[no_panic::no_panic]
            #[inline(never)]
            pub fn $name($($argument: $type),*) -> $output {
                $value
            }
        )*
        pub fn all() -> usize {
            let all = [$($name as *const ()),*];
            core::hint::black_box(all).len()
        }
    };
}

/// Joint names without a model.
const NAMES: &[&str; 4] = &["a", "b", "c", "d"];

macro_rules! scalar {
    ($module:ident, $scalar:ty) => {
        mod $module {
            use super::*;
            type T = $scalar;
            type Refused = <T as Scalar>::Refused;
            type Solved = Result<SVector<T, 4>, <T as Scalar>::Singular<4>>;

            proved! {
                from_f64(x: f64) -> T = T::from_f64(x);
                from_parts(hi: f64, lo: f64) -> T = T::from_parts(hi, lo);
                mul_add(a: T, b: T, c: T) -> T = Scalar::mul_add(a, b, c);
                sqrt(x: T) -> T = Scalar::sqrt(x);
                sin_cos(x: T) -> (T, T) = Scalar::sin_cos(x);
                sin_cos_sum(x: &[T; 3], lo: f64) -> (T, T) = T::sin_cos_sum(x, (0.4, lo));
                sin_cos_all(x: [&[T]; 9], y: [(f64, f64); 9]) -> [(T, T); 9] = T::sin_cos_all(x, y);
                exp(x: T) -> T = Scalar::exp(x);
                ln(x: T) -> T = Scalar::ln(x);
                tanh(x: T) -> T = Scalar::tanh(x);
                abs(x: T) -> T = Scalar::abs(x);
                min(x: T, y: T) -> T = Scalar::min(x, y);
                max(x: T, y: T) -> T = Scalar::max(x, y);
                sign(x: T) -> T = Scalar::sign(x);
                select(x: T, y: T) -> T = T::select(x.less(y), x, y);
                checked_pivot(x: T, size: T, joint: usize, refused: &mut Refused) -> T =
                    x.checked_pivot(size, joint, refused);
                finish(x: SVector<T, 4>, refused: Refused, q: &SVector<T, 4>) -> Solved =
                    T::finish(x, refused, NAMES, |look| look(Argument::Q, NAMES, q.as_slice()));
                about_x(x: T) -> Matrix3<T> = rotation::about_x(x);
                about_y(x: T) -> Matrix3<T> = rotation::about_y(x);
                about_z(x: T) -> Matrix3<T> = rotation::about_z(x);
                rpy(x: T, y: T, z: T) -> Matrix3<T> = rotation::rpy(x, y, z);
                skew(x: &Vector3<T>) -> Matrix3<T> = rotation::skew(x);
                unskew(x: &Matrix3<T>) -> Vector3<T> = rotation::unskew(x);
                spherical_rates(q: [T; 4], v: [T; 3]) -> [T; 4] = manifold::spherical::position_rates(q, v);
                spherical_integrate(q: [T; 4], d: [T; 3]) -> [T; 4] = manifold::spherical::integrate(q, d);
                spherical_difference(p: [T; 4], q: [T; 4]) -> [T; 3] = manifold::spherical::difference(p, q);
                spherical_normalize(q: [T; 4]) -> [T; 4] = manifold::spherical::normalize(q);
                spherical_sample(u: [T; 3]) -> [T; 4] = manifold::spherical::sample(u);
                floating_rates(q: [T; 7], v: [T; 6]) -> [T; 7] = manifold::floating::position_rates(q, v);
                floating_integrate(q: [T; 7], d: [T; 6]) -> [T; 7] = manifold::floating::integrate(q, d);
                floating_difference(p: [T; 7], q: [T; 7]) -> [T; 6] = manifold::floating::difference(p, q);
                floating_normalize(q: [T; 7]) -> [T; 7] = manifold::floating::normalize(q);
                floating_sample(u: [T; 6]) -> [T; 7] = manifold::floating::sample(u);
                planar_rates(q: [T; 3], v: [T; 3]) -> [T; 3] = manifold::planar::position_rates(q, v);
                planar_integrate(q: [T; 3], d: [T; 3]) -> [T; 3] = manifold::planar::integrate(q, d);
                planar_difference(p: [T; 3], q: [T; 3]) -> [T; 3] = manifold::planar::difference(p, q);
                planar_normalize(q: [T; 3]) -> [T; 3] = manifold::planar::normalize(q);
                planar_sample(u: [T; 3]) -> [T; 3] = manifold::planar::sample(u);
                quaternion_rotation(q: [T; 4]) -> Matrix3<T> = manifold::rotation(q);
                quaternion_of(x: &Matrix3<T>) -> [T; 4] = manifold::quaternion_of(x);
                parallel_axis(m: T, r: &Vector3<T>) -> Matrix3<T> = inertia::parallel_axis(m, r);
                about_origin(j: &Matrix3<T>, m: T, r: &Vector3<T>) -> Matrix3<T> =
                    inertia::about_origin(j, m, r);
                rotate(j: &Matrix3<T>, r: &Matrix3<T>) -> Matrix3<T> = inertia::rotate(j, r);
                pseudo_inertia(j: &Matrix3<T>) -> Matrix3<T> = inertia::pseudo_inertia(j);
                from_pseudo_inertia(d: &Matrix3<T>) -> Matrix3<T> = inertia::from_pseudo_inertia(d);
                to_parameters(x: &LogCholesky<T>) -> SVector<T, 10> = x.to_parameters();
                from_parameters(p: &SVector<T, 10>) -> LogCholesky<T> = LogCholesky::from_parameters(p);
                by_numbers(x: &LogCholesky<T>) -> SMatrix<T, 10, 10> = x.jacobian();
                columns_of_joint(v: T, a: T, w: T) -> [T; 4] = joint_columns(v, a, w);
                transform_point(x: &Pose<T>, p: &Vector3<T>) -> Vector3<T> = x.transform_point(p);
                transform_vector(x: &Pose<T>, v: &Vector3<T>) -> Vector3<T> = x.transform_vector(v);
                transform_twist(x: &Pose<T>, v: &SVector<T, 6>) -> SVector<T, 6> = x.transform_twist(v);
                turn_twist(x: &Pose<T>, v: &SVector<T, 6>) -> SVector<T, 6> = x.turn_twist(v);
                error_to(x: &Pose<T>, y: &Pose<T>) -> SVector<T, 6> = x.error_to(y);
                inverse(x: &Pose<T>) -> Pose<T> = x.inverse();
                product(x: Pose<T>, y: Pose<T>) -> Pose<T> = x * y;
                rotation_vector(x: &Matrix3<T>) -> Vector3<T> = rotation::vector(x);
                between(x: &Matrix3<T>, y: &Matrix3<T>) -> Vector3<T> = rotation::between(x, y);
                to_homogeneous(x: &Pose<T>) -> Matrix4<T> = x.to_homogeneous();
                vector_of(x: [T; 7]) -> SVector<T, 7> = vector(x);
                matrix_of(x: [[T; 6]; 7]) -> SMatrix<T, 6, 7> = matrix(x);
                mirrored(m: &mut SMatrix<T, 7, 7>) -> () = mirror(m);
                products(m: &mut SMatrix<T, 9, 9>, x: &[[T; 9]; 6], y: &[[T; 6]; 2],
                    runs: &[[usize; 3]; 2]) -> () = inner_products(m, x, y, runs);
            }
        }
    };
}
scalar!(single, f32);
scalar!(double, f64);
scalar!(double_double, Dd);

/// Keeps every function in the program; returns their number.
pub fn all() -> usize {
    single::all() + double::all() + double_double::all()
}
