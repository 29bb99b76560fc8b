//! Actuated joints of mechanisms with loops in compiled code: constants, efforts and accelerations in every scalar,
//! errors.

mod assembled;

use bgdyn::nalgebra::{DMatrix, DVector, SVector, vector};
use bgdyn::runtime::wide::f64x4;
use bgdyn::runtime::{Argument, Cause, Dd};
use bgdyn::{Dynamics, Scalar};

bgdyn::bgdyn!(
    "crank_and_rod.yaml",
    methods = [dynamics, reactions, joint_reactions]
);
bgdyn::bgdyn!("three_drives.yaml");
bgdyn::bgdyn!("one_drive.yaml", methods = [dynamics, joint_reactions]);
bgdyn::bgdyn!(
    "../../specs/loops/five_bar.yaml",
    methods = [dynamics, constrained_dynamics, reactions, joint_reactions]
);

use crank_and_rod::CrankAndRod;
use five_bar::FiveBar;
use one_drive::OneDrive;
use three_drives::ThreeDrives;

/// A closed position, velocities, accelerations and efforts.
fn state<T: Scalar>() -> (SVector<T, 4>, [SVector<T, 2>; 3]) {
    let model = CrankAndRod::<T>::default();
    let number = T::from_f64;
    let q = model.integrate(&model.neutral(), &vector![number(0.2), number(-0.1)]);
    let two = |x: f64, y: f64| vector![number(x), number(y)];
    (q, [two(0.75, -1.5), two(3.0, 2.0), two(2.0, -0.5)])
}

fn results<T: Scalar>() -> (SVector<T, 2>, SVector<T, 2>) {
    let model = CrankAndRod::<T>::default();
    let (q, [v, a, tau]) = state::<T>();
    let efforts = model.inverse_dynamics(&q, &v, &a);
    let moved = model.forward_dynamics(&q, &v, &tau);
    (
        efforts.unwrap_or_else(|error| panic!("{error:?}")),
        moved.unwrap_or_else(|error| panic!("{error:?}")),
    )
}

#[test]
fn constants_name_the_actuated_joints_in_the_order_of_the_tree() {
    assert_eq!(crank_and_rod::NA, 2);
    assert_eq!(
        crank_and_rod::ACTUATED,
        ["proximal1_angle", "proximal2_angle"]
    );
    assert_eq!(
        crank_and_rod::JOINT_NAMES,
        ["proximal1_angle", "distal1_angle"]
    );
    assert_eq!(three_drives::NA, 3);
    assert_eq!(one_drive::ACTUATED, ["distal1_angle"]);
}

/// The same machine in two coordinates: efforts on the cranks are the same, and so is the motion.
#[test]
fn efforts_of_the_cranks_do_not_depend_on_the_coordinates() {
    let (own, other) = (CrankAndRod::<f64>::default(), FiveBar::<f64>::default());
    let (q, [v, a, tau]) = state::<f64>();
    let (qd, qdd) = (own.tree_velocity(&q, &v), own.tree_acceleration(&q, &v, &a));
    let cranks = |x: &SVector<f64, 4>| vector![x[0], x[2]];
    let efforts = own.inverse_dynamics(&q, &v, &a).expect("regular");
    let wanted = other.inverse_dynamics(&q, &cranks(&qd), &cranks(&qdd));
    assert!((efforts - wanted).amax() < 1e-12 * wanted.amax());
    let moved = own.forward_dynamics(&q, &v, &tau).expect("regular");
    let moved = own.tree_acceleration(&q, &v, &moved);
    let other_moved = other
        .forward_dynamics(&q, &cranks(&qd), &tau)
        .expect("regular");
    let size = other_moved.amax();
    assert!((cranks(&moved) - other_moved).amax() < 1e-12 * size);
    let loads = own.reactions(&q, &v, &tau).expect("regular");
    let other_loads = other.reactions(&q, &cranks(&qd), &tau).expect("regular");
    for (own, other) in loads.iter().zip(&other_loads) {
        let size = other.force.amax();
        assert!((own.force - other.force).amax() < 1e-12 * size);
    }
}

/// The same machine in two coordinates: drives at the cranks load the joints in the same way.
#[test]
fn loads_of_joints_do_not_depend_on_the_coordinates() {
    let (own, other) = (CrankAndRod::<f64>::default(), FiveBar::<f64>::default());
    let (q, [v, a, _]) = state::<f64>();
    let (qd, qdd) = (own.tree_velocity(&q, &v), own.tree_acceleration(&q, &v, &a));
    let cranks = |x: &SVector<f64, 4>| vector![x[0], x[2]];
    let tau = own.inverse_dynamics(&q, &v, &a).expect("regular");
    let loads = own.joint_reactions(&q, &v, &a, &tau);
    let wanted = other.joint_reactions(&q, &cranks(&qd), &cranks(&qdd));
    assert_eq!(loads.len(), crank_and_rod::LINK_NAMES.len());
    let size = wanted.iter().map(|load| load.force.amax());
    let size = size.fold(0.0, f64::max);
    for (own, other) in loads.iter().zip(&wanted) {
        let off = (own.force - other.force).amax();
        assert!(off < 1e-12 * size, "{off:e} of {size}");
        let off = (own.moment - other.moment).amax();
        assert!(off < 1e-12 * size, "{off:e} of {size}");
    }
    // About their axes joints bear the efforts of their drives: that of a dependent joint to the last bit.
    assert!((loads[0].moment[2] - tau[0]).abs() < 1e-12 * size);
    assert!(loads[1].moment[2].abs() < 1e-12 * size);
    assert_eq!((loads[2].moment[2], loads[3].moment[2]), (tau[1], 0.0));
}

/// One drive at a rod for two cranks: the cranks have no drives, and move as the drive alone moves them.
#[test]
fn joints_of_an_underactuated_machine_bear_its_drive_alone() {
    let machine = OneDrive::<f64>::default();
    let (q, v, tau) = (machine.neutral(), vector![0.75, -1.5], vector![2.0]);
    let a = machine.forward_dynamics(&q, &v, &tau).expect("regular");
    let loads = machine.joint_reactions(&q, &v, &a, &tau);
    let about_axes = loads.map(|load| load.moment[2]);
    assert_eq!(one_drive::ACTUATED, ["distal1_angle"]);
    assert_eq!((about_axes[1], about_axes[3]), (2.0, 0.0));
    assert!(about_axes[0].abs() < 1e-12 && about_axes[2].abs() < 1e-12);
}

#[test]
fn the_trait_has_efforts_along_the_independent_velocities() {
    fn of_trait<D: Dynamics<f64, 4, 2>>(model: &D) -> [SVector<f64, 2>; 2] {
        let (q, [v, a, _]) = state::<f64>();
        let efforts = model.inverse_dynamics(&q, &v, &a);
        let moved = model.forward_dynamics(&q, &v, &efforts).expect("regular");
        [efforts, moved - a]
    }
    let model = CrankAndRod::<f64>::default();
    let (q, [v, a, tau]) = state::<f64>();
    let [efforts, off] = of_trait(&model);
    assert!(off.amax() < 1e-12);
    assert_eq!(efforts, model.reduced_inverse_dynamics(&q, &v, &a));
    // A P, with the rows of S of the cranks.
    let own = model.inverse_dynamics(&q, &v, &a).expect("regular");
    let map = model.velocity_map(&q);
    let along = |p: &SVector<f64, 2>| map.row(0).transpose() * p[0] + map.row(2).transpose() * p[1];
    assert!((along(&own) - efforts).amax() < 1e-13 * efforts.amax());
    let reduced = model.reduced_forward_dynamics(&q, &v, &along(&tau));
    let moved = model.forward_dynamics(&q, &v, &tau).expect("regular");
    assert!((reduced.expect("regular") - moved).amax() < 1e-12 * moved.amax());
    // P · q̇ = (A P) · u
    let qd = model.tree_velocity(&q, &v);
    let power = own[0] * qd[0] + own[1] * qd[2];
    assert!((power - efforts.dot(&v)).abs() < 1e-13 * power.abs());
}

#[test]
fn every_scalar_has_the_same_results() {
    let exact = results::<Dd>();
    let (long, short, lanes) = (results::<f64>(), results::<f32>(), results::<f64x4>());
    let near = |found: f64, exact: Dd, digits: f64| {
        let off = (found - exact.to_f64()).abs();
        let size = exact.to_f64().abs().max(10.0);
        assert!(off <= digits * size, "{found} against {exact:?}");
    };
    for j in 0..2 {
        near(long.0[j], exact.0[j], 1e-13);
        near(long.1[j], exact.1[j], 1e-13);
        near(f64::from(short.0[j]), exact.0[j], 1e-4);
        near(f64::from(short.1[j]), exact.1[j], 1e-4);
        assert_eq!(lanes.0[j].to_array(), [long.0[j]; 4]);
        assert_eq!(lanes.1[j].to_array(), [long.1[j]; 4]);
    }
}

/// Three drives: A P = Sᵀ P of all joints, and P over its limits is the shortest, by a singular value decomposition.
#[test]
fn three_drives_share_the_effort_by_their_limits() {
    let model = ThreeDrives::<f64>::default();
    let limits = DMatrix::from_diagonal(&DVector::from_vec(vec![10.0, 2.0, 12.0]));
    let mut q = model.neutral();
    for k in 0..50 {
        let t = f64::from(k) * 0.1;
        let u = vector![0.3 * t.sin(), 0.2 * (1.3 * t).cos()];
        q = model.integrate(&model.neutral(), &u);
        let (v, a) = (vector![t.cos(), -0.5], vector![2.0, -3.0 * t.sin()]);
        let efforts = model.inverse_dynamics(&q, &v, &a).expect("regular");
        let wanted = model.reduced_inverse_dynamics(&q, &v, &a);
        let map = model.velocity_map(&q);
        let matrix = DMatrix::from_fn(2, 3, |k, j| map[(j, k)]);
        let inverse = (&matrix * &limits)
            .pseudo_inverse(1e-12)
            .expect("a decomposition");
        let least = &limits * inverse * DVector::from_iterator(2, wanted.iter().copied());
        let off = (0..3).map(|j| (efforts[j] - least[j]).abs());
        assert!(off.fold(0.0, f64::max) < 1e-12 * least.amax(), "{k}");
        let moved = model.forward_dynamics(&q, &v, &efforts).expect("regular");
        assert!((moved - a).amax() < 1e-11, "{k}");
    }
    assert!(model.constraint_residual(&q).amax() < 1e-15);
}

/// Fewer drives than velocities: accelerations under their efforts, and what would be needed.
#[test]
fn one_drive_moves_the_machine() {
    let (model, other) = (OneDrive::<f64>::default(), FiveBar::<f64>::default());
    let q = model.neutral();
    let v = vector![0.4, -0.3];
    let tau = vector![1.7];
    let a = model.forward_dynamics(&q, &v, &tau).expect("regular");
    let needed = model.reduced_inverse_dynamics(&q, &v, &a);
    let map = model.velocity_map(&q);
    assert!((needed - map.row(1).transpose() * 1.7).amax() < 1e-13);
    let qd = other.tree_velocity(&q, &v);
    let all = vector![0.0, 1.7, 0.0, 0.0];
    let (moved, _) = other.constrained_dynamics(&q, &qd, &all).expect("regular");
    assert!((vector![moved[0], moved[2]] - a).amax() < 1e-12 * a.amax());
}

/// The rods in line with each other: the ends of the cranks are 0.7 m apart.
fn aligned() -> SVector<f64, 4> {
    let angle = 0.8_f64.acos();
    let pi = std::f64::consts::PI;
    vector![pi - angle, angle - pi, angle, pi - angle]
}

#[test]
fn where_the_rods_are_aligned_only_efforts_are_missing() {
    let model = CrankAndRod::<f64>::default();
    let q = aligned();
    assert!(model.constraint_residual(&q).amax() < 1e-15);
    let (_, [v, a, tau]) = state::<f64>();
    let error = model.inverse_dynamics(&q, &v, &a).expect_err("singular");
    assert_eq!(
        (error.name(), error.cause()),
        ("distal1_angle", Cause::Actuators)
    );
    assert_eq!(
        crank_and_rod::ACTUATED_PIVOT_NAMES[error.joint()],
        "distal1_angle"
    );
    assert_eq!(
        error.to_string(),
        "no efforts of the actuated joints: `distal1_angle` does not follow the actuated joints here"
    );
    let moved = model
        .forward_dynamics(&q, &v, &tau)
        .expect("the loop is regular");
    let needed = model.reduced_inverse_dynamics(&q, &v, &moved);
    let map = model.velocity_map(&q);
    let along = map.row(0).transpose() * tau[0] + map.row(2).transpose() * tau[1];
    assert!((needed - along).amax() < 1e-12);
    assert!(model.reactions(&q, &v, &tau).is_ok());
    // In the coordinates of the cranks it is the loop that is singular: it is at the end of its reach.
    let other = FiveBar::<f64>::default();
    let error = other.forward_dynamics(&q, &v, &tau).expect_err("singular");
    assert_eq!(error.cause(), Cause::OutOfReach);
}

#[test]
fn errors_name_loop_and_argument() {
    let model = CrankAndRod::<f64>::default();
    let (q, [v, a, tau]) = state::<f64>();
    // The second crank in line with its rod.
    let mut flat = q;
    (flat[0], flat[1]) = (2.0, -1.2);
    let tip = [
        0.25 * 2.0_f64.cos() + 0.35 * 0.8_f64.cos(),
        0.25 * 2.0_f64.sin() + 0.35 * 0.8_f64.sin(),
    ];
    let line = tip[1].atan2(tip[0] - 0.3);
    (flat[2], flat[3]) = (line, 0.0);
    let error = model.inverse_dynamics(&flat, &v, &a).expect_err("singular");
    assert_eq!((error.name(), error.cause()), ("tip_pin", Cause::Loop));
    assert_eq!(
        crank_and_rod::ACTUATED_PIVOT_NAMES[error.joint()],
        "tip_pin"
    );
    let argument = |argument, index| Cause::Argument { argument, index };
    let lost = vector![0.0, f64::NAN];
    let error = model
        .inverse_dynamics(&q, &v, &lost)
        .expect_err("no number");
    assert_eq!(
        (error.name(), error.cause()),
        ("distal1_angle", argument(Argument::A, 1))
    );
    assert!(error.to_string().contains("of argument `a`"), "{error}");
    let error = model
        .forward_dynamics(&q, &v, &lost)
        .expect_err("no number");
    assert_eq!(
        (error.name(), error.cause()),
        ("proximal2_angle", argument(Argument::Tau, 1))
    );
    let error = model.reduced_forward_dynamics(&q, &v, &lost);
    assert_eq!(error.expect_err("no number").name(), "distal1_angle");
    let huge = vector![1e308, -1e308];
    let error = model
        .inverse_dynamics(&q, &v, &huge)
        .expect_err("too large");
    assert_eq!(error.cause(), Cause::NotFinite);
    assert!(crank_and_rod::ACTUATED.contains(&error.name()));
    assert!(model.reactions(&q, &lost, &tau).is_err());

    // A lane that fails leaves the others their efforts.
    let model = CrankAndRod::<f64x4>::default();
    let mut lanes = q.map(f64x4::splat);
    for (lane, &x) in lanes.iter_mut().zip(aligned().iter()) {
        let mut each = lane.to_array();
        each[2] = x;
        *lane = f64x4::new(each);
    }
    let [v, a] = [v, a].map(|x| x.map(f64x4::splat));
    let error = model.inverse_dynamics(&lanes, &v, &a).expect_err("lane 2");
    let failed: Vec<_> = error.failed().collect();
    assert_eq!(failed.len(), 1);
    assert_eq!((failed[0].0, failed[0].1.cause()), (2, Cause::Actuators));
    assert_eq!(failed[0].1.name(), "distal1_angle");
}
