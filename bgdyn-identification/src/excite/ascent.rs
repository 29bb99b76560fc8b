//! Ascent by the method of limited memory (L-BFGS: Nocedal 1980), with a line search that halves the step.

use nalgebra::DVector;

/// Pairs that are remembered.
const MEMORY: usize = 12;
/// The share of the slope's promise that a step must keep (Armijo).
const KEPT: f64 = 1e-4;
/// So many steps are judged together: the first ones of an ascent are short.
const PATIENCE: usize = 6;
/// So often a step is halved.
const HALVED: usize = 30;

/// A function with slopes.
pub trait Slope {
    /// Returns the value; `None` outside of where it is defined.
    fn value(&self, x: &DVector<f64>) -> Option<f64>;

    /// Returns the slopes at a point where it is defined.
    fn slope(&self, x: &DVector<f64>) -> Option<DVector<f64>>;
}

/// What an ascent found.
#[derive(Clone, Debug)]
pub struct Ascent {
    /// The last point.
    pub x: DVector<f64>,
    /// The values, rising, with that of the start.
    pub values: Vec<f64>,
}

/// Ascends from a point where `f` is defined, at most `rounds` steps; `PATIENCE` steps that rise by less than `least`
/// in sum end it.
pub fn ascend(
    f: &dyn Slope,
    start: DVector<f64>,
    rounds: usize,
    least: f64,
    each: &mut dyn FnMut(),
) -> Ascent {
    let Some(value) = f.value(&start) else {
        return Ascent {
            x: start,
            values: vec![],
        };
    };
    let mut found = Ascent {
        x: start,
        values: vec![value],
    };
    let mut pairs: Vec<[DVector<f64>; 2]> = Vec::new();
    let Some(mut slope) = f.slope(&found.x) else {
        return found;
    };
    for _ in 0..rounds {
        each();
        let mut direction = direction(&pairs, &slope);
        if direction.dot(&slope) <= 0.0 {
            pairs.clear();
            direction = slope.clone();
        }
        // Without memory the slope has no scale: begin with a short step.
        let first = match pairs.is_empty() {
            true => 0.02 / direction.norm(),
            false => 1.0,
        };
        let promise = direction.dot(&slope);
        let now = *found.values.last().expect("the start's");
        let mut step = first;
        let next = (0..HALVED).find_map(|_| {
            let x = &found.x + &direction * step;
            let value = f
                .value(&x)
                .filter(|value| *value > now + KEPT * step * promise);
            step /= 2.0;
            value.map(|value| (x, value))
        });
        let Some((x, value)) = next else {
            if pairs.is_empty() {
                break;
            }
            pairs.clear();
            continue;
        };
        let Some(new) = f.slope(&x) else { break };
        // Of −f, whose curvature is positive near a maximum.
        let pair = [&x - &found.x, &slope - &new];
        if pair[0].dot(&pair[1]) > 1e-10 * pair[0].norm() * pair[1].norm() {
            pairs.push(pair);
        }
        if pairs.len() > MEMORY {
            pairs.remove(0);
        }
        (found.x, slope) = (x, new);
        found.values.push(value);
        let before = found.values.len().checked_sub(1 + PATIENCE);
        if before.is_some_and(|i| value - found.values[i] < least) {
            break;
        }
    }
    found
}

/// Returns the direction of ascent from the remembered pairs: two loops over them.
fn direction(pairs: &[[DVector<f64>; 2]], slope: &DVector<f64>) -> DVector<f64> {
    let mut d = slope.clone();
    let mut shares = Vec::new();
    for [s, y] in pairs.iter().rev() {
        let share = s.dot(&d) / s.dot(y);
        d.axpy(-share, y, 1.0);
        shares.push(share);
    }
    if let Some([s, y]) = pairs.last() {
        d *= s.dot(y) / y.norm_squared();
    }
    for ([s, y], share) in pairs.iter().zip(shares.into_iter().rev()) {
        let back = y.dot(&d) / s.dot(y);
        d.axpy(share - back, s, 1.0);
    }
    d
}

#[cfg(test)]
mod tests {
    use super::*;

    /// −Σ (1 − x)² − 100 (y − x²)², defined for x < 1.2.
    struct Valley;

    impl Slope for Valley {
        fn value(&self, x: &DVector<f64>) -> Option<f64> {
            let value = -(1.0 - x[0]).powi(2) - 100.0 * (x[1] - x[0] * x[0]).powi(2);
            (x[0] < 1.2).then_some(value)
        }

        fn slope(&self, x: &DVector<f64>) -> Option<DVector<f64>> {
            let off = x[1] - x[0] * x[0];
            let slopes = vec![2.0 * (1.0 - x[0]) + 400.0 * off * x[0], -200.0 * off];
            Some(DVector::from_vec(slopes))
        }
    }

    #[test]
    fn a_curved_valley_is_followed_to_its_end() {
        let start = DVector::from_vec(vec![-1.2, 1.0]);
        let found = ascend(&Valley, start, 200, 0.0, &mut || {});
        assert!(found.values.windows(2).all(|w| w[1] > w[0]));
        assert!(found.x.add_scalar(-1.0).amax() < 1e-5, "{}", found.x);
    }
}
