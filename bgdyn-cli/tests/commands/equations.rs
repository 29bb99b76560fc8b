//! `bgdyn equations`.

use std::fs;

use crate::{bgdyn, scratch};

const CART: &str = "specs/cart_pole.yaml";

#[test]
fn text_and_latex() {
    let text = bgdyn(&["equations", CART]).good();
    let equation = "P₁ = (m₁ + m₂)·q̈₁ + m₂·c₂·cos(q₂)·q̈₂ − m₂·c₂·sin(q₂)·q̇₂²\n";
    assert!(text.contains(equation), "{text}");
    assert_eq!(bgdyn(&["equations", CART, "--format", "text"]).good(), text);
    let latex = bgdyn(&["equations", CART, "--format", "latex"]).good();
    assert!(latex.contains("\\begin{align*}\nP_{1} &= "), "{latex}");
    let path = scratch("equations", "cart.txt", "");
    let stdout = bgdyn(&["equations", CART, "-o", &path]).good();
    assert_eq!(stdout, "");
    assert_eq!(fs::read_to_string(path).expect("a file"), text);
}

#[test]
fn digits_are_as_asked_for() {
    let digits = |n: &str| bgdyn(&["equations", CART, "--digits", n]).good();
    assert!(digits("3").contains("= 9.81 m/s²"), "{}", digits("3"));
    assert!(digits("2").contains("≈ 9.8 m/s²"), "{}", digits("2"));
    bgdyn(&["equations", CART, "--digits", "0"]).bad_usage();
    bgdyn(&["equations", CART, "--digits", "18"]).bad_usage();
}

#[test]
fn what_is_too_long_is_refused_with_a_way_out() {
    let told = bgdyn(&["equations", "specs/panda.yaml"]).bad_input();
    let words = [
        "specs/panda.yaml: too long",
        "limit is 300 terms",
        "`--limit N`",
    ];
    for word in words {
        assert!(told.contains(word), "{word}: {told}");
    }
    let told = bgdyn(&["equations", CART, "--limit", "3"]).bad_input();
    assert!(told.contains("its equations have"), "{told}");
}

#[test]
fn scenes_have_none() {
    let scene = "specs/scenes/stick_slip.scene.yaml";
    let told = bgdyn(&["equations", scene]).bad_usage();
    assert!(told.contains("`equations` is for mechanisms"), "{told}");
}
