//! What is no sound problem ends, and says so.

use bgdyn_sim::cone::{ContactOptions, solve};

use crate::problems::{Owned, Random};

#[test]
fn a_number_that_is_none_is_reported() {
    let mut random = Random::new(51);
    for bad in [f64::NAN, f64::INFINITY] {
        for place in 0..3 {
            let mut owned = random.dense::<4>(8, 0.5);
            match place {
                0 => owned.delassus[1][2][0][2] = bad,
                1 => owned.velocities[2][2] = -bad,
                _ => owned.friction = [f64::NAN; 4],
            }
            let mut p = [[0.1; 3]; 4];
            let outcome = owned.solve(&mut p);
            assert!(!outcome.solved, "{outcome:?}");
            assert!(p.as_flattened().iter().all(|x| x.is_finite()), "{p:?}");
        }
    }
}

#[test]
fn an_indefinite_matrix_ends() {
    let mut random = Random::new(52);
    for _ in 0..100 {
        let mut owned = random.dense::<3>(6, 0.5);
        for x in owned
            .delassus
            .as_flattened_mut()
            .as_flattened_mut()
            .as_flattened_mut()
        {
            *x = random.number();
        }
        let mut p = [[0.0; 3]; 3];
        let outcome = owned.solve(&mut p);
        assert!(p.as_flattened().iter().all(|x| x.is_finite()), "{p:?}");
        assert!(outcome.residual >= 0.0, "{outcome:?}");
        assert!(outcome.sweeps <= ContactOptions::<f64>::default().most_sweeps);
    }
}

/// A contact that approaches and cannot be moved.
#[test]
fn what_no_impulse_changes_is_not_solved() {
    let owned = Owned {
        delassus: Box::new([[[[0.0; 3]; 3]; 1]; 1]),
        velocities: [[0.0, 0.0, -1.0]],
        friction: [0.5],
        active: [true],
    };
    let mut p = [[0.0; 3]];
    let outcome = owned.solve(&mut p);
    assert!(!outcome.solved && outcome.residual == 1.0, "{outcome:?}");
}

#[test]
fn no_contact_needs_no_work() {
    let mut owned = Random::new(53).dense::<4>(8, 0.5);
    owned.active = [false; 4];
    let mut p = [[1.0; 3]; 4];
    let outcome = owned.solve(&mut p);
    assert!(outcome.solved && outcome.sweeps == 0, "{outcome:?}");
    assert_eq!(p, [[0.0; 3]; 4]);
    let empty = Owned::<f64, 0> {
        delassus: Box::new([]),
        velocities: [],
        friction: [],
        active: [],
    };
    assert!(empty.solve(&mut []).solved);
}

#[test]
fn the_bounds_are_kept() {
    let mut random = Random::new(54);
    let options = ContactOptions {
        tolerance: 0.0,
        most_sweeps: 7,
        most_newton_steps: 2,
    };
    for _ in 0..20 {
        let owned = random.dense::<6>(11, 0.8);
        let outcome = solve(&owned.problem(), &options, &mut [[0.0; 3]; 6]);
        assert!(
            outcome.sweeps <= 7 && outcome.newton_steps <= 2,
            "{outcome:?}"
        );
    }
}
