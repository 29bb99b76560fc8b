//! Quantiles.

/// Returns the median; 0 for no numbers.
pub fn median(x: Vec<f64>) -> f64 {
    quantile(x, 0.5)
}

/// Returns the number below which this share is; 0 for no numbers.
pub fn quantile(mut x: Vec<f64>, share: f64) -> f64 {
    let at = (share * x.len() as f64) as usize;
    match x.is_empty() {
        true => 0.0,
        false => *x.select_nth_unstable_by(at, f64::total_cmp).1,
    }
}
