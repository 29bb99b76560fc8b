//! P = d/dt ∂T/∂q̇ − ∂T/∂q + ∂V/∂q from the energies alone, by nested dual numbers.
//!
//! T needs no angular velocity: with the pseudo-inertia D = ½ tr(J)·1 − J about the centre of mass
//! a link has T_i = ½ m_i ṙ_i·ṙ_i + ½ tr(Ȧ_i D Ȧ_iᵀ). Only A_i(q), r_i(q) and their rates enter.

use crate::common::kinematics::{M3, Number, Place, dot, gravity, inertial, m3, places, v3};
use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{FORMULATIONS, Robot, State, assert_close, golden, largest, natural_effort};
use bgdyn_codegen::method::Method;
use num_dual::{Dual, HyperDual};

/// A link's A_i and r_i along the motion q + v t: values and rates.
fn moving<D: Number>(robot: &Robot, q: &[D], v: &[D]) -> Vec<Place<Dual<D>>>
where
    Dual<D>: Number,
{
    let along: Vec<Dual<D>> = q.iter().zip(v).map(|(&q, &v)| Dual::new(q, v)).collect();
    places(&robot.mechanism, &along)
}

/// D = ½ tr(J)·1 − J
fn pseudo(tensor: M3<f64>) -> M3<f64> {
    let half = 0.5 * (tensor[0][0] + tensor[1][1] + tensor[2][2]);
    m3(|i, j| {
        if i == j {
            half - tensor[i][j]
        } else {
            -tensor[i][j]
        }
    })
}

/// T − V
fn lagrangian<D: Number>(robot: &Robot, q: &[D], v: &[D]) -> D
where
    Dual<D>: Number,
{
    let (t, potential) = energies(robot, q, v);
    t - potential
}

/// (T, V)
fn energies<D: Number>(robot: &Robot, q: &[D], v: &[D]) -> (D, D)
where
    Dual<D>: Number,
{
    let g = gravity(&robot.mechanism);
    let (mut kinetic, mut potential) = (D::from(0.0), D::from(0.0));
    for (i, place) in moving(robot, q, v).into_iter().enumerate() {
        let (mass, tensor) = inertial(&robot.mechanism, i);
        let rate = v3(|c| place.centre[c].eps);
        kinetic += dot(rate, rate) * (0.5 * mass);
        let d = pseudo(tensor);
        for row in place.rotation {
            for (j, x) in row.iter().enumerate() {
                for (k, y) in row.iter().enumerate() {
                    kinetic += x.eps * y.eps * (0.5 * d[j][k]);
                }
            }
        }
        for c in 0..3 {
            potential -= place.centre[c].re * (mass * g[c]);
        }
    }
    (kinetic, potential)
}

/// Returns the joint efforts: for each j the mixed derivative of L in q̇_j and time, minus ∂L/∂q_j.
fn efforts(robot: &Robot, s: &State) -> Vec<f64> {
    let n = robot.nv();
    let on = |yes: bool| f64::from(u8::from(yes));
    let effort = |j: usize| {
        let (q, v): (Vec<_>, Vec<_>) = (0..n)
            .map(|k| {
                let q = HyperDual::new(s.q[k], 0.0, s.v[k], 0.0);
                (q, HyperDual::new(s.v[k], on(k == j), s.a[k], 0.0))
            })
            .unzip();
        let momentum_rate = lagrangian(robot, &q, &v).eps1eps2;
        let (q, v): (Vec<_>, Vec<_>) = (0..n)
            .map(|k| (Dual::new(s.q[k], on(k == j)), Dual::new(s.v[k], 0.0)))
            .unzip();
        momentum_rate - lagrangian(robot, &q, &v).eps
    };
    (0..n).map(effort).collect()
}

fn check(robot: &Robot, states: usize, rng: &mut Rng, what: &str) {
    let motions = robot.motions();
    for formulation in FORMULATIONS {
        let inverse = robot.function(formulation, Method::InverseDynamics);
        let kinetic = robot.function(formulation, Method::KineticEnergy);
        let potential = robot.function(formulation, Method::PotentialEnergy);
        for k in 0..states {
            let s = State::random(rng, &motions);
            let place = || format!("{what}, {formulation}, state {k}\n{s:?}");
            let expected = efforts(robot, &s);
            let natural = natural_effort(robot, &s);
            let tolerance = 1e-11 * largest(&expected) + 1e-15 * natural;
            assert_close(&s.value::<f64>(&inverse), &expected, tolerance, place);
            let (t, v) = energies(robot, &s.q, &s.v);
            assert_close(
                &s.value::<f64>(&kinetic),
                &[t],
                1e-13 * t.abs() + 1e-15 * natural,
                place,
            );
            // Zero with every centre of mass at the world's origin: the constant is not arbitrary.
            let base: f64 = robot
                .mechanism
                .links()
                .iter()
                .map(|l| {
                    let at = l.joint.origin.translation.0;
                    at.iter().map(|x| x.to_f64().abs()).sum::<f64>()
                })
                .sum();
            let tolerance = 1e-14 * (natural + v.abs()) * (1.0 + base);
            assert_close(&s.value::<f64>(&potential), &[v], tolerance, place);
        }
    }
}

#[test]
fn golden_robots() {
    let mut rng = Rng::new(1788);
    let robots = golden::robots_up_to(7);
    assert!(robots.len() >= 12);
    for (name, robot) in robots {
        check(&robot, 3, &mut rng, &name);
    }
}

#[test]
fn random_trees() {
    for seed in 1000..1080 {
        let mut rng = Rng::new(seed);
        let text = Draft::random(&mut rng, 5).yaml();
        let robot = Robot::read(&text, None);
        check(&robot, 2, &mut rng, &format!("seed {seed}\n{text}"));
    }
}
