//! Decimal text of double-doubles against a decimal library.

use crate::exact::{BITS, Exact, cases, exact as ex, operand, relative};
use bgdyn_runtime::{Dd, ParseDdError};
use dashu_float::DBig;
use proptest::prelude::*;

fn decimal(text: &str) -> Exact {
    let number: DBig = text.parse().unwrap();
    number
        .with_precision(400)
        .value()
        .with_base_and_precision::<2>(BITS)
        .value()
        .with_rounding()
}

/// Checks that `text` is parsed to half a unit in the last place of the low word.
fn assert_read(text: &str) {
    let x: Dd = text.parse().unwrap();
    assert_eq!(x.hi(), text.parse::<f64>().unwrap(), "{text}");
    let error = relative(x, &decimal(text));
    assert!(error <= 0.5, "{text}: {x:?} is off by {error}");
}

#[test]
fn texts_are_read() {
    for text in [
        "0.1",
        "-1.5e-3",
        "+3",
        "3",
        "0.3",
        "1e22",
        "1e23",
        "9.81",
        "-9.80665",
        ".5",
        "5.",
        "1E5",
        "1e+5",
        "0.000123",
        "00012.50",
        "1234567890123456789012345678901234567890",
        "3.14159265358979323846264338327950288419716939937510582097494459230781640628620899",
        "1e-250",
        "7.123456789012345678901234567890123456789e-270",
        "1.7976931348623157e308",
        "6.02214076e23",
        "0.9999999999999999999999999999999999999999",
        "1.0000000000000001",
        "9007199254740993",
        "0.30000000000000000000000000000000000000000000000000000000000000001",
        "2.22507385850720138309e-200",
        "123456.789e-30",
    ] {
        assert_read(text);
        if !text.starts_with(['+', '-']) {
            assert_read(&format!("-{text}"));
        }
    }
    // The low word of the exact value of 0.1_f64 is zero.
    let word: Dd = "0.1000000000000000055511151231257827021181583404541015625"
        .parse()
        .unwrap();
    assert_eq!(word, Dd::from_f64(0.1));
    let zeros = format!("0.{}1e1001", "0".repeat(1000));
    assert_eq!(zeros.parse(), Ok(Dd::ONE));
    assert_eq!(
        "-0".parse::<Dd>().unwrap().hi().to_bits(),
        (-0.0_f64).to_bits()
    );
    assert_eq!("0e99999999999999999999".parse(), Ok(Dd::ZERO));
    assert_eq!("1e-99999999999999999999".parse(), Ok(Dd::ZERO));
    assert_eq!("1e-310".parse::<Dd>().unwrap().hi(), 1e-310);
}

#[test]
fn other_texts_are_errors() {
    for text in [
        "", " ", "+", "-", ".", "e5", "1e", "1_000", "inf", "-inf", "infinity", "nan", "NaN",
        "0x10", " 1", "1 ", "1.2.3", "--1", "1e5.5", "1,5", "½", "1e--5", "+-1", "1f64",
    ] {
        assert_eq!(text.parse::<Dd>(), Err(ParseDdError::Invalid), "{text:?}");
    }
    for text in ["1e309", "-1e400", "1e99999999999999999999", "1.8e308"] {
        assert_eq!(text.parse::<Dd>(), Err(ParseDdError::Overflow), "{text:?}");
    }
    assert_eq!(ParseDdError::Overflow.to_string(), "number too large");
    assert_eq!(ParseDdError::Invalid.to_string(), "not a decimal number");
}

#[test]
fn numbers_are_written() {
    for text in [
        "0",
        "1",
        "-1",
        "0.1",
        "-0.25",
        "3.5",
        "10",
        "120000",
        "100000000000000000000",
        "1e21",
        "0.00001",
        "1.5e-6",
        "-2.5e300",
        "0.01",
        "1.0625",
        "123.456",
        "1e-30",
        "999.5",
        "3.1415926535897932384626433832795",
        "99999999999999999999",
        "1e100",
    ] {
        assert_eq!(text.parse::<Dd>().unwrap().to_string(), text);
    }
    assert_eq!(Dd::PI.to_string(), "3.1415926535897932384626433832795");
    assert_eq!(
        (Dd::ONE / Dd::from_f64(3.0)).to_string(),
        format!("0.{}", "3".repeat(32))
    );
    // Rounding carries into a new digit.
    assert_eq!(Dd::new(1.0, -1e-40).to_string(), "1");
    assert_eq!(Dd::new(1000.0, -1e-40).to_string(), "1000");
    assert_eq!(Dd::new(1e21, -1e-40).to_string(), "1e21");
    assert_eq!(Dd::from_f64(f64::INFINITY).to_string(), "inf");
    assert_eq!(Dd::from_f64(f64::NAN).to_string(), "NaN");
    assert_eq!(Dd::from_f64(-0.0).to_string(), "-0");
    assert_eq!(
        Dd::from_f64(5e-324).to_string(),
        "4.9406564584124654417656879286822e-324"
    );
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn random_texts_are_read(text in "-?[0-9]{1,25}\\.[0-9]{0,40}[1-9](e-?[0-9]{1,2})?") {
        if text.contains(|c| ('1'..='9').contains(&c)) {
            assert_read(&text);
        }
    }

    /// 32 digits represent a double-double to half of 1e-31 at worst.
    #[test]
    fn written_numbers_are_read_back(x in operand(-900..1000)) {
        let text = x.to_string();
        let back: Dd = text.parse().unwrap();
        let digits = text.split('e').next().unwrap().trim_matches(['-', '.', '0']);
        prop_assert!(digits.len() <= 33, "{}", text);
        let limit = 0.5e-31 * 2_f64.powi(106) + 0.5;
        prop_assert!(relative(back, &ex(x)) <= limit, "{:?} {} {:?}", x, text, back);
    }
}
