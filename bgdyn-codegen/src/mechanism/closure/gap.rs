//! By how much loops that do not close miss.

use bgdyn_runtime::Dd;

use super::{ClosingRow, Closure, RowKind};

/// The gap of a loop.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gap {
    /// Between the places, or what a rod is too short or too long by, m.
    pub distance: f64,
    /// By which the rotation differs from the held one, rad.
    pub angle: f64,
}

impl Closure {
    /// Returns the loop with the largest gap at a position of the open tree, relative to the size of the largest loop and
    /// to 1 rad.
    pub fn widest_gap(&self, q: &[Dd]) -> (usize, Gap) {
        let size = self.size();
        let all = (0..self.loops.len()).map(|closes| (closes, self.gap(closes, q)));
        let weight = |gap: &Gap| gap.distance / size + gap.angle;
        let widest = all.max_by(|a, b| weight(&a.1).total_cmp(&weight(&b.1)));
        widest.unwrap_or_default()
    }

    /// Returns the gap of a loop, with all its rows that decide about positions.
    fn gap(&self, closes: usize, q: &[Dd]) -> Gap {
        let one = &self.loops[closes];
        let rows = one
            .rows()
            .into_iter()
            .filter(|(_, kind)| kind.has_positions());
        let rows: Vec<_> = rows
            .map(|(name, kind)| super::LoopRow { closes, name, kind })
            .collect();
        let (residuals, _) = self.values(&rows, q);
        let (mut distance, mut sine) = (0.0_f64, 0.0_f64);
        for (row, x) in rows.iter().zip(residuals) {
            let x = x.to_f64();
            match row.kind {
                // (d·d − L²) / 2L
                RowKind::Closing(ClosingRow::Length) => {
                    let length = one.length.to_f64();
                    let found = f64::max(0.0, length * (length + 2.0 * x)).sqrt();
                    distance = distance.hypot(found - length);
                }
                RowKind::Closing(ClosingRow::Place(_)) | RowKind::Contact(_) => {
                    distance = distance.hypot(x);
                }
                RowKind::Closing(_) => sine = sine.hypot(x),
            }
        }
        let angle = f64::min(sine, 1.0).asin();
        let angle = match self.flipped(closes, q) {
            true => std::f64::consts::PI - angle,
            false => angle,
        };
        Gap { distance, angle }
    }
}
