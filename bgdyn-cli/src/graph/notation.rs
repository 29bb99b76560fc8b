//! Prints numbers and symbols for drawings.

use bgdyn_runtime::Digits;

/// Returns a subscript: `₁₂`.
pub(super) fn subscript(n: usize) -> String {
    digits(n, '₀'..='₉')
}

/// Returns a superscript: `¹²`.
pub(super) fn superscript(n: usize) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    n.to_string()
        .bytes()
        .map(|b| DIGITS[usize::from(b - b'0')])
        .collect()
}

fn digits(n: usize, signs: std::ops::RangeInclusive<char>) -> String {
    let zero = u32::from(*signs.start());
    let sign = |b: u8| char::from_u32(zero + u32::from(b - b'0')).unwrap_or('?');
    n.to_string().bytes().map(sign).collect()
}

/// Prints a number with three digits, integers up to a million with all digits: `0.0825`, `−1`, `2.38e−6`.
pub(super) fn number(x: f64) -> String {
    Digits::new(x, 3).to_string().replace('-', "−")
}

/// Prints coordinates by their numbers, with three or more consecutive ones abbreviated: `q₁…q₃, q₅`.
pub(super) fn coordinates(numbers: &[usize]) -> String {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for &n in numbers {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == n => *last = n,
            _ => runs.push((n, n)),
        }
    }
    let q = |n: usize| format!("q{}", subscript(n));
    let run = |&(first, last): &(usize, usize)| match last - first {
        0 => q(first),
        1 => format!("{} {}", q(first), q(last)),
        _ => format!("{}…{}", q(first), q(last)),
    };
    runs.iter().map(run).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let written = [0.0825, -1.0, 2.375e-6, 400.0, 0.10000001, -1234567.0, 9.81];
        let wanted = ["0.0825", "−1", "2.38e−6", "400", "0.1", "−1.23e6", "9.81"];
        assert_eq!(written.map(number), wanted);
    }

    #[test]
    fn coordinates_in_a_row_are_written_in_short() {
        assert_eq!(coordinates(&[1, 2, 3, 5, 10, 11]), "q₁…q₃ q₅ q₁₀ q₁₁");
        assert_eq!(coordinates(&[]), "");
        assert_eq!(superscript(120), "¹²⁰");
    }
}
