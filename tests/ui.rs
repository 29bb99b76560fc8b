//! The macro as callers see it: what compiles, and what they read where it does not.
//!
//! After a wanted change: `TRYBUILD=overwrite cargo test --test ui`.

#[test]
fn callers() {
    let cases = trybuild::TestCases::new();
    cases.pass("tests/ui/pass/*.rs");
    cases.compile_fail("tests/ui/fail/*.rs");
}
