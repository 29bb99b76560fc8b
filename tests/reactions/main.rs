//! Methods on request of mechanisms with loops and contacts, and loads through joints, in compiled code: constants,
//! errors, other scalars.

use bgdyn::nalgebra::{SVector, Vector3, vector};
use bgdyn::runtime::wide::f64x4;
use bgdyn::runtime::{Argument, Cause, Dd, Wrench};
use bgdyn::{Dynamics, Scalar};

bgdyn::bgdyn!(
    "../../specs/loops/five_bar.yaml",
    methods = [
        dynamics,
        constraint_bias,
        constrained_dynamics,
        project_velocity,
        reactions,
        joint_reactions
    ]
);
bgdyn::bgdyn!(
    "../../specs/constraints/differential_drive.yaml",
    methods = [
        dynamics,
        constrained_dynamics,
        project_velocity,
        reactions,
        joint_reactions
    ]
);
bgdyn::bgdyn!(
    "../../specs/loops/bricard.yaml",
    methods = [dynamics, reactions]
);
bgdyn::bgdyn!(
    "../../specs/scara.yaml",
    methods = [dynamics, joint_reactions]
);

use differential_drive::DifferentialDrive;
use five_bar::{FiveBar, NC, NT};
use scara::Scara;

/// A closed position of the five-bar with velocities and efforts of its cranks.
fn five_bar_state<T: Scalar>() -> (SVector<T, 4>, SVector<T, 2>, SVector<T, 2>) {
    let model = FiveBar::<T>::default();
    let number = T::from_f64;
    let q = model.integrate(&model.neutral(), &vector![number(0.2), number(-0.1)]);
    let v = vector![number(0.75), number(-1.5)];
    (q, v, vector![number(2.0), number(-0.5)])
}

/// Returns the accelerations and multipliers at that state, with efforts on the cranks alone.
fn constrained<T: Scalar>() -> (SVector<T, NT>, SVector<T, NC>) {
    let model = FiveBar::<T>::default();
    let (q, v, tau) = five_bar_state::<T>();
    let zero = T::from_f64(0.0);
    let all = vector![tau[0], zero, tau[1], zero];
    let qd = model.tree_velocity(&q, &v);
    let found = model.constrained_dynamics(&q, &qd, &all);
    found.unwrap_or_else(|error| panic!("{error:?}"))
}

#[test]
fn redundant_coordinates_move_as_independent_ones() {
    let model = FiveBar::<f64>::default();
    let (q, v, tau) = five_bar_state::<f64>();
    let (accelerations, lambda) = constrained::<f64>();
    let a = model.forward_dynamics(&q, &v, &tau).expect("regular");
    assert!((accelerations - model.tree_acceleration(&q, &v, &a)).amax() < 1e-12);
    assert!((lambda - model.multipliers(&q, &v, &a)).amax() < 1e-12);
    let qd = model.tree_velocity(&q, &v);
    let bias = model.constraint_bias(&q, &qd);
    assert!((model.constraint_jacobian(&q) * accelerations + bias).amax() < 1e-12);
    // The rows do no work.
    assert!(lambda.dot(&(model.constraint_jacobian(&q) * qd)).abs() < 1e-14);
    // Efforts on all joints are those on the independent ones with the same power: P · q̇ = (Sᵀ P) · u.
    let efforts = vector![2.0, 0.3, -0.5, 0.7];
    let own = model.velocity_map(&q).transpose() * efforts;
    assert!((efforts.dot(&qd) - own.dot(&v)).abs() < 1e-14);
    let (moved, _) = model
        .constrained_dynamics(&q, &qd, &efforts)
        .expect("regular");
    let a = model.forward_dynamics(&q, &v, &own).expect("regular");
    assert!((moved - model.tree_acceleration(&q, &v, &a)).amax() < 1e-12);
    let kept = model.project_velocity(&q, &qd).expect("regular");
    assert!((kept - qd).amax() < 1e-14);
    let pushed = qd + vector![0.1, 0.2, -0.3, 0.4];
    let held = model.project_velocity(&q, &pushed).expect("regular");
    assert!((model.constraint_jacobian(&q) * held).amax() < 1e-15);
    assert!((held - pushed).amax() > 0.01);
}

#[test]
fn every_scalar_has_the_same_results() {
    let exact = constrained::<Dd>();
    let near = |found: f64, exact: Dd, digits: f64| {
        let off = (found - exact.to_f64()).abs();
        assert!(
            off <= digits * exact.to_f64().abs().max(10.0),
            "{found} against {exact:?}"
        );
    };
    let (long, short, lanes) = (
        constrained::<f64>(),
        constrained::<f32>(),
        constrained::<f64x4>(),
    );
    for j in 0..NT {
        near(long.0[j], exact.0[j], 1e-13);
        near(f64::from(short.0[j]), exact.0[j], 1e-4);
        assert_eq!(lanes.0[j].to_array(), [long.0[j]; 4]);
    }
    for r in 0..NC {
        near(long.1[r], exact.1[r], 1e-13);
        near(f64::from(short.1[r]), exact.1[r], 1e-4);
        assert_eq!(lanes.1[r].to_array(), [long.1[r]; 4]);
    }
}

#[test]
fn errors_name_the_loop_and_the_argument() {
    let model = FiveBar::<f64>::default();
    let (q, v, tau) = five_bar_state::<f64>();
    let still = SVector::<f64, NT>::zeros();
    // The rods in line with each other: the elbows 0.7 m apart.
    let mut flat = q;
    let reach = (0.7_f64 - 0.3) / 2.0 / 0.25;
    flat[0] = std::f64::consts::PI - reach.acos();
    flat[2] = reach.acos();
    flat[1] = -flat[0];
    flat[3] = std::f64::consts::PI - flat[2];
    assert!(model.constraint_residual(&flat).amax() < 1e-14);
    let error = model
        .constrained_dynamics(&flat, &still, &still)
        .expect_err("singular");
    assert_eq!((error.name(), error.cause()), ("tip_pin", Cause::Loop));
    assert_eq!(error.joint(), NT);
    assert_eq!(five_bar::TREE_PIVOT_NAMES[NT], "tip_pin");
    let error = model.project_velocity(&flat, &still).expect_err("singular");
    assert_eq!(error.name(), "tip_pin");
    let error = model
        .reactions(&flat, &vector![0.0, 0.0], &tau)
        .expect_err("singular");
    assert_eq!(error.name(), "tip_pin");

    let mut lost = model.tree_velocity(&q, &v);
    lost[1] = f64::NAN;
    let argument = |argument, index| Cause::Argument { argument, index };
    let error = model
        .constrained_dynamics(&q, &lost, &still)
        .expect_err("no number");
    assert_eq!(
        (error.name(), error.cause()),
        ("distal1_angle", argument(Argument::Qd, 1))
    );
    assert!(error.to_string().contains("of argument `qd`"), "{error}");
    let error = model.project_velocity(&q, &lost).expect_err("no number");
    assert_eq!(error.cause(), argument(Argument::Qd, 1));
    let error = model
        .constrained_dynamics(&q, &still, &lost)
        .expect_err("no number");
    assert_eq!(error.cause(), argument(Argument::Tau, 1));

    // A lane that fails leaves the others their accelerations.
    let model = FiveBar::<f64x4>::default();
    let [q, mut qd] = [q, still].map(|x| x.map(f64x4::splat));
    qd[2] = f64x4::new([0.0, f64::NAN, 0.0, 0.0]);
    let tau = SVector::<f64x4, NT>::from_element(f64x4::splat(0.5));
    let error = model
        .constrained_dynamics(&q, &qd, &tau)
        .expect_err("lane 1");
    assert_eq!(
        error.failed().map(|(lane, _)| lane).collect::<Vec<_>>(),
        [1]
    );
    assert!(error.accelerations[0].to_array()[0].is_finite());
}

/// Three rows of a hinge in a planar loop have no multipliers: the force along its axis, the moments across it.
#[test]
fn what_is_not_determined_is_listed() {
    let [axial, tilt_x, tilt_y] = five_bar::UNDETERMINED;
    assert_eq!(five_bar::REACTION_NAMES, ["tip_pin"]);
    assert_eq!((axial.reaction, axial.row), (0, "tip_pin z"));
    assert_eq!((axial.force, axial.moment), ([0.0, 0.0, 1.0], [0.0; 3]));
    assert_eq!(
        (tilt_x.row, tilt_x.moment),
        ("tip_pin tilt x", [1.0, 0.0, 0.0])
    );
    assert_eq!(
        (tilt_y.row, tilt_y.moment),
        ("tip_pin tilt y", [0.0, 1.0, 0.0])
    );
    // The weights of both wheels act on an axle that is held in its height by the planar joint.
    let normal = differential_drive::UNDETERMINED.map(|u| (u.row, u.force));
    let up = [0.0, 0.0, 1.0];
    assert_eq!(
        normal,
        [("right_contact height", up), ("left_contact height", up)]
    );
    // A row that follows from others where the loop is closed.
    let [follows] = bricard::UNDETERMINED;
    assert_eq!(follows.row, "last_hinge tilt y");
    let size: f64 = follows.moment.iter().map(|x| x * x).sum();
    assert!((size - 1.0).abs() < 1e-15 && follows.force == [0.0; 3]);
    let machine = bricard::Bricard::<f64>::default();
    let loads = machine.reactions(&machine.neutral(), &vector![0.7], &vector![0.3]);
    let moment = loads.expect("a regular position")[0].moment;
    assert!(moment.dot(&Vector3::from(follows.moment)).abs() < 1e-13 * moment.norm());
}

/// Each link of the five-bar is a free body: here the whole machine, whose weight the two pivots carry at rest.
#[test]
fn pivots_carry_the_weight_at_rest() {
    let model = FiveBar::<f64>::default();
    let (q, _, _) = five_bar_state::<f64>();
    let still = vector![0.0, 0.0];
    let loads = model.joint_reactions(&q, &still, &still);
    let of = |name: &str| {
        let index = five_bar::LINK_NAMES.iter().position(|link| *link == name);
        loads[index.expect("a link")]
    };
    let [first, second] = ["proximal1", "proximal2"].map(of);
    let turned = |load: Wrench<f64>, angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let [x, y] = [load.force[0], load.force[1]];
        [x * cos - y * sin, x * sin + y * cos]
    };
    let (a, b) = (turned(first, q[0]), turned(second, q[2]));
    let tau = model.gravity(&q);
    assert!((first.moment[2] - tau[0]).abs() < 1e-14 && (second.moment[2] - tau[1]).abs() < 1e-14);
    assert!((a[0] + b[0]).abs() < 1e-13, "no force across the weight");
    let weight = a[1] + b[1];
    assert!(weight > 9.0, "{weight}");
    // Moment about the origin of both pivots: the weight acts at the common centre of mass.
    let slope = |h: f64| {
        let moved = model.integrate(&q, &vector![h, 0.0]);
        model.potential_energy(&moved)
    };
    assert!((slope(1e-6) - slope(-1e-6) - 2e-6 * tau[0]).abs() < 1e-9);
}

/// Forces ahead drive the cart, and the force along the axle holds it on its circle.
#[test]
fn wheels_carry_the_forces_of_newton() {
    let robot = DifferentialDrive::<f64>::default();
    let (q, v, tau) = (robot.neutral(), vector![5.0, 3.0], vector![0.3, 0.2]);
    let [right, left] = robot.reactions(&q, &v, &tau).expect("regular");
    let a = robot.forward_dynamics(&q, &v, &tau).expect("regular");
    let rates = robot.tree_velocity(&q, &v);
    let moved = robot.tree_acceleration(&q, &v, &a);
    // The velocity of the cart's origin is along x; its centre of mass is 0.06 m ahead, the wheels are on the axle.
    let (speed, turning) = (rates[0], rates[2]);
    let ahead = 11.0 * moved[0] - 10.0 * 0.06 * turning * turning;
    let aside = 11.0 * speed * turning + 10.0 * 0.06 * moved[2];
    assert!((right.force[0] + left.force[0] - ahead).abs() < 1e-13);
    assert!((right.force[1] - aside).abs() < 1e-13 && left.force[1] == 0.0);
    assert_eq!(
        (right.moment, left.moment),
        (Vector3::zeros(), Vector3::zeros())
    );
    // The axle of the right wheel: its torque, and what the wheel itself needs.
    let loads = robot.joint_reactions(&q, &v, &a);
    let wheel = differential_drive::LINK_NAMES
        .iter()
        .position(|name| *name == "right_wheel");
    let load = loads[wheel.expect("a wheel")];
    assert!((load.moment[1] - 0.3).abs() < 1e-14);
    assert!((load.moment[1] - (0.005 * a[0] + 0.1 * right.force[0])).abs() < 1e-14);
}

/// The moment about a joint's axis, or the force along it, is the effort of the joint; the base carries the weight.
#[test]
fn loads_of_an_arm_contain_its_efforts_and_weight() {
    let arm = Scara::<f64>::default();
    let q = vector![0.3, -0.8, 0.1, 0.4];
    let (v, a) = (vector![1.0, -2.0, 0.5, 3.0], vector![0.5, 1.5, -1.0, 2.0]);
    let tau = arm.inverse_dynamics(&q, &v, &a);
    let loads = arm.joint_reactions(&q, &v, &a);
    assert_eq!(loads.len(), scara::LINK_NAMES.len());
    let efforts = [loads[0].moment[2], loads[1].moment[2]];
    assert!((efforts[0] - tau[0]).abs() < 1e-12 && (efforts[1] - tau[1]).abs() < 1e-12);
    // About another point: M − r × F.
    let there = loads[1].about(&Vector3::new(0.1, 0.2, 0.3));
    let expected = loads[1].moment - Vector3::new(0.1, 0.2, 0.3).cross(&loads[1].force);
    assert!((there.moment - expected).amax() < 1e-14 && there.force == loads[1].force);
    let still = vector![0.0, 0.0, 0.0, 0.0];
    let base = arm.joint_reactions(&q, &still, &still)[0];
    // ∂V/∂(height) of the whole arm is its weight: the force at the base.
    assert!(base.force[2] > 0.0 && base.force[0].abs() < 1e-12 && base.force[1].abs() < 1e-12);
}
