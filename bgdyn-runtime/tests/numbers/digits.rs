//! Tests numbers with significant digits against the numbers parsed from them.

use bgdyn_runtime::Digits;

#[test]
fn numbers_have_so_many_digits() {
    let written = [
        (0.0, "0", "0"),
        (-0.0, "0", "0"),
        (0.1, "0.1", "0.100000"),
        (-123.456789, "-123.457", "-123.457"),
        (999_999.6, "1e6", "1.00000e6"),
        (0.001, "0.001", "0.00100000"),
        (9.999_999_9e-5, "0.0001", "0.000100000"),
        (1.5e-7, "1.5e-7", "1.50000e-7"),
        (100_000.0, "100000", "100000"),
        (f64::NAN, "NaN", "NaN"),
        (f64::NEG_INFINITY, "-inf", "-inf"),
    ];
    for (x, short, all) in written {
        let digits = Digits::new(x, 6);
        assert_eq!(digits.to_string(), short);
        assert_eq!(digits.with_zeros().to_string(), all);
    }
}

#[test]
fn whole_numbers_keep_their_digits() {
    assert_eq!(Digits::new(12_345.6, 2).to_string(), "12346");
    assert_eq!(Digits::new(400.0, 1).to_string(), "400");
}

#[test]
fn exponents_begin_where_they_are_asked_to() {
    let x = Digits::new(0.002, 3);
    assert_eq!(x.clone().plain(-2..6).to_string(), "2e-3");
    assert_eq!(x.plain(0..0).with_zeros().to_string(), "2.00e-3");
    // No text is longer than a number of 30 places.
    assert_eq!(Digits::new(1e300, 3).plain(-400..400).to_string(), "1e300");
    assert_eq!(
        Digits::new(1e-300, 3).plain(-400..400).to_string(),
        "1e-300"
    );
    let longest = Digits::new(-f64::MIN_POSITIVE, 100).plain(-400..400);
    assert_eq!(longest.to_string(), "-2.2250738585072014e-308");
    let longest = Digits::shortest(1.234_567_890_123_456_7e-30).plain(-400..400);
    assert_eq!(longest.to_string().len(), "0.".len() + 30 - 1 + 17);
}

/// For all sizes and signs: at most the selected number of digits, and an error of at most half a unit of
/// the last one.
#[test]
fn no_more_is_lost_than_the_digits_left_out() {
    for k in 0..4000 {
        let x = (f64::from(k) * 0.7).sin() * 10_f64.powi(k % 40 - 20);
        for text in [Digits::new(x, 6), Digits::new(x, 6).with_zeros()].map(|d| d.to_string()) {
            let mantissa = text.split('e').next().unwrap_or("");
            let digits = mantissa.replace(['-', '.'], "");
            assert!(digits.trim_start_matches('0').len() <= 6, "{text}");
            let back: f64 = text.parse().expect("a number");
            assert!(
                (back - x).abs() <= 5.000_1e-6 * x.abs(),
                "{x} is written as {text}"
            );
        }
        let text = Digits::shortest(x).plain(-3..5).to_string();
        assert_eq!(text.parse(), Ok(x));
    }
}
