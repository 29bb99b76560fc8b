//! Checks that compiled code executes exactly the operations that the generator counts: a counting scalar
//! runs every method, and its counts equal the module's `OPERATIONS`.

use bgdyn::Dynamics;
use bgdyn::nalgebra::SVector;
use bgdyn::runtime::Operations;

use crate::counted::{Counted, executed};

pub(crate) fn counts_equal<M: Dynamics<Counted, N, N>, const N: usize>(
    robot: &str,
    model: &M,
    operations: &[(&str, Operations)],
) {
    let vector = |scale: f64| SVector::<Counted, N>::from_fn(|j, _| Counted(scale + j as f64));
    let (q, v, a) = (vector(0.3), vector(-1.1), vector(2.7));
    let runs: [(&str, Operations); 7] = [
        (
            "inverse_dynamics",
            executed(|| model.inverse_dynamics(&q, &v, &a)),
        ),
        ("mass_matrix", executed(|| model.mass_matrix(&q))),
        ("bias", executed(|| model.bias(&q, &v))),
        ("gravity", executed(|| model.gravity(&q))),
        (
            "forward_dynamics",
            executed(|| model.forward_dynamics(&q, &v, &a)),
        ),
        ("kinetic_energy", executed(|| model.kinetic_energy(&q, &v))),
        ("potential_energy", executed(|| model.potential_energy(&q))),
    ];
    // The trait's methods come first.
    assert_eq!(runs.as_slice(), &operations[..7], "{robot}");
}

#[test]
fn compiled_code_executes_what_is_counted() {
    crate::robots::for_each_operations!(counts_equal);
}

mod whole {
    bgdyn::bgdyn!("../golden/specs/puma_arm.yaml", derivatives = true);
}

/// The methods that are not in the trait.
#[test]
fn so_do_the_other_methods() {
    let model = whole::puma_arm::PumaArm::<Counted>::default();
    let vector = |scale: f64| SVector::<Counted, 6>::from_fn(|j, _| Counted(scale + j as f64));
    let (q, v, a) = (vector(0.3), vector(-1.1), vector(2.7));
    let runs = [
        (
            "coriolis_matrix",
            executed(|| model.coriolis_matrix(&q, &v)),
        ),
        (
            "inverse_dynamics_derivatives",
            executed(|| model.inverse_dynamics_derivatives(&q, &v, &a)),
        ),
        (
            "forward_dynamics_derivatives",
            executed(|| model.forward_dynamics_derivatives(&q, &v, &a)),
        ),
        ("pose_l6", executed(|| model.pose_l6(&q))),
        ("velocity_l6", executed(|| model.velocity_l6(&q, &v))),
        (
            "jacobian_world_l6",
            executed(|| model.jacobian_world_l6(&q)),
        ),
        (
            "jacobian_dot_v_world_l6",
            executed(|| model.jacobian_dot_v_world_l6(&q, &v)),
        ),
    ];
    assert_eq!(runs, whole::puma_arm::OPERATIONS[7..]);
}

/// `bgdyn ops` counts the functions that the macro emits, because both use the same generator.
#[test]
fn the_generator_counts_the_same_again() {
    for (name, stated) in [
        ("scara_rrpr", crate::robots::scara_rrpr::OPERATIONS),
        ("puma_arm", crate::robots::puma_arm::OPERATIONS),
    ] {
        let path = format!(
            "{}/tests/golden/specs/{name}.yaml",
            env!("CARGO_MANIFEST_DIR")
        );
        let text = std::fs::read_to_string(path).unwrap();
        let (mechanism, _) = bgdyn_codegen::read(&text, Some(name));
        let model =
            bgdyn_codegen::selection::model(mechanism.unwrap(), &Default::default()).unwrap();
        let counted: Vec<_> = model
            .functions
            .iter()
            .map(|f| (f.name(), f.operations()))
            .collect();
        assert_eq!(counted, stated, "{name}");
    }
}
