//! Compares results and describes their differences.

use bgdyn_runtime::Dd;

use super::Difference;
use crate::expr::Inputs;
use crate::function::Function;

/// Permitted relative error of values that both sides compute in double-double.
pub(super) const EXACT: f64 = 1e-18;

/// Permitted relative error of accelerations and their derivatives substituted into the equations of
/// motion: the solution loses digits with the condition number of the mass matrix.
pub(super) const SOLVED: f64 = 1e-12;

/// A law for a result, and the permitted error.
pub(super) struct Law {
    /// The law in words or as a formula.
    pub text: &'static str,
    /// Permitted error, relative to the largest number on either side.
    pub allowed: f64,
}

/// What a law says, its two sides, and the size of their terms.
pub(super) type SizedLaw = (&'static str, Vec<Dd>, Vec<Dd>, f64);

/// Compares a function's result with the expected one. `size` is the size of the terms that may cancel in
/// them.
pub(super) fn differs(
    (subject, function): (&str, &Function),
    law: &Law,
    (found, expected): (&[Dd], &[Dd]),
    size: f64,
    at: &Inputs<Dd>,
) -> Option<Difference> {
    debug_assert_eq!(
        found.len(),
        expected.len(),
        "{}: {}",
        function.name,
        law.text
    );
    let size = largest(found).max(largest(expected)).max(size);
    let off = |i: usize| (found[i] - expected[i]).to_f64().abs();
    // A NaN is the largest error.
    let key = |i: &usize| {
        if off(*i).is_nan() {
            f64::INFINITY
        } else {
            off(*i)
        }
    };
    let worst = (0..found.len()).max_by(|i, k| key(i).total_cmp(&key(k)))?;
    if off(worst) <= law.allowed * size {
        return None;
    }
    Some(Difference {
        subject: subject.to_owned(),
        function: function.name.clone(),
        formulation: function.formulation.clone(),
        law: law.text,
        component: worst,
        found: found[worst].to_f64(),
        expected: expected[worst].to_f64(),
        state: state(at),
    })
}

/// Returns the largest magnitude; infinity for a NaN.
pub(super) fn largest(x: &[Dd]) -> f64 {
    x.iter().fold(0.0, |most: f64, x| {
        let size = x.to_f64().abs();
        if size.is_nan() {
            f64::INFINITY
        } else {
            most.max(size)
        }
    })
}

/// Returns a vector with other signs of its components: terms that cancel in a product with it do not
/// cancel in a product with these.
pub(super) fn turned(x: &[Dd]) -> [Vec<Dd>; 3] {
    [1, 2, 3].map(|period| {
        let signed = x.iter().enumerate().map(|(j, x)| {
            let size = Dd::abs(*x);
            if j / period % 2 == 0 { size } else { -size }
        });
        signed.collect()
    })
}

/// Returns x − y.
pub(super) fn minus(x: &[Dd], y: &[Dd]) -> Vec<Dd> {
    x.iter().zip(y).map(|(&x, &y)| x - y).collect()
}

/// Returns x + y.
pub(super) fn plus(x: &[Dd], y: &[Dd]) -> Vec<Dd> {
    x.iter().zip(y).map(|(&x, &y)| x + y).collect()
}

/// Returns Σ x_i y_i.
pub(super) fn dot(x: &[Dd], y: &[Dd]) -> Dd {
    let products = x.iter().zip(y).map(|(&x, &y)| x * y);
    products.fold(Dd::ZERO, |sum, p| sum + p)
}

/// Returns a matrix, given row by row, times a vector of `columns` numbers.
pub(super) fn times(matrix: &[Dd], x: &[Dd]) -> Vec<Dd> {
    matrix
        .chunks(x.len().max(1))
        .map(|row| dot(row, x))
        .collect()
}

/// Prints a state in a form that a reader can copy.
fn state(at: &Inputs<Dd>) -> String {
    let parts = [
        ("q", &at.q),
        ("v", &at.v),
        ("a", &at.a),
        ("x", &at.x),
        ("u", &at.u),
        ("modes", &at.modes),
        ("parameters", &at.parameters),
    ];
    let mut text: Vec<String> = Vec::new();
    for (name, values) in parts.into_iter().filter(|(_, values)| !values.is_empty()) {
        let values: Vec<f64> = values.iter().map(|x| x.to_f64()).collect();
        text.push(format!("{name} = {values:?}"));
    }
    if let Some(t) = at.t {
        text.push(format!("t = {}", t.to_f64()));
    }
    text.join(", ")
}
