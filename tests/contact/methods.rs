//! Compiled methods of contacts agree with each other, and with differences of the gaps along the motion.

use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::runtime::Dynamics;

bgdyn::bgdyn!(
    "branches.yaml",
    methods = [
        inverse_dynamics,
        mass_matrix,
        bias,
        gravity,
        forward_dynamics,
        kinetic_energy,
        potential_energy,
        contact_gaps,
        contact_frames,
        contact_velocity,
        contact_jacobian,
        contact_bias,
        contact_delassus,
        contact_response
    ]
);
use branches::{Branches, CONTACT_NAMES, NQ, NV};

/// Number of contacts, and of their directions.
const K: usize = CONTACT_NAMES.len();
const ROWS: usize = 3 * K;

fn state() -> (SVector<f64, NQ>, SVector<f64, NV>) {
    let q = SVector::from_fn(|i, _| (1.3 * i as f64 + 0.4).sin());
    let q = Branches::default().normalize(&q);
    (q, SVector::from_fn(|i, _| (0.7 * i as f64 - 1.1).cos()))
}

#[test]
fn a_capsule_is_two_contacts_and_a_box_eight() {
    assert_eq!(K, 14);
    assert_eq!(CONTACT_NAMES[3..6], ["bar_1", "bar_2", "block_1"]);
}

#[test]
fn velocities_are_rates_of_the_gaps() {
    let (robot, (q, v)) = (Branches::<f64>::default(), state());
    let velocity: SVector<f64, ROWS> = robot.contact_velocity(&q, &v);
    let jacobian: SMatrix<f64, ROWS, NV> = robot.contact_jacobian(&q);
    assert!((jacobian * v - velocity).amax() < 1e-13);
    let step = 1e-5;
    let at = |step: f64| robot.integrate(&q, &(v * step));
    let (after, before) = (at(step), at(-step));
    let rates = (robot.contact_gaps(&after) - robot.contact_gaps(&before)) / (2.0 * step);
    for k in 0..K {
        assert!((rates[k] - velocity[3 * k + 2]).abs() < 1e-8, "{k}");
    }
    let along = |q: &SVector<f64, NQ>| robot.contact_velocity(q, &v);
    let rates = (along(&after) - along(&before)) / (2.0 * step);
    assert!((rates - robot.contact_bias(&q, &v)).amax() < 1e-7);
}

#[test]
fn impulses_move_what_they_act_on() {
    let (robot, (q, _)) = (Branches::<f64>::default(), state());
    let jacobian = robot.contact_jacobian(&q);
    let response: SMatrix<f64, NV, ROWS> = robot.contact_response(&q).expect("regular");
    assert!((robot.mass_matrix(&q) * response - jacobian.transpose()).amax() < 1e-12);
    let delassus: SMatrix<f64, ROWS, ROWS> = robot.contact_delassus(&q).expect("regular");
    assert_eq!(delassus, delassus.transpose());
    assert!((jacobian * response - delassus).amax() < 1e-12 * delassus.amax());
    let not_a_number = SVector::from_element(f64::NAN);
    assert!(robot.contact_response(&not_a_number).is_err());
}

#[test]
fn frames_are_rotations() {
    let (robot, (q, _)) = (Branches::<f64>::default(), state());
    for frame in robot.contact_frames(&q) {
        let turned = frame.rotation.transpose() * frame.rotation;
        assert!((turned - SMatrix::identity()).amax() < 1e-14);
        assert!((frame.rotation.determinant() - 1.0).abs() < 1e-14);
    }
}
