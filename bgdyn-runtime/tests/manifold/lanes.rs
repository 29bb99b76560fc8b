//! Lanes against the scalar.

use bgdyn_runtime::manifold::{quaternion_of, rotation, spherical};
use bgdyn_runtime::wide::{f32x8, f64x4};

use crate::joint::{Floating, Joint, Most, Planar, Spherical, Word, displacement, distance, draw};
use crate::random::Random;

macro_rules! lanes {
    ($test:ident: $lanes:ident, $float:ident, $n:literal) => {
        #[test]
        fn $test() {
            fn check<J: Joint>(name: &'static str) {
                let mut most = Most(name, 0.0);
                let mut random = Random(13);
                for _ in 0..500 {
                    // Lanes on both sides of every selection.
                    let each: [[Vec<$float>; 3]; $n] = std::array::from_fn(|lane| {
                        let angle = [0.0, 1e-9, 2.0, 5.0][lane % 4] * random.unit();
                        let q = J::sample(&draw::<$float>(&mut random, J::NV));
                        let other = J::sample(&draw::<$float>(&mut random, J::NV));
                        [q, other, displacement::<J, $float>(&mut random, angle)]
                    });
                    let [q, other, d] = std::array::from_fn(|which| {
                        let component =
                            |k: usize| $lanes::new(each.each_ref().map(|a| a[which][k]));
                        (0..each[0][which].len())
                            .map(component)
                            .collect::<Vec<$lanes>>()
                    });
                    let mut near =
                        |found: Vec<$lanes>, scalar: &dyn Fn(&[Vec<$float>; 3]) -> Vec<$float>| {
                            for (lane, inputs) in each.iter().enumerate() {
                                let found: Vec<_> =
                                    found.iter().map(|x| x.to_array()[lane]).collect();
                                let error = distance(&found, &scalar(inputs));
                                most.see(error, 20.0 * f64::from($float::EPSILON), inputs);
                            }
                        };
                    near(J::integrate(&q, &d), &|[q, _, d]| J::integrate(q, d));
                    near(J::difference(&J::integrate(&q, &d), &q), &|[q, _, d]| {
                        J::difference(&J::integrate(q, d), q)
                    });
                    near(J::position_rates(&q, &d), &|[q, _, d]| {
                        J::position_rates(q, d)
                    });
                    near(J::normalize(&other), &|[_, other, _]| J::normalize(other));
                }
            }
            check::<Spherical>(concat!("spherical, ", stringify!($lanes)));
            check::<Floating>(concat!("floating, ", stringify!($lanes)));
            check::<Planar>(concat!("planar, ", stringify!($lanes)));
            // Rows of the largest component differ by lane.
            let mut random = Random(14);
            let each: [[$float; 4]; $n] = std::array::from_fn(|_| {
                spherical::sample(std::array::from_fn(|_| $float::unit(&mut random)))
            });
            let q = std::array::from_fn(|k| $lanes::new(each.map(|q| q[k])));
            let found = quaternion_of(&rotation(q));
            for (lane, q) in each.into_iter().enumerate() {
                let found = found.map(|x| x.to_array()[lane]);
                let wanted = quaternion_of(&rotation(q));
                assert!(distance(&found, &wanted) <= 4.0 * f64::from($float::EPSILON));
            }
        }
    };
}

lanes!(lanes_equal_the_scalar_in_double_precision: f64x4, f64, 4);
lanes!(lanes_equal_the_scalar_in_single_precision: f32x8, f32, 8);
