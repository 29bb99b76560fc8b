//! Mechanisms without a moving joint: C has the functions that have a result, and no empty arrays.

use bgdyn_codegen::options::Options;

use crate::same_bits::{check, files, model_of};

/// An arm whose motion is given at run time, and nothing else moves.
const GIVEN: &str = "
format: 1
links:
  - name: arm
    joint: { name: shoulder, type: continuous, axis: [0.6, 0.48, 0.64] }
    mass: 3
    com: [0.2, 0.1, -0.3]
    inertia: { xx: 0.1, yy: 0.2, zz: 0.15 }
  - name: tool
    parent: arm
    joint: { name: flange, type: fixed, origin: { xyz: [0.4, 0, 0.1] } }
    mass: 0.5
    inertia: { xx: 0.01, yy: 0.01, zz: 0.01 }
constraints:
  motor: { type: prescribed, joint: shoulder }
frames:
  - { name: tip, link: tool, origin: { xyz: [0.1, 0, 0] } }
";

/// A post.
const FIXED: &str = "
format: 1
links:
  - name: post
    joint: { name: foot, type: fixed, origin: { xyz: [0.1, 0.2, 0.3] } }
    mass: 3
    com: [0.2, 0.1, -0.3]
    inertia: { xx: 0.1, yy: 0.2, zz: 0.15 }
";

#[test]
fn what_has_a_result_is_written() {
    for (stem, text) in [("given_arm", GIVEN), ("post", FIXED)] {
        for methods in [
            None,
            Some(vec!["potential_energy".into(), "mass_matrix".into()]),
        ] {
            let options = Options {
                derivatives: methods.is_none(),
                methods,
                ..Options::default()
            };
            let model = model_of(text, stem, &options);
            assert_eq!(model.mechanism.nv(), 0);
            check::<f64>(stem, &model);
            check::<f32>(stem, &model);
            let header = &files(&model, &[])[0].text;
            assert!(header.contains("_potential_energy(") && !header.contains("_mass_matrix("));
            assert!(
                !header.contains("[0]") && !header.contains("_NV]"),
                "{header}"
            );
        }
    }
    let model = model_of(GIVEN, "given_arm", &Options::default());
    assert!(
        files(&model, &[])[0]
            .text
            .contains("given_arm_drive_efforts(")
    );
}

/// Files without any function are C as well.
#[test]
fn nothing_is_written_where_nothing_has_a_result() {
    let options = Options {
        methods: Some(vec!["bias".into()]),
        ..Options::default()
    };
    check::<f64>("nothing", &model_of(FIXED, "post", &options));
}
