//! Combines rows of contacts with constant factors, so that fewer velocities appear in each.
//!
//! The sum of two knife edges that are steered by opposite angles moves a board sideways only. Rows of loops stay as
//! they are: they may be written in the axes of their other place, where other factors and other constants hold.

use bgdyn_runtime::Dd;

use crate::mechanism::closure::Closure;

/// An entry below this at all sampled positions is zero, relative to the terms that it is the sum of.
const ZERO: f64 = 1e-24;

/// Sets the combinations of the rows, and the entries that are the same at all sampled positions. Mechanisms with loops
/// alone keep their rows.
pub(super) fn combine(closure: &mut Closure) {
    if !closure.nonholonomic() {
        return;
    }
    let at = closure.samples.iter();
    closure.combined.clear();
    let mut sampled: Vec<Vec<Vec<Dd>>> = at.map(|q| closure.solved_rates(q)).collect();
    let n = closure.rows.len();
    let mut combined: Vec<Vec<Dd>> = (0..n).map(|r| unit(n, r)).collect();
    let mut rest = n * n;
    let of_contacts: Vec<usize> = (0..n).filter(|&r| is_of_contact(closure, r)).collect();
    while let Some((row, other, factor)) = better(&sampled, &of_contacts)
        && rest > 0
    {
        rest -= 1;
        for rates in &mut sampled {
            subtract(rates, row, other, factor);
        }
        subtract(&mut combined, row, other, factor);
    }
    let all = 0..closure.positions.len();
    let of_row = |r: usize| {
        let entry = |j: usize| constant(&sampled, r, j).filter(|_| is_of_contact(closure, r));
        all.clone().map(entry).collect()
    };
    closure.constants = (0..n).map(of_row).collect();
    closure.combined = combined;
}

fn is_of_contact(closure: &Closure, r: usize) -> bool {
    let one = &closure.loops[closure.rows[r].closes];
    one.contact.is_some()
}

fn unit(n: usize, r: usize) -> Vec<Dd> {
    let at = |k: usize| if k == r { Dd::ONE } else { Dd::ZERO };
    (0..n).map(at).collect()
}

fn is_zero(sampled: &[Vec<Vec<Dd>>], row: usize, j: usize) -> bool {
    sampled
        .iter()
        .all(|rates| rates[row][j].to_f64().abs() < ZERO)
}

/// Returns an entry if it is the same at all sampled positions.
fn constant(sampled: &[Vec<Vec<Dd>>], row: usize, j: usize) -> Option<Dd> {
    let first = exact(sampled.first()?[row][j]);
    let mut all = sampled.iter();
    let same = all.all(|rates| (rates[row][j] - first).to_f64().abs() < ZERO);
    same.then_some(first)
}

/// Returns a row that has fewer entries after a multiple of another one is subtracted, both of these rows.
fn better(sampled: &[Vec<Vec<Dd>>], rows: &[usize]) -> Option<(usize, usize, Dd)> {
    let width = sampled.first()?.first()?.len();
    let entries = |row: usize| (0..width).filter(|&j| !is_zero(sampled, row, j)).count();
    for &row in rows {
        for other in rows.iter().copied().filter(|&other| other != row) {
            for j in 0..width {
                let Some(factor) = constant_ratio(sampled, (row, other), j) else {
                    continue;
                };
                let left =
                    |rates: &Vec<Vec<Dd>>, j: usize| rates[row][j] - factor * rates[other][j];
                let remains = |&j: &usize| {
                    let mut all = sampled.iter();
                    all.any(|rates| left(rates, j).to_f64().abs() >= ZERO)
                };
                if (0..width).filter(remains).count() < entries(row) {
                    return Some((row, other, factor));
                }
            }
        }
    }
    None
}

/// Returns the ratio of two entries if it is the same number at all sampled positions.
fn constant_ratio(sampled: &[Vec<Vec<Dd>>], (row, other): (usize, usize), j: usize) -> Option<Dd> {
    if is_zero(sampled, row, j) || is_zero(sampled, other, j) {
        return None;
    }
    let first = sampled.first()?;
    let factor = exact(first[row][j] / first[other][j]);
    let off = |rates: &Vec<Vec<Dd>>| (rates[row][j] - factor * rates[other][j]).to_f64().abs();
    let mut all = sampled.iter();
    all.all(|rates| off(rates) < ZERO).then_some(factor)
}

/// Returns a fraction with a small denominator if the number is one.
fn exact(x: Dd) -> Dd {
    let fraction = |k: u32| {
        let denominator = Dd::from_f64(f64::from(k));
        Dd::from_f64((x * denominator).to_f64().round()) / denominator
    };
    let mut all = (1..=12).map(fraction);
    all.find(|near| (*near - x).to_f64().abs() < ZERO)
        .unwrap_or(x)
}

fn subtract(rows: &mut [Vec<Dd>], row: usize, other: usize, factor: Dd) {
    let subtracted = rows[other].clone();
    for (x, y) in rows[row].iter_mut().zip(subtracted) {
        *x -= factor * y;
    }
}
