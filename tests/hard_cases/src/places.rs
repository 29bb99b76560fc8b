//! Bar 11: large angles, and a distant base.

use bgdyn_sim::{Ode, Rk4, Solver};
use nalgebra::DVector;

use crate::bars::{Digits, Found, Reference, Subject, norm, off, rounded};
use crate::literal::Literal;
use crate::outcome::{Outcome, Worst};
use crate::rng::Rng;
use crate::written::{cases, list};
use crate::{Extent, State};
use hard_cases_compiled::{Compiled, Model, model, spec};

/// Checks inverse dynamics at the angles of a case, to 16 eps.
fn turned<T: Digits + Compiled>(name: &str, reference: &Literal, s: &State) -> Found {
    let exact = reference.inverse(s);
    let found = Subject::<T>::inverse(&model::<T>(name), s);
    let measured = norm(&off(&found, &exact));
    let allowed = 16.0 * T::EPS * norm(&rounded(&exact));
    Found::new("11", "inverse dynamics", measured, allowed)
}

/// Angles to 1e12 rad, with skew and with parallel axes. The arguments are `f32` numbers too; in `f32` the
/// sine of a sum is accurate up to 8e6 rad.
pub(crate) fn large_angles(_: Extent) -> Vec<Outcome> {
    let mut outcomes = vec![];
    for (case, name) in [
        ("static_large_angles", "spatial_4"),
        ("large angles, parallel axes", "planar_4"),
    ] {
        let reference = Literal::new(spec(name));
        let mut worst = Worst::default();
        for case_of_file in cases(include_str!("../static_large_angles.json")) {
            let s = State {
                q: list(&case_of_file["q"]),
                v: list(&case_of_file["qd"]),
                a: list(&case_of_file["qdd"]),
                tau: vec![0.0; 4],
                parameters: vec![],
            };
            let scale = case_of_file["angle_scale"].as_f64().expect("a scale");
            let at = format!("{scale:e} rad");
            if name == "spatial_4" {
                let wanted = list(&case_of_file["tau"]);
                let measured = crate::bars::apart(&rounded(&reference.inverse(&s)), &wanted);
                let allowed = 2.0 * f64::EPSILON * norm(&wanted);
                let what = "inverse dynamics, against the file";
                let found = Found::new("ref", what, measured, allowed);
                worst.add(case, "", &at, vec![found]);
            }
            worst.add(case, "", &at, vec![turned::<f64>(name, &reference, &s)]);
            if scale <= 1e6 {
                worst.add(
                    case,
                    f32::MARK,
                    &at,
                    vec![turned::<f32>(name, &reference, &s)],
                );
            }
        }
        outcomes.extend(worst.finish());
    }
    outcomes
}

/// A mechanism without efforts, in positions and velocities.
struct Free<'a>(&'a dyn Model<f64>);

impl Ode for Free<'_> {
    type State = DVector<f64>;
    type Error = String;

    fn rates(&self, _: f64, y: &DVector<f64>) -> Result<DVector<f64>, String> {
        let (q, v) = y.as_slice().split_at(self.0.nv());
        let a = self.0.forward_dynamics(q, v, &vec![0.0; q.len()])?;
        Ok(DVector::from_vec([v, &a].concat()))
    }
}

/// Results that are not bit for bit those of the base at the origin.
struct Differ {
    inverse: usize,
    mass: usize,
    forward: usize,
    moved: usize,
}

fn differ<T: Digits + Compiled>(here: &str, there: &str, states: usize) -> Differ {
    let (one, other) = (model::<T>(here), model::<T>(there));
    let bits = |x: Vec<f64>| -> Vec<u64> { x.into_iter().map(f64::to_bits).collect() };
    let mut rng = Rng::new(29);
    let mut found = Differ {
        inverse: 0,
        mass: 0,
        forward: 0,
        moved: 0,
    };
    for _ in 0..states {
        let s = State::seeded(&mut rng, one.nv());
        let apart = |x: Vec<f64>, y: Vec<f64>| usize::from(bits(x) != bits(y));
        found.inverse += apart(one.inverse(&s), other.inverse(&s));
        found.mass += apart(one.mass(&s), other.mass(&s));
        let [x, y] = [&one, &other].map(|m| m.forward(&s).expect("regular"));
        found.forward += apart(x, y);
    }
    found
}

/// Returns the components of the state that differ after steps of 1 ms from a seeded state.
fn moved(here: &str, there: &str, steps: usize) -> usize {
    let end = |name: &str| {
        let free = model::<f64>(name);
        let s = State::seeded(&mut Rng::new(31), free.nv());
        let start = DVector::from_vec([&s.q[..], &s.v[..]].concat());
        let (free, mut solver) = (Free(&*free), Solver::new(Rk4, 0.0, start));
        for _ in 0..steps {
            solver.advance(&free, 1e-3).expect("regular");
        }
        solver.y().clone()
    };
    let (one, other) = (end(here), end(there));
    let pairs = one.iter().zip(other.iter());
    pairs.filter(|(x, y)| x.to_bits() != y.to_bits()).count()
}

/// The base up to 1e9 m away: the results are equal bit for bit, and so is the motion.
pub(crate) fn moved_base(extent: Extent) -> Vec<Outcome> {
    let (states, steps) = (extent.of(10_000, 200), extent.of(10_000, 1000));
    let mut outcomes = vec![];
    for arm in ["scara", "puma560"] {
        let here = format!("{arm}_at_0");
        let mut all = [("f64", [0; 4]), ("f32", [0; 4])];
        for place in 1..4 {
            let there = format!("{arm}_at_{place}");
            let mut add = |k: usize, d: Differ| {
                let of = &mut all[k].1;
                of[0] += d.inverse;
                of[1] += d.mass;
                of[2] += d.forward;
                of[3] += d.moved;
            };
            let double = Differ {
                moved: moved(&here, &there, steps),
                ..differ::<f64>(&here, &there, states)
            };
            add(0, double);
            add(1, differ::<f32>(&here, &there, states));
        }
        for (scalar, counts) in all {
            let what = [
                "inverse dynamics",
                "mass matrices",
                "forward dynamics",
                "components of a motion's end",
            ];
            for (what, count) in
                what.into_iter()
                    .zip(counts)
                    .take(if scalar == "f64" { 4 } else { 3 })
            {
                let quantity = format!("{what} that differ, {scalar}");
                let case = format!("{arm}, base to 1e9 m away");
                outcomes.push(Outcome::new(case, "11", quantity, count as f64, 0.0));
            }
        }
    }
    outcomes
}
