//! The laws between positions, velocities and the methods.

use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::runtime::wide::f64x4;
use bgdyn::runtime::{Coriolis, Dd, Derivatives};
use bgdyn::{Dynamics, Scalar};
use bgdyn_codegen::random::Random;

use crate::any_length::AnyLength;
use crate::coupled::Coupled;
use crate::helical_universal_test::{self as every_type, HelicalUniversalTest};
use crate::quadrotor_arm::{self, QuadrotorArm};
use crate::spherical_chain3::SphericalChain3;

/// Returns numbers in −size … size.
fn numbers<T: Scalar, const N: usize>(random: &mut Random, size: f64) -> SVector<T, N> {
    SVector::from_fn(|_, _| T::from_f64(random.signed() * size))
}

/// Returns a position with quaternions of length 1 in this scalar.
fn position<T: Scalar, M: Dynamics<T, NQ, NV>, const NQ: usize, const NV: usize>(
    model: &M,
    random: &mut Random,
) -> SVector<T, NQ> {
    let half = T::from_f64(0.5);
    let u: SVector<T, NV> = numbers(random, 1.0);
    model.normalize(&model.sample(&u.map(|x: T| x * half + half)))
}

/// Returns m x; double-double numbers have no products of matrices.
fn product<const N: usize>(m: &SMatrix<Dd, N, N>, x: &SVector<Dd, N>) -> SVector<Dd, N> {
    SVector::from_fn(|i, _| (0..N).fold(Dd::from_f64(0.0), |sum, j| sum + m[(i, j)] * x[j]))
}

fn worst<const N: usize>(a: &SVector<Dd, N>, b: &SVector<Dd, N>) -> f64 {
    let off = a.iter().zip(b.iter()).map(|(&x, &y)| (x - y).abs());
    off.fold(0.0, |most: f64, x| most.max(x.to_f64()))
}

/// `difference` undoes `integrate`, and the rates of positions are the derivative of `integrate`.
fn positions_and_velocities<M: Dynamics<Dd, NQ, NV>, const NQ: usize, const NV: usize>(model: &M) {
    let mut random = Random(3);
    for _ in 0..20 {
        let q = position(model, &mut random);
        let d: SVector<Dd, NV> = numbers(&mut random, 1.5);
        let back = model.difference(&model.integrate(&q, &d), &q);
        assert!(worst(&back, &d) < 1e-27, "{:e}", worst(&back, &d));
        let h = Dd::from_f64(1e-8);
        let [ahead, behind] = [h, -h].map(|h| model.integrate(&q, &d.map(|x| x * h)));
        let slope = SVector::from_fn(|i, _| (ahead[i] - behind[i]) / (h + h));
        let rates = model.position_rates(&q, &d);
        assert!(worst(&slope, &rates) < 1e-14, "{:e}", worst(&slope, &rates));
    }
}

#[test]
fn positions_and_velocities_fit_each_other() {
    positions_and_velocities(&HelicalUniversalTest::<Dd>::default());
    positions_and_velocities(&SphericalChain3::<Dd>::default());
    positions_and_velocities(&Coupled::<Dd>::default());
}

#[test]
fn gravity_is_the_derivative_of_potential_energy_along_the_tangent() {
    gravity_is_the_slope(&HelicalUniversalTest::<Dd>::default());
    gravity_is_the_slope(&Coupled::<Dd>::default());
}

fn gravity_is_the_slope<M: Dynamics<Dd, NQ, NV>, const NQ: usize, const NV: usize>(model: &M) {
    let mut random = Random(5);
    let q = position(model, &mut random);
    let found = model.gravity(&q);
    let h = Dd::from_f64(1e-9);
    let slope = SVector::<Dd, NV>::from_fn(|j, _| {
        let step = |h: Dd| SVector::from_fn(|i, _| if i == j { h } else { Dd::from_f64(0.0) });
        let [ahead, behind] =
            [h, -h].map(|h| model.potential_energy(&model.integrate(&q, &step(h))));
        (ahead - behind) / (h + h)
    });
    assert!(worst(&slope, &found) < 1e-13, "{:e}", worst(&slope, &found));
}

#[test]
fn forward_undoes_inverse_dynamics_and_momenta_give_the_energy() {
    forward_undoes_inverse(&HelicalUniversalTest::<Dd>::default());
    forward_undoes_inverse(&Coupled::<Dd>::default());
}

fn forward_undoes_inverse<M: Dynamics<Dd, NQ, NV>, const NQ: usize, const NV: usize>(model: &M) {
    let mut random = Random(7);
    for _ in 0..5 {
        let q = position(model, &mut random);
        let (v, a) = (numbers(&mut random, 2.0), numbers(&mut random, 5.0));
        let tau = model.inverse_dynamics(&q, &v, &a);
        let found = model
            .forward_dynamics(&q, &v, &tau)
            .expect("it has inertia");
        // Constants are rounded to f64 in each function by itself.
        assert!(worst(&found, &a) < 1e-12, "{:e}", worst(&found, &a));
        let momenta = product(&model.mass_matrix(&q), &v);
        let products = momenta.iter().zip(v.iter()).map(|(&p, &v)| p * v);
        let twice = products.fold(Dd::from_f64(0.0), |sum, x| sum + x);
        let twice = twice - model.kinetic_energy(&q, &v) * Dd::from_f64(2.0);
        assert!(twice.to_f64().abs() < 1e-13, "{:e}", twice.to_f64());
    }
}

/// Ṁ = C + Cᵀ with Ṁ along the motion, also for quasi-velocities; C v is the bias without gravity.
#[test]
fn twice_the_coriolis_matrix_is_the_rate_of_the_mass_matrix_but_for_a_skew_part() {
    coriolis(&QuadrotorArm::<Dd>::default());
    coriolis(&Coupled::<Dd>::default());
}

fn coriolis<M, const NQ: usize, const NV: usize>(model: &M)
where
    M: Dynamics<Dd, NQ, NV> + Coriolis<Dd, NQ, NV>,
{
    let mut random = Random(11);
    let q = position(model, &mut random);
    let v: SVector<Dd, NV> = numbers(&mut random, 2.0);
    let c = model.coriolis_matrix(&q, &v);
    let h = Dd::from_f64(1e-8);
    let [ahead, behind] = [h, -h].map(|h| model.mass_matrix(&model.integrate(&q, &(v * h))));
    let rate = (ahead - behind).map(|x| x / (h + h));
    let off = (rate - (c + c.transpose())).map(|x| x.to_f64().abs()).max();
    assert!(off < 1e-14, "{off:e}");
    let bias = product(&c, &v) + model.gravity(&q);
    let off = worst(&bias, &model.bias(&q, &v));
    // Constants are rounded to f64 in each function by itself.
    assert!(off < 1e-13, "{off:e}");
}

/// Derivatives along the tangent, by differences through `integrate`.
#[test]
fn derivatives_are_along_the_tangent() {
    derivatives(&QuadrotorArm::<Dd>::default());
    derivatives(&Coupled::<Dd>::default());
}

fn derivatives<M, const NQ: usize, const NV: usize>(model: &M)
where
    M: Dynamics<Dd, NQ, NV> + Derivatives<Dd, NQ, NV>,
{
    let mut random = Random(13);
    let q = position(model, &mut random);
    let [v, a, tau]: [SVector<Dd, NV>; 3] = [2.0, 3.0, 4.0].map(|s| numbers(&mut random, s));
    let [by_q, _] = model.inverse_dynamics_derivatives(&q, &v, &a);
    let [forward_by_q, ..] = model
        .forward_dynamics_derivatives(&q, &v, &tau)
        .expect("it has inertia");
    let h = Dd::from_f64(1e-9);
    for j in 0..NV {
        let step = |h: Dd| SVector::from_fn(|i, _| if i == j { h } else { Dd::from_f64(0.0) });
        let ends = [h, -h].map(|h| model.integrate(&q, &step(h)));
        let slope = |f: &dyn Fn(&SVector<Dd, NQ>) -> SVector<Dd, NV>| {
            let [ahead, behind] = [f(&ends[0]), f(&ends[1])];
            (ahead - behind).map(|x| x / (h + h))
        };
        let efforts = slope(&|q| model.inverse_dynamics(q, &v, &a));
        assert!(worst(&efforts, &by_q.column(j).into_owned()) < 1e-12);
        let accelerations = slope(&|q| model.forward_dynamics(q, &v, &tau).expect("inertia"));
        assert!(worst(&accelerations, &forward_by_q.column(j).into_owned()) < 1e-9);
    }
}

/// Lanes equal the scalar model lane by lane, in methods and in integration.
#[test]
fn lanes_equal_the_scalar_model() {
    const NQ: usize = every_type::NQ;
    const NV: usize = every_type::NV;
    let (model, lanes) = (
        HelicalUniversalTest::<f64>::default(),
        HelicalUniversalTest::<f64x4>::default(),
    );
    let mut random = Random(17);
    let q: [SVector<f64, NQ>; 4] = std::array::from_fn(|_| position(&model, &mut random));
    let [v, a]: [[SVector<f64, NV>; 4]; 2] =
        std::array::from_fn(|_| std::array::from_fn(|_| numbers(&mut random, 2.0)));
    fn pack<const N: usize>(all: &[SVector<f64, N>; 4]) -> SVector<f64x4, N> {
        SVector::from_fn(|i, _| f64x4::new(std::array::from_fn(|k| all[k][i])))
    }
    let (wide_q, wide_v, wide_a) = (pack(&q), pack(&v), pack(&a));
    let efforts = lanes.inverse_dynamics(&wide_q, &wide_v, &wide_a);
    let moved = lanes.integrate(&wide_q, &wide_v);
    let apart = lanes.difference(&moved, &wide_q);
    for k in 0..4 {
        let one = model.inverse_dynamics(&q[k], &v[k], &a[k]);
        let reached = model.integrate(&q[k], &v[k]);
        let difference = model.difference(&reached, &q[k]);
        for i in 0..NV {
            assert_eq!(efforts[i].to_array()[k].to_bits(), one[i].to_bits());
            assert!((apart[i].to_array()[k] - difference[i]).abs() < 1e-14);
        }
        for i in 0..NQ {
            assert!((moved[i].to_array()[k] - reached[i]).abs() < 1e-14);
        }
    }
}

/// With `quaternion: any` nothing depends on the lengths of the quaternions, but their own rates, which are
/// proportional to them.
#[test]
fn quaternions_of_any_length() {
    let model = AnyLength::<Dd>::default();
    let mut random = Random(23);
    let q = position(&model, &mut random);
    let (v, d) = (numbers(&mut random, 2.0), numbers(&mut random, 1.0));
    let lengths = [3.0, 0.2];
    let length = |p: usize| match p {
        3..7 => Dd::from_f64(lengths[0]),
        7..11 => Dd::from_f64(lengths[1]),
        _ => Dd::from_f64(1.0),
    };
    let scaled = SVector::from_fn(|p, _| q[p] * length(p));
    let rates = model.position_rates(&q, &v);
    let wanted = SVector::from_fn(|p, _| rates[p] * length(p));
    assert!(worst(&model.position_rates(&scaled, &v), &wanted) < 1e-28);
    let moved = model.integrate(&q, &d);
    assert!(worst(&model.integrate(&scaled, &d), &moved) < 1e-28);
    assert!(worst(&model.difference(&moved, &scaled), &d) < 1e-27);
    let bias = model.bias(&q, &v);
    assert!(worst(&model.bias(&scaled, &v), &bias) < 1e-26);
}

/// The mass matrix in single precision, to its rounding.
#[test]
fn single_precision() {
    let model = SphericalChain3::<f32>::default();
    let exact = SphericalChain3::<Dd>::default();
    let mut random = Random(19);
    let q = position(&model, &mut random);
    let found = model.mass_matrix(&q);
    let wanted = exact.mass_matrix(&exact.normalize(&q.map(|x| Dd::from_f64(f64::from(x)))));
    let off = found.map(f64::from) - wanted.map(Dd::to_f64);
    assert!(off.amax() < 3e-6, "{:e}", off.amax());
}

#[test]
fn names_of_positions_and_velocities() {
    assert_eq!(
        quadrotor_arm::JOINT_NAMES,
        [
            "free_x", "free_y", "free_z", "free_rx", "free_ry", "free_rz", "shoulder", "elbow"
        ]
    );
    assert_eq!(
        quadrotor_arm::POSITION_NAMES,
        [
            "free_x", "free_y", "free_z", "free_qx", "free_qy", "free_qz", "free_qw", "shoulder",
            "elbow"
        ]
    );
    assert!(
        !every_type::LINK_NAMES
            .iter()
            .any(|name| name.contains("hooke"))
    );
}
