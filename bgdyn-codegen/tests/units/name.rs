//! Names that are identifiers.

use bgdyn_codegen::name::{is_identifier, to_identifier};

#[test]
fn identifiers() {
    for good in ["a", "arm", "upper_arm", "iiwa14", "link_1_2", "q2d"] {
        assert!(is_identifier(good), "{good}");
    }
    for bad in [
        "", "_", "a_", "_a", "a__b", "Arm", "1a", "a-b", "a b", "ä", "fn", "self", "gen",
    ] {
        assert!(!is_identifier(bad), "{bad}");
    }
}

#[test]
fn anything_with_a_letter_becomes_an_identifier() {
    assert_eq!(to_identifier("Upper Arm").as_deref(), Some("upper_arm"));
    assert_eq!(
        to_identifier("LHipYawLink").as_deref(),
        Some("l_hip_yaw_link")
    );
    assert_eq!(to_identifier("FR_hip").as_deref(), Some("fr_hip"));
    assert_eq!(to_identifier("1-dof").as_deref(), Some("n1_dof"));
    assert_eq!(to_identifier("fn").as_deref(), Some("fn_n"));
    assert_eq!(to_identifier("__x__y").as_deref(), Some("x_y"));
    assert_eq!(to_identifier("—"), None);
    for text in [
        "Upper Arm",
        "1-dof",
        "fn",
        "__x__y",
        "Schulter (links)",
        "self",
    ] {
        assert!(
            to_identifier(text).is_some_and(|n| is_identifier(&n)),
            "{text}"
        );
    }
}
