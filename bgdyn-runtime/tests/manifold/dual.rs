//! Derivatives by dual numbers against differences in double-double.

use bgdyn_runtime::num_dual::{Dual2, Dual64};
use bgdyn_runtime::{Dd, Scalar};

use crate::joint::{Floating, Joint, Most, Planar, Spherical, displacement, draw};
use crate::random::Random;

/// First and second derivatives along `direction` by dual numbers and by differences in double-double.
fn derivatives(
    most: &mut Most,
    at: &[f64],
    direction: &[f64],
    dual: impl Fn(&[Dual64]) -> Vec<Dual64>,
    second: impl Fn(&[Dual2<f64>]) -> Vec<Dual2<f64>>,
    reference: impl Fn(&[Dd]) -> Vec<Dd>,
) {
    let seeds = || at.iter().zip(direction);
    let first = dual(
        &seeds()
            .map(|(&x, &e)| Dual64::new(x, e))
            .collect::<Vec<_>>(),
    );
    let both = second(
        &seeds()
            .map(|(&x, &e)| Dual2::new(x, e, 0.0))
            .collect::<Vec<_>>(),
    );
    let h = Dd::from_f64(1e-8);
    let moved = |h: Dd| {
        let x = |(&x, &e): (&f64, &f64)| Dd::from_f64(x) + h * Dd::from_f64(e);
        reference(&seeds().map(x).collect::<Vec<_>>())
    };
    let (up, here, down) = (moved(h), moved(Dd::ZERO), moved(-h));
    for k in 0..here.len() {
        let slope = ((up[k] - down[k]) / (h + h)).to_f64();
        let bend = ((up[k] - here[k] - (here[k] - down[k])) / (h * h)).to_f64();
        let errors = [first[k].eps - slope, both[k].v1 - slope, both[k].v2 - bend];
        for error in errors {
            most.see(error.abs(), 5e-14, (at, direction, k, slope, bend));
        }
    }
}

fn dual<J: Joint>(name: &'static str) {
    let mut random = Random(15);
    let mut most = Most(name, 0.0);
    for angle in [
        0.0, 0.0, 1e-12, 1e-5, 0.3, 1.0, 2.0, 3.0, 3.13, 3.999, 4.001, 5.0,
    ] {
        for _ in 0..10 {
            let q = J::sample(&draw::<f64>(&mut random, J::NV));
            let d = displacement::<J, f64>(&mut random, angle);
            let at = [q.clone(), d.clone()].concat();
            let direction: Vec<f64> = (0..2 * J::NQ).map(|_| random.signed()).collect();
            // By q and d together.
            fn whole<J: Joint, T: Scalar>(x: &[T]) -> Vec<T> {
                let (q, d) = x.split_at(J::NQ);
                J::integrate(q, d)
            }
            derivatives(
                &mut most,
                &at,
                &direction,
                whole::<J, Dual64>,
                whole::<J, Dual2<f64>>,
                whole::<J, Dd>,
            );
            if angle <= 3.0 {
                fn back<J: Joint, T: Scalar>(x: &[T]) -> Vec<T> {
                    let (q0, q1) = x.split_at(J::NQ);
                    J::difference(q1, q0)
                }
                let at = [q.clone(), J::integrate(&q, &d)].concat();
                derivatives(
                    &mut most,
                    &at,
                    &direction,
                    back::<J, Dual64>,
                    back::<J, Dual2<f64>>,
                    back::<J, Dd>,
                );
            }
        }
    }
}

#[test]
fn derivatives_by_dual_numbers_are_differences() {
    dual::<Spherical>("spherical, derivatives");
    dual::<Floating>("floating, derivatives");
    dual::<Planar>("planar, derivatives");
}
