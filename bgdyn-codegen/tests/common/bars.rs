//! Error bars for generated functions, in one state of a mechanism, with the evaluator: errors of a scalar
//! against double-double at the same arguments, compared with their limits.

use std::f64::consts::FRAC_PI_2;
use std::marker::PhantomData;

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::mechanism::Motion;
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::rng::Rng;
use super::{Robot, State, full};

#[path = "../../../tests/hard_cases/src/bars.rs"]
mod measure;

#[allow(unused_imports)] // each test file uses a part
pub use measure::{
    Digits, Found, Hard, Reference, SINGULAR, Subject, apart, norm, off, part, rounded,
};

/// The generated methods of a mechanism.
pub struct Generated {
    pub inverse: Function,
    pub mass: Function,
    pub bias: Function,
    pub gravity: Function,
    pub forward: Function,
}

impl Generated {
    pub fn new(robot: &Robot) -> Self {
        Generated {
            inverse: robot.chosen(Method::InverseDynamics),
            mass: robot.chosen(Method::MassMatrix),
            bias: robot.chosen(Method::Bias),
            gravity: robot.chosen(Method::Gravity),
            forward: robot.chosen(Method::ForwardDynamics),
        }
    }
}

/// The same in a scalar under test.
pub struct In<'a, T>(&'a Generated, PhantomData<T>);

impl Generated {
    pub fn within<T>(&self) -> In<'_, T> {
        In(self, PhantomData)
    }
}

fn values<T: Digits>(f: &Function, s: &State) -> Vec<f64> {
    s.value::<T>(f).into_iter().map(T::to_f64).collect()
}

pub fn fine(f: &Function, s: &State) -> Vec<Dd> {
    s.value(f)
}

fn square<T: Copy>(triangle: &[T], n: usize) -> Vec<T> {
    full(triangle, n).into_iter().flatten().collect()
}

impl<T: Digits> Subject<T> for In<'_, T> {
    fn inverse(&self, s: &State) -> Vec<f64> {
        values::<T>(&self.0.inverse, s)
    }

    fn mass(&self, s: &State) -> Vec<f64> {
        square(&values::<T>(&self.0.mass, s), s.v.len())
    }

    fn forward(&self, s: &State) -> Option<Vec<f64>> {
        let (found, refused) = self.0.forward.evaluate(s.inputs::<T>());
        let regular = refused.is_none();
        regular.then(|| found.into_iter().map(T::to_f64).collect())
    }
}

impl Reference for Generated {
    fn inverse(&self, s: &State) -> Vec<Dd> {
        fine(&self.inverse, s)
    }

    fn mass(&self, s: &State) -> Vec<Dd> {
        square(&fine(&self.mass, s), s.v.len())
    }

    fn bias(&self, s: &State) -> Vec<Dd> {
        fine(&self.bias, s)
    }

    fn gravity(&self, s: &State) -> Vec<Dd> {
        fine(&self.gravity, s)
    }

    fn forward_off(&self, s: &State, argument: usize, component: usize, factor: Dd) -> Vec<Dd> {
        let mut inputs: Inputs<Dd> = s.inputs();
        let argument = match argument {
            0 => &mut inputs.q,
            1 => &mut inputs.v,
            _ => &mut inputs.u,
        };
        argument[component] *= factor;
        let (found, refused) = self.forward.evaluate(inputs);
        assert_eq!(refused, None, "a pivot is refused in double-double");
        found
    }
}

/// Checks bars 1 to 5 of generated functions.
pub fn all<T: Digits>(what: &str, generated: &Generated, state: &State, cond: Option<f64>) {
    let hard = Hard::new::<T>(generated, state, cond);
    for found in hard.all::<T>(&generated.within::<T>(), generated, SINGULAR) {
        let Found {
            bar,
            what: of,
            measured,
            allowed,
            ..
        } = found;
        assert!(
            measured <= allowed,
            "{what}, bar {bar}, {of}: {measured:e}, allowed {allowed:e}"
        );
    }
}

/// Returns a random state, with efforts of some twenty units or those of its own accelerations; in half of
/// them every joint is almost a quarter turn from zero or from another position.
pub fn near_aligned(rng: &mut Rng, robot: &Robot) -> State {
    let motions = robot.motions();
    let mut state = State::random(rng, &motions);
    state.parameters = (robot.mechanism.parameters().iter())
        .map(|p| p.default.to_f64())
        .collect();
    if rng.chance(0.5) {
        let off = *rng.pick(&[0.0, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2]);
        for (q, motion) in state.q.iter_mut().zip(&motions) {
            if *motion == Motion::Rotation && rng.chance(0.8) {
                *q = f64::from(rng.below(4) as u32) * FRAC_PI_2 + off;
            }
        }
    }
    state
}

/// Returns the state with the efforts of its accelerations.
pub fn driven(state: &State, generated: &Generated) -> State {
    let efforts: Vec<Dd> = state.value(&generated.inverse);
    State {
        tau: efforts.iter().map(|x| x.to_f64()).collect(),
        ..state.clone()
    }
}
