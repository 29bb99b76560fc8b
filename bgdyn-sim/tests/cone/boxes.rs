//! Boxes on four corners: redundant contacts.

use crate::conditions::check;
use crate::problems::{Owned, Random, add_point, inverse_of_box, largest};

const HALF: [f64; 3] = [0.5, 0.4, 0.3];
const MASS: f64 = 7.0;

fn corner(c: usize) -> [f64; 3] {
    let sign = |bit: usize| if c & bit == 0 { 1.0 } else { -1.0 };
    [sign(1) * HALF[0], sign(2) * HALF[1], -HALF[2]]
}

/// A box on a table with velocity (v, ω), and the same friction at each corner.
fn boxed(v: [f64; 6], friction: f64) -> Owned<f64, 4> {
    let mut rows = vec![vec![0.0; 6]; 12];
    for c in 0..4 {
        add_point(&mut rows[3 * c..3 * c + 3], 0, corner(c), 1.0);
    }
    Owned::new(&rows, &inverse_of_box(MASS, HALF), &v, [friction; 4])
}

/// The impulse on the box, and its moment about the centre.
fn wrench(p: &[[f64; 3]; 4]) -> [f64; 6] {
    let mut sum = [0.0; 6];
    for c in 0..4 {
        let r = corner(c);
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            sum[i] += p[c][i];
            sum[3 + i] += r[j] * p[c][k] - r[k] * p[c][j];
        }
    }
    sum
}

fn assert_wrench(p: &[[f64; 3]; 4], expected: [f64; 6]) {
    let (found, size) = (wrench(p), largest(p));
    for (x, y) in found.into_iter().zip(expected) {
        assert!((x - y).abs() < 1e-12 * size, "{found:?}, not {expected:?}");
    }
}

#[test]
fn a_box_at_rest_is_carried_and_held() {
    let moments = inverse_of_box(MASS, HALF).map(|x| 1.0 / x);
    for v in [
        [0.0, 0.0, -0.01, 0.0, 0.0, 0.0],
        [2e-3, -1e-3, -0.01, 0.0, 0.0, 0.0],
        [1e-3, 1e-3, -0.01, 3e-3, -2e-3, 4e-3],
    ] {
        let owned = boxed(v, 0.5);
        let p = owned.solved();
        check(&owned, &p, 1e-12);
        // It stops: the wrench is all momentum.
        assert_wrench(&p, std::array::from_fn(|i| -moments[i] * v[i]));
    }
}

#[test]
fn a_box_that_slides_is_braked_by_its_weight_times_friction() {
    let friction = 0.3;
    let owned = boxed([0.6, 0.8, -0.01, 0.0, 0.0, 0.0], friction);
    let p = owned.solved();
    check(&owned, &p, 1e-12);
    let normal = MASS * 0.01;
    let brake = friction * normal;
    let [x, y, z, ..] = wrench(&p);
    for (found, expected) in [(x, -0.6 * brake), (y, -0.8 * brake), (z, normal)] {
        assert!(
            (found - expected).abs() < 1e-12 * normal,
            "{found}, not {expected}"
        );
    }
}

#[test]
fn a_box_on_one_edge_presses_there_only() {
    // It turns about y: the corners at +x come down, the others go up.
    let owned = boxed([0.0, 0.0, 0.1, 0.0, 1.0, 0.0], 0.4);
    let p = owned.solved();
    check(&owned, &p, 1e-12);
    for c in 0..4 {
        assert_eq!(p[c][2] > 0.0, corner(c)[0] > 0.0, "{p:?}");
    }
}

#[test]
fn stacks_are_solved() {
    let mut random = Random::new(3);
    let mut slowest: f64 = 0.0;
    for speed in [0.0, 0.003, 1.0] {
        for _ in 0..30 {
            let owned = random.stack::<8>(speed);
            slowest = slowest.max(check(&owned, &owned.solved(), 1e-12));
            let owned = random.stack::<12>(speed);
            slowest = slowest.max(check(&owned, &owned.solved(), 1e-12));
        }
    }
    println!(
        "sticking contacts move at {slowest:e} of the velocity that the largest impulse causes"
    );
    assert!(slowest < 128.0 * f64::EPSILON, "{slowest:e}");
}
