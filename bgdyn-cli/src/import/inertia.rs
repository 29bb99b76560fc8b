//! Computes principal moments of an inertia tensor, and the rules that they violate.

/// Tolerance, relative to the largest principal moment.
const TOLERANCE: f64 = 1e-9;

/// In kg·m²: a milligram 30 µm from the centre of mass. An invalid tensor below this is the rounding error
/// of a zero tensor.
pub(super) const DUST: f64 = 1e-15;

/// The result of the check of a tensor's principal moments.
#[derive(Debug, PartialEq)]
pub(super) enum Verdict {
    Physical,
    /// The sum of the two smaller moments is less than the largest.
    NoTriangle([f64; 3]),
    /// A moment is negative.
    Indefinite([f64; 3]),
}

/// Checks the tensor with entries xx, yy, zz, xy, xz, yz.
pub(super) fn judge(entries: [f64; 6]) -> Verdict {
    let moments = principal_moments(entries);
    let [small, middle, large] = moments;
    let margin = TOLERANCE * small.abs().max(large.abs());
    if small < -margin {
        Verdict::Indefinite(moments)
    } else if small + middle < large - margin {
        Verdict::NoTriangle(moments)
    } else {
        Verdict::Physical
    }
}

/// Returns whether the tensor is invalid, and so small that it was zero before rounding.
pub(super) fn is_dust(entries: [f64; 6]) -> bool {
    entries.iter().all(|entry| entry.abs() < DUST)
        && matches!(judge(entries), Verdict::Indefinite(_))
}

/// Returns the eigenvalues in ascending order, by Jacobi rotations.
pub(super) fn principal_moments([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> [f64; 3] {
    let mut m = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    // Scaled to 1, so that neither large nor small entries exceed the range of f64.
    let scale = m
        .iter()
        .flatten()
        .fold(0.0, |size: f64, entry| size.max(entry.abs()));
    if scale == 0.0 {
        return [0.0; 3];
    }
    m.iter_mut().flatten().for_each(|entry| *entry /= scale);
    for _ in 0..30 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            rotate(&mut m, p, q);
        }
    }
    let mut moments = [m[0][0], m[1][1], m[2][2]].map(|moment| moment * scale);
    moments.sort_by(f64::total_cmp);
    moments
}

/// Applies the rotation in the plane of p and q that makes their product of inertia 0.
fn rotate(m: &mut [[f64; 3]; 3], p: usize, q: usize) {
    let product = m[p][q];
    if product.abs() < f64::MIN_POSITIVE {
        return;
    }
    let ratio = (m[q][q] - m[p][p]) / (2.0 * product);
    let tan = ratio.signum() / (ratio.abs() + ratio.hypot(1.0));
    let cos = 1.0 / tan.hypot(1.0);
    let sin = tan * cos;
    let other = 3 - p - q;
    m[p][p] -= tan * product;
    m[q][q] += tan * product;
    let (a, b) = (m[p][other], m[q][other]);
    let (turned_p, turned_q) = (cos * a - sin * b, sin * a + cos * b);
    for (i, j, value) in [(p, q, 0.0), (p, other, turned_p), (q, other, turned_q)] {
        m[i][j] = value;
        m[j][i] = value;
    }
}

#[cfg(test)]
mod tests {
    use super::{Verdict, is_dust, judge, principal_moments};

    #[test]
    fn moments_of_known_tensors() {
        assert_eq!(
            principal_moments([3.0, 1.0, 2.0, 0.0, 0.0, 0.0]),
            [1.0, 2.0, 3.0]
        );
        // Eigenvalues 2 - √2, 2, 2 + √2.
        let moments = principal_moments([2.0, 2.0, 2.0, -1.0, 0.0, -1.0]);
        let root = std::f64::consts::SQRT_2;
        for (found, wanted) in moments.iter().zip([2.0 - root, 2.0, 2.0 + root]) {
            assert!((found - wanted).abs() < 1e-14, "{moments:?}");
        }
        // A full matrix of ones: 0, 0, 3.
        let moments = principal_moments([1.0; 6]);
        assert!(
            moments[0].abs() < 1e-15
                && moments[1].abs() < 1e-15
                && (moments[2] - 3.0).abs() < 1e-14
        );
        assert_eq!(principal_moments([0.0; 6]), [0.0; 3]);
        assert!(
            principal_moments([1e308; 6])
                .iter()
                .all(|moment| !moment.is_nan())
        );
    }

    #[test]
    fn dust_is_impossible_and_small() {
        assert!(is_dust([0.0, 0.0, 0.0, 0.0, 2.4e-35, 0.0]));
        assert!(!is_dust([1e-16, 1e-16, 1e-16, 0.0, 0.0, 0.0]));
        assert!(!is_dust([0.0, 0.0, 0.0, 0.0, 2.4e-14, 0.0]));
    }

    #[test]
    fn verdicts() {
        assert_eq!(judge([1.0, 1.0, 2.0, 0.0, 0.0, 0.0]), Verdict::Physical);
        assert_eq!(
            judge([1.0, 1.0, 2.0 + 1e-9, 0.0, 0.0, 0.0]),
            Verdict::Physical
        );
        assert_eq!(
            judge([1.0, 1.0, 2.1, 0.0, 0.0, 0.0]),
            Verdict::NoTriangle([1.0, 1.0, 2.1])
        );
        assert_eq!(
            judge([0.0, 0.0, 0.35, 0.0, 0.0, 0.0]),
            Verdict::NoTriangle([0.0, 0.0, 0.35])
        );
        assert!(matches!(
            judge([1.0, 1.0, 1.0, 2.0, 0.0, 0.0]),
            Verdict::Indefinite(_)
        ));
        assert!(matches!(
            judge([-1.0, -1.0, -1.0, 0.0, 0.0, 0.0]),
            Verdict::Indefinite(_)
        ));
    }
}
