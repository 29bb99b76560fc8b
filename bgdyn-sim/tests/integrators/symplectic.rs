//! Tests the energy error of symplectic integrators on the double pendulum in canonical momenta.

use bgdyn_runtime::{Dd, vector};
use bgdyn_sim::{Gauss2, Gauss3, Integrator, Midpoint, Real, Rk4, Solver, Start};
use nalgebra::{SMatrix, SVector};

use crate::problems::{As, Equation, dd, distance, fixed, ode};

/// Two point masses of 1 kg on massless rods of 1 m, joint angles q from hanging straight down,
/// momenta p = M(q) v: the state is (q, p).
struct Pendulum;

const GRAVITY: f64 = 9.81;
/// Half the energy between hanging down and standing up: the unit of the bars, J.
const UNIT: f64 = 29.43;

/// Velocities, by the determinant of M = [[3 + 2c, 1 + c], [1 + c, 1]].
fn velocities<T: Real>(y: &SVector<T, 4>) -> (T, T, T) {
    let [one, two, three] = [1.0, 2.0, 3.0].map(T::from_f64);
    let (sin, cos) = y[1].sin_cos();
    let determinant = two - cos * cos;
    let beside = one + cos;
    let v1 = (y[2] - beside * y[3]) / determinant;
    let v2 = ((three + two * cos) * y[3] - beside * y[2]) / determinant;
    (v1, v2, sin)
}

impl<T: Real> Equation<T, 4> for Pendulum {
    fn rates(&self, _: T, y: &SVector<T, 4>) -> SVector<T, 4> {
        let [g, two] = [GRAVITY, 2.0].map(T::from_f64);
        let (v1, v2, sin) = velocities(y);
        let both = g * (y[0] + y[1]).sin_cos().0;
        let upper = -(two * g * y[0].sin_cos().0 + both);
        vector([v1, v2, upper, -both - sin * v1 * (v1 + v2)])
    }
}

/// The same pendulum in joint rates: the state is (q, v).
struct InRates;

/// (q, p) of (q, v).
fn momenta<T: Real>(y: &SVector<T, 4>) -> SVector<T, 4> {
    let [one, two, three] = [1.0, 2.0, 3.0].map(T::from_f64);
    let cos = y[1].sin_cos().1;
    let beside = one + cos;
    let first = (three + two * cos) * y[2] + beside * y[3];
    vector([y[0], y[1], first, beside * y[2] + y[3]])
}

impl<T: Real> Equation<T, 4> for InRates {
    /// v̇ = M⁻¹ (ṗ − Ṁ v)
    fn rates(&self, t: T, y: &SVector<T, 4>) -> SVector<T, 4> {
        let two = T::from_f64(2.0);
        let forces = Pendulum.rates(t, &momenta(y));
        let (v1, v2) = (y[2], y[3]);
        let turn = y[1].sin_cos().0 * v2;
        let left = vector([
            y[0],
            y[1],
            forces[2] + turn * (two * v1 + v2),
            forces[3] + turn * v1,
        ]);
        let (a1, a2, _) = velocities(&left);
        vector([v1, v2, a1, a2])
    }
}

/// ½ p·v + V
fn energy(y: &SVector<Dd, 4>) -> Dd {
    let (v1, v2, _) = velocities(y);
    let g = dd(GRAVITY);
    let kinetic = dd(0.5) * (y[2] * v1 + y[3] * v2);
    let cos = |angle: Dd| angle.sin_cos().1;
    kinetic - g * (dd(2.0) * cos(y[0]) + cos(y[0] + y[1]))
}

/// Returns the largest energy error, in [`UNIT`]s: in the first tenth of the run, and in its last.
fn drift<M: Integrator<SVector<f64, 4>>>(
    method: M,
    h: f64,
    steps: u32,
    compensated: bool,
) -> [f64; 3] {
    let mut solver = Solver::new(method, 0.0, vector([0.5, 0.0, 0.0, 0.0]));
    if compensated {
        solver = solver.compensated();
    }
    let in_two_words = |solver: &Solver<SVector<f64, 4>, M>| {
        let high = solver.y().map(dd);
        energy(&solver.low().map_or(high, |low| high + low.map(dd)))
    };
    let start = in_two_words(&solver);
    let mut tenths = [0.0_f64; 10];
    for i in 0..steps {
        solver
            .advance(&ode::<f64, _, 4>(&Pendulum), h)
            .expect("it swings on");
        let off = (in_two_words(&solver) - start).abs().to_f64() / UNIT;
        let tenth = &mut tenths[(10 * u64::from(i) / u64::from(steps)) as usize];
        *tenth = tenth.max(off);
    }
    let most = tenths.iter().fold(0.0_f64, |most, &x| most.max(x));
    [tenths[0], tenths[9], most]
}

/// The bars of 1e6 steps, with fewer steps: a growing error grows at least linearly. The example
/// `hard_cases` runs all of them, and 1e7, with compiled code.
#[test]
fn energy_keeps_within_its_bars() {
    let [_, _, rk4] = drift(Rk4, 1e-3, 20_000, false);
    assert!(rk4 < 5e-12 / 25.0, "{rk4:e}");
    let [first, last, midpoint] = drift(Midpoint::new(), 1e-2, 20_000, false);
    assert!(midpoint < 1e-6 && last < 1.5 * first, "{first:e} {last:e}");
    let [first, last, two] = drift(Gauss2::new(), 1e-2, 20_000, false);
    assert!(two < 1e-10 && last < 1.5 * first, "{first:e} {last:e}");
    let [_, _, three] = drift(Gauss3::new(), 1e-3, 10_000, false);
    assert!(three < 3e-14, "{three:e}");
    let [_, _, compensated] = drift(Gauss3::new(), 1e-3, 10_000, true);
    assert!(
        compensated < 1e-15 && compensated < three,
        "{compensated:e}"
    );
}

/// Velocities and momenta describe the same pendulum.
#[test]
fn both_forms_move_alike() {
    let start = vector([2.0, 0.5, 0.3, -0.7]);
    let rates = fixed(Gauss3::new(), &ode::<f64, _, 4>(&InRates), start, 1.0, 1000);
    let there = momenta(&start);
    let moved = fixed(
        Gauss3::new(),
        &ode::<f64, _, 4>(&Pendulum),
        there,
        1.0,
        1000,
    );
    let off = distance(&momenta(&rates), &moved);
    assert!(off < 1e-11, "{off:e}");
}

/// Returns ΨᵀJΨ − J of one step's derivative Ψ, from central differences in double-double.
fn defect<M: Integrator<SVector<Dd, 4>>>(method: &M) -> f64 {
    let pendulum: As<'_, _, Dd, 4> = ode(&Pendulum);
    let stepped = |y: SVector<Dd, 4>| {
        let start = Start {
            t: dd(0.0),
            y: &y,
            before: None,
        };
        match method.step(&pendulum, &start, dd(0.05)) {
            Ok(step) => y + step.change,
            Err(_) => panic!("the step succeeds"),
        }
    };
    let y = [0.9, -0.4, 1.5, 0.7].map(dd);
    let distance = dd(1e-10);
    let mut slope = SMatrix::<Dd, 4, 4>::repeat(dd(0.0));
    for c in 0..4 {
        let mut ends = [y, y];
        ends[0][c] += distance;
        ends[1][c] += -distance;
        let [ahead, behind] = ends.map(|y| stepped(vector(y)));
        for r in 0..4 {
            slope[(r, c)] = (ahead[r] - behind[r]) / (dd(2.0) * distance);
        }
    }
    let mut worst = 0.0_f64;
    for (a, b) in (0..4).flat_map(|a| (0..4).map(move |b| (a, b))) {
        let form = (0..2).fold(dd(0.0), |sum, i| {
            sum + slope[(i, a)] * slope[(i + 2, b)] - slope[(i + 2, a)] * slope[(i, b)]
        });
        let wanted = f64::from(i8::from(b == a + 2) - i8::from(a == b + 2));
        worst = worst.max((form - dd(wanted)).abs().to_f64());
    }
    worst
}

#[test]
fn gauss_steps_are_symplectic_and_runge_kuttas_are_not() {
    let gauss = [
        defect(&Midpoint::<Dd>::new()),
        defect(&Gauss2::<Dd>::new()),
        defect(&Gauss3::<Dd>::new()),
    ];
    for defect in gauss {
        assert!(defect < 1e-17, "{gauss:?}");
    }
    assert!(defect(&Rk4) > 1e-8);
}
