//! Tests JSON input and output of the feature `serde`. The structs are as in generated modules.

use bgdyn_runtime::nalgebra::Vector2;
use bgdyn_runtime::serde::de::value::SeqDeserializer;
use bgdyn_runtime::serde::{Deserialize, de};
use bgdyn_runtime::{Dd, Limits};
use core::marker::PhantomData;
use serde_json::{from_str, to_string};

#[derive(Clone, Copy, Debug, PartialEq)]
struct State<T = f64> {
    swing: T,
    swing_rate: T,
}
bgdyn_runtime::__serde! { State { swing, swing_rate } }

#[derive(Clone, Copy, Debug, PartialEq)]
struct Input<T = f64> {
    scalar: PhantomData<T>,
}
bgdyn_runtime::__serde! { Input {} }

const STATE: State = State {
    swing: 0.1,
    swing_rate: -2.5e-7,
};

#[test]
fn a_struct_keeps_its_names_and_values() {
    let text = to_string(&STATE).expect("written");
    assert_eq!(text, r#"{"swing":0.1,"swing_rate":-2.5e-7}"#);
    assert_eq!(from_str::<State>(&text).expect("read"), STATE);
    let turned = r#"{"swing_rate":-2.5e-7,"swing":0.1}"#;
    assert_eq!(from_str::<State>(turned).expect("any order"), STATE);
    let listed: State = from_str("[0.1, -2.5e-7]").expect("formats without names");
    assert_eq!(listed, STATE);
    let single: State<f32> = from_str(&text).expect("f32");
    assert_eq!(single.swing, 0.1_f32);
}

#[test]
fn a_struct_without_fields_is_an_empty_one() {
    let empty = Input::<f64> {
        scalar: PhantomData,
    };
    assert_eq!(to_string(&empty).expect("written"), "{}");
    assert_eq!(from_str::<Input>("{}").expect("read"), empty);
    assert!(from_str::<Input>(r#"{"scalar":null}"#).is_err());
}

#[test]
fn what_does_not_fit_is_refused_by_name() {
    let refused = |text: &str| from_str::<State>(text).expect_err(text).to_string();
    let cases = [
        (r#"{"swing":0.1}"#, "missing field `swing_rate`"),
        (r#"{"swing":1,"swing":2}"#, "duplicate field `swing`"),
        (
            r#"{"swing":1,"speed":2}"#,
            "unknown field `speed`, expected `swing` or `swing_rate`",
        ),
        (
            "[1.0]",
            "invalid length 1, expected struct State with 2 fields",
        ),
        ("[1.0, 2.0, 3.0]", "trailing characters"),
        (r#"{"swing":"1","swing_rate":0}"#, "invalid type: string"),
        ("3", "expected struct State with 2 fields"),
    ];
    for (text, wanted) in cases {
        let error = refused(text);
        assert!(error.contains(wanted), "{text}: {error}");
    }
}

#[test]
fn limits_without_bounds_survive_a_format_without_infinities() {
    let open = Limits {
        lower: f64::NEG_INFINITY,
        upper: 1.5,
        velocity: f64::INFINITY,
        effort: f64::INFINITY,
    };
    let text = to_string(&open).expect("written");
    let wanted = r#"{"lower":null,"upper":1.5,"velocity":null,"effort":null}"#;
    assert_eq!(text, wanted);
    assert_eq!(from_str::<Limits>(&text).expect("read"), open);
    assert_eq!(from_str::<Limits>(r#"{"upper":1.5}"#).expect("read"), open);
    assert!(from_str::<Limits>(r#"{"uper":1.5}"#).is_err());
    let bounded = Limits {
        lower: -0.25,
        upper: 0.5,
        velocity: 3.0,
        effort: 12.0,
    };
    let text = to_string(&bounded).expect("written");
    assert_eq!(from_str::<Limits>(&text).expect("read"), bounded);
}

#[test]
fn double_double_keeps_every_digit() {
    let long: Dd = "0.1".parse().expect("a number");
    let numbers = Vector2::new(long, -long / Dd::from_f64(3.0));
    for x in numbers.iter() {
        assert_eq!(to_string(x).expect("written"), words(x));
        // Formats that preserve the bits of an f64 preserve those of its two words.
        let parts = SeqDeserializer::<_, de::value::Error>::new([x.hi(), x.lo()].into_iter());
        assert_eq!(Dd::deserialize(parts).expect("read"), *x);
    }
    let state = State {
        swing: long,
        swing_rate: numbers[1],
    };
    let text = to_string(&state).expect("written");
    let read = from_str::<State<Dd>>(&text).expect("read");
    // serde_json may parse the last digit of an f64 differently.
    assert!((read.swing_rate - state.swing_rate).abs() < Dd::from_f64(1e-31));
}

/// Returns the two words of a number in JSON.
fn words(x: &Dd) -> String {
    to_string(&[x.hi(), x.lo()]).expect("written")
}
