//! Evaluates Kuzmin's (2)–(6) literally with hyper-dual numbers in fixed axes, against the generated
//! functions; and checks the bond graph's structure against the same numbers.
//!
//! Nothing here uses the generator's equations: A_i(q) and r_i(q) come from the checked mechanism,
//! everything else is their derivatives.

use crate::common::kinematics::{
    M3, Place, V3, add, apply, cross, dot, gravity, inertial, m3, places, scaled, times,
    transposed, v3,
};
use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{
    FORMULATIONS, Robot, State, assert_close, golden, largest, natural_effort, natural_inertia,
};
use bgdyn_codegen::bond_graph::{Junction, Modulus, StoreInertia};
use bgdyn_codegen::mechanism::{CoordinateId, LinkId, Motion};
use bgdyn_codegen::method::Method;
use num_dual::HyperDual;

/// Derivatives of A_i and r_i, for every link.
type Change = Vec<(M3<f64>, V3<f64>)>;

/// First and second derivatives of A_i and r_i at one q.
struct Derivatives {
    at: Vec<Place<f64>>,
    /// [k][i]: ∂/∂q_k
    first: Vec<Change>,
    /// [k][l][i]: ∂²/∂q_k∂q_l
    second: Vec<Vec<Change>>,
}

impl Derivatives {
    fn new(robot: &Robot, q: &[f64]) -> Self {
        let n = q.len();
        let seeded = |k: usize, l: usize| {
            let q: Vec<HyperDual<f64>> = (0..n)
                .map(|j| {
                    let on = |yes: bool| f64::from(u8::from(yes));
                    HyperDual::new(q[j], on(j == k), on(j == l), 0.0)
                })
                .collect();
            places(&robot.mechanism, &q)
        };
        let both: Vec<Vec<Vec<Place<HyperDual<f64>>>>> = (0..n)
            .map(|k| (0..n).map(|l| seeded(k, l)).collect())
            .collect();
        let part = |p: &Place<HyperDual<f64>>, f: fn(HyperDual<f64>) -> f64| {
            (m3(|i, j| f(p.rotation[i][j])), v3(|i| f(p.centre[i])))
        };
        let first = |k: usize| both[k][0].iter().map(|p| part(p, |x| x.eps1)).collect();
        let second = |k: usize, l: usize| {
            let places = &both[k][l];
            places.iter().map(|p| part(p, |x| x.eps1eps2)).collect()
        };
        Derivatives {
            at: places(&robot.mechanism, q),
            first: (0..n).map(first).collect(),
            second: (0..n)
                .map(|k| (0..n).map(|l| second(k, l)).collect())
                .collect(),
        }
    }

    /// (2)–(4): ρ_k^i = [α β γ]ᵀ.
    fn rho(&self, k: usize, i: usize) -> V3<f64> {
        transformer(self.first[k][i].0, self.at[i].rotation)
    }

    /// ∂ρ_k^i/∂q_l, by the product rule on (2)–(4).
    fn rho_rate(&self, k: usize, l: usize, i: usize) -> V3<f64> {
        let bent = transformer(self.second[k][l][i].0, self.at[i].rotation);
        add(bent, transformer(self.first[k][i].0, self.first[l][i].0))
    }
}

/// α = Σ_μ d_3μ a_2μ, β = −Σ_μ d_3μ a_1μ, γ = Σ_μ d_2μ a_1μ
fn transformer(d: M3<f64>, a: M3<f64>) -> V3<f64> {
    [dot(d[2], a[1]), -dot(d[2], a[0]), dot(d[1], a[0])]
}

/// P_j of (6).
fn efforts(robot: &Robot, s: &State, d: &Derivatives) -> Vec<f64> {
    let n = robot.nv();
    let g = gravity(&robot.mechanism);
    let mut efforts = vec![0.0; n];
    for i in 0..d.at.len() {
        let (mass, tensor) = inertial(&robot.mechanism, i);
        let a = d.at[i].rotation;
        // J_i = A_i J_i⁰ A_iᵀ
        let tensor = times(times(a, tensor), transposed(a));
        let (mut omega, mut omega_dot, mut accel) = ([0.0; 3], [0.0; 3], [0.0; 3]);
        for k in 0..n {
            omega = add(omega, scaled(d.rho(k, i), s.v[k]));
            omega_dot = add(omega_dot, scaled(d.rho(k, i), s.a[k]));
            accel = add(accel, scaled(d.first[k][i].1, s.a[k]));
            for l in 0..n {
                let rates = s.v[k] * s.v[l];
                omega_dot = add(omega_dot, scaled(d.rho_rate(k, l, i), rates));
                accel = add(accel, scaled(d.second[k][l][i].1, rates));
            }
        }
        // K̇_i = J_i ω̇_i + ω_i × (J_i ω_i); R_i = m_i g, M_i = 0
        let turning = cross(omega, apply(tensor, omega));
        let moment = add(apply(tensor, omega_dot), turning);
        let force = v3(|c| mass * (accel[c] - g[c]));
        for j in 0..n {
            efforts[j] += dot(d.first[j][i].1, force) + dot(d.rho(j, i), moment);
        }
    }
    efforts
}

/// M_jk = Σ_i [ ∂r_i/∂q_j · m_i ∂r_i/∂q_k + ρ_j · J_i ρ_k ], its lower triangle.
fn mass_matrix(robot: &Robot, d: &Derivatives) -> Vec<f64> {
    let mut mass = Vec::new();
    for j in 0..robot.nv() {
        for k in 0..=j {
            let entry = (0..d.at.len()).map(|i| {
                let (m, tensor) = inertial(&robot.mechanism, i);
                let back = transposed(d.at[i].rotation);
                let (x, y) = (apply(back, d.rho(j, i)), apply(back, d.rho(k, i)));
                m * dot(d.first[j][i].1, d.first[k][i].1) + dot(x, apply(tensor, y))
            });
            mass.push(entry.sum());
        }
    }
    mass
}

/// Whether coordinate j moves link i.
fn on_path(robot: &Robot, j: usize, i: usize) -> bool {
    let links = robot.mechanism.links();
    let mut link = Some(LinkId(i));
    while let Some(LinkId(l)) = link {
        if links[l].joint.coordinate == Some(CoordinateId(j)) {
            return true;
        }
        link = links[l].parent;
    }
    false
}

/// Checks that the bond graph has the elements of the paper, and that its zeros and constants are correct.
fn check_structure(robot: &Robot, d: &Derivatives, what: &str) {
    let (graph, n, links) = (robot.graph, robot.nv(), robot.mechanism.links().len());
    for j in 0..n {
        let mine = |x: &&Junction| **x == Junction::Velocity(CoordinateId(j));
        assert_eq!(graph.junctions.iter().filter(mine).count(), 1, "{what}");
    }
    assert_eq!(graph.junctions.len(), n + 2 * links, "{what}");
    assert_eq!(
        (graph.stores.len(), graph.sources.len()),
        (2 * links, 2 * links)
    );
    for i in 0..links {
        let (to_r, to_omega) = (graph.translation(LinkId(i)), graph.rotation(LinkId(i)));
        assert_eq!(graph.junctions[to_r.0], Junction::Translation(LinkId(i)));
        assert_eq!(graph.junctions[to_omega.0], Junction::Rotation(LinkId(i)));
        let store = |at| graph.stores.iter().filter(move |s| s.junction == at);
        assert!(store(to_r).all(|s| matches!(s.inertia, StoreInertia::Mass(_))));
        assert!(store(to_omega).all(|s| matches!(s.inertia, StoreInertia::Tensor(_))));
        for at in [to_r, to_omega] {
            assert_eq!(store(at).count(), 1, "{what}");
            let sources = graph.sources.iter().filter(|s| s.junction == at);
            assert_eq!(sources.count(), 1, "{what}");
        }
        for j in 0..n {
            for (to, number) in [(to_r, d.first[j][i].1), (to_omega, d.rho(j, i))] {
                let velocity = graph.velocity(CoordinateId(j));
                let found: Vec<_> = graph.into(to).filter(|t| t.from == velocity).collect();
                assert!(
                    found.len() <= 1,
                    "{what}: two transformers from {j} to {to:?}"
                );
                let modulus = found.first().map_or([Modulus::Zero; 3], |t| t.modulus.0);
                assert!(
                    found.is_empty() || modulus.iter().any(|m| !m.is_zero()),
                    "{what}: a transformer of nothing"
                );
                for (c, m) in modulus.into_iter().enumerate() {
                    let expected = match m {
                        Modulus::Zero => 0.0,
                        Modulus::Constant(x) => x.to_f64(),
                        Modulus::Varying(_) => continue,
                    };
                    assert!(
                        (number[c] - expected).abs() < 1e-12,
                        "{what}: {m:?} from {j} to {to:?}, component {c}, is {}",
                        number[c]
                    );
                }
                assert!(
                    found.is_empty() || on_path(robot, j, i),
                    "{what}: {j} to {to:?}"
                );
            }
            // ρ is the axis of a rotation on the path, and nothing else.
            let link = robot.mechanism.coordinates()[j].0;
            let turns = robot.motions()[j] == Motion::Rotation && on_path(robot, j, i);
            let axis = if turns { d.at[link].axis } else { [0.0; 3] };
            assert_close(&d.rho(j, i), &axis, 1e-13, || {
                format!("{what}: ρ of {j}, {i}")
            });
        }
    }
}

/// The worst relative error seen.
fn check(robot: &Robot, states: usize, rng: &mut Rng, what: &str) -> f64 {
    let functions = FORMULATIONS.map(|f| {
        (
            robot.function(f, Method::InverseDynamics),
            robot.function(f, Method::MassMatrix),
        )
    });
    let motions = robot.motions();
    let mut worst = 0.0_f64;
    for k in 0..states {
        let s = State::random(rng, &motions);
        let d = Derivatives::new(robot, &s.q);
        check_structure(robot, &d, what);
        let (inverse, mass) = (efforts(robot, &s, &d), mass_matrix(robot, &d));
        for (f, m) in &functions {
            let own = s.value::<f64>(f);
            // Relative to the largest effort; no less than the rounding of the largest terms.
            let size = largest(&inverse);
            let tolerance = 1e-11 * size + 1e-15 * natural_effort(robot, &s);
            assert_close(&own, &inverse, tolerance, || {
                format!(
                    "{what}, {}, state {k}: inverse dynamics\n{s:?}",
                    f.formulation
                )
            });
            for (x, y) in own.iter().zip(&inverse) {
                worst = worst.max((x - y).abs() / size.max(f64::MIN_POSITIVE));
            }
            let tolerance = 1e-11 * largest(&mass) + 1e-15 * natural_inertia(robot, &s).1;
            assert_close(&s.value::<f64>(m), &mass, tolerance, || {
                format!("{what}, {}, state {k}: mass matrix\n{s:?}", m.formulation)
            });
        }
    }
    worst
}

#[test]
fn golden_robots() {
    let mut rng = Rng::new(2007);
    let robots = golden::robots_up_to(7);
    assert!(robots.len() >= 12);
    for (name, robot) in robots {
        let worst = check(&robot, 4, &mut rng, &name);
        println!("{name:14} worst relative error {worst:.1e}");
    }
}

#[test]
fn random_trees() {
    let mut worst = 0.0_f64;
    for seed in 0..60 {
        let mut rng = Rng::new(seed);
        let text = Draft::random(&mut rng, 5).yaml();
        let robot = Robot::read(&text, None);
        worst = worst.max(check(&robot, 2, &mut rng, &format!("seed {seed}\n{text}")));
    }
    println!("worst relative error {worst:.1e}");
}
