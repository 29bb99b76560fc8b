//! Measures the time of a call.

use std::time::{Duration, Instant};

/// Duration of a batch of calls: long compared with the clock's resolution, short compared with
/// interruptions by the system.
const BATCH: Duration = Duration::from_micros(40);
/// Smallest number of batches for a median.
const BATCHES: usize = 31;

/// Returns the duration of a measurement by a program of the comparison: `PEERS_SECONDS`, by default a
/// tenth of a second.
pub fn span() -> Duration {
    let seconds = std::env::var("PEERS_SECONDS").ok();
    let seconds = seconds.and_then(|s| s.parse().ok()).unwrap_or(0.1);
    Duration::from_secs_f64(seconds)
}

/// Returns the median time of a call, ns, over batches that take `span` together. `call(k)` is one call,
/// in state k of `number`.
pub fn median(number: usize, span: Duration, mut call: impl FnMut(usize)) -> f64 {
    let (mut k, mut calls) = (0, 1_u32);
    let mut batch = |calls: u32| {
        let start = Instant::now();
        for _ in 0..calls {
            call(k);
            k = if k + 1 == number { 0 } else { k + 1 };
        }
        start.elapsed()
    };
    // Warms up, and determines the number of calls in a batch.
    let warm = Instant::now();
    while warm.elapsed() < Duration::from_millis(30).min(span) {
        let time = batch(calls);
        if time < BATCH {
            calls *= 2;
        } else if time > 3 * BATCH && calls > 1 {
            calls /= 2;
        }
    }
    let (start, mut times) = (Instant::now(), Vec::new());
    while start.elapsed() < span || times.len() < BATCHES {
        times.push(batch(calls).as_secs_f64() * 1e9 / f64::from(calls));
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
