//! A scene for tests: its state is set by name, its functions are called by the evaluator.

use std::collections::BTreeMap;

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

/// A scene with one state of it.
pub struct Bench {
    pub system: SceneEquations,
    /// The state, the inputs, the accelerations.
    pub at: Inputs<Dd>,
    functions: BTreeMap<SceneFunction, Function>,
}

impl Bench {
    /// The scene at its start, inputs and accelerations zero.
    pub fn new(system: SceneEquations) -> Self {
        let layout = &system.scene.layout;
        let at = Inputs {
            q: system.initial.q.clone(),
            v: system.initial.v.clone(),
            a: vec![Dd::ZERO; layout.nv()],
            x: system.initial.x.clone(),
            u: vec![Dd::ZERO; layout.inputs.len()],
            modes: system.initial.modes.clone(),
            parameters: system.scene.parameters.iter().map(|p| p.default).collect(),
            t: Some(Dd::ZERO),
            passed: vec![],
        };
        Bench {
            system,
            at,
            functions: BTreeMap::new(),
        }
    }

    /// Number of a coordinate.
    pub fn coordinate(&self, name: &str) -> usize {
        let found = self.system.scene.layout.coordinate_named(name);
        found.unwrap_or_else(|| panic!("no coordinate {name}"))
    }

    /// Number of a first-order state.
    pub fn state(&self, name: &str) -> usize {
        let states = &self.system.scene.layout.states;
        let found = states.iter().position(|s| s.name == name);
        found.unwrap_or_else(|| panic!("no state {name}"))
    }

    /// Sets an input.
    pub fn give(&mut self, name: &str, value: f64) {
        let inputs = &self.system.scene.layout.inputs;
        let found = inputs.iter().position(|i| i.name == name);
        self.at.u[found.unwrap_or_else(|| panic!("no input {name}"))] = Dd::from_f64(value);
    }

    /// Sets a run-time parameter.
    pub fn set(&mut self, name: &str, value: f64) {
        let parameters = &self.system.scene.parameters;
        let found = parameters.iter().position(|p| p.name == name);
        self.at.parameters[found.unwrap_or_else(|| panic!("no parameter {name}"))] =
            Dd::from_f64(value);
    }

    /// Returns the value of a scene function in this state.
    pub fn value(&mut self, role: SceneFunction) -> Vec<Dd> {
        let system = &self.system;
        let function = self.functions.entry(role);
        let function = function.or_insert_with(|| system.function(role));
        let (values, refused) = function.evaluate(self.at.clone());
        assert!(refused.is_none(), "singular");
        values
    }

    /// v̇ of a coordinate.
    pub fn acceleration(&mut self, name: &str) -> Dd {
        let j = self.coordinate(name);
        self.value(SceneFunction::Derivative)[j]
    }

    /// ẋ of a first-order state.
    pub fn rate(&mut self, name: &str) -> Dd {
        let i = self.system.scene.layout.nv() + self.state(name);
        self.value(SceneFunction::Derivative)[i]
    }

    /// An output by its name.
    pub fn output(&mut self, name: &str) -> Dd {
        let found = self.system.outputs.iter().position(|o| o.name == name);
        let i = found.unwrap_or_else(|| panic!("no output {name}"));
        self.value(SceneFunction::Outputs)[i]
    }

    /// Power supplied, rate of the energy stored, power dissipated by an effect.
    pub fn power(&mut self, name: &str) -> [Dd; 3] {
        let found = self.system.entries.iter().position(|e| e.name == name);
        let i = found.unwrap_or_else(|| panic!("no entry {name}"));
        let all = self.value(SceneFunction::Power);
        [all[3 * i], all[3 * i + 1], all[3 * i + 2]]
    }
}

/// A decimal as a double-double.
pub fn dd(text: &str) -> Dd {
    text.parse().expect("a decimal")
}

/// Asserts that two numbers agree to `digits` relative to the larger of `size` and the second one.
pub fn agree(what: &str, got: Dd, wanted: Dd, size: f64, digits: f64) {
    let off = (got - wanted).to_f64().abs();
    let size = wanted.to_f64().abs().max(size);
    assert!(
        off <= digits * size,
        "{what}: {got:?}, not {wanted:?}, off by {:e} of {size:e}",
        off / size
    );
}
