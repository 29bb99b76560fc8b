//! Laws of mechanics in double-double, for the formulation chosen and for the literal sum.

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::robot::{Robot, State, Way, close, dot, full, largest, times};
use super::specs;

const WAYS: [Way; 2] = [None, Some("literal")];
/// Step of central differences: their error is of the size of its square and of 1e-32 over it.
const STEP: f64 = 1e-11;
/// Relative error of equal values; of differences; of solutions.
const EXACT: f64 = 1e-27;
const BY_DIFFERENCES: f64 = 1e-17;
const SOLVED: f64 = 1e-22;

fn minus(x: &[Dd], y: &[Dd]) -> Vec<Dd> {
    x.iter().zip(y).map(|(&x, &y)| x - y).collect()
}

fn zeros(n: usize) -> Vec<Dd> {
    vec![Dd::ZERO; n]
}

/// The central difference of a function of a state that moves with q̇ = N(q) v and v̇ = a.
fn rate(
    robot: &Robot,
    s: &State<Dd>,
    along: (&[Dd], &[Dd]),
    f: impl Fn(&State<Dd>) -> Vec<Dd>,
) -> Vec<Dd> {
    let at = |h: f64| {
        let h = Dd::from_f64(h);
        let v = s.v.iter().zip(along.1).map(|(&v, &a)| v + h * a);
        f(&State {
            q: robot.moved(&s.q, along.0, h),
            v: v.collect(),
            ..s.clone()
        })
    };
    let half = Dd::from_f64(0.5) / Dd::from_f64(STEP);
    let difference = minus(&at(STEP), &at(-STEP));
    difference.into_iter().map(|d| d * half).collect()
}

/// Every law at every state of every mechanism; `law` gets what to say of a failure.
fn everywhere(law: impl Fn(&Robot, Way, &State<Dd>, &str)) {
    for (name, robot) in specs::robots() {
        for way in WAYS {
            for seed in [1, 2] {
                let what = format!("{name}, {way:?}, seed {seed}");
                law(&robot, way, &robot.state(seed), &what);
            }
        }
    }
}

/// M, its columns by inverse dynamics, is symmetric and positive.
#[test]
fn the_mass_matrix_is_symmetric_and_positive() {
    everywhere(|robot, way, s, what| {
        let n = robot.nv();
        let inverse = robot.function(way, Method::InverseDynamics);
        let mass = full(&s.value(&robot.function(way, Method::MassMatrix)), n);
        let efforts = |a: Vec<Dd>| {
            let v = zeros(n);
            State { v, a, ..s.clone() }.value(&inverse)
        };
        let at_rest = efforts(zeros(n));
        let size = largest(&mass.concat());
        let mut columns = Vec::new();
        for j in 0..n {
            let mut unit = zeros(n);
            unit[j] = Dd::ONE;
            columns.push(minus(&efforts(unit), &at_rest));
            close(&columns[j], &mass[j], EXACT, size + largest(&at_rest), what);
        }
        for (i, j) in (0..n).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let off = (columns[i][j] - columns[j][i]).to_f64().abs();
            assert!(
                off <= EXACT * (size + largest(&at_rest)),
                "{what}: {i}, {j}: {off:e}"
            );
        }
        // Cholesky: every pivot positive.
        let mut rest = mass.clone();
        for k in 0..n {
            let pivot = rest[k][k];
            assert!(
                pivot.to_f64() > 1e-9 * mass[k][k].to_f64(),
                "{what}: pivot {k}: {pivot:?}"
            );
            let row = rest[k].clone();
            for i in k + 1..n {
                let factor = row[i] / pivot;
                for j in k + 1..n {
                    rest[i][j] -= factor * row[j];
                }
            }
        }
        let kinetic = s.value(&robot.function(way, Method::KineticEnergy));
        let half = dot(&times(&mass, &s.v), &s.v) * Dd::from_f64(0.5);
        close(&kinetic, &[half], EXACT, size, &format!("{what}: T"));
    });
}

#[test]
fn the_efforts_are_those_of_their_parts() {
    everywhere(|robot, way, s, what| {
        let n = robot.nv();
        let value = |method: Method, s: &State<Dd>| s.value(&robot.function(way, method));
        let inverse = robot.function(way, Method::InverseDynamics);
        let no_a = State {
            a: zeros(n),
            ..s.clone()
        };
        let bias = no_a.value(&inverse);
        close(
            &value(Method::Bias, s),
            &bias,
            EXACT,
            0.0,
            &format!("{what}: bias"),
        );
        let still = State {
            v: zeros(n),
            ..no_a
        };
        let gravity = still.value(&inverse);
        close(
            &value(Method::Gravity, s),
            &gravity,
            EXACT,
            1.0,
            &format!("{what}: gravity"),
        );
        // Forward dynamics, substituted.
        let a = value(Method::ForwardDynamics, s);
        let driven = State { a, ..s.clone() }.value(&inverse);
        close(&driven, &s.u, SOLVED, largest(&bias), &format!("{what}: q̈"));
    });
}

/// bias = C v + gravity, Ṁ = C + Cᵀ along q̇ = N(q) v: Ṁ − 2C is skew.
#[test]
fn the_mass_matrix_minus_two_coriolis_is_skew() {
    everywhere(|robot, way, s, what| {
        let n = robot.nv();
        let value = |method: Method| s.value(&robot.function(way, method));
        let matrix = value(Method::CoriolisMatrix);
        let rows: Vec<Vec<Dd>> = matrix.chunks(n).map(<[Dd]>::to_vec).collect();
        let bias = value(Method::Bias);
        let velocity_part = minus(&bias, &value(Method::Gravity));
        let size = largest(&bias);
        close(
            &times(&rows, &s.v),
            &velocity_part,
            EXACT,
            size,
            &format!("{what}: C v"),
        );
        let mass = robot.function(way, Method::MassMatrix);
        let rates = rate(robot, s, (&s.v, &zeros(n)), |s| s.value(&mass));
        let rates = full(&rates, n).concat();
        let both: Vec<Dd> = (0..n * n)
            .map(|k| matrix[k] + matrix[k % n * n + k / n])
            .collect();
        let size = largest(&s.value(&mass));
        close(&both, &rates, BY_DIFFERENCES, size, &format!("{what}: Ṁ"));
    });
}

/// gravity_k is the rate of V along unit velocity k.
#[test]
fn gravity_is_the_slope_of_the_potential_energy() {
    everywhere(|robot, way, s, what| {
        let n = robot.nv();
        let energy = robot.function(way, Method::PotentialEnergy);
        let gravity = s.value(&robot.function(way, Method::Gravity));
        let slope = |k: usize| {
            let mut unit = zeros(n);
            unit[k] = Dd::ONE;
            rate(robot, s, (&unit, &zeros(n)), |s| s.value(&energy))[0]
        };
        let slopes: Vec<Dd> = (0..n).map(slope).collect();
        let size = largest(&s.value(&energy));
        close(&slopes, &gravity, BY_DIFFERENCES, size, what);
    });
}

/// The power of the efforts is the rate of both energies, with a = dv/dt component by component.
#[test]
fn the_efforts_supply_the_rate_of_the_energy() {
    everywhere(|robot, way, s, what| {
        let kinetic = robot.function(way, Method::KineticEnergy);
        let potential = robot.function(way, Method::PotentialEnergy);
        let total = |s: &State<Dd>| vec![s.value(&kinetic)[0] + s.value(&potential)[0]];
        let rates = rate(robot, s, (&s.v, &s.a), total);
        let efforts = s.value(&robot.function(way, Method::InverseDynamics));
        let power = dot(&efforts, &s.v);
        let size = largest(&efforts) + largest(&total(s));
        close(&rates, &[power], BY_DIFFERENCES, size, what);
    });
}

/// Position rates of the generator are those written by hand.
#[test]
fn position_rates_are_those_of_the_definitions() {
    for (name, robot) in specs::robots() {
        for seed in 1..5 {
            let s = robot.state(seed);
            let found = robot.graph.position_rates(&s.q, &s.v);
            close(&found, &robot.rates(&s.q, &s.v), 1e-30, 0.0, name);
        }
    }
}

/// Derivatives along the tangent against differences of the function itself.
#[test]
fn derivatives_are_along_the_tangent() {
    for (name, robot) in specs::robots() {
        let n = robot.nv();
        let s = robot.state(3);
        let inverse = robot.function(None, Method::InverseDynamics);
        let forward = robot.function(None, Method::ForwardDynamics);
        let of_inverse = s.value(&robot.function(None, Method::InverseDynamicsDerivatives));
        let of_forward = s.value(&robot.function(None, Method::ForwardDynamicsDerivatives));
        let value = s.value(&forward);
        close(&of_forward[..n], &value, SOLVED, 0.0, &format!("{name}: q̈"));
        let column = |all: &[Dd], k: usize| -> Vec<Dd> { (0..n).map(|i| all[i * n + k]).collect() };
        for k in 0..n {
            let mut unit = zeros(n);
            unit[k] = Dd::ONE;
            let none = zeros(n);
            for (part, (f, all), relative) in [
                ("τ", (&inverse, &of_inverse[..]), 1e-16),
                ("q̈", (&forward, &of_forward[n..]), 1e-13),
            ] {
                let by_q = rate(&robot, &s, (&unit, &none), |s| s.value(f));
                let by_v = rate(&robot, &s, (&none, &unit), |s| s.value(f));
                let size = largest(&s.value(f));
                let what = format!("{name}: ∂{part}/∂q, column {k}");
                close(&column(&all[..n * n], k), &by_q, relative, size, &what);
                let what = format!("{name}: ∂{part}/∂v, column {k}");
                close(&column(&all[n * n..], k), &by_v, relative, size, &what);
            }
        }
    }
}
