//! Compares the oracle with generated functions: derivative, energy, power, Jacobian.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::formulation::by_name;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::verify::{check_scene, explain};
use bgdyn_runtime::Dd;

use super::draft::Written;
use super::readings::Readings;
use super::rng::Rng;
use super::scene::Scene;
use super::state::{Named, State};
use super::vector::dd;

/// Formulations selected by name, besides those that the generator chooses from.
const WAYS: [&str; 4] = [
    "recursion",
    "recursion_own",
    "articulated",
    "articulated_base",
];
/// Number of states per scene.
const STATES: usize = 3;
/// Tolerance of derivatives and energies in double-double, relative to the largest of them. A pressure is
/// β ln(W/V): flows between almost equal ones lose ten digits and more.
pub const EXACT: f64 = 1e-20;
/// Tolerance of the Jacobian against differences of the oracle's derivative, in the same unit.
const SLOPE: f64 = 1e-11;
/// Step of those differences.
const STEP: f64 = 1e-10;

/// A scene in two forms: that of the oracle, and that of the generator.
pub struct Pair {
    pub written: Written,
    pub oracle: Scene,
    pub system: SceneEquations,
    derivatives: Vec<Function>,
    pub energy: Function,
    pub power: Function,
    pub readings: Readings,
    /// All alternatives for the Jacobian.
    jacobians: Vec<Function>,
}

/// The extent of the comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Depth {
    /// The derivative as emitted and by one more formulation, other functions before factoring; the
    /// Jacobian of some scenes.
    Part(u64),
    /// Everything, as emitted.
    Whole,
}

/// The largest differences, relative to their scale.
#[derive(Clone, Copy, Debug, Default)]
pub struct Worst {
    pub derivative: f64,
    pub energy: f64,
    pub power: f64,
    pub slope: f64,
    pub readings: f64,
    /// Contacts that overlap, and that do not.
    pub touching: [usize; 2],
}

impl Pair {
    pub fn new(written: Written, system: SceneEquations, depth: Depth) -> Self {
        let made = |role: SceneFunction| match depth {
            Depth::Whole => vec![system.function(role)],
            Depth::Part(_) => system.ways(role),
        };
        let by = |name: &&str| system.derivative_by(by_name(name)?);
        let mut derivatives = vec![system.function(SceneFunction::Derivative)];
        derivatives.extend(system.ways(SceneFunction::Derivative));
        let jacobians = match depth {
            Depth::Part(seed) => {
                derivatives.extend(by(&WAYS[seed as usize % WAYS.len()]));
                let wanted = seed % 3 == 0;
                if wanted {
                    made(SceneFunction::Jacobian)
                } else {
                    vec![]
                }
            }
            Depth::Whole => {
                derivatives.extend(WAYS.iter().filter_map(by));
                made(SceneFunction::Jacobian)
            }
        };
        let one = |role| made(role).swap_remove(0);
        Pair {
            oracle: Scene::read(&written.scene, &written.mechanism),
            derivatives,
            energy: one(SceneFunction::Energy),
            power: one(SceneFunction::Power),
            readings: Readings::new(&system, made),
            jacobians,
            written,
            system,
        }
    }

    /// Returns the message of the generator's own check of the functions.
    pub fn refused(&self) -> Option<String> {
        let made = self.derivatives[..1].iter().chain(&self.jacobians);
        let functions: Vec<Function> = made.cloned().collect();
        let differences = check_scene(&self.system, &functions);
        (!differences.is_empty()).then(|| explain(&differences))
    }

    /// Compares everything in random states; the first difference, with the scene, is the error.
    pub fn compare(&self, rng: &mut Rng, worst: &mut Worst) -> Result<(), String> {
        for _ in 0..STATES {
            let state = self.state(rng);
            let along = self.direction(rng);
            let compared = self
                .derivative(&state, worst)
                .and_then(|()| self.energy(&state, worst))
                .and_then(|()| self.touches(&state, worst))
                .and_then(|()| self.slope(&state, &along, worst));
            compared.map_err(|what| {
                let Written {
                    mechanism, scene, ..
                } = &self.written;
                format!("{what}\n--- mechanism\n{mechanism}--- scene\n{scene}--- state\n{state}")
            })?;
        }
        Ok(())
    }

    fn inputs(&self, state: &State) -> Inputs<Dd> {
        let layout = &self.system.scene.layout;
        let stored = layout.coordinates.iter().filter(|c| c.position.is_some());
        Inputs {
            q: stored.map(|c| state.q[&c.name]).collect(),
            v: layout
                .coordinates
                .iter()
                .map(|c| state.v[&c.name])
                .collect(),
            a: vec![Dd::ZERO; layout.coordinates.len()],
            x: layout.states.iter().map(|p| state.x[&p.name]).collect(),
            u: layout.inputs.iter().map(|p| state.u[&p.name]).collect(),
            modes: layout.modes.iter().map(|p| state.modes[&p.name]).collect(),
            parameters: self
                .system
                .scene
                .parameters
                .iter()
                .map(|p| p.default)
                .collect(),
            t: Some(dd(0.3)),
            passed: vec![],
        }
    }

    /// The oracle's rates, in the generator's order.
    fn wanted(&self, state: &State) -> Vec<Dd> {
        let layout = &self.system.scene.layout;
        let answer = self.oracle.answer(state);
        let coordinates = layout
            .coordinates
            .iter()
            .map(|c| answer.accelerations[&c.name]);
        let states = layout.states.iter().map(|p| answer.rates[&p.name]);
        coordinates.chain(states).collect()
    }

    fn names(&self) -> Vec<&str> {
        let layout = &self.system.scene.layout;
        let coordinates = layout.coordinates.iter().map(|c| c.rate_name.as_str());
        coordinates
            .chain(layout.states.iter().map(|p| p.name.as_str()))
            .collect()
    }

    pub fn value(&self, function: &Function, state: &State) -> Result<Vec<Dd>, String> {
        let (found, refused) = function.evaluate(self.inputs(state));
        match refused {
            None => Ok(found),
            Some(j) => Err(format!("{}: pivot {j} is refused", function.formulation)),
        }
    }

    fn derivative(&self, state: &State, worst: &mut Worst) -> Result<(), String> {
        let wanted = self.wanted(state);
        for function in &self.derivatives {
            let found = self.value(function, state)?;
            let what = format!("derivative by {}", function.formulation);
            let off = self.equal(&what, &found, &wanted, EXACT)?;
            worst.derivative = worst.derivative.max(off);
        }
        Ok(())
    }

    /// Compares entry by entry, accelerations relative to the largest of them, first-order states each on
    /// its own scale.
    fn equal(&self, what: &str, found: &[Dd], wanted: &[Dd], allowed: f64) -> Result<f64, String> {
        let names = self.names();
        assert_eq!((found.len(), wanted.len()), (names.len(), names.len()));
        let coordinates = self.system.scene.layout.coordinates.len();
        let size = |x: Dd| x.to_f64().abs();
        let largest = wanted[..coordinates]
            .iter()
            .fold(1.0, |m, &x| size(x).max(m));
        let mut worst = 0.0_f64;
        for (i, (&x, &y)) in found.iter().zip(wanted).enumerate() {
            let scale = if i < coordinates {
                largest
            } else {
                size(y).max(1e-9)
            };
            let off = size(x - y) / scale;
            if off.is_nan() || off > allowed {
                let (x, y) = (x.to_f64(), y.to_f64());
                return Err(format!(
                    "{what}: rate of {} is {x:e}, by the oracle {y:e}; off by {off:e} of {scale:e}",
                    names[i]
                ));
            }
            worst = worst.max(off);
        }
        Ok(worst)
    }

    /// Checks that the stored energy is the oracle's, and the balance of power is satisfied.
    fn energy(&self, state: &State, worst: &mut Worst) -> Result<(), String> {
        let stored = self.value(&self.energy, state)?;
        let size = stored.iter().fold(1.0, |m: f64, x| m.max(x.to_f64().abs()));
        let sum = stored.into_iter().fold(Dd::ZERO, |s, x| s + x);
        let wanted = self.oracle.answer(state).energy;
        let off = (sum - wanted).to_f64().abs() / size;
        if off.is_nan() || off > EXACT {
            return Err(format!(
                "energy is {:e}, by the oracle {:e}",
                sum.to_f64(),
                wanted.to_f64()
            ));
        }
        let (mut left, mut size) = (Dd::ZERO, 1.0_f64);
        for entry in self.value(&self.power, state)?.chunks(3) {
            left = left + entry[0] - entry[1] - entry[2];
            size = entry.iter().fold(size, |m, x| m.max(x.to_f64().abs()));
        }
        let open = left.to_f64().abs() / size;
        if open.is_nan() || open > EXACT {
            return Err(format!("{:e} W are left over", left.to_f64()));
        }
        (worst.energy, worst.power) = (worst.energy.max(off), worst.power.max(open));
        Ok(())
    }

    /// Checks that the Jacobian times a direction is the slope of the oracle's derivative.
    fn slope(&self, state: &State, along: &State, worst: &mut Worst) -> Result<(), String> {
        let moved = |by: f64| {
            let shift = |x: &Named, d: &Named| -> Named {
                let get = |name: &String| d.get(name).copied().unwrap_or(Dd::ZERO);
                x.iter()
                    .map(|(name, &x)| (name.clone(), x + get(name) * dd(by)))
                    .collect()
            };
            let (q, v, x) = (
                shift(&state.q, &along.q),
                shift(&state.v, &along.v),
                shift(&state.x, &along.x),
            );
            self.wanted(&State {
                q,
                v,
                x,
                ..state.clone()
            })
        };
        let (after, before) = (moved(STEP), moved(-STEP));
        let wanted: Vec<Dd> = after
            .iter()
            .zip(&before)
            .map(|(&a, &b)| (a - b) / dd(2.0 * STEP))
            .collect();
        let direction = self.inputs(&State {
            u: state.u.clone(),
            modes: state.modes.clone(),
            ..along.clone()
        });
        let columns = direction.q.iter().chain(&direction.v).chain(&direction.x);
        for jacobian in &self.jacobians {
            let slopes = self.value(jacobian, state)?;
            let mut found = vec![Dd::ZERO; wanted.len()];
            for (column, &d) in slopes.chunks(wanted.len()).zip(columns.clone()) {
                found
                    .iter_mut()
                    .zip(column)
                    .for_each(|(sum, &x)| *sum += x * d);
            }
            let what = format!("Jacobian by {}", jacobian.formulation);
            let off = self.equal(&what, &found, &wanted, SLOPE)?;
            worst.slope = worst.slope.max(off);
        }
        Ok(())
    }
}
