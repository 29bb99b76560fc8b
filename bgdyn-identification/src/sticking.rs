//! Looks for dry friction that holds a joint: near rest the model misses the efforts by more than elsewhere.

use crate::judge::rms;
use crate::prepare::Samples;
use crate::statistics::median;

/// Bins of the rows over the speed, at most.
const BINS: usize = 40;
/// Rows of a bin, at least.
const BIN_ROWS: usize = 16;
/// The slowest rows stick if their residual exceeds that of the faster half so many times. Where velocities only change
/// their signs, the steps of the friction leave four times as much; where joints stick, eight to thirty times.
const STICKS: f64 = 6.0;
/// They end where it does not exceed it so many times.
const ENDS: f64 = 3.0;

/// Rows near rest of which the model misses more than of others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sticking {
    /// The joint.
    pub joint: usize,
    /// The speed below which rows are so, rad/s or m/s.
    pub below: f64,
    /// The residual of the slowest of them over that of the faster half.
    pub factor: f64,
}

/// Returns the joints that stick, by the `residual` of each row. Rows that are slower than `still` have no weight, and
/// are not looked at.
pub fn sticking(samples: &Samples, residual: &[f64], still: f64) -> Vec<Sticking> {
    let of_joint = |joint: usize| {
        let rows = (joint..residual.len()).step_by(samples.joints);
        let rows = rows.map(|i| (samples.v[i].abs(), residual[i]));
        let (below, factor) = slow_part(rows.filter(|(v, _)| *v >= still).collect())?;
        Some(Sticking {
            joint,
            below,
            factor,
        })
    };
    (0..samples.joints).filter_map(of_joint).collect()
}

/// Returns the speed below which residuals are larger, and how many times; `rows` are speeds with residuals.
fn slow_part(mut rows: Vec<(f64, f64)>) -> Option<(f64, f64)> {
    let bins = BINS.min(rows.len() / BIN_ROWS);
    if bins < 4 {
        return None;
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    // The highest speed of each bin, and its residual.
    let of_bin = |bin: &[(f64, f64)]| {
        let residuals: Vec<f64> = bin.iter().map(|row| row.1).collect();
        (bin[bin.len() - 1].0, rms(&residuals))
    };
    let bins: Vec<(f64, f64)> = rows.chunks(rows.len().div_ceil(bins)).map(of_bin).collect();
    let fast = bins[bins.len() / 2..].iter().map(|bin| bin.1).collect();
    let usual = median(fast);
    let slow = bins.iter().take_while(|bin| bin.1 > ENDS * usual);
    let (below, _) = slow.last()?;
    let factor = bins[0].1 / usual;
    (factor > STICKS).then_some((*below, factor))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Speeds that are evenly spread, with residuals of both signs.
    fn rows(residual: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        let row = |k: usize| {
            let speed = k as f64 / 1000.0;
            let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
            (speed, sign * residual(speed))
        };
        // In another order than that of the speeds.
        (0..1000).map(|k| row(k * 7 % 1000)).collect()
    }

    #[test]
    fn rows_near_rest_stick() {
        let (below, factor) = slow_part(rows(|v| if v < 0.1 { 8.0 } else { 1.0 })).unwrap();
        assert!((below - 0.1).abs() < 0.03, "{below}");
        assert!((factor - 8.0).abs() < 0.1, "{factor}");
    }

    #[test]
    fn even_residuals_do_not() {
        assert_eq!(slow_part(rows(|_| 1.0)), None);
        // Steps of friction that is known.
        assert_eq!(slow_part(rows(|v| if v < 0.05 { 4.0 } else { 1.0 })), None);
        assert_eq!(slow_part(rows(|v| 1.0 + 8.0 * v)), None);
        // A few rows far off are no friction.
        let few = |v: f64| if v < 0.004 { 8.0 } else { 1.0 };
        assert_eq!(slow_part(rows(few)), None);
        assert_eq!(slow_part(rows(|_| 1.0)[..40].to_vec()), None);
    }
}
