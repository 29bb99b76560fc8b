//! Checks that the golden specs are the output of `bgdyn import` for the golden URDFs.

use std::fs;

use crate::{bgdyn, root};

#[test]
fn every_golden_spec_is_its_urdf_imported() {
    let mut count = 0;
    let folder = root().join("tests/golden/urdf");
    for entry in folder.read_dir().expect("the folder") {
        let urdf = entry.expect("an entry").path();
        let name = urdf.file_stem().expect("a name").display().to_string();
        let spec = root().join(format!("tests/golden/specs/{name}.yaml"));
        let kept = fs::read_to_string(&spec).expect("the spec");
        let made = bgdyn(&["import", &urdf.display().to_string()]).good();
        assert!(made == kept, "{name}: import and the kept spec differ");
        let spec = spec.display().to_string();
        let told = bgdyn(&["check", &spec]).good();
        assert!(told.starts_with(&format!("ok: {name}, NQ ")), "{told}");
        count += 1;
    }
    let specs = root().join("tests/golden/specs").read_dir();
    assert_eq!(count, specs.expect("the folder").count());
}
