//! Runs compiled scenes with stiff, step-controlled and symplectic integrators, against known solutions.

use bgdyn_runtime::HybridSystem;
use bgdyn_sim::{CanonicalPlant, Dop853, Gauss3, HybridState, Rodas4, Run, ScenePlant, Tolerance};
use nalgebra::SVector;
use scenes::{
    hydraulic_cylinder, lugre_stick_slip, motor_linear_stiff, stick_slip, stiff_spring_pendulum,
};

/// Returns a tolerance for states with small components: volumes, deflections.
fn tolerance(relative: f64) -> Tolerance<f64> {
    Tolerance {
        absolute: 1e-4 * relative,
        relative,
    }
}

fn within(found: f64, wanted: f64, relative: f64) {
    let off = (found - wanted).abs();
    assert!(off <= relative * wanted.abs(), "{found}, not {wanted}");
}

/// A motor whose current settles within 1e-5 s, with steps of 1e-2 s: two exponentials in closed
/// form, (t, rate, angle).
#[test]
fn a_stiff_motor_with_long_steps() {
    let wanted = [
        (0.1, 2.2792215427719675, 0.11592427623120703),
        (1.0, 14.920276569774797, 8.7304159924448),
        (10.0, 23.076220854586044, 208.5805479880985),
    ];
    let scene = motor_linear_stiff::MotorLinearStiff::<f64>::default();
    let names = scene.state_names();
    let place = |name| {
        names
            .iter()
            .position(|&n| n == name)
            .expect("a part of the state")
    };
    let (angle, rate) = (place("shaft"), place("shaft_rate"));
    let mut run = Run::by(Rodas4, ScenePlant::with_slope(&scene), Run::begin(&scene));
    for (t, speed, turned) in wanted {
        while run.t() < t - 1e-9 {
            run.step(1e-2).expect("it turns");
        }
        within(run.y()[rate], speed, 1e-6);
        within(run.y()[angle], turned, 1e-6);
    }
}

/// (t, slide, rate, pressures of side a, side b and the line): extrapolation and Gauss–Legendre in
/// quadruple precision agree on them to 14 digits.
const CYLINDER: [[f64; 6]; 3] = [
    [
        0.06,
        0.018047046313596903,
        0.21608416483362258,
        9423362.563172767,
        9608248.995723119,
        10480037.635829281,
    ],
    [
        0.22,
        0.06559412534554422,
        0.2927404792737075,
        10028429.71405186,
        8970917.398815695,
        11025521.683705876,
    ],
    [
        0.5,
        0.14945536405671758,
        0.299496690073609,
        10031653.545420375,
        8971347.358947834,
        11028487.957410462,
    ],
];

#[test]
fn stiff_hydraulics_with_fixed_and_controlled_steps() {
    let scene = hydraulic_cylinder::HydraulicCylinder::<f64>::default();
    let by = || Run::by(Rodas4, ScenePlant::with_slope(&scene), Run::begin(&scene));
    for (mut run, bar, h) in [
        (by().with_tolerance(tolerance(1e-9)), 1e-6, 0.01),
        (by(), 1e-3, 1e-3),
    ] {
        for wanted in CYLINDER {
            while run.t() < wanted[0] - 1e-9 {
                run.step(h).expect("it moves");
            }
            let output = run.plant().output(run.t(), run.y(), run.modes());
            for (i, (&found, wanted)) in output.iter().zip(&wanted[1..]).enumerate() {
                within(found, *wanted, if i < 2 { bar } else { 10.0 * bar });
            }
        }
    }
}

/// A block that sticks with bristles and slips, by a stiff integrator whose steps end at the kinks of the
/// law: its position at 25 s, and the last time its velocity is 0.
#[test]
fn bristles_stick_and_slip() {
    let scene = lugre_stick_slip::LugreStickSlip::<f64>::default();
    let plant = ScenePlant::with_differences(&scene);
    let mut run = Run::by(Rodas4, plant, Run::begin(&scene)).with_tolerance(tolerance(1e-9));
    let (mut kinks, mut zero) = (0, 0.0);
    while run.t() < 25.0 {
        run.advance_densely(25.0 - run.t()).expect("it slides");
        if run.kinks > kinks {
            (kinks, zero) = (run.kinks, run.t());
        }
    }
    assert!(
        (run.y()[0] - 1.90883919922548).abs() < 1e-7,
        "{}",
        run.y()[0]
    );
    assert!((zero - 23.026399357676176).abs() < 1e-6, "{zero}");
}

/// The times of a block on a belt, by an integrator of order 8 with step control.
#[test]
fn the_block_on_the_belt_with_long_steps() {
    let scene = stick_slip::StickSlip::<f64>::default();
    let mut run = Run::by(Dop853, ScenePlant::new(&scene), Run::begin(&scene));
    run = run.with_tolerance(tolerance(1e-12));
    let slip = 3.0 * std::f64::consts::PI / 20.0;
    let (mut wanted, mut seen) = (0.4, 0);
    while run.t() < 5.0 {
        run.advance_densely(5.0 - run.t()).expect("it goes on");
        if run.events > seen {
            seen = run.events;
            let off = (run.last_event - wanted).abs();
            assert!(
                off < 1e-9,
                "event {seen} at {}, not {wanted}",
                run.last_event
            );
            wanted += if seen % 2 == 1 { slip } else { 0.2 };
        }
    }
    assert_eq!(seen, 14);
    assert!(run.audit().drift().abs() < 1e-9, "{}", run.audit().drift());
}

/// A mass that swings on a stiff spring, in canonical form and in velocities: the same motion; with known
/// slopes also for long steps.
#[test]
fn canonical_form_and_velocities_agree() {
    let scene = stiff_spring_pendulum::StiffSpringPendulum::<f64>::default();
    let begin = Run::begin(&scene);
    let canonical = CanonicalPlant::new(&scene);
    let start = HybridState {
        y: canonical.to_canonical(0.0, &begin.y, &begin.modes),
        ..begin
    };
    let mut momenta = Run::by(Gauss3::new(), canonical, start);
    let mut velocities = Run::by(Gauss3::new(), ScenePlant::with_slope(&scene), begin);
    for _ in 0..2000 {
        momenta.step(1e-4).expect("it swings");
        velocities.step(1e-4).expect("it swings");
    }
    let y = momenta
        .plant()
        .to_natural(momenta.t(), momenta.y(), momenta.modes());
    let y: SVector<f64, _> = y.expect("the mass matrix is regular");
    let swing = 1.374847606374844;
    assert!((y[0] - swing).abs() < 1e-8, "{}", y[0]);
    assert!(
        (velocities.y()[0] - swing).abs() < 1e-8,
        "{}",
        velocities.y()[0]
    );
    assert!(
        momenta.audit().drift().abs() < 1e-8,
        "{}",
        momenta.audit().drift()
    );

    // Steps six times longer than the period of the spring, which is at rest.
    let mut long = Run::by(Gauss3::new(), ScenePlant::with_slope(&scene), begin);
    for _ in 0..250 {
        long.step(4e-3).expect("it swings");
    }
    let wanted = -1.4050269601503225;
    assert!((long.y()[0] - wanted).abs() < 1e-11, "{}", long.y()[0]);
}
