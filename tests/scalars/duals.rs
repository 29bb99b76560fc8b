//! Checks that derivatives by dual numbers obey the laws that relate the methods, and equal differences
//! computed in double-double.

use bgdyn::nalgebra::{SMatrix, SVector};
use bgdyn::runtime::Dd;
use bgdyn::runtime::num_dual::{Dual64, DualSVec64, HyperDual64};
use bgdyn::{Dynamics, Singular};
use bgdyn_codegen::random::Random;

use crate::models::puma560::Puma560;
use crate::models::scara4::Scara4;
use crate::models::spherical_pendulum::SphericalPendulum;
use crate::models::{State, vector, widen};

/// The argument of the derivative.
const Q: usize = 0;
const V: usize = 1;
const A: usize = 2;

/// Returns the state with a unit derivative of component `j` of argument `part`.
fn along<const N: usize>(state: &State<f64, N>, part: usize, j: usize) -> State<Dual64, N> {
    let mut dual: State<Dual64, N> = widen(state);
    dual[part][j].eps = 1.0;
    dual
}

fn near<const R: usize, const C: usize>(
    what: &str,
    found: &SMatrix<f64, R, C>,
    wanted: &SMatrix<f64, R, C>,
    relative: f64,
) {
    let error = (found - wanted).amax();
    let size = wanted.amax().max(1.0);
    assert!(
        error <= relative * size,
        "{what}: off by {error:e} of {size:e}"
    );
}

/// Returns a matrix column by column, from one derivative each.
fn columns<const N: usize>(f: impl Fn(usize) -> SVector<Dual64, N>) -> SMatrix<f64, N, N> {
    let columns: Vec<SVector<f64, N>> = (0..N).map(|j| f(j).map(|x| x.eps)).collect();
    SMatrix::from_columns(&columns)
}

/// Returns ∂τ/∂(argument), by central differences in double-double.
fn difference<M: Dynamics<Dd, N, N>, const N: usize>(
    model: &M,
    state: &State<f64, N>,
    part: usize,
    step: f64,
) -> SMatrix<f64, N, N> {
    let at = |j: usize, step: f64| {
        let mut shifted: State<Dd, N> = widen(state);
        shifted[part][j] += Dd::from_f64(step);
        let [q, v, a] = &shifted;
        model.inverse_dynamics(q, v, a)
    };
    SMatrix::from_fn(|i, j| {
        let change = at(j, step)[i] - at(j, -step)[i];
        (change / Dd::from_f64(2.0 * step)).to_f64()
    })
}

struct Models<A, B, C, D, E> {
    plain: A,
    dual: B,
    vector: C,
    hyper: D,
    wide: E,
}

fn obeys<const N: usize>(
    models: &Models<
        impl Dynamics<f64, N, N>,
        impl Dynamics<Dual64, N, N>,
        impl Dynamics<DualSVec64<N>, N, N>,
        impl Dynamics<HyperDual64, N, N>,
        impl Dynamics<Dd, N, N>,
    >,
) {
    let (plain, model) = (&models.plain, &models.dual);
    let mut random = Random(41);
    for _ in 0..100 {
        let state @ [q, v, a] = &[
            vector(&mut random, 3.0),
            vector(&mut random, 2.0),
            vector(&mut random, 5.0),
        ];
        let mass = plain.mass_matrix(q);
        let effort = |part: usize| {
            columns(|j| {
                let [q, v, a] = &along(state, part, j);
                model.inverse_dynamics(q, v, a)
            })
        };
        near("M = ∂τ/∂a", &effort(A), &mass, 1e-12);
        let of_speed = difference(&models.wide, state, V, 1e-3);
        near("∂τ/∂v", &effort(V), &of_speed, 1e-12);
        let of_place = difference(&models.wide, state, Q, 1e-8);
        near("∂τ/∂q", &effort(Q), &of_place, 1e-12);

        let potential = |j: usize| model.potential_energy(&along(state, Q, j)[Q]);
        let slope = SVector::<f64, N>::from_fn(|j, _| potential(j).eps);
        near("gravity = ∂V/∂q", &slope, &plain.gravity(q), 1e-12);
        let momentum = SVector::<f64, N>::from_fn(|j, _| {
            let [q, v, _] = &along(state, V, j);
            model.kinetic_energy(q, v).eps
        });
        near("M v = ∂T/∂v", &momentum, &(mass * v), 1e-12);

        let dual_q: SVector<DualSVec64<N>, N> =
            SVector::from_fn(|j, _| DualSVec64::from_re(q[j]).derivative(j));
        let constant = |x: &SVector<f64, N>| x.map(DualSVec64::<N>::from_re);
        let at_once = models
            .vector
            .inverse_dynamics(&dual_q, &constant(v), &constant(a));
        let at_once = SMatrix::from_fn(|i, j| at_once[i].eps.0.map_or(0.0, |eps| eps[j]));
        near("∂τ/∂q in one pass", &at_once, &effort(Q), 1e-13);

        let curvature = SMatrix::from_fn(|i, j| {
            let mut q = q.map(HyperDual64::from_re);
            q[i].eps1 = 1.0;
            q[j].eps2 = 1.0;
            models.hyper.potential_energy(&q).eps1eps2
        });
        let stiffness = columns(|j| model.gravity(&along(state, Q, j)[Q]));
        near("∂g/∂q = ∂²V/∂q²", &curvature, &stiffness, 1e-12);

        let mobility = columns(|j| {
            let [q, v, tau] = &along(state, A, j);
            model.forward_dynamics(q, v, tau).expect("M is regular")
        });
        // The error of the inverse is proportional to its norm.
        let relative = 1e-14 * N as f64 * mass.amax() * mobility.amax().max(1.0);
        near(
            "M ∂a/∂τ = 1",
            &(mass * mobility),
            &SMatrix::identity(),
            relative.max(1e-12),
        );
    }
}

macro_rules! models {
    ($model:ident, $n:literal) => {
        Models {
            plain: $model::<f64>::default(),
            dual: $model::<Dual64>::default(),
            vector: $model::<DualSVec64<$n>>::default(),
            hyper: $model::<HyperDual64>::default(),
            wide: $model::<Dd>::default(),
        }
    };
}

#[test]
fn derivatives_of_the_puma() {
    obeys::<6>(&models!(Puma560, 6));
}

#[test]
fn derivatives_of_the_scara() {
    obeys::<4>(&models!(Scara4, 4));
}

#[test]
fn the_real_part_decides_what_is_singular() {
    let model = SphericalPendulum::<Dual64>::default();
    let azimuth = Singular::new(0, &["azimuth"]);
    let (v, tau) = (SVector::zeros(), SVector::repeat(Dual64::from_re(1.0)));
    let at = |tilt| SVector::from([Dual64::from_re(0.3), tilt]);
    let singular = at(Dual64::new(0.0, 1.0));
    assert_eq!(model.forward_dynamics(&singular, &v, &tau), Err(azimuth));
    for eps in [0.0, -1e30] {
        let regular = at(Dual64::new(0.5, eps));
        assert!(model.forward_dynamics(&regular, &v, &tau).is_ok());
    }
}
