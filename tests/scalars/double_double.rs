//! Checks that compiled code in double-double agrees with that in `f64`. (`tests/compiled` compares it
//! with the evaluator.)

use bgdyn::Dynamics;
use bgdyn::nalgebra::SVector;
use bgdyn::runtime::Dd;
use bgdyn_codegen::random::Random;

use crate::models::puma560::Puma560;
use crate::models::scara4::Scara4;
use crate::models::{State, results, vector, widen};

fn near(what: &str, found: &[Dd], wanted: &[Dd], relative: f64) {
    assert_eq!(found.len(), wanted.len(), "{what}");
    let size = wanted.iter().map(|x| x.abs().to_f64()).fold(1.0, f64::max);
    for (x, y) in found.iter().zip(wanted) {
        let error = (*x - *y).abs().to_f64();
        assert!(
            error <= relative * size,
            "{what}: off by {error:e} of {size:e}"
        );
    }
}

fn agrees<const N: usize>(
    robot: &str,
    plain: &impl Dynamics<f64, N, N>,
    double: &impl Dynamics<Dd, N, N>,
) {
    let mut random = Random(43);
    for _ in 0..50 {
        let narrow: State<f64, N> = [
            vector(&mut random, 3.0),
            vector(&mut random, 2.0),
            vector(&mut random, 5.0),
        ];
        let state: State<Dd, N> = widen(&narrow);
        let [q, v, tau] = &state;
        let found = results(double, &state);
        for ((name, found), (_, wanted)) in found.iter().zip(results(plain, &narrow)) {
            let wanted: Vec<Dd> = wanted.into_iter().map(Dd::from_f64).collect();
            near(&format!("{robot} {name}"), found, &wanted, 1e-12);
        }
        let accelerations: SVector<Dd, N> = double.forward_dynamics(q, v, tau).expect("regular");
        let what = format!("{robot} forward_dynamics");
        let [q, v, tau] = &narrow;
        let wanted = plain.forward_dynamics(q, v, tau).expect("regular");
        let wanted = wanted.map(Dd::from_f64);
        near(&what, accelerations.as_slice(), wanted.as_slice(), 1e-12);
    }
}

#[test]
fn double_double_extends_double_precision() {
    agrees::<6>("puma560", &Puma560::<f64>::default(), &Puma560::default());
    agrees::<4>("scara4", &Scara4::<f64>::default(), &Scara4::default());
}
