//! Checks that compiled scenes give the evaluator's results, word by word: the same operations on the same
//! constants.

use std::path::Path;

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::files::{beside, stem};
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::read_scene;
use bgdyn_runtime::{Canonical, FixedVector, HybridSystem, Slope, StateVector};

/// Number of states per scene.
const STATES: usize = 200;

/// Returns numbers within about `size` of these; numbers with a scale of their own, such as volumes of
/// fluid, change by a fraction of it.
fn around<V: FixedVector<Scalar = f64>>(random: &mut Random, start: &V, size: f64) -> V {
    V::from_entries(|i| {
        let x = start.entries()[i];
        x + random.signed() * if x == 0.0 { size } else { 0.02 * x }
    })
}

/// Returns the generator's own equations of a scene.
fn generated(path: &Path) -> bgdyn_codegen::system::SceneEquations {
    let text = std::fs::read_to_string(path).expect("a scene");
    let load = |mechanism: &str| {
        std::fs::read_to_string(beside(path, mechanism)).map_err(|e| e.to_string())
    };
    let (system, _) = read_scene(&text, &stem(path), load).expect("a sound scene");
    system
}

/// Returns the arguments of the evaluator.
fn inputs(
    system: &bgdyn_codegen::system::SceneEquations,
    [y, modes, u]: [&[f64]; 3],
    t: f64,
) -> Inputs<f64> {
    let (nq, nv) = (system.scene.layout.nq(), system.scene.layout.nv());
    let parameters = system.scene.parameters.iter();
    Inputs {
        q: y[..nq].to_vec(),
        v: y[nq..nq + nv].to_vec(),
        a: vec![],
        x: y[nq + nv..].to_vec(),
        u: u.to_vec(),
        modes: modes.to_vec(),
        parameters: parameters.map(|p| p.default.to_f64()).collect(),
        t: Some(t),
        passed: vec![],
    }
}

fn agrees<S: HybridSystem<f64>>(compiled: &S, path: &Path) {
    let system = generated(path);
    let nq = system.scene.layout.nq();
    let (start, _) = compiled.start();
    let mut random = Random(2007);
    let functions: Vec<(SceneFunction, _)> = system
        .roles()
        .into_iter()
        .map(|role| (role, system.function(role)))
        .collect();
    let evaluate = |role: SceneFunction, inputs: &Inputs<f64>| -> Vec<f64> {
        let found = functions.iter().find(|(r, _)| *r == role);
        found.map_or(vec![], |(_, f)| f.evaluate(inputs.clone()).0)
    };
    for k in 0..STATES {
        let y = around(&mut random, &start, 0.02);
        let m = S::Modes::from_entries(|_| (random.signed() * 1.5).round());
        let u = around(&mut random, &S::Inputs::zero_vector(), 1.0);
        let t = random.signed().abs();
        let inputs = inputs(&system, [y.entries(), m.entries(), u.entries()], t);
        let name = &system.scene.name;
        let Ok(rates) = compiled.derivative(&y, &m, &u, t) else {
            panic!("{name}: state {k} is singular");
        };
        let mut wanted = inputs.v[..nq].to_vec();
        wanted.extend(evaluate(SceneFunction::Derivative, &inputs));
        assert_eq!(rates.entries(), wanted, "{name}: derivative, state {k}");
        if S::Inputs::LEN > 0 {
            let input = compiled.input(&y, &m, &u, t);
            assert_eq!(
                input.entries(),
                evaluate(SceneFunction::Inputs, &inputs),
                "{name}: input"
            );
        }
        let events = compiled.events(&y, &m, &u, t).expect("regular");
        assert_eq!(
            events.entries(),
            evaluate(SceneFunction::Events, &inputs),
            "{name}: events"
        );
        let contacts = compiled.contacts(&y, &m, &u, t).expect("regular");
        let contacts = contacts.as_ref().iter();
        let contacts = contacts.flat_map(|c| [c.slip, c.slip_rate, c.holding, c.margin]);
        assert_eq!(
            contacts.collect::<Vec<_>>(),
            evaluate(SceneFunction::Contacts, &inputs),
            "{name}: contacts"
        );
        let output = compiled.output(&y, &m, &u, t);
        assert_eq!(
            output.entries(),
            evaluate(SceneFunction::Outputs, &inputs),
            "{name}: output"
        );
        let energy = compiled.energy(&y, &m, &u, t);
        assert_eq!(
            energy.as_ref(),
            evaluate(SceneFunction::Energy, &inputs),
            "{name}: energy"
        );
        let power = compiled.power(&y, &m, &u, t).expect("regular");
        let power = power.as_ref().iter();
        let power = power.flat_map(|b| [b.supplied, b.stored_rate, b.dissipated]);
        assert_eq!(
            power.collect::<Vec<_>>(),
            evaluate(SceneFunction::Power, &inputs),
            "{name}: power"
        );
    }
}

macro_rules! agree {
    ($module:ident, $scene:ident, $path:literal) => {
        agrees(&scenes::$module::$scene::<f64>::default(), Path::new($path));
    };
}

#[test]
fn compiled_scenes_equal_the_evaluator() {
    scenes::each_scene!(agree);
}

/// Compares the Jacobian and the canonical form, through the traits.
fn forms_agree<S: Slope<f64> + Canonical<f64>>(compiled: &S, path: &Path) {
    let system = generated(path);
    let layout = &system.scene.layout;
    let (nq, nv) = (layout.nq(), layout.nv());
    let functions = [
        SceneFunction::Jacobian,
        SceneFunction::ToCanonical,
        SceneFunction::FromCanonical,
        SceneFunction::CanonicalRates,
    ];
    let functions = functions.map(|role| system.function(role));
    let (start, _) = compiled.start();
    let mut random = Random(1984);
    let name = &system.scene.name;
    for k in 0..STATES {
        let y = around(&mut random, &start, 0.02);
        let m = S::Modes::from_entries(|_| (random.signed() * 1.5).round());
        let u = around(&mut random, &S::Inputs::zero_vector(), 1.0);
        let t = random.signed().abs();
        let [jacobian, to, from, rates] = &functions;
        let at = |y: &S::State| inputs(&system, [y.entries(), m.entries(), u.entries()], t);

        let (slope, along_time) = compiled.slope(&y, &m, &u, t).expect("regular");
        let wanted = jacobian.evaluate(at(&y)).0;
        let columns = S::State::columns(&slope).chunks(S::State::LEN);
        for (k, column) in columns.chain([along_time.entries()]).enumerate() {
            let rate = |i: usize| if k == nq + i { 1.0 } else { 0.0 };
            let of_positions: Vec<f64> = (0..nq).map(rate).collect();
            assert_eq!(column[..nq], of_positions, "{name}: q̇ in column {k}");
            let n = S::State::LEN - nq;
            assert_eq!(
                column[nq..],
                wanted[k * n..(k + 1) * n],
                "{name}: column {k}"
            );
        }

        let z = compiled.to_canonical(&y, &m, &u, t);
        let mut wanted = y;
        let momenta = to.evaluate(at(&y)).0;
        wanted.entries_mut()[nq..nq + nv].copy_from_slice(&momenta);
        assert_eq!(z, wanted, "{name}: momenta, state {k}");

        let back = compiled.from_canonical(&z, &m, &u, t).expect("regular");
        let velocities = from.evaluate(at(&z)).0;
        wanted.entries_mut()[nq..nq + nv].copy_from_slice(&velocities);
        assert_eq!(back, wanted, "{name}: velocities, state {k}");

        let found = compiled.canonical_rates(&z, &m, &u, t).expect("regular");
        let wanted = rates.evaluate(at(&z)).0;
        assert_eq!(
            found.entries(),
            wanted,
            "{name}: canonical rates, state {k}"
        );
    }
}

macro_rules! forms {
    ($module:ident, $scene:ident, $path:literal) => {
        forms_agree(&scenes::$module::$scene::<f64>::default(), Path::new($path));
    };
}

#[test]
fn compiled_jacobians_and_canonical_forms_equal_the_evaluator() {
    scenes::each_formed!(forms);
}
