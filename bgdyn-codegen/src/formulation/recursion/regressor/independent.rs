//! Finds which columns are independent, in double-double.

use bgdyn_runtime::{Dd, Scalar};

/// A column of which less than this share is independent of the columns before it depends on them. The shares of other
/// columns are above 1e-3, and the rounding errors below 1e-25.
const LEAST: f64 = 1e-12;

/// A column shorter than this share of the longest one consists of rounding errors of zeros.
const ZERO: f64 = 1e-26;

/// A coefficient below this share of the largest one is a rounding error.
const NOISE: f64 = 1e-20;

/// What was found of columns.
pub(super) struct Independence {
    /// Each dependent column with its coefficients by independent ones before it.
    pub dependent: Vec<(usize, Vec<(usize, Dd)>)>,
}

/// A column scaled to length 1 after those before it were removed, with its coefficients by them.
struct UnitColumn {
    column: usize,
    unit: Vec<Dd>,
    /// Components along the directions before, and the length along its own.
    triangle: Vec<Dd>,
}

/// Orthogonalises the columns one after the other (modified Gram–Schmidt, twice).
pub(super) fn independent(columns: &[Vec<Dd>]) -> Independence {
    let mut directions: Vec<UnitColumn> = Vec::new();
    let mut dependent = Vec::new();
    let longest = columns.iter().map(|column| length(column).to_f64());
    let longest = longest.fold(0.0, f64::max);
    for (column, values) in columns.iter().enumerate() {
        let size = length(values);
        let mut rest = values.clone();
        let mut triangle = vec![Dd::ZERO; directions.len()];
        for _ in 0..2 {
            for (known, along) in directions.iter().zip(&mut triangle) {
                let part = dot(&known.unit, &rest);
                *along += part;
                for (x, &unit) in rest.iter_mut().zip(&known.unit) {
                    *x -= part * unit;
                }
            }
        }
        let left = length(&rest);
        if size.to_f64() <= ZERO * longest {
            dependent.push((column, Vec::new()));
            continue;
        }
        if left.to_f64() <= LEAST * size.to_f64() {
            dependent.push((column, solve(&directions, triangle)));
            continue;
        }
        triangle.push(left);
        let unit = rest.into_iter().map(|x| x / left).collect();
        directions.push(UnitColumn {
            column,
            unit,
            triangle,
        });
    }
    Independence { dependent }
}

/// Solves R x = y for the upper triangle R of the directions.
fn solve(directions: &[UnitColumn], mut y: Vec<Dd>) -> Vec<(usize, Dd)> {
    let mut found = Vec::new();
    for (k, direction) in directions.iter().enumerate().rev() {
        let x = y[k] / direction.triangle[k];
        for (y, &r) in y.iter_mut().zip(&direction.triangle) {
            *y -= x * r;
        }
        found.push((direction.column, rounded(x)));
    }
    let largest = found.iter().map(|(_, x)| x.to_f64().abs());
    let largest = largest.fold(0.0, f64::max);
    found.retain(|(_, x)| x.to_f64().abs() > NOISE * largest);
    found.reverse();
    found
}

/// Returns a whole number or half of one that differs by a rounding error as it is.
fn rounded(x: Dd) -> Dd {
    let twice = (x + x).to_f64().round();
    let near = Dd::from_f64(twice * 0.5);
    match (x - near).to_f64().abs() < NOISE {
        true => near,
        false => x,
    }
}

fn dot(x: &[Dd], y: &[Dd]) -> Dd {
    let products = x.iter().zip(y).map(|(&x, &y)| x * y);
    products.fold(Dd::ZERO, |sum, p| sum + p)
}

fn length(x: &[Dd]) -> Dd {
    Scalar::sqrt(dot(x, x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_of_columns_is_found_with_its_coefficients() {
        let column = |f: fn(f64) -> f64| (0..9).map(|k| Dd::from_f64(f(f64::from(k)))).collect();
        let (x, y): (Vec<Dd>, Vec<Dd>) = (column(|t| 1.0 + t * t), column(|t| t.sin()));
        let pairs = x.iter().zip(&y);
        let third = Dd::ONE / Dd::from_f64(3.0);
        let sum: Vec<Dd> = pairs.map(|(&x, &y)| x * third - y).collect();
        let zero = vec![Dd::ZERO; 9];
        let found = independent(&[x, zero, y, sum]).dependent;
        assert_eq!(found[0], (1, vec![]));
        let [(0, first), (2, second)] = found[1].1[..] else {
            panic!("{:?}", found[1]);
        };
        assert!((first - third).to_f64().abs() < 1e-28, "{first:?}");
        assert_eq!(second, -Dd::ONE);
    }
}
