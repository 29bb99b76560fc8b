//! Locates the first instant of an event within a step.

use crate::real::Real;

/// Largest number of evaluations: bisection alone would need no more.
const MAX_EVALUATIONS: u32 = 400;

/// One end of the search interval: its position and the value at it.
type End<T> = (T, T);

/// Returns the later end of an interval, not longer than `width`, in which `value` first passes through
/// zero. The value is positive or 0 at `low`, and negative (according to `passed`) at `high`. `guess` is
/// tried first.
///
/// Regula falsi in the Illinois form (Dowell, Jarratt 1971); every fourth step is a bisection.
pub(crate) fn first_passage<T: Real, E>(
    mut value: impl FnMut(T) -> Result<(T, bool), E>,
    (mut low, mut high): (End<T>, End<T>),
    guess: Option<T>,
    width: T,
) -> Result<T, E> {
    let half = T::from_f64(0.5);
    // The end that moved last.
    let mut moved = None;
    for i in 0..MAX_EVALUATIONS {
        let length = high.0 - low.0;
        if length <= width {
            break;
        }
        let secant = low.0 + length * (low.1 / (low.1 - high.1));
        let (first, last) = (low.0 + half * width, high.0 - half * width);
        let next = match guess {
            Some(guess) if i == 0 => guess,
            _ if i % 4 == 3 || !secant.is_finite() => low.0 + half * length,
            _ => secant,
        };
        let next = next.max(first).min(last);
        let (value, passed) = value(next)?;
        if passed {
            if moved == Some(true) {
                low.1 = half * low.1;
            }
            high = (next, value);
        } else {
            if moved == Some(false) {
                high.1 = half * high.1;
            }
            low = (next, value);
        }
        moved = Some(passed);
    }
    Ok(high.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(f: impl Fn(f64) -> f64, guess: Option<f64>) -> (f64, u32) {
        let mut calls = 0;
        let ends = ((0.0, f(0.0)), (1.0, f(1.0)));
        let counted = |x: f64| {
            calls += 1;
            Ok::<_, ()>((f(x), f(x) < 0.0))
        };
        let at = first_passage(counted, ends, guess, 1e-15).expect("f is defined everywhere");
        (at, calls)
    }

    #[test]
    fn smooth_values_take_few_evaluations_and_jumps_take_bisection() {
        let (at, calls) = found(|x| x.cos() - 0.9, None);
        assert!(
            (at - 0.9_f64.acos()).abs() < 1e-15 && calls < 16,
            "{at} {calls}"
        );
        let (at, calls) = found(|x| 0.25 - x * x, Some(0.5 + 1e-9));
        assert!((at - 0.5).abs() < 1e-15 && calls < 12, "{at} {calls}");
        let (at, calls) = found(|x| if x < 0.3 { 1.0 } else { -1e-9 }, None);
        assert!((at - 0.3).abs() < 1e-14 && calls < 300, "{at} {calls}");
    }
}
