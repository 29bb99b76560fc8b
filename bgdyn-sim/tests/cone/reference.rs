//! An independent method: de Saxcé's fixed point around projected gradients with small steps. It takes thousands of steps,
//! for problems whose solution is unique.

use crate::problems::{Owned, Random, largest};

/// Projects a point onto the cone |p_t| ≤ μ p_n along the gradient of the distance, by the three cases as printed.
fn onto_cone(friction: f64, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let tangential = x.hypot(y);
    if tangential <= friction * z {
        [x, y, z]
    } else if friction * tangential <= -z {
        [0.0; 3]
    } else {
        let normal = (friction * tangential + z) / (1.0 + friction * friction);
        let scale = friction * normal / tangential;
        [scale * x, scale * y, normal]
    }
}

/// Minimises ½ pᵀGp + (b + μ |γ_t| n)ᵀ p over the cones again and again, with |γ_t| of the minimum before.
fn reference<const K: usize>(owned: &Owned<f64, K>) -> [[f64; 3]; K] {
    let rows = owned
        .delassus
        .iter()
        .flat_map(|row| (0..3).map(move |i| row.map(|b| b[i])));
    let norm = rows.map(|row| row.as_flattened().iter().map(|x| x.abs()).sum::<f64>());
    let step = 1.0 / norm.fold(0.0, f64::max);
    let (mut p, mut slip) = ([[0.0; 3]; K], [0.0; K]);
    for _ in 0..60 {
        for _ in 0..500 {
            let after = owned.after(&p);
            p = std::array::from_fn(|c| {
                let [x, y, z] = after[c];
                let gradient = [x, y, z + owned.friction[c] * slip[c]];
                onto_cone(
                    owned.friction[c],
                    std::array::from_fn(|i| p[c][i] - step * gradient[i]),
                )
            });
        }
        slip = owned.after(&p).map(|[x, y, _]| x.hypot(y));
    }
    p
}

fn compare<const K: usize>(seed: u64, count: usize) {
    let mut random = Random::new(seed);
    for k in 0..count {
        let mut owned = random.dense::<K>(6 * K + 3, 0.3);
        // Well conditioned, so that the small steps arrive.
        for c in 0..K {
            (0..3).for_each(|i| owned.delassus[c][c][i][i] += 2.0);
        }
        let (found, expected) = (owned.solved(), reference(&owned));
        let size = largest(&expected);
        for (x, y) in found.as_flattened().iter().zip(expected.as_flattened()) {
            assert!(
                (x - y).abs() <= 1e-9 * size,
                "problem {k}: {found:?}, not {expected:?}"
            );
        }
    }
}

#[test]
fn unique_solutions_are_those_of_small_steps() {
    compare::<1>(31, 4);
    compare::<2>(32, 4);
    compare::<4>(34, 3);
}
