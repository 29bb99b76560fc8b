//! Random problems: the conditions of Signorini and Coulomb hold, in `f64` and `f32`.

use crate::conditions::check;
use crate::problems::Random;

/// Problems for each number of contacts; fewer without optimisation.
const COUNT: usize = if cfg!(debug_assertions) { 100 } else { 500 };

/// Checks random problems with K contacts, of full rank and of half of it. Returns how many are not solved, in `f64` and
/// `f32`, and the largest velocity of a contact that sticks.
fn run<const K: usize>(seed: u64) -> ([usize; 2], f64) {
    let mut random = Random::new(seed);
    let (mut failures, mut slowest) = ([0; 2], 0.0_f64);
    for k in 0..COUNT {
        let n = if k % 2 == 0 { 3 * K + 3 } else { 3 * K / 2 + 2 };
        let mut owned = random.dense::<K>(n, 0.8);
        if k % 5 == 0 {
            owned.friction[0] = 0.0;
        }
        if k % 7 == 0 {
            owned.active[K - 1] = false;
            owned.delassus[K - 1][K - 1] = [[f64::NAN; 3]; 3];
        }
        let mut p = [[0.0; 3]; K];
        if owned.solve(&mut p).solved {
            slowest = slowest.max(check(&owned, &p, 5e-14));
        } else {
            failures[0] += 1;
        }
        let owned = owned.rounded();
        let mut p = [[0.0; 3]; K];
        if owned.solve(&mut p).solved {
            check(&owned, &p, 3e-5);
        } else {
            failures[1] += 1;
        }
    }
    (failures, slowest)
}

/// A thread of a test has 2 MB of memory.
#[test]
fn thirty_two_contacts_fit_on_the_stack() {
    let owned = Random::new(23).dense::<32>(102, 0.8);
    check(&owned, &owned.solved(), 1e-13);
}

#[test]
fn the_conditions_hold_at_random_problems() {
    let results = [
        run::<1>(11),
        run::<2>(12),
        run::<3>(13),
        run::<4>(14),
        run::<5>(15),
        run::<6>(16),
        run::<7>(17),
        run::<8>(18),
        run::<9>(19),
        run::<10>(20),
        run::<11>(21),
        run::<12>(22),
    ];
    for (k, (failures, slowest)) in results.into_iter().enumerate() {
        let k = k + 1;
        println!("{k} contacts: not solved {failures:?} of {COUNT}; sticking at {slowest:e}");
        assert!(
            failures.iter().all(|&f| f <= 2),
            "{k} contacts: {failures:?} of {COUNT}"
        );
        assert!(slowest < 128.0 * f64::EPSILON, "{k} contacts: {slowest:e}");
    }
}
