//! Tests the macro from the caller's side: programs that compile, and the errors of those that do not.
//!
//! After an intended change: `TRYBUILD=overwrite cargo test -p ui`.

#[test]
fn callers() {
    let cases = trybuild::TestCases::new();
    cases.pass("pass/*.rs");
    cases.compile_fail("fail/*.rs");
}
