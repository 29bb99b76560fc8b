//! The rows of loops as expressions: rates, values, second derivatives.

use std::borrow::Cow;

use crate::expr::{Builder, Expr};
use crate::mechanism::closure::{Closure, KinematicLoop, LoopChain, LoopRow, RelativePlace};

/// The way in which the rows of the loops are written and solved.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LoopForm {
    /// In the axes of places b, for loops whose rows hold there too.
    pub(super) reversed: bool,
    /// For the vectors S u and Sᵀ f alone, without the matrix S.
    pub(super) by_vectors: bool,
}

/// Returns the chain of a loop in this form.
fn chain(one: &KinematicLoop, form: LoopForm) -> Cow<'_, LoopChain> {
    match form.reversed && one.reversible {
        true => Cow::Owned(one.chain.reversed()),
        false => Cow::Borrowed(&one.chain),
    }
}

/// The rows of the loops: rates per unit velocity of the open tree, and −γ.
pub(super) struct LoopRows<'g> {
    /// For each row of the closure, the rate for a unit of each velocity of the tree.
    pub(super) rates: Vec<Vec<Expr<'g>>>,
}

/// Returns the rows of the loops.
pub(super) fn loop_rows<'g>(
    b: &'g Builder,
    closure: &Closure,
    q: &[Expr<'g>],
    form: LoopForm,
) -> LoopRows<'g> {
    let places: Vec<RelativePlace<Expr<'g>>> = closure
        .loops
        .iter()
        .map(|one| {
            let chain = chain(one, form);
            chain.place(&chain.frames(q, &b), one.kind.coincident, &b)
        })
        .collect();
    let rates = closure.rows.iter().map(|row| {
        let (place, length) = (&places[row.closes], closure.loops[row.closes].length);
        let mut rates = vec![b.zero(); closure.positions.len()];
        for (j, column) in &place.columns {
            rates[j.0] = row.kind.rate(place, column, length);
        }
        rates
    });
    LoopRows {
        rates: rates.collect(),
    }
}

/// Returns c(q), row by row.
pub(super) fn loop_residuals<'g>(
    b: &'g Builder,
    closure: &Closure,
    q: &[Expr<'g>],
) -> Vec<Expr<'g>> {
    let row = |row: &LoopRow| {
        let one = &closure.loops[row.closes];
        let frames = one.chain.frames(q, &b);
        let place = one.chain.place(&frames, one.kind.coincident, &b);
        row.kind.residual(&place, one.length, |x| b.constant(x))
    };
    closure.rows.iter().map(row).collect()
}

/// Returns −γ = Ḃ q̇ for velocities of the tree, row by row.
pub(super) fn loop_bias<'g>(
    b: &'g Builder,
    closure: &Closure,
    (q, v): (&[Expr<'g>], &[Expr<'g>]),
    form: LoopForm,
) -> Vec<Expr<'g>> {
    let row = |row: &LoopRow| {
        let one = &closure.loops[row.closes];
        let chain = chain(one, form);
        let frames = chain.frames(q, &b);
        let place = chain.place(&frames, one.kind.coincident, &b);
        let rates = chain.rates(&frames, v, &b);
        row.kind.bias(&place, &rates, one.length)
    };
    closure.rows.iter().map(row).collect()
}
