//! Two bars for each line: what something costs, and what comes of it.

use crate::svg::{ALARM, Anchor, Drawing, FAINT, GRID, INK};
use crate::text::short;

/// A line with its two bars.
pub(super) struct Bar {
    pub label: String,
    /// On a linear axis; may be negative.
    pub left: Option<f64>,
    /// On a logarithmic axis.
    pub right: Option<f64>,
    /// Why there are none.
    pub failed: Option<String>,
}

/// A figure of such lines.
pub(super) struct Bars {
    pub title: String,
    pub left: String,
    pub right: String,
    pub bars: Vec<Bar>,
    /// Left bars shorter than this say nothing, and are drawn so.
    pub noise: f64,
}

const WIDTH: f64 = 1000.0;
const TOP: f64 = 92.0;
const LINE: f64 = 30.0;
const THICK: f64 = 17.0;
/// Where the bars of both sides begin and end.
const COST: (f64, f64) = (225.0, 560.0);
const CHANGE: (f64, f64) = (630.0, 910.0);

impl Bars {
    pub fn draw(&self) -> String {
        let bottom = TOP + LINE * self.bars.len() as f64;
        let mut d = Drawing::new(WIDTH, bottom + 18.0);
        d.text((24.0, 32.0), 17, INK, Anchor::Start, &self.title);
        d.text((COST.0, TOP - 24.0), 14, INK, Anchor::Start, &self.left);
        d.text((CHANGE.0, TOP - 24.0), 14, INK, Anchor::Start, &self.right);
        for (i, bar) in self.bars.iter().enumerate() {
            let y = TOP + LINE * i as f64;
            d.line((24.0, y - 6.0), (WIDTH - 24.0, y - 6.0), GRID, "");
            d.text((COST.0 - 60.0, y + 13.0), 14, INK, Anchor::End, &bar.label);
            self.cost(&mut d, bar, y);
            self.change(&mut d, bar, y);
        }
        d.finish()
    }

    /// The left bar, from a zero that leaves room for negative ones.
    fn cost(&self, d: &mut Drawing, bar: &Bar, y: f64) {
        let values = || self.bars.iter().filter_map(|b| b.left);
        let (low, high) = values().fold((0.0_f64, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
        let span = (high - low).max(f64::MIN_POSITIVE);
        // Room for the numbers behind the bars.
        let scale = (COST.1 - COST.0 - 70.0) / span;
        let zero = COST.0 - low * scale;
        let Some(x) = bar.left else {
            return;
        };
        let (from, length) = (zero + x.min(0.0) * scale, x.abs() * scale);
        let colour = match x {
            x if x.abs() < self.noise => FAINT,
            x if x < 0.0 => "#9ccbe6",
            _ => "#0072b2",
        };
        d.rectangle((from, y), (length.max(1.0), THICK), colour);
        match x < 0.0 {
            true => d.text((from - 6.0, y + 13.0), 13, INK, Anchor::End, &short(x)),
            false => d.text(
                (from + length + 6.0, y + 13.0),
                13,
                INK,
                Anchor::Start,
                &short(x),
            ),
        }
        d.line((zero, y - 6.0), (zero, y + LINE - 6.0), FAINT, "");
    }

    /// The right bar, from the decade below the smallest.
    fn change(&self, d: &mut Drawing, bar: &Bar, y: f64) {
        let logs = self
            .bars
            .iter()
            .filter_map(|b| b.right)
            .filter(|x| *x > 0.0);
        let logs = logs.map(f64::log10);
        let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
            (l.min(x), h.max(x))
        });
        if let Some(why) = &bar.failed {
            d.text(
                (CHANGE.0 + 4.0, y + 13.0),
                13,
                ALARM,
                Anchor::Start,
                &format!("failed: {why}"),
            );
            return;
        }
        let Some(x) = bar.right else {
            return;
        };
        let low = (low - 0.3).floor();
        let span = (high - low).max(1.0);
        let length = match x > 0.0 {
            true => (CHANGE.1 - CHANGE.0) * (x.log10() - low) / span,
            false => 0.0,
        };
        d.rectangle((CHANGE.0, y), (length.max(1.0), THICK), "#d55e00");
        d.text(
            (CHANGE.0 + length + 6.0, y + 13.0),
            13,
            INK,
            Anchor::Start,
            &short(x),
        );
        d.line((CHANGE.0, y - 6.0), (CHANGE.0, y + LINE - 6.0), FAINT, "");
    }
}
