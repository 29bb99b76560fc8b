//! The generated file that is kept in the tree is what the generator makes of the spec.

use bgdyn_codegen::Build;

#[test]
fn the_kept_file_is_current() {
    let source = Build::new("specs/head.yaml")
        .methods(["gravity"])
        .source()
        .expect("a sound spec");
    let path = "generated/head.rs";
    if std::env::var_os("BGDYN_WRITE").is_some() {
        std::fs::write(path, &source.text).expect("a file");
    }
    let kept = std::fs::read_to_string(path).expect("the kept file");
    assert!(
        kept == source.text,
        "{path} is not up to date: run this test with BGDYN_WRITE=1"
    );
}
