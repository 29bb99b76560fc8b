//! Tests run-time parameters in compiled code: fields, defaults, values set by the caller.

use bgdyn::nalgebra::SVector;
use bgdyn::runtime::{Argument, Cause};
use bgdyn::{Dynamics, Scalar, Singular};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::random::Random;

use crate::counted::{Counted, executed};
use crate::counting::counts_equal;
use crate::golden_values::equals_golden;
use crate::laws::vector;

bgdyn::bgdyn!("specs/puma_changed.yaml");
bgdyn::bgdyn!("specs/puma_payload.yaml", derivatives = true);

use puma_changed::PumaChanged;
use puma_payload::PumaPayload;

/// The hand of `tests/golden/specs/puma560.yaml`, empty.
fn golden<T: Scalar>() -> PumaPayload<T> {
    let (k, zero) = (T::from_f64, T::from_f64(0.0));
    PumaPayload {
        hand_mass: k(0.09),
        hand_x: zero,
        hand_y: zero,
        hand_z: k(0.031999999999999994),
        hand_xx: k(0.00015),
        hand_yy: k(0.00015),
        hand_zz: k(4e-5),
        hand_xy: zero,
        hand_xz: zero,
        hand_yz: zero,
        ..PumaPayload::default()
    }
}

/// The numbers of `puma_changed.yaml`.
fn changed<T: Scalar>() -> PumaPayload<T> {
    let k = T::from_f64;
    PumaPayload {
        hand_mass: k(0.2),
        hand_x: k(-0.015),
        hand_y: k(0.005),
        hand_z: k(0.04),
        hand_xx: k(0.001),
        hand_yy: k(0.0012),
        hand_zz: k(0.0008),
        hand_xy: k(-0.0001),
        hand_xz: k(0.0002),
        hand_yz: k(0.00005),
        payload: k(2.5),
        payload_x: k(0.02),
        payload_y: k(0.01),
        payload_z: k(0.05),
    }
}

/// Returns the parameters in the order of the file.
fn values<T: Copy>(m: &PumaPayload<T>) -> Vec<T> {
    vec![
        m.hand_mass,
        m.hand_x,
        m.hand_y,
        m.hand_z,
        m.hand_xx,
        m.hand_yy,
        m.hand_zz,
        m.hand_xy,
        m.hand_xz,
        m.hand_yz,
        m.payload,
        m.payload_x,
        m.payload_y,
        m.payload_z,
    ]
}

#[test]
fn the_default_has_the_specs_values() {
    let spec = [
        0.3, 0.01, -0.02, 0.05, 0.002, 0.0025, 0.0015, 0.0001, -0.0002, 0.0003, 0.0, 0.0, 0.0, 0.0,
    ];
    assert_eq!(values(&PumaPayload::<f64>::default()), spec);
    let single: Vec<f32> = spec.iter().map(|&x| x as f32).collect();
    assert_eq!(values(&PumaPayload::<f32>::default()), single);
    assert_eq!(size_of::<PumaPayload<f64>>(), spec.len() * size_of::<f64>());
    assert_eq!(size_of::<PumaChanged<f64>>(), 0);
}

#[test]
fn parameters_set_to_the_golden_robots_give_its_values() {
    let joints = &puma_payload::JOINT_NAMES;
    equals_golden::<f64, _, 6>("puma560", &golden(), joints, 1.0, |x| x);
    let unit = f64::from(f32::EPSILON) / f64::EPSILON;
    equals_golden::<f32, _, 6>("puma560", &golden(), joints, unit, f64::from);
}

/// Returns every result of the trait's methods, in one list.
fn results<M: Dynamics<f64, 6, 6>>(
    model: &M,
    [q, v, a]: &[SVector<f64, 6>; 3],
) -> Vec<(Method, Vec<f64>)> {
    let mass = model.mass_matrix(q);
    let triangle = (0..6).flat_map(|i| (0..=i).map(move |j| mass[(i, j)]));
    let list = |x: SVector<f64, 6>| x.as_slice().to_vec();
    vec![
        (
            Method::InverseDynamics,
            list(model.inverse_dynamics(q, v, a)),
        ),
        (Method::MassMatrix, triangle.collect()),
        (Method::Bias, list(model.bias(q, v))),
        (Method::Gravity, list(model.gravity(q))),
        (
            Method::ForwardDynamics,
            list(model.forward_dynamics(q, v, a).expect("M is regular")),
        ),
        (Method::KineticEnergy, vec![model.kinetic_energy(q, v)]),
        (Method::PotentialEnergy, vec![model.potential_energy(q)]),
    ]
}

fn near(method: Method, found: &[f64], wanted: &[f64]) {
    let size = wanted.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    for (x, y) in found.iter().zip(wanted) {
        assert!((x - y).abs() <= 1e-12 * size, "{method:?}: {x} and {y}");
    }
}

#[test]
fn parameters_set_at_run_time_equal_constants_and_the_evaluator() {
    let text = include_str!("specs/puma_payload.yaml");
    let (mechanism, _) = bgdyn_codegen::read(text, Some("puma_payload"));
    let evaluator =
        bgdyn_codegen::selection::model(mechanism.expect("a sound spec"), &Default::default());
    let evaluator = evaluator.expect("nothing unknown");
    let (model, constant) = (changed::<f64>(), PumaChanged::<f64>::default());
    let mut random = Random(29);
    for _ in 0..50 {
        let state = [
            vector(&mut random, 3.0),
            vector(&mut random, 2.0),
            vector(&mut random, 5.0),
        ];
        let found = results(&model, &state);
        let wanted = results(&constant, &state);
        for ((method, found), (_, wanted)) in found.iter().zip(&wanted) {
            near(*method, found, wanted);
            let [q, v, a] = state.map(|x| x.as_slice().to_vec());
            let inputs = Inputs {
                q,
                v,
                u: a.clone(),
                a,
                parameters: values(&model),
                ..Inputs::default()
            };
            let function = evaluator.function(*method).expect("it is generated");
            let (evaluated, refused) = function.evaluate(inputs);
            assert_eq!(refused, None);
            near(*method, found, &evaluated);
        }
    }
}

#[test]
fn arithmetic_on_parameters_is_counted() {
    let model = PumaPayload::<Counted>::default();
    counts_equal::<_, 6>("puma_payload", &model, &puma_payload::OPERATIONS);
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
    ];
    assert_eq!(runs, puma_payload::OPERATIONS[7..10]);
}

#[test]
fn derivatives_follow_the_parameters() {
    let model = changed::<f64>();
    let [q, v, a] = [0.3, -1.1, 2.7].map(|x| SVector::from_fn(|j, _| x + j as f64));
    let [along_q, along_v] = model.inverse_dynamics_derivatives(&q, &v, &a);
    let h = 1e-5;
    for j in 0..6 {
        let mut step = SVector::<f64, 6>::zeros();
        step[j] = h;
        let effort = |q: SVector<f64, 6>, v: SVector<f64, 6>| model.inverse_dynamics(&q, &v, &a);
        let slope_q = (effort(q + step, v) - effort(q - step, v)) / (2.0 * h);
        let slope_v = (effort(q, v + step) - effort(q, v - step)) / (2.0 * h);
        let size = along_q.amax().max(along_v.amax());
        assert!((slope_q - along_q.column(j)).amax() < 1e-8 * size);
        assert!((slope_v - along_v.column(j)).amax() < 1e-8 * size);
    }
    let coriolis = model.coriolis_matrix(&q, &v);
    let rest = coriolis * v + model.gravity(&q) - model.bias(&q, &v);
    assert!(rest.amax() < 1e-12 * model.bias(&q, &v).amax());
}

/// Without inertia at the hand its joint cannot be accelerated, and the error names it.
#[test]
fn inertia_set_to_zero_is_singular() {
    let model = PumaPayload::<f64> {
        hand_mass: 0.0,
        hand_xx: 0.0,
        hand_yy: 0.0,
        hand_zz: 0.0,
        hand_xy: 0.0,
        hand_xz: 0.0,
        hand_yz: 0.0,
        ..PumaPayload::default()
    };
    let (q, zero) = (SVector::from_element(0.4), SVector::zeros());
    let hand = Singular::new(5, &puma_payload::JOINT_NAMES);
    assert_eq!(model.forward_dynamics(&q, &zero, &zero), Err(hand));
    let held = PumaPayload {
        hand_zz: 1e-5,
        ..model
    };
    assert!(held.forward_dynamics(&q, &zero, &zero).is_ok());
}

/// Forward dynamics names the argument that is NaN or infinite, also a run-time parameter; tested for each
/// component of each argument.
#[test]
fn what_is_no_number_is_named() {
    let model = PumaPayload::<f64>::default();
    let names = &puma_payload::JOINT_NAMES;
    for wild in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (part, argument) in [Argument::Q, Argument::V, Argument::Tau]
            .into_iter()
            .enumerate()
        {
            for index in 0..puma_payload::NV {
                let mut state = [SVector::<f64, 6>::from_element(0.4); 3];
                state[part][index] = wild;
                let [q, v, tau] = &state;
                let cause = Cause::Argument { argument, index };
                let read = (part, index) != (0, 0);
                match model.forward_dynamics(q, v, tau) {
                    Ok(_) => assert!(!read, "{argument:?}[{index}] = {wild} was accepted"),
                    Err(error) => assert_eq!((error.cause(), error.name()), (cause, names[index])),
                }
                let slopes = model.forward_dynamics_derivatives(q, v, tau);
                assert_eq!(slopes.err().map(|e| e.cause()), read.then_some(cause));
            }
        }
        let x = SVector::from_element(0.4);
        let model = PumaPayload {
            payload: wild,
            ..model
        };
        let error = model.forward_dynamics(&x, &x, &x).unwrap_err().to_string();
        assert!(error.contains("(`payload`) of argument `self`"), "{error}");
    }
}
