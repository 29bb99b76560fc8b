//! Compares two mechanisms that move alike, in different coordinates.

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::robot::{Robot, State, Way, close, full, largest, times};

pub(super) const WAYS: [Way; 2] = [None, Some("literal")];
pub(super) const EXACT: f64 = 1e-26;

/// A state of one mechanism in the coordinates of another: its q, v' = G v, a' = G a + γ.
pub struct Mapped {
    pub q: Vec<Dd>,
    pub g: Vec<Vec<Dd>>,
    pub gamma: Vec<Dd>,
}

pub(super) fn transposed(m: &[Vec<Dd>], columns: usize) -> Vec<Vec<Dd>> {
    (0..columns)
        .map(|j| m.iter().map(|row| row[j]).collect())
        .collect()
}

/// A · B
pub(super) fn product(a: &[Vec<Dd>], b: &[Vec<Dd>]) -> Vec<Vec<Dd>> {
    let columns = transposed(b, b.first().map_or(0, Vec::len));
    a.iter().map(|row| times(&columns, row)).collect()
}

pub(super) fn plus(x: &[Dd], y: &[Dd]) -> Vec<Dd> {
    x.iter().zip(y).map(|(&x, &y)| x + y).collect()
}

pub(super) fn rows(flat: &[Dd], n: usize) -> Vec<Vec<Dd>> {
    flat.chunks(n).map(<[Dd]>::to_vec).collect()
}

/// Asserts that `one` is `other` in the coordinates that `map` relates; `places` have the same names.
/// `constant`: G does not depend on q.
pub fn same(
    (one, other): (&Robot, &Robot),
    map: impl Fn(&State<Dd>) -> Mapped,
    constant: bool,
    places: &[&str],
    name: &str,
) {
    for way in WAYS {
        for seed in [21, 22] {
            let what = |part: &str| format!("{name}, {way:?}, seed {seed}: {part}");
            let s = one.state(seed);
            let (n, m) = (one.nv(), other.nv());
            let Mapped { q, g, gamma } = map(&s);
            let back = transposed(&g, n);
            let t = State {
                q,
                v: times(&g, &s.v),
                a: plus(&times(&g, &s.a), &gamma),
                u: vec![Dd::ZERO; m],
            };
            let own = |method| s.value(&one.function(way, method));
            let theirs = |method| t.value(&other.function(way, method));
            let mass = product(&back, &product(&full(&theirs(Method::MassMatrix), m), &g)).concat();
            close(
                &full(&own(Method::MassMatrix), n).concat(),
                &mass,
                EXACT,
                0.0,
                &what("M"),
            );
            let expected = times(&back, &theirs(Method::InverseDynamics));
            let efforts = own(Method::InverseDynamics);
            close(&efforts, &expected, EXACT, 0.0, &what("τ"));
            let size = largest(&efforts);
            let expected = times(&back, &theirs(Method::Gravity));
            close(
                &own(Method::Gravity),
                &expected,
                EXACT,
                size,
                &what("gravity"),
            );
            for method in [Method::KineticEnergy, Method::PotentialEnergy] {
                close(&own(method), &theirs(method), EXACT, 1.0, &what("energy"));
            }
            let unmoved = State {
                a: gamma.clone(),
                ..t.clone()
            };
            let bias = unmoved.value(&other.function(way, Method::InverseDynamics));
            close(
                &own(Method::Bias),
                &times(&back, &bias),
                EXACT,
                size,
                &what("bias"),
            );
            // Accelerations: those of `one` solve the equations of `other`.
            let accelerations = own(Method::ForwardDynamics);
            let moved = State {
                a: plus(&times(&g, &accelerations), &gamma),
                ..t.clone()
            };
            let driven = moved.value(&other.function(way, Method::InverseDynamics));
            close(
                &times(&back, &driven),
                &s.u,
                1e-20,
                largest(&bias),
                &what("q̈"),
            );
            if constant {
                let own = own(Method::InverseDynamicsDerivatives);
                let theirs = theirs(Method::InverseDynamicsDerivatives);
                for (part, k) in [("∂τ/∂q", 0), ("∂τ/∂v", 1)] {
                    let theirs = rows(&theirs[k * m * m..(k + 1) * m * m], m);
                    let expected = product(&back, &product(&theirs, &g)).concat();
                    let found = &own[k * n * n..(k + 1) * n * n];
                    close(found, &expected, EXACT, size, &what(part));
                }
            }
            for place in places {
                let of = |robot: &Robot, s: &State<Dd>| {
                    Method::of_site(robot.site(place)).map(|m| s.value(&robot.function(way, m)))
                };
                let [pose, velocity, jacobian, rate] = of(one, &s);
                let [their_pose, their_velocity, their_jacobian, their_rate] = of(other, &t);
                let size = 1.0 + largest(&their_velocity) + largest(&their_rate);
                close(&pose, &their_pose, EXACT, size, &what(place));
                close(&velocity, &their_velocity, EXACT, size, &what(place));
                let their_jacobian = rows(&their_jacobian, m);
                let expected = product(&their_jacobian, &g).concat();
                close(&jacobian, &expected, EXACT, size, &what(place));
                let expected = plus(&their_rate, &times(&their_jacobian, &gamma));
                close(&rate, &expected, EXACT, size, &what(place));
            }
        }
    }
}

/// The map of two mechanisms with the same names of positions and velocities.
pub(super) fn by_names(one: &Robot, other: &Robot) -> impl Fn(&State<Dd>) -> Mapped + use<> {
    let places = |own: Vec<String>, theirs: Vec<String>| -> Vec<usize> {
        assert_eq!(own.len(), theirs.len(), "{own:?} against {theirs:?}");
        let place = |name: &String| own.iter().position(|n| n == name);
        let found = theirs
            .iter()
            .map(|name| place(name).unwrap_or_else(|| panic!("{name}?")));
        found.collect()
    };
    let (a, b) = (&one.mechanism, &other.mechanism);
    let positions = places(a.position_names(), b.position_names());
    let velocities = places(a.joint_names(), b.joint_names());
    move |s| {
        let n = velocities.len();
        let unit = |j: usize| {
            (0..n)
                .map(|k| if k == j { Dd::ONE } else { Dd::ZERO })
                .collect()
        };
        Mapped {
            q: positions.iter().map(|&p| s.q[p]).collect(),
            g: velocities.iter().map(|&j| unit(j)).collect(),
            gamma: vec![Dd::ZERO; n],
        }
    }
}

pub(super) type Tree = [(String, Option<String>)];
