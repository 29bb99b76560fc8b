//! Every case within what is allowed of it. `--nocapture` shows the measured numbers beside that.

use trajectories::CASES;

/// Runs a case and prints its outcomes.
fn meets(case: &str) {
    let (_, run) = CASES.iter().find(|(name, _)| *name == case).expect(case);
    let outcomes = run();
    for outcome in &outcomes {
        println!("{outcome}");
    }
    let missed: Vec<_> = outcomes.iter().filter(|o| !o.met()).collect();
    assert!(missed.is_empty(), "{missed:#?}");
}

macro_rules! cases {
    ($($name:ident)*) => {
        /// The cases that are tested.
        const TESTED: &[&str] = &[$(stringify!($name)),*];
        $(
            #[test]
            fn $name() {
                meets(stringify!($name));
            }
        )*
    };
}

cases! {
    a01_simple_pendulum
    double_pendulum_chaotic
    chain8_rods
    arm6_3d
    mass_ratio_1e6_1
    mass_ratio_1e9_1
    stiff_spring_pendulum
    stiff_spring_two_mass
    motor_linear_stiff
    hydraulic_cylinder
    lugre_stick_slip
    coulomb_stick_slip_belt
}

#[test]
fn every_case_is_tested() {
    assert_eq!(CASES.map(|(name, _)| name), TESTED);
}
