//! Planar loops in closed form against the literal sum, in double-double at closed positions.

use bgdyn_codegen::choice::Choice;
use bgdyn_codegen::formulation::{self, Prepared};
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::references::spec;
use super::robot::{Robot, State, close, largest};

const METHODS: [Method; 7] = [
    Method::ForwardDynamics,
    Method::InverseDynamics,
    Method::MassMatrix,
    Method::Bias,
    Method::Gravity,
    Method::KineticEnergy,
    Method::PotentialEnergy,
];

#[test]
fn print_counts() {
    for name in [
        "four_bar",
        "slider_crank",
        "five_bar",
        "six_bar",
        "excavator",
        "slider_crank_near_singular",
        "parallelograms",
        "andrews",
    ] {
        let robot = Robot::read(&spec(name));
        let choice = Choice::new(&robot.graph, None);
        let prepared = Prepared::new(&robot.graph);
        for method in METHODS {
            let f = choice.function(method).expect("a function");
            println!("{name} {method:?}: {} {:?}", f.formulation, f.operations());
            for r in &f.rejected {
                println!("      rejected {} {}", r.what, r.cost);
            }
            let Some(literal) = formulation::specification().function(&prepared, method) else {
                continue;
            };
            let closure = robot.mechanism.closure().expect("loops");
            for (k, sample) in closure.samples.iter().enumerate() {
                let mut state = robot.state(k as u64);
                for p in closure.moved_positions() {
                    state.q[p.0] = sample[p.0];
                }
                let (found, refused) = state.checked(&f);
                let expected = state.value(&literal);
                let off = found
                    .iter()
                    .zip(&expected)
                    .map(|(x, y)| (*x - *y).to_f64().abs())
                    .fold(0.0, f64::max);
                if off > 1e-24 * largest(&expected) || refused.is_some() {
                    println!(
                        "   sample {k}: {off:e} {:?} {:?} refused {refused:?}",
                        found[0], expected[0]
                    );
                }
            }
        }
    }
}
