//! Balances of energy and momentum, and the scene's equations against the mechanism's methods.

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::HybridSystem;
use bgdyn::{Dynamics, runtime};
use bgdyn_sim::{Dop853, Gauss2, Rk4, Run, ScenePlant, Tolerance};

use crate::buoy_run::BuoyRun;
use crate::cart_run::{self, CartRun};
use crate::satellite_arm6::{NQ, NV, SatelliteArm6};
use crate::satellite_torques::{self, SatelliteTorques};
use crate::{buoy_run, excess};

/// Springs, dampers and drag on a floating body with an arm and a ball joint: a long run loses no energy that
/// no entry accounts for.
#[test]
fn the_energy_of_a_buoy_adds_up() {
    let scene = BuoyRun::<f64>::default();
    let run = Run::by(Dop853, ScenePlant::new(&scene), Run::begin(&scene));
    let mut run = run.with_tolerance(Tolerance {
        absolute: 1e-10,
        relative: 1e-10,
    });
    while run.t() < 20.0 {
        let left = 20.0 - run.t();
        run.advance_densely(left).expect("it floats");
        assert!(excess(run.y().as_slice(), 3).abs() < 1e-15);
        assert!(excess(run.y().as_slice(), 8).abs() < 1e-15);
    }
    let audit = run.audit();
    let (lost, closed) = (audit.dissipated.sum(), audit.drift());
    assert!(lost > 20.0, "{lost} J are dissipated");
    assert!(closed.abs() < 1e-7 * lost, "{closed} J of {lost} J");
}

/// A cart on a plane, with a screw, a joint that follows another, friction that sticks, a motor's winding and
/// an elastic drive: the state has velocities and positions of all kinds.
#[test]
fn the_energy_of_a_cart_adds_up() {
    let scene = CartRun::<f64>::default();
    let mut run = Run::new(&scene);
    while run.t() < 3.0 {
        run.step(1e-3).expect("it moves");
    }
    assert!(
        run.events > 2,
        "friction holds and releases: {} events",
        run.events
    );
    let audit = run.audit();
    let (supplied, closed) = (audit.supplied.sum(), audit.drift());
    assert!(
        closed.abs() < 1e-6 * supplied.abs(),
        "{closed} J of {supplied} J"
    );
}

/// Power in every state: what is supplied is stored or dissipated.
#[test]
fn power_adds_up_where_nothing_is_held() {
    let scene = BuoyRun::<f64>::default();
    let (y, modes) = scene.start();
    let none = SVector::from([0.0; buoy_run::NU]);
    let all = HybridSystem::power(&scene, &y, &modes, &none, 0.3).expect("it has inertia");
    let sum: f64 = all
        .iter()
        .map(|b| b.supplied - b.stored_rate - b.dissipated)
        .sum();
    let size: f64 = all.iter().map(|b| b.stored_rate.abs()).sum();
    assert!(sum.abs() < 1e-12 * size, "{sum} W of {size} W");
}

/// The scene's rates are those of the mechanism's methods: q̇ = N(q) v, and forward dynamics under the inputs.
#[test]
fn rates_are_those_of_the_mechanism() {
    let (scene, model) = (
        SatelliteTorques::<f64>::default(),
        SatelliteArm6::<f64>::default(),
    );
    assert_eq!((satellite_torques::NQ, satellite_torques::NV), (NQ, NV));
    let u = SVector::<f64, NV>::from_fn(|i, _| (i as f64 * 0.37 + 0.2).fract());
    let q = model.sample(&u);
    let v = u.map(|u| 2.0 * u - 1.0);
    let input = SVector::<f64, { satellite_torques::NU }>::from_fn(|i, _| 1.0 - 0.3 * i as f64);
    let tau = SVector::<f64, NV>::from_fn(|j, _| if j < 6 { 0.0 } else { input[j - 6] });
    let y = SVector::from_fn(|i, _| if i < NQ { q[i] } else { v[i - NQ] });
    let rates = HybridSystem::derivative(&scene, &y, &SVector::from([]), &input, 0.0);
    let rates = rates.expect("it has inertia");
    let positions = model.position_rates(&q, &v);
    let accelerations = model
        .forward_dynamics(&q, &v, &tau)
        .expect("it has inertia");
    for (i, wanted) in positions.iter().chain(&accelerations).enumerate() {
        let off = (rates[i] - wanted).abs();
        assert!(off < 1e-12 * wanted.abs().max(1.0), "rate {i}: by {off:e}");
    }
    let names = scene.state_names();
    assert_eq!((names[3], names[7]), ("free_qx", "shoulder_yaw"));
    assert_eq!(
        (names[NQ], names[NQ + 6]),
        ("free_x_velocity", "shoulder_yaw_rate")
    );
    let joint = runtime::QuasiJoint {
        kind: runtime::QuasiJointKind::Floating,
        position: 0,
        velocity: NQ,
    };
    assert_eq!(scene.quasi_joints(), [joint]);
}

/// A satellite moves itself by its arm: its momentum, the first six rows of M v, remains zero.
#[test]
fn a_satellite_keeps_zero_momentum() {
    let (scene, model) = (
        SatelliteTorques::<f64>::default(),
        SatelliteArm6::<f64>::default(),
    );
    let momentum = |y: &[f64]| {
        let q = SVector::<f64, NQ>::from_column_slice(&y[..NQ]);
        let v = SVector::<f64, NV>::from_column_slice(&y[NQ..]);
        let mass = model.mass_matrix(&q);
        let own = (0..6)
            .map(|i| mass[(i, i)] * v[i].abs())
            .fold(0.0, f64::max);
        ((mass * v).rows(0, 6).amax(), own)
    };
    let largest = |steps: usize| {
        let mut run = Run::by(Rk4, ScenePlant::new(&scene), Run::begin(&scene)).unaudited();
        let (mut most, mut size) = (0.0_f64, 0.0_f64);
        for _ in 0..steps {
            run.step(1.0 / steps as f64).expect("it turns");
            let (found, own) = momentum(run.y().as_slice());
            (most, size) = (most.max(found), size.max(own));
        }
        most / size
    };
    let (coarse, fine) = (largest(100), largest(200));
    assert!(fine < 1e-9, "{fine:e}");
    let order = (coarse / fine).log2();
    assert!(order > 3.5, "{coarse:e}, {fine:e}: order {order}");
}

/// The cart's state has a position for each joint of one degree and three for the planar one, none for the
/// follower and the winding.
#[test]
fn the_state_of_the_cart_has_these_parts() {
    let names = [
        "drive_x",
        "drive_y",
        "drive_turn",
        "feed",
        "turn_first",
        "turn_second",
        "grip",
        "pole",
        "elastic",
        "drive_x_velocity",
        "drive_y_velocity",
        "drive_turn_rate",
        "feed_rate",
        "turn_first_rate",
        "turn_second_rate",
        "grip_rate",
        "pole_rate",
        "elastic_rate",
        "wheels_current",
    ];
    assert_eq!(cart_run::STATE_NAMES, names);
    let scene = CartRun::<f64>::default();
    let plant = ScenePlant::with_slope(&scene);
    let mut run = Run::by(Gauss2::new(), plant, Run::begin(&scene));
    run.step(1e-3).expect("it moves");
}
