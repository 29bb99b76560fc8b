//! The same code in single and in double precision.

use bgdyn::Scalar;
use bgdyn::nalgebra::SVector;

bgdyn::bgdyn!("arm.yaml");

fn holding<T: Scalar>(angle: f64) -> T {
    let q = SVector::<T, { arm::NQ }>::from_element(T::from_f64(angle));
    arm::Arm::<T>::default().gravity(&q)[0]
}

fn main() {
    let (single, double): (f32, f64) = (holding(0.7), holding(0.7));
    assert!((f64::from(single) - double).abs() < 1e-5);
}
