//! Courses in time, as expressions.

use bgdyn_runtime::Dd;

use crate::expr::{Builder, Expr, Graph, Leaf, Tangent};
use crate::scene::{Piece, Waveform};

/// Returns the derivative by time.
pub(super) fn rate<'g>(b: &'g Builder, x: Expr<'g>) -> Expr<'g> {
    let seed = |g: &mut Graph, leaf| (leaf == Leaf::Time).then(|| g.constant(Dd::ONE));
    let x = x.signed();
    let rate = b.with_graph(|g| Tangent::new(seed).of(g, x));
    b.expr(rate)
}

/// Returns a signal in time.
pub(super) fn course<'g>(b: &'g Builder, signal: &Waveform) -> Expr<'g> {
    let t = b.leaf(Leaf::Time);
    match signal {
        Waveform::Constant(x) => b.constant(*x),
        Waveform::Ramp { from, rate } => b.constant(*from) + t * *rate,
        Waveform::Harmonic {
            amplitude,
            frequency,
            phase,
            offset,
        } => {
            let turn = Dd::PI * Dd::from_f64(2.0);
            let (_, sine) = b.cos_sin(&[t * (*frequency * turn)], *phase);
            b.constant(*offset) + sine * *amplitude
        }
        Waveform::Table(points) => table(b, t, points),
        Waveform::Pieces { before, pieces } => {
            let mut value = b.constant(*before);
            // The last piece that has begun holds.
            let mut ends: Option<Expr<'g>> = None;
            for piece in pieces.iter().rev() {
                let own = polynomial(b, t, piece);
                let next = pieces.iter().find(|other| other.start > piece.start);
                ends = Some(match (ends, next) {
                    (Some(later), Some(next)) => t.if_less(b.constant(next.start), own, later),
                    _ => own,
                });
            }
            if let (Some(begun), Some(first)) = (ends, pieces.first()) {
                value = t.if_less(b.constant(first.start), value, begun);
            }
            value
        }
        Waveform::Sum(terms) => {
            let terms = terms.iter().map(|term| course(b, term));
            terms.fold(b.zero(), |sum, term| sum + term)
        }
    }
}

/// Returns Σ c_k (t − start)ᵏ by Horner's rule.
fn polynomial<'g>(b: &'g Builder, t: Expr<'g>, piece: &Piece) -> Expr<'g> {
    let since = t - b.constant(piece.start);
    let terms = piece.coefficients.iter().rev();
    terms.fold(b.zero(), |sum, &c| sum * since + b.constant(c))
}

/// Interpolates linearly between points; constant before the first and after the last.
fn table<'g>(b: &'g Builder, t: Expr<'g>, points: &[[Dd; 2]]) -> Expr<'g> {
    let number = |x: Dd| b.constant(x);
    let last = points[points.len() - 1];
    let pieces = points.windows(2).rev();
    let after_first = pieces.fold(number(last[1]), |later, pair| {
        let ([t0, y0], [t1, y1]) = (pair[0], pair[1]);
        let slope = (y1 - y0) / (t1 - t0);
        let line = number(y0) + (t - number(t0)) * slope;
        t.if_less(number(t1), line, later)
    });
    t.if_less(number(points[0][0]), number(points[0][1]), after_first)
}
