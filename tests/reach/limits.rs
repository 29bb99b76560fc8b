//! Limits of the efforts: they hold, and the optimum satisfies the conditions of Karush, Kuhn and Tucker.

use bgdyn_sim::ilqr::Ending;

use super::task::{Joints, Reach, problem};
use super::{Panda7, at_rest};

#[test]
fn limits_hold_and_the_optimum_is_one() {
    let arm = Panda7::default();
    let cost = Reach::new(&arm);
    let mut problem = problem(&arm, &cost);
    let mut free = at_rest(&problem);
    let without = free.solve(&problem, 1e-12, 100).expect("an optimum").cost;

    // Room for a part of what the free optimum takes.
    let room = Joints::from_fn(|i, _| {
        let most = free.efforts().map(|tau| (tau[i] - cost.holding[i]).abs());
        0.4 * most.fold(0.0, f64::max)
    });
    let [lower, upper] = [cost.holding - room, cost.holding + room];
    problem.limits = Some([lower, upper]);
    let mut ilqr = at_rest(&problem);
    let outcome = ilqr.solve(&problem, 1e-14, 300).expect("an optimum");
    assert_eq!(outcome.end, Ending::Converged);
    assert!(outcome.cost > without, "limits cost something");

    let gradient = ilqr.gradient(&problem).expect("derivatives");
    let (mut held, mut most) = (0, 0f64);
    for (tau, slope) in ilqr.efforts().zip(&gradient) {
        for i in 0..tau.len() {
            assert!(lower[i] <= tau[i] && tau[i] <= upper[i]);
            // What the slope could still gain: at a limit only inwards.
            let gain = if tau[i] == lower[i] {
                held += 1;
                (-slope[i]).max(0.0)
            } else if tau[i] == upper[i] {
                held += 1;
                slope[i].max(0.0)
            } else {
                slope[i].abs()
            };
            most = most.max(gain);
        }
    }
    println!(
        "{held} efforts at limits, slope {most:e}, cost {}",
        outcome.cost
    );
    assert!(held > 10, "{held} efforts at limits");
    assert!(most < 1e-7, "a slope of {most:e} is left");
}
