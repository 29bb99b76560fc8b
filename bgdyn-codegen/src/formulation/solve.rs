//! M q̈ = f for a symmetric positive definite M, unrolled.

use bgdyn_runtime::Dd;

use crate::expr::{Builder, Ex};

/// Solves M x = f by M = Lᵀ D L from the last coordinate to the first, which keeps the zeros of
/// a branching mechanism (Featherstone 2005). `mass` is the lower triangle; every pivot is checked.
pub(super) fn ltdl<'g>(
    b: &'g Builder,
    mut mass: Vec<Vec<Ex<'g>>>,
    mut x: Vec<Ex<'g>>,
) -> Vec<Ex<'g>> {
    let n = x.len();
    let original: Vec<Ex<'g>> = (0..n).map(|k| mass[k][k]).collect();
    let mut inverse = vec![b.zero(); n];
    for k in (0..n).rev() {
        // Only what was really subtracted can have lost digits; what folded to a number was
        // subtracted in double-double, which tells a small rest from nothing.
        let folded = mass[k][k].as_constant().is_some();
        let magnitude = if folded || mass[k][k] == original[k] {
            b.zero()
        } else {
            original[k]
        };
        let pivot = mass[k][k].pivot(magnitude, k);
        inverse[k] = b.constant(Dd::ONE) / pivot;
        // M_ij ← M_ij − l_ki M_kj for i, j < k with l_ki = M_ki / d_k
        for i in (0..k)
            .rev()
            .filter(|&i| !mass[k][i].is_zero())
            .collect::<Vec<_>>()
        {
            // Two joints on one axis have equal entries: M_ki / M_kk = ±1 folds exactly.
            let l = if mass[k][i] == mass[k][k] {
                b.number(1.0)
            } else if mass[k][i] == -mass[k][k] {
                b.number(-1.0)
            } else {
                mass[k][i] * inverse[k]
            };
            for j in (0..=i)
                .filter(|&j| !mass[k][j].is_zero())
                .collect::<Vec<_>>()
            {
                mass[i][j] = mass[i][j] - l * mass[k][j];
            }
            mass[k][i] = l;
        }
    }
    // Lᵀ y = f, then L x = D⁻¹ y
    for k in (0..n).rev() {
        for i in 0..k {
            x[i] = x[i] - mass[k][i] * x[k];
        }
    }
    for k in 0..n {
        x[k] = x[k] * inverse[k];
        for i in 0..k {
            x[k] = x[k] - mass[k][i] * x[i];
        }
    }
    x
}
