//! The conditions of Signorini and Coulomb, checked one by one, not by the natural map of the solver.

use bgdyn_sim::Real;

use crate::problems::{Owned, largest};

/// Asserts the conditions at every contact. `tolerance` is relative to the largest impulse, and for velocities to that times
/// a third of the trace of the block. Returns the largest velocity of a contact inside of its cone, in that unit.
pub fn check<T: Real, const K: usize>(
    owned: &Owned<T, K>,
    impulses: &[[T; 3]; K],
    tolerance: f64,
) -> f64 {
    let (p, after) = (impulses.map(|p| p.map(T::to_f64)), owned.after(impulses));
    let size = largest(&p);
    let mut slowest: f64 = 0.0;
    for c in 0..K {
        let ([px, py, pn], [vx, vy, vn]) = (p[c], after[c]);
        if !owned.active[c] {
            assert_eq!(
                p[c], [0.0; 3],
                "an impulse at contact {c}, which is not active"
            );
            continue;
        }
        let trace: f64 = (0..3).map(|i| owned.delassus[c][c][i][i].to_f64()).sum();
        let (small, slow) = (tolerance * size, tolerance * size * trace / 3.0);
        let (pt, vt) = (px.hypot(py), vx.hypot(vy));
        let limit = owned.friction[c].to_f64() * pn;
        let about = format!("contact {c}: p {:?}, γ {:?}, μ p_n {limit}", p[c], after[c]);
        assert!(
            pn >= 0.0 && pt <= limit * (1.0 + 8.0 * T::EPSILON.to_f64()),
            "cone, {about}"
        );
        assert!(vn >= -slow, "penetration, {about}");
        assert!(pn <= small || vn <= slow, "complementarity, {about}");
        if limit - pt > 8.0 * small {
            assert!(vt <= slow, "sticking, {about}");
            slowest = slowest.max(vt / (size * trace / 3.0));
        }
        if vt > 8.0 * slow {
            assert!(limit - pt <= small, "friction below its limit, {about}");
        }
        // Against the velocity.
        let product = px * vx + py * vy;
        assert!(product <= size * slow, "friction that drives, {about}");
        let across = (px * vy - py * vx).abs();
        assert!(
            across <= 8.0 * small * (vt + pt * trace / 3.0),
            "direction, {about}"
        );
    }
    slowest
}
