//! Starts: a good one saves iterations, and no start changes the result.

use bgdyn_sim::cone::{ContactOptions, solve};

use crate::problems::{Random, largest};

#[test]
fn the_solution_is_its_own_start() {
    let mut random = Random::new(41);
    for _ in 0..50 {
        let owned = random.stack::<8>(0.01);
        let mut p = owned.solved();
        let before = p;
        let outcome = owned.solve(&mut p);
        assert_eq!(
            (outcome.sweeps, outcome.newton_steps, outcome.solved),
            (0, 0, true)
        );
        assert_eq!(p, before);
    }
}

/// Each problem twice, the second time with velocities that have changed a little.
#[test]
fn the_impulses_of_the_step_before_save_iterations() {
    let (mut cold, mut warm) = (0, 0);
    for seed in 100..200 {
        let [before, owned] = [0.002, 0.00201].map(|speed| Random::new(seed).stack::<8>(speed));
        let mut p = before.solved();
        let outcome = owned.solve(&mut p);
        assert!(outcome.solved, "{outcome:?}");
        warm += outcome.newton_steps;
        let outcome = owned.solve(&mut [[0.0; 3]; 8]);
        assert!(outcome.solved, "{outcome:?}");
        cold += outcome.newton_steps;
    }
    println!("{warm} Newton steps from the impulses before, {cold} from 0");
    assert!(
        10 * warm < 9 * cold,
        "{warm} Newton steps from the impulses before, {cold} from 0"
    );
}

#[test]
fn a_bad_start_does_no_harm() {
    let mut random = Random::new(43);
    for k in 0..60 {
        let owned = random.dense::<6>(24, 0.3);
        let expected = owned.solved();
        let bad = [1e9, -1e9, f64::NAN, f64::INFINITY, 1e-30, 3.0][k % 6];
        let mut p: [[f64; 3]; 6] =
            std::array::from_fn(|_| std::array::from_fn(|_| bad * random.number()));
        let outcome = owned.solve(&mut p);
        assert!(outcome.solved, "{bad}: {outcome:?}");
        for (x, y) in p.as_flattened().iter().zip(expected.as_flattened()) {
            assert!(
                (x - y).abs() <= 1e-11 * largest(&expected),
                "{bad}: {p:?}, not {expected:?}"
            );
        }
    }
}

/// Sweeps alone find the same velocities.
#[test]
fn newton_steps_can_be_left_out() {
    let mut random = Random::new(44);
    let options = ContactOptions {
        most_sweeps: 100_000,
        most_newton_steps: 0,
        ..ContactOptions::default()
    };
    for _ in 0..20 {
        let owned = random.dense::<5>(20, 0.3);
        let mut p = [[0.0; 3]; 5];
        let outcome = solve(&owned.problem(), &options, &mut p);
        assert!(outcome.solved && outcome.newton_steps == 0, "{outcome:?}");
        let expected = owned.solved();
        for (x, y) in p.as_flattened().iter().zip(expected.as_flattened()) {
            assert!(
                (x - y).abs() <= 1e-10 * largest(&expected),
                "{p:?}, not {expected:?}"
            );
        }
    }
}
